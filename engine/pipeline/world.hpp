// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The world: bodies, shapes, joints, and the step. Two worlds share nothing; a copy of a world has the same
// future, bit for bit. Instantiated for Space2f, Space2d, Space3f and Space3d.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/integrators/motion.hpp"
#include "engine/pipeline/contact_set.hpp"
#include "engine/pipeline/events.hpp"
#include "engine/pipeline/joint_set.hpp"
#include "engine/pipeline/step_positions.hpp"
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
    Relax,
    Positions,
    Correct
};
inline constexpr std::size_t kPhases = 9;
const char* phaseName(Phase phase);  ///< "broad_phase", "narrow_phase", ...

/// What happened in one step. Spans are valid until the next.
template <class S>
struct StepResult {
    bool nonFinite = false;     ///< a velocity or pose has become NaN or infinite
    std::size_t pairTests = 0;  ///< boxes that the broad phase compared
    std::size_t pairs = 0, contacts = 0, rows = 0;
    int iterations = 0;  ///< of the solver, in all sub-steps
    /// Largest velocity error removed from a row or block, per iteration [m/s or rad/s].
    std::span<const typename S::Real> residuals;
    std::span<const Event<S>> events;       ///< what began and ended, in the order of shapes
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
    /// Removes the body with its shapes and joints.
    void removeBody(BodyId body);
    ShapeId addShape(BodyId body, const ShapeDef<S>& def);
    std::uint32_t addMaterial(Real friction, Real restitution);
    /// Coefficients of two materials instead of sqrt(mu_a mu_b) and min(e_a, e_b).
    void setPair(std::uint32_t materialA, std::uint32_t materialB, const PairCoefficients<S>& coefficients);
    JointId addJoint(const JointDef<S>& def);
    void removeJoint(JointId joint);

    /// All shapes, in the order of their dense indices; those of removed bodies are gone.
    std::span<const ShapeRecord<S>> shapes() const { return contacts_.shapes(); }
    Pose<S> shapePose(const ShapeRecord<S>& shape) const {
        return compose<S>(bodies_.pose[shape.body], shape.local);
    }  ///< now, world frame
    BodyId bodyOf(const ShapeRecord<S>& shape) const { return bodies_.id[shape.body]; }

    // --- running
    /// Force [N] and torque [N m] at the centre of mass, world frame, during the next step. Adds up.
    void applyForce(BodyId body, const Vec& force, const Ang& torque);
    /// Advances by h [s], > 0.
    const StepResult<S>& step(Real h);
    /// The same a phase at a time: beginStep(h), then runPhase() while stepping(). Between phases everything
    /// may be read; bodies, shapes and joints may not be added or removed.
    void beginStep(Real h);
    bool stepping() const { return cursor_.active; }
    Phase nextPhase() const { return cursor_.next; }
    int substep() const { return cursor_.substep; }  ///< 0 .. def().substeps - 1
    void runPhase();

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
    Pose<S> pose(BodyId body) const;  ///< of the body frame
    Vec velocity(BodyId body) const {
        return bodies_.velocity[bodyIds_.dense(body)].v;
    }  ///< of the centre of mass
    Ang angularVelocity(BodyId body) const { return bodies_.velocity[bodyIds_.dense(body)].w; }
    const BodyConstants<S>& constants(BodyId body) const { return bodies_.constants[bodyIds_.dense(body)]; }
    void setVelocity(BodyId body, const Vec& velocity, const Ang& angularVelocity);
    const PairCoefficients<S>& pairCoefficients(std::uint32_t a, std::uint32_t b) const;
    const WorldDef<S>& def() const { return def_; }
    const StepResult<S>& lastStep() const { return result_; }
    /// Replaces `out` by the contacts of the last step.
    void readContacts(std::vector<ContactView<S>>& out) const;
    /// The rows of the last sub-step, solved or not yet.
    const ConstraintRows<S>& rows() const { return rows_; }
    /// Impulses of a joint's rows in the last step, summed over its sub-steps [N s] or [N m s].
    std::span<const Real> jointImpulses(JointId joint) const;
    /// Of everything that decides the future.
    std::uint64_t stateHash() const;

  private:
    /// Where in a step we are.
    struct Cursor {
        bool active = false;
        Phase next = Phase::BroadPhase;
        std::size_t place = 0;  ///< in the order of a sub-step
        int substep = 0;
        Real size = 0, substepSize = 0;  ///< [s]
    };

    void advanceCursor();
    void endStep();
    bool firstStep() const { return stepCount_ == 0 && cursor_.substep == 0; }
    BiasRule<Real> biasRule() const;
    void makeRows();
    void solveVelocities(int iterations, bool warmStarted);
    void relax();
    void solvePositions();
    void correct();
    void spoil(Phase phase);
    void rebuildExclusions();
    void breakJoints();
    const Joint<S>& joint_(JointId joint) const { return joints_.records()[jointIds_.dense(joint)].joint; }
    void checkFinite();
    std::uint32_t bodyOrWorld(BodyId id) const { return id ? bodyIds_.dense(id) : 0; }

    WorldDef<S> def_;
    Motion<S> motion_;
    std::shared_ptr<const NarrowPhase<S>> narrowPhase_;
    FrictionLaw<S> friction_ = nullptr;
    ClonePtr<BroadPhase<S>> broadPhase_;
    ClonePtr<Solver<S>> solver_;
    ClonePtr<PositionCorrection<S>> correction_;
    SolverStyle<S> style_;
    const Fault<S>* fault_ = nullptr;

    BodyArrays<S> bodies_;
    IdTable<BodyTag> bodyIds_;
    IdTable<ShapeTag> shapeIds_;
    IdTable<JointTag> jointIds_;
    ContactSet<S> contacts_;
    JointSet<S> joints_;
    Real lastStepSize_ = 0;
    std::uint64_t stepCount_ = 0;

    // --- recomputed every step
    Cursor cursor_;
    JointStep<S> jointStep_{};
    ConstraintRows<S> rows_;
    PositionScratch<S> positionScratch_;
    std::vector<Real> residuals_;
    std::vector<Event<S>> events_;
    std::vector<JointId> broken_;
    StepResult<S> result_;
};

}  // namespace rigor::engine
