// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The world: bodies, shapes, joints, and the step. Two worlds share nothing; a copy of a world has the same
// future, bit for bit. Instantiated for Space2f, Space2d, Space3f and Space3d.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "engine/ccd/continuous_collision.hpp"
#include "engine/contacts/contact_model.hpp"
#include "engine/contacts/contacts.hpp"
#include "engine/core/clone_ptr.hpp"
#include "engine/faults/fault.hpp"
#include "engine/integrators/motion.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/pipeline/joint_set.hpp"
#include "engine/pipeline/step_positions.hpp"
#include "engine/sleeping/sleeping.hpp"
#include "engine/solvers/restitution.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::engine {

/// Parts of a step (step.cpp); the first two run once, the others in every sub-step.
enum class Phase : std::uint8_t {
    BroadPhase,
    NarrowPhase,
    Rows,
    Velocities,
    Solve,
    Move,
    Impacts,
    Relax,
    Positions,
    Correct
};
inline constexpr std::size_t kPhases = 10;
const char* phaseName(Phase phase);  ///< "broad_phase", "narrow_phase", ...

enum class ResidualMeasure : std::uint8_t {
    Change,     ///< largest velocity error that the iteration removed from a row or block
    NaturalMap  ///< how far all rows are from their laws after it (solvers/natural_map.hpp)
};
/// Called after each iteration of the velocity solver with its number in the step, the rows (impulses so far)
/// and its residual as in StepResult.
template <class S>
using IterationObserver = std::function<void(int, const ConstraintRows<S>&, typename S::Real)>;

/// What happened in one step. Spans are valid until the next.
template <class S>
struct StepResult {
    bool nonFinite = false;     ///< a velocity or pose has become NaN or infinite
    std::size_t pairTests = 0;  ///< boxes that the broad phase compared
    std::size_t pairs = 0, contacts = 0, rows = 0;
    std::size_t narrowPhaseCalls = 0;  ///< narrow-phase queries: pairs, or pieces of surfaces
    int iterations = 0;                ///< of the solver, in all sub-steps
    /// Collisions that continuous_collision = conservative_advancement has put at their time, in its order.
    std::span<const ImpactEvent<S>> impacts;
    std::size_t sleeping = 0;  ///< bodies asleep at the end of the step
    bool impactsCut = false;   ///< a body had too many of them and lost the rest of its time
    /// What `residuals` holds, one per iteration [m/s or rad/s].
    ResidualMeasure measure = ResidualMeasure::Change;
    std::span<const typename S::Real> residuals;
    std::span<const Event<S>> events;  ///< what began and ended, in the order of shapes
    bool solverGaveUp = false;         ///< a solver did not reach what it promises and left the best it had
    std::array<double, kPhases> seconds{};  ///< wall time per phase
    std::span<const JointId> broken;        ///< joints that broke in this step; they are gone
};

/// A contact point as the last step solved it. A is the body of lower dense index.
template <class S>
struct ContactView {
    BodyId bodyA, bodyB;
    ShapeId shapeA, shapeB;
    typename S::Vec pointA, pointB, normal;  ///< at the pose where it was found; normal from A to B
    typename S::Real separation;             ///< [m]; < 0: overlap
    typename S::Real normalImpulse;          ///< [N s], >= 0
    typename S::Vec frictionImpulse;         ///< on B [N s]
};

template <class S>
class World {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    /// Throws EngineError for unknown algorithm names and for numbers out of range.
    explicit World(const WorldDef<S>& def);

    // --- building. Each throws EngineError for values out of range.
    BodyId addBody(const BodyDef<S>& def);
    /// Removes the body with its shapes, joints and forces.
    void removeBody(BodyId body);
    ShapeId addShape(BodyId body, const ShapeDef<S>& def);
    std::uint32_t addMaterial(Real friction, Real restitution, Real staticFriction = 0);
    /// Coefficients of two materials instead of what WorldDef's combine rules make of them (by default
    /// sqrt(mu_a mu_b) and min(e_a, e_b)).
    void setPair(std::uint32_t materialA, std::uint32_t materialB, const PairCoefficients<S>& coefficients);
    JointId addJoint(const JointDef<S>& def);
    void removeJoint(JointId joint);
    /// A force that the integrator evaluates itself, at each of its stages.
    ForceId addForce(const ForceDef<S>& def);
    void removeForce(ForceId force);

    /// All shapes, in the order of their dense indices; those of removed bodies are gone.
    std::span<const ShapeRecord<S>> shapes() const { return contacts_.shapes().records(); }
    Pose<S> shapePose(const ShapeRecord<S>& shape) const {
        return compose<S>(bodies_.pose[shape.body], shape.local);
    }  ///< now, world frame
    BodyId bodyOf(const ShapeRecord<S>& shape) const { return bodies_.id[shape.body]; }

