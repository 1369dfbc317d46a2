// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The world: what a program builds, steps and reads. Two worlds share nothing; a copy of a world has the same
// future, bit for bit. Instantiated for Space2f, Space2d, Space3f and Space3d.
//
// A world is its parts (world_parts.hpp) and the state of a step (step.hpp). This class checks the arguments
// of calls, wakes the bodies that they may move, and passes the calls on to the parts.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/pipeline/events.hpp"
#include "engine/pipeline/step.hpp"
#include "engine/pipeline/world_parts.hpp"

namespace rigor::engine {

template <class S>
class World {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    using Ang = typename S::Ang;

    /// Throws EngineError for unknown algorithm names and for numbers out of range.
    explicit World(const WorldDef<S>& def);

    // --- building. Each throws EngineError for values out of range and then leaves the world as it was.
    BodyId addBody(const BodyDef<S>& def);
    /// Removes the body with its shapes, joints and forces.
    void removeBody(BodyId body);
    ShapeId addShape(BodyId body, const ShapeDef<S>& def);
    /// Removes the shape; its contacts end, and what touched its body wakes. A body whose mass is that of its shapes
    /// gets another one. Throws EngineError "step_in_progress" between the phases of a step.
    void removeShape(ShapeId shape);
    bool contains(ShapeId shape) const { return parts_.contacts.shapes().ids().contains(shape); }
    /// Replaces what a shape collides with, and wakes the bodies that this may move. Contacts that it no longer
    /// allows end in the next step. Throws EngineError "step_in_progress" between the phases of a step.
    void setFilter(ShapeId shape, const ShapeFilter& filter);
    const ShapeFilter& filter(ShapeId shape) const {
        return parts_.contacts.shapes()[parts_.contacts.shapes().ids().dense(shape)].filter;
    }
    std::uint32_t addMaterial(Real friction, Real restitution, Real staticFriction = 0);
    /// The same with rolling and torsional friction. Throws EngineError "material_moments" where these are negative.
    std::uint32_t addMaterial(const PairCoefficients<S>& own);
    /// Number of materials, with those that each world has.
    std::size_t materialCount() const { return parts_.contacts.materials().size(); }
    /// Coefficients of two materials instead of what WorldDef's combine rules make of them (by default
    /// sqrt(mu_a mu_b) and min(e_a, e_b)).
    void setPair(std::uint32_t materialA, std::uint32_t materialB, const PairCoefficients<S>& coefficients);
    JointId addJoint(const JointDef<S>& def);
    void removeJoint(JointId joint);
    /// A force that the integrator evaluates itself, at each of its stages.
    ForceId addForce(const ForceDef<S>& def);
    void removeForce(ForceId force);

    /// All shapes, in the order of their dense indices; those of removed bodies are gone.
    std::span<const ShapeRecord<S>> shapes() const { return parts_.contacts.shapes().records(); }
    Pose<S> shapePose(const ShapeRecord<S>& shape) const {
        return compose<S>(parts_.bodies.arrays().pose[shape.body], shape.local);
    }  ///< now, world frame
    BodyId bodyOf(const ShapeRecord<S>& shape) const { return parts_.bodies.arrays().id[shape.body]; }

    // --- running
    /// Force [N] and torque [N m] at the centre of mass, world frame, during the next step. Adds up.
    void applyForce(BodyId body, const Vec& force, const Ang& torque);
    /// Changes linear and angular momentum at once [N s], [N m s].
    void applyImpulse(BodyId body, const Vec& impulse, const Ang& angularImpulse);
    /// The same at a point of the world frame [m]: force, with its moment about the centre of mass.
    void applyForceAt(BodyId body, const Vec& force, const Vec& point);
    void applyImpulseAt(BodyId body, const Vec& impulse, const Vec& point);
    /// Advances by h [s], > 0.
    const StepResult<S>& step(Real h);
    /// The same a phase at a time: beginStep(h), then runPhase() while stepping(). Between phases everything
    /// may be read; bodies, shapes and joints may not be added or removed.
    void beginStep(Real h);
    bool stepping() const { return step_.active; }
    Phase nextPhase() const { return Step<S>::next(parts_, step_).phase; }
    int substep() const {
        return Step<S>::next(parts_, step_).substep;
    }  ///< sub-step of the next phase: 0 .. substeps() - 1
    void runPhase();
    /// Sets the callback that may refuse a contact, change its coefficients, or let its surfaces move, before a step
    /// solves it (contacts/pre_solve.hpp); null: none. Copies of the world have the same callback. What it throws ends the step
    /// where it is and leaves step(); the world may go on from there, or from a snapshot. A callback may read the world
    /// but not change it.
    void setPreSolve(PreSolve<S> callback);
    /// Sets the observer of the solver, null: none. Copies of the world have the same observer.
    void observeIterations(IterationObserver<S> observer) { step_.observer = std::move(observer); }

