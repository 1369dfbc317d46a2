// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One step of a world: the loop over its stages (step.cpp) and what each stage does (stages.cpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ccd/flight_impacts.hpp"
#include "engine/core/disjoint_sets.hpp"
#include "engine/pipeline/joint_convergence.hpp"
#include "engine/pipeline/step_positions.hpp"
#include "engine/pipeline/step_result.hpp"
#include "engine/pipeline/world_parts.hpp"

namespace rigor::engine {

/// Way of a body from where the step began to where its contacts were found.
template <class S>
struct Lead {
    Pose<S> start, middle;  ///< poses at its two ends
    Velocity<S> motion;     ///< translation [m], rotation vector [rad]
};

/// A body that others hold has landed within the step (step_landings.cpp).
template <class S>
struct Landing {
    std::uint32_t body;
    typename S::Real time;    ///< fraction of the step before it: the mean of its points
    typename S::Real points;  ///< number of the points that land
    Velocity<S> change;       ///< velocity before the step minus that after it
};

/// Data that a step keeps from stage to stage. None of it decides the future of a world between steps.
template <class S>
struct StepState {
    using Real = typename S::Real;
    // --- how far the step is
    bool active = false;
    int stagesDone = 0;
    int substep = 0;                 ///< index of the sub-step of the stage that runs, or has run last
    Real size = 0, substepSize = 0;  ///< [s]
    Real lastSubstepSize = 0;        ///< sub-step of the impulses that the rows start from [s]
    // --- which islands take part (island_method.hpp)
    IslandKind islands =
        IslandKind::Usual;          ///< kind of those that the stage works on that runs, or has run last
    PerIslandKind<bool> any{true};  ///< islands of that kind that are awake
    IslandSort<S> sort;
    // --- the problem of the sub-step
    JointStep<S> jointStep{};
    ConstraintRows<S> rows;
    std::size_t jointRows = 0;  ///< number of joint rows; they come first in `rows`
    std::vector<Real> warmStart;
    JointConvergence<S> convergence;
    PartProblem<S> part;  ///< parts that are solved again
    PositionScratch<S> positions;
    ConstraintRows<S> noContacts;         ///< always empty
    std::vector<Velocity<S>> still, way;  ///< zero; velocities of each body in the last sub-step
    // --- the second search (step_second_search.cpp)
    std::vector<Velocity<S>> foreseen;    ///< velocities that the first search has looked ahead with
    std::vector<std::uint8_t> disturbed;  ///< bodies that have others by now
    bool searchedAgain = false;           ///< in the islands that the stage works on
    PerIslandKind<Real> searchTime;  ///< time of the step at which contacts of the islands were found [s]
    std::vector<Lead<S>> leads;  ///< ways to the midpoints; integrators that have none leave them as they are
    DisjointSets jointed;        ///< bodies that joints connect
    std::vector<std::uint8_t> leaving;  ///< roots of those of which one leaves its midpoint
    std::vector<std::uint8_t> renewed;  ///< bodies whose midpoints were found anew in this step
    FlightImpacts<S> flights;
    std::vector<std::uint8_t> mayLand;  ///< bodies whose landings are impacts at their own time
    std::vector<Velocity<S>> before;    ///< velocities before the forces of the step
    std::vector<Landing<S>> landings;
    std::vector<LandingPoint<Real>> bounces;
    std::vector<Velocity<S>> delay, delayAtEnd;  ///< velocities that bounces take from the means of bodies
    std::vector<Real> firstBounce;               ///< times of the bodies' first bounces; 0: none
    std::vector<Real> startImpulses;             ///< impulses of the rows before the solve
    std::vector<std::uint32_t> bouncing;         ///< contacts that bounce within the step, by time
    std::vector<std::uint32_t> partners;         ///< the one body that acts on each
    std::vector<std::uint8_t> bounceBlocks;      ///< blocks that bounce or pass it on
    std::vector<std::pair<std::uint32_t, Real>> passedOn;  ///< blocks that pass a bounce on, and its time
    std::vector<std::pair<std::uint32_t, Real>> held;      ///< rows and impulses that act before landings
    std::vector<std::uint8_t> bound;                       ///< bodies that joints hold or forces act on
    // --- what the result refers to
    std::vector<Real> residuals;
    std::vector<ImpactEvent<S>> impacts;
    std::vector<Event<S>> events;
    std::vector<JointId> broken;
    StepResult<S> result;

    IterationObserver<S> observer;
};

template <class S>
class Step {
  public:
    using Real = typename S::Real;
    /// A part of a step, and the sub-step that it belongs to.
    struct Stage {
        Phase phase = Phase::BroadPhase;
        int substep = 0;
    };