    // --- running
    /// Force [N] and torque [N m] at the centre of mass, world frame, during the next step. Adds up.
    void applyForce(BodyId body, const Vec& force, const Ang& torque);
    /// Changes linear and angular momentum at once [N s], [N m s].
    void applyImpulse(BodyId body, const Vec& impulse, const Ang& angularImpulse);
    /// Advances by h [s], > 0.
    const StepResult<S>& step(Real h);
    /// The same a phase at a time: beginStep(h), then runPhase() while stepping(). Between phases everything
    /// may be read; bodies, shapes and joints may not be added or removed.
    void beginStep(Real h);
    bool stepping() const { return progress_.active; }
    Phase nextPhase() const { return nextStage().phase; }
    int substep() const { return nextStage().substep; }  ///< of the next phase: 0 .. substeps() - 1
    void runPhase();
    /// Sets the observer of the solver, null: none. Copies of the world have the same observer.
    void observeIterations(IterationObserver<S> observer) { observer_ = std::move(observer); }

    // --- joints while running; coordinates are numbered as in JointDef. Throw EngineError as addJoint does.
    bool contains(JointId joint) const { return jointIds_.contains(joint); }
    int jointAxes(JointId joint) const { return joint_(joint).axisCount; }
    Real jointCoordinate(JointId joint, int axis = 0) const;  ///< [m] or [rad], angles over turns
    Real jointSpeed(JointId joint, int axis = 0) const;       ///< its rate [m/s] or [rad/s]
    Vec jointForce(JointId joint) const;   ///< mean of the last step, of A on B at B's anchor [N]
    Ang jointTorque(JointId joint) const;  ///< likewise, about B's anchor [N m]
    /// Replaces the limits, motor and spring of a coordinate.
    void setJointAxis(JointId joint, int axis, const JointAxis<Real>& control);
    /// Motor of a coordinate: its speed [m/s] or [rad/s] and largest force or torque; 0: none.
    void setJointMotor(JointId joint, int axis, Real speed, Real maxForce);
    /// Where the spring of a coordinate pulls to [m] or [rad].
    void setJointTarget(JointId joint, int axis, Real target);
    const JointAxis<Real>& jointAxis(JointId joint, int axis = 0) const;

    // --- reading
    std::size_t bodyCount() const { return bodies_.size() - 1; }
    bool contains(BodyId body) const { return bodyIds_.contains(body); }
    bool contains(ForceId force) const { return forces_.contains(force); }
    double time() const { return time_; }  ///< the sum of all steps [s]
    Pose<S> pose(BodyId body) const;       ///< of the body frame
    Vec velocity(BodyId body) const {
        return bodies_.velocity[bodyIds_.dense(body)].v;
    }  ///< of the centre of mass
    Ang angularVelocity(BodyId body) const { return bodies_.velocity[bodyIds_.dense(body)].w; }
    const BodyConstants<S>& constants(BodyId body) const { return bodies_.constants[bodyIds_.dense(body)]; }
    void setVelocity(BodyId body, const Vec& velocity, const Ang& angularVelocity);
    const PairCoefficients<S>& pairCoefficients(std::uint32_t a, std::uint32_t b) const;
    const WorldDef<S>& def() const { return def_; }
    /// Sub-steps of a step, and most iterations of each: the settings, or the solver's own.
    int substeps() const { return def_.substeps > 0 ? def_.substeps : style_.substeps; }
    int velocityIterations() const {
        return def_.velocityIterations > 0 ? def_.velocityIterations : style_.iterations.value_or(50);
    }
    const StepResult<S>& lastStep() const { return result_; }
    /// The boxes that the broad phase has compared in the last step, in the order of shapes() [m], world
    /// frame; those of dynamic bodies are grown by the speculative distance. Empty before the first broad
    /// phase.
    std::span<const Aabb<S>> boxes() const { return contacts_.shapes().boxes(); }
    /// Shapes whose boxes overlapped then, as indices of shapes(), the lower one first.
    std::span<const ProxyPair> pairs() const { return contacts_.pairs(); }
    /// What the last narrow phase found of them, sorted by shapes: normal, points with their separations and
    /// features, and the impulses they start with. Also points that the solver has no need of.
    const ContactList<S>& manifolds() const { return contacts_.list(); }
    /// Replaces `out` by the contacts of the last step: the points that got rows.
    void readContacts(std::vector<ContactView<S>>& out) const;
    /// The rows of the last sub-step, solved or not yet.
    const ConstraintRows<S>& rows() const { return rows_; }
    /// Where a joint's rows stand among them: the first, and how many.
    std::pair<std::uint32_t, std::uint32_t> jointRows(JointId joint) const;
    /// Impulses of a joint's rows in the last step, summed over its sub-steps [N s] or [N m s].
    std::span<const Real> jointImpulses(JointId joint) const;
    /// Of the contacts and joints of the last step, between dynamic bodies, asleep or not. Found when they
    /// are asked for, so the first to ask after a step must be alone.
    const Islands& islands() const {
        if (islandsStale_) findIslands();
        return islands_;
    }
    bool isAsleep(BodyId body) const { return bodies_.asleep[bodyIds_.dense(body)]; }
    /// Of everything that decides the future (state/state_fields.def).
    std::uint64_t stateHash() const;