    // --- joints while running; coordinates are numbered as in JointDef. Throw EngineError as addJoint does.
    bool contains(JointId joint) const { return parts_.joints.ids().contains(joint); }
    int jointAxes(JointId joint) const { return parts_.joints.joint(joint).axisCount; }
    Real jointCoordinate(JointId joint, int axis = 0) const {
        return parts_.joints.coordinate(joint, axis, parts_.bodies.arrays());
    }  ///< [m] or [rad], angles over turns
    Real jointSpeed(JointId joint, int axis = 0) const {
        return parts_.joints.speed(joint, axis, parts_.bodies.arrays());
    }  ///< its rate [m/s] or [rad/s]
    Vec jointForce(JointId joint) const {
        return parts_.joints.force(joint, parts_.lastStepSize());
    }  ///< mean of the last step, of A on B at B's anchor [N]
    Ang jointTorque(JointId joint) const {
        return parts_.joints.torque(joint, parts_.lastStepSize());
    }  ///< mean torque of the last step, of A on B about B's anchor [N m]
    /// Replaces the limits, motor and spring of a coordinate.
    void setJointAxis(JointId joint, int axis, const JointAxis<Real>& control);
    /// Motor of a coordinate: its speed [m/s] or [rad/s] and largest force or torque; 0: none.
    void setJointMotor(JointId joint, int axis, Real speed, Real maxForce);
    /// Sets the rest value of a coordinate's spring [m] or [rad].
    void setJointTarget(JointId joint, int axis, Real target);
    const JointAxis<Real>& jointAxis(JointId joint, int axis = 0) const {
        return parts_.joints.axis(joint, axis);
    }

    // --- reading
    std::size_t bodyCount() const { return parts_.bodies.size() - 1; }
    /// All bodies. Changed by adding and removing them.
    std::span<const BodyId> bodies() const { return std::span(parts_.bodies.arrays().id).subspan(1); }
    /// Replaces `out` by all joints, in the order in which they were added.
    void readJoints(std::vector<JointPlace<S>>& out) const;
    bool contains(BodyId body) const { return parts_.bodies.ids().contains(body); }
    bool contains(ForceId force) const { return parts_.forces.contains(force); }
    double time() const { return parts_.clock.time; }                     ///< the sum of all steps [s]
    Pose<S> pose(BodyId body) const { return parts_.bodies.pose(body); }  ///< pose of the body frame
    Vec velocity(BodyId body) const {
        return parts_.bodies.velocity(body).v;
    }  ///< velocity of the centre of
       ///< mass
    Ang angularVelocity(BodyId body) const { return parts_.bodies.velocity(body).w; }
    Vec velocityAt(BodyId body,
                   const Vec& point) const;  ///< velocity of the body's point at `point`, world frame
    const BodyConstants<S>& constants(BodyId body) const { return parts_.bodies.constants(body); }
    void setVelocity(BodyId body, const Vec& velocity, const Ang& angularVelocity);
    /// Velocity of a shape's surface over its body, as ShapeDef::surfaceVelocity; wakes what may rest on it. Throws
    /// EngineError "shape_surface_velocity" where it is not finite, "step_in_progress" between the phases of a step.
    void setSurfaceVelocity(ShapeId shape, const Velocity<S>& surface);
    /// The velocity that was set, as in ShapeDef.
    Velocity<S> surfaceVelocity(ShapeId shape) const;
    /// Puts a body elsewhere, of any type, without a way between: its velocity stays, its contacts begin anew, and
    /// what it touched or hung on wakes. Joints pull it back. Throws EngineError "body_pose" for poses that are
    /// not finite or no rotation, "step_in_progress" between the phases of a step.
    void setPose(BodyId body, const Pose<S>& pose);
    /// Wakes the island of a body, or puts it to sleep at once; a static or kinematic body has none. Throws
    /// EngineError "sleeping" where the world has no sleeping that would wake it.
    void wake(BodyId body);
    void putToSleep(BodyId body);