    /// The step of the islands that take part in it now.
    Step(WorldParts<S>& world, StepState<S>& state, IslandKind islands = IslandKind::Usual);

    /// Begins a step of h [s]. Throws EngineError for a size out of range, and where a step has not ended.
    void begin(Real h);
    void runAll();
    /// Runs the next stage; the last one ends the step.
    void runNext();
    static Stage next(const WorldParts<S>& world, const StepState<S>& state);

  private:
    using Ang = typename S::Ang;
    using Work = void (Step::*)();
    using Clock = std::chrono::steady_clock;

    template <class Visitor>
    static void forEachStage(const WorldParts<S>& world, const StepState<S>& state, const Visitor& stage);
    void run(Phase phase, int substep, Work work, Clock::time_point& mark);
    void end();
    void abandon();
    void injectFault(Phase phase);

    // --- islands by kind
    void sortIslands();
    bool isShared() const;
    void joinByForces(const Islands& islands);
    void beginIslands();
    void pauseOthers();
    std::span<const std::uint8_t> pausedBodies() const;
    void placeKinematic(int substeps, Real later = 0);
    void resume(std::uint32_t body);
    void endIslands();
    void sortImpacts();

    // --- stages
    void findPairs();
    void findManifolds();
    void searchAgain();
    void makeRows();
    void kick();
    void solve();
    void move();
    void resolveImpacts();
    void relax();
    void solvePositions();
    void correct();

    // --- data shared by them
    MovedWorld<S> movedWorld(Real h, Real begin, std::span<const std::uint8_t> paused = {});
    // step_midpoints.cpp
    void toMidpoints();
    bool moveToMidpoints(bool same);
    Real halfOf(IslandKind islands) const;
    void measureLead(std::size_t body);
    void changeHalves(std::span<const IslandKind> before);
    void moveContact(Contact<S>& contact, const typename S::Vec& pA, const Velocity<S>& a,
                     const typename S::Vec& pB, const Velocity<S>& b) const;
    void toEnd();
    void releaseBroken();
    void leaveMidpointsOfJoints();
    StepPositions<S> jointPositions();
    bool hasRenewed() const;
    bool beginDrift(bool there);
    void endDrift(bool drifts, bool there);
    // step_shown.cpp
    void showContacts();
    Velocity<S> motionToEnd(const Contact<S>& contact, std::uint32_t body) const;
    void showAtEnd(Contact<S>& contact, const RowLags<S>& lags) const;
    void showGap(Contact<S>& contact) const;
    // step_first_frames.cpp
    void findRenewed(bool same);
    void findFirstFrames();
    // step_second_search.cpp
    bool findDisturbed();
    bool hasMovingSurface() const;
    // step_violent.cpp
    void findViolent();
    static bool mayBeViolent(std::size_t contacts);
    static bool isViolent(const typename IslandSort<S>::Counts& counts);
    void countViolent(const Islands& islands);
    // step_bounces.cpp
    void placeBounces();
    MovingShape<S> movingShapeOf(std::uint32_t shape) const;
    void findBounces();
    void leaveSecondBounces();
    void spreadBounces();
    void delayBounces();
    void shortenBounces();
    void showBounces();
    // step_landings.cpp
    void findLandingBodies();
    void beginLandings();
    void placeLandings();
    void shortenLandings();
    void beginFlights();
    void endFlights();
    bool rowsLag() const;
    /// Bodies land and bounce at their own times within the step.
    bool locatesLandings() const { return algorithms_.locatesImpacts && rowsLag(); }
    ContactStep<S> contactStep() const;
    BiasRule<Real> biasRule() const;
    void solveVelocities(int iterations, bool warmStarted);
    void solveLinearised(const SolverInput<S>& input, std::span<const std::uint32_t> blocks);
    void solveImpacts();
    void countContacts();
    void advanceContacts();
    SleepStep<S> sleepStep();
    void breakJoints();
    bool isFinite() const;

    WorldParts<S>& world_;
    StepState<S>& state_;
    // --- parts of both, by the names that the stages use
    const WorldDef<S>& def_;
    StepAlgorithms<S>& algorithms_;
    IslandKind kind_;          ///< kind of the islands that take part
    IslandMethod<S>& method_;  ///< their method
    const Tasks& tasks_;
    BodyArrays<S>& bodies_;
    Contacts<S>& contacts_;
    JointSet<S>& joints_;
    Motion<S>& motion_;
    ContactModel<S>& contactModel_;
    ConstraintRows<S>& rows_;
    StepResult<S>& result_;
};

}  // namespace rigor::engine