    // --- saving and going on
    /// Replaces `bytes` by the state. Restored into a world that was built alike it has the same future, bit
    /// for bit. Throws EngineError "step_in_progress" between the phases of a step.
    void saveSnapshot(std::vector<unsigned char>& bytes) const;
    /// Throws EngineError "snapshot_format" (not a snapshot, or of another version), "snapshot_corrupt",
    /// "snapshot_world" (another dimension, precision, or other bodies, shapes, joints, forces), and leaves
    /// the world as it is.
    void restoreSnapshot(std::span<const unsigned char> bytes);

  private:
    /// A part of a step, and the sub-step that it belongs to.
    struct Stage {
        Phase phase = Phase::BroadPhase;
        int substep = 0;
    };
    /// How far the step is.
    struct Progress {
        bool active = false;
        int stagesDone = 0;
        int substep = 0;                 ///< of the stage that runs, or has run last
        Real size = 0, substepSize = 0;  ///< [s]
    };

    using Work = void (World::*)();

    template <class Visitor>
    void forEachStage(const Visitor& stage) const;
    void runStage(Phase phase, int substep, Work work);
    Stage nextStage() const;
    void findPairs();
    void findManifolds();
    void solve();
    void move();
    void endStep();
    BiasRule<Real> biasRule() const;
    Load<S> load() const;
    ContactStep<S> contactStep() const;
    void makeRows();
    void solveVelocities(int iterations, bool warmStarted);
    void resolveImpacts();
    void relax();
    void kick();
    void findIslands() const;
    ContactSearch<S> contactSearch() const;
    SleepStep<S> sleepStep();
    void wakeIslandOf(std::uint32_t body);
    void wakeNeighboursOf(std::uint32_t body);
    void solveImpacts();
    void solvePositions();
    void correct();
    void injectFault(Phase phase);
    void rebuildExclusions();
    void breakJoints();
    const Joint<S>& joint_(JointId joint) const { return joints_.records()[jointIds_.dense(joint)].joint; }
    void checkFinite();
    template <class A, class W>
    static void visitState(A& archive, W& world);
    std::uint64_t structureHash() const;
    void checkRestored(std::size_t bodyCount) const;
    std::uint32_t bodyOrWorld(BodyId id) const { return id ? bodyIds_.dense(id) : 0; }

    WorldDef<S> def_;
    Motion<S> motion_;
    std::shared_ptr<const NarrowPhase<S>> narrowPhase_;
    ManifoldFunction<S> makeManifold_ = nullptr;
    FrictionLaw<S> friction_ = nullptr;
    ClonePtr<BroadPhase<S>> broadPhase_;
    ClonePtr<Solver<S>> solver_;
    ClonePtr<PositionCorrection<S>> correction_;
    ClonePtr<ContinuousCollision<S>> ccd_;
    SleepingScheme<S> sleeping_;
    ClonePtr<Restitution<S>> restitution_;
    SolverStyle<S> style_;
    const Fault<S>* fault_ = nullptr;
    Tasks tasks_;

    BodyArrays<S> bodies_;
    IdTable<BodyTag> bodyIds_;
    IdTable<JointTag> jointIds_;
    Contacts<S> contacts_;
    ClonePtr<ContactModel<S>> contactModel_;
    JointSet<S> joints_;
    ForceSet<S> forces_;
    double time_ = 0;  ///< [s]
    Real lastStepSize_ = 0;
    std::uint64_t stepCount_ = 0;

    // --- recomputed every step
    Progress progress_;
    JointStep<S> jointStep_{};
    ConstraintRows<S> rows_;
    std::size_t jointRows_ = 0;  ///< of rows_, which come first
    PositionScratch<S> positionScratch_;
    mutable Islands islands_;
    mutable std::vector<std::uint8_t> islandMarks_;
    mutable bool islandsStale_ = false;  ///< they are not yet those of contacts_
    std::vector<Real> residuals_, warmStart_;
    std::vector<Event<S>> events_;
    std::vector<JointId> broken_;
    std::vector<ImpactEvent<S>> impacts_;
    IterationObserver<S> observer_;
    StepResult<S> result_;
};

}  // namespace rigor::engine