    // --- changes while running. Each wakes what it may set in motion, and throws EngineError "step_in_progress" between
    // the phases of a step. A snapshot is of a world with the same types, masses, densities, materials, gravity scales
    // and continuous modes; restoring it sets gravity back.
    /// Makes a body static, kinematic or dynamic. A static one loses its velocity; others keep theirs. A dynamic one has
    /// the mass that its definition or its shapes give it. Throws "half_space_body", "surface_body" for shapes that need
    /// a static body.
    void setType(BodyId body, BodyType type);
    /// Mass [kg], centre of mass in the body frame [m], inertia about it, body axes [kg m^2] of a dynamic body, by hand:
    /// shapes no longer change them. Every point of the body keeps its velocity. Throws "body_mass",
    /// "body_center_of_mass", "body_inertia".
    void setMass(BodyId body, const MassProperties<S>& properties);
    /// The mass properties of the shapes, by their densities, from now on; scaled to `mass` [kg] if that is > 0.
    void setMassOfShapes(BodyId body, Real mass = 0);
    /// Density of a shape [kg/m^3] (2D: [kg/m^2]), >= 0; changes its body's mass if that is of its shapes. Throws
    /// "shape_density", for sensors, too.
    void setDensity(ShapeId shape, Real density);
    /// Throws "shape_material" for a material that there is not.
    void setMaterial(ShapeId shape, std::uint32_t material);
    /// Gravity of the world [m/s^2]; def() shows it.
    void setGravity(const Vec& gravity);
    /// Factor on the world's gravity for one body.
    void setGravityScale(BodyId body, Real scale);
    /// Whether continuous collision looks at a body, as BodyDef::continuous. The first body that needs it in a world
    /// without brings the algorithm, and with it rounding: bodies of large scenes no longer move in SIMD, and with
    /// moreau_midpoint impacts of bodies in flight are those of the algorithm.
    void setContinuous(BodyId body, ContinuousMode mode);

    /// Shapes that overlap or touch a sensor, of other bodies, sorted, as they were at the end of the last step
    /// (contacts/sensors.hpp); StepResult::events has the changes. The list is valid until the next step. Throws
    /// EngineError "sensor" for a shape that is none.
    std::span<const SensorOverlap> sensorOverlaps(ShapeId sensor) const;
    const PairCoefficients<S>& pairCoefficients(std::uint32_t a, std::uint32_t b) const;
    const WorldDef<S>& def() const { return parts_.def; }
    /// Sub-steps of a step, and most iterations of each: the settings, or the solver's own.
    int substeps() const { return parts_.substeps(); }
    int velocityIterations() const { return parts_.velocityIterations(); }
    const StepResult<S>& lastStep() const { return step_.result; }
    /// The boxes that the broad phase has compared in the last step, in the order of shapes() [m], world
    /// frame; those of dynamic bodies are grown by the speculative distance. Empty before the first broad
    /// phase.
    std::span<const Aabb<S>> boxes() const { return parts_.contacts.shapes().boxes(); }
    /// Shapes whose boxes overlapped then, as indices of shapes(), the lower one first.
    std::span<const ProxyPair> pairs() const { return parts_.contacts.pairs(); }
    /// Contacts of the last narrow phase, sorted by shapes: normal, points with their separations and
    /// features, and the impulses they start with. The list also has points that the solver does not need.
    const ContactList<S>& manifolds() const { return parts_.contacts.list(); }
    /// Replaces `out` by the contacts of the last step: the points that got rows, and where contacts belong to the end of
    /// the step, shapes that overlap there, and impacts at their own times. Where they lie: contactsAtStepEnd().
    void readContacts(std::vector<ContactView<S>>& out) const;
    /// True if points, normals and separations of contacts are those of the poses at the end of the step, as with
    /// `moreau_midpoint`; false: of the poses at its start, where they were found.
    bool contactsAtStepEnd() const { return parts_.algorithms.usual.motion.isAtMidpoint(); }
    /// The rows of the last sub-step, solved or not yet.
    const ConstraintRows<S>& rows() const { return step_.rows; }
    /// First row of a joint and the number of its rows.
    std::pair<std::uint32_t, std::uint32_t> jointRows(JointId joint) const {
        return parts_.joints.rows(joint);
    }
    /// Impulses of a joint's rows in the last step, summed over its sub-steps [N s] or [N m s].
    std::span<const Real> jointImpulses(JointId joint) const { return parts_.joints.impulses(joint); }
    /// Islands of the contacts and joints of the last step, between dynamic bodies, asleep or not. They are
    /// found on demand, so the first call after a step must not be concurrent.
    const Islands& islands() const { return parts_.currentIslands(); }
    bool isAsleep(BodyId body) const { return parts_.bodies.arrays().asleep[parts_.bodies.dense(body)]; }
    /// Hash of everything that decides the future (state/state_fields.def).
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
    void requireBetweenSteps() const;

    WorldParts<S> parts_;
    StepState<S> step_;
};

}  // namespace rigor::engine
