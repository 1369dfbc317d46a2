// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a world is told before it starts: settings, bodies, shapes and joints. Bad values are refused with an
// EngineError when they are used.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "engine/core/ids.hpp"
#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

template <class S>
class NarrowPhase;  // narrowphase/manifold.hpp

/// Settings of a world, constant after construction. Algorithms are named as in the tables of their folders.
template <class S>
struct WorldDef {
    using Real = typename S::Real;
    typename S::Vec gravity = S::Vec::Zero();  ///< [m/s^2]

    std::string integrator = "symplectic_euler";
    std::string rotation = "lie_midpoint";
    std::string orientationUpdate = "exponential_map";
    std::string broadPhase = "dynamic_aabb_tree";
    std::string narrowPhase = "sat";
    /// In place of `narrowPhase` where set; shared by copies of the world.
    std::shared_ptr<const NarrowPhase<S>> customNarrowPhase;
    std::string manifold = "clipped";
    std::string solver = "block";
    std::string positionCorrection = "ngs";
    std::string friction = "cone";
    std::string fault = "none";  ///< a deliberate mistake, for study (engine/faults)
    std::string continuousCollision = "none";
    std::string sleeping = "off";
    std::string restitution = "newton";
    /// Of two materials whose pair has no coefficients of its own (World::setPair).
    std::string frictionCombine = "geometric_mean", restitutionCombine = "min";

    /// Equal parts a step is solved in, contacts found once, >= 0. 0: the solver's own number, which is 1
    /// except for solvers that are made of sub-steps (tgs_soft, xpbd).
    int substeps = 0;
    /// Of each sub-step, at most, >= 0. 0: the solver's own number, which is 50 except for solvers that are
    /// made of sub-steps, or of a single pass.
    int velocityIterations = 0;
    int positionIterations = 10;  ///< of each sub-step, >= 0
    /// Iterations end early when one changes less than this share of the speed that gravity adds in a
    /// (sub-)step, or than the precision resolves; 0: never. >= 0
    Real velocityTolerance = Real(1e-6);
    int firstStepIterations = 400;  ///< of the first step, which has no impulses to start from, >= 1
    /// Solvers that promise a residual (nsgs, dantzig, lemke): the natural map (solvers/natural_map.hpp) at
    /// which they are done [m/s], >= 0; single precision stops at what it resolves.
    Real residualTolerance = Real(1e-10);
    /// Residuals of the step are the natural map instead of the change an iteration made; costs a pass each.
    bool measureResiduals = false;
    /// Threads that share the work of a step, 1..1024; the bits of the results do not depend on it.
    int threads = 1;
    int pyramidDirections = 4;  ///< lemke: generators of its friction cone, even, 2..64
    bool warmStarting = true;   ///< start from the impulses of the last step
    /// Joint rows aim at the constraint at the end of the step instead of its linearisation at the start:
    /// pendulums keep their energy.
    bool curvedJoints = true;
    /// Soft contacts and joints as damped springs, where the solver or the position correction wants them:
    /// frequency [Hz], > 0, at most a quarter of the sub-step rate is used; damping ratio >= 0.
    Real contactFrequency = 30, contactDampingRatio = 10;
    Real jointFrequency = 60, jointDampingRatio = 2;
    /// Where bodies may sleep: an island whose bodies have all been slower than this [m/s], [rad/s] for
    /// timeToSleep [s] does. >= 0
    Real sleepLinearVelocity = Real(0.01), sleepAngularVelocity = Real(0.02), timeToSleep = Real(0.5);
    Real restitutionThreshold = Real(0.01);  ///< slower approaches do not bounce [m/s], >= 0
    Real slop = Real(1e-5);                  ///< overlap that position correction leaves alone [m], >= 0
    /// A gap up to this counts as closed [m], >= 0: where position correction has lifted a corner, closing
    /// the gap by velocity would start stacks rocking. Impacts close it all the same.
    Real gapSlop = Real(5e-4);
    /// Contacts are found up to this separation [m], >= 0, so that resting bodies land without overlap.
    Real speculativeDistance = Real(1e-3);
    /// What the narrow phase has found of two shapes is kept, and moved with them, until they have moved by
    /// this against each other [m], >= 0; 0: it is asked in every step (pipeline/contact_reuse.cpp). Not with
    /// manifold = "persistent", which lives from asking.
    Real reuseDistance = 0;
    /// The broad phase is asked anew only when a box has left its own of last time grown by this share of its
    /// longest edge, >= 0; 0: in every step. Results do not depend on it.
    Real boxMargin = 0;
};

template <class S>
struct BodyDef {
    using Real = typename S::Real;
    BodyType type = BodyType::Dynamic;
    Pose<S> pose;                                    ///< of the body frame, world frame
    typename S::Vec velocity = S::Vec::Zero();       ///< of the centre of mass, world frame [m/s]
    typename S::Ang angularVelocity = zeroAng<S>();  ///< world frame [rad/s]
    Real mass = 1;                                   ///< [kg], > 0; read for dynamic bodies only
    typename S::Vec centerOfMass = S::Vec::Zero();   ///< in the body frame [m]
    typename S::Inertia inertia =
        identityInertia();         ///< about the centre of mass, body axes; positive definite
    Real linearVelocityKept = 1;   ///< in (0, 1], per second
    Real angularVelocityKept = 1;  ///< in (0, 1], per second
    Real gravityScale = 1;         ///< factor on the world's gravity
    bool collides = true;          ///< false: no contacts for any of its shapes

    static typename S::Inertia identityInertia() {
        if constexpr (S::dim == 2)
            return Real(1);
        else
            return S::Inertia::Identity();
    }
};

template <class S>
struct ShapeDef {
    Shape<S> shape;
    Pose<S> pose;                ///< shape frame in the body frame
    std::uint32_t material = 0;  ///< from World::addMaterial; 0 is frictionless and inelastic
};

/// What two touching surfaces share.
template <class S>
struct PairCoefficients {
    typename S::Real friction = 0;     ///< Coulomb, >= 0
    typename S::Real restitution = 0;  ///< in [0, 1]
    /// Contacts stick up to this and slide at `friction`; 0: at `friction` too. Else >= friction.
    typename S::Real staticFriction = 0;
};

enum class JointType : std::uint8_t { Ball, ConeTwist, Distance, Fixed, Hinge, SixDof, Slider, Wheel };

/// What a coordinate of a joint may do.
enum class AxisMode : std::uint8_t {
    Usual,  ///< the joint's own: locked for distance and six_dof, else free
    Free,
    Locked,   ///< stays at `lower` where that equals `upper`, else as it was when added (distance: `length`)
    Limited,  ///< stays within [lower, upper]
};

/// Stops, motor and spring along one coordinate of a joint. Unit u is [m] or [rad].
template <class R>
struct JointAxis {
    AxisMode mode = AxisMode::Usual;
    R lower = -std::numeric_limits<R>::infinity();  ///< Limited: <= upper; infinite for one-sided limits [u]
    R upper = std::numeric_limits<R>::infinity();
    R motorSpeed = 0;     ///< the motor drives the coordinate's rate to this [u/s]
    R motorMaxForce = 0;  ///< with at most this [N] or [N m]; 0: no motor
    /// Spring to `target` [u]: by frequency [Hz] and damping ratio on the effective mass of the coordinate,
    /// or by stiffness [N/m, N m/rad] and damping [N s/m, N m s/rad]. All zero: no spring.
    R target = 0, frequency = 0, dampingRatio = 0, stiffness = 0, damping = 0;

    bool hasMotor() const { return motorMaxForce > 0; }
    bool hasSpring() const { return frequency > 0 || stiffness > 0 || damping > 0; }
};
inline constexpr std::size_t kMaxJointAxes = 6;

/// Anchors and axes are in body frames; a null body is the world. Joints hold the relative pose of the moment
/// they are added as their zero. axes[k] controls coordinate k of the joint:
///     hinge       the angle about the axis, counted over turns                           1
///     slider      the travel along the axis                                              1
///     distance    the distance of the anchors: locked: rod; upper limit: rope; spring    1
///     ball (3D)   the angle between the axes: `upper` is a cone's half angle, < pi       1
///     cone_twist  0: the twist about the axis, over turns; 1: the angle between the axes as for ball    (3D)
///     six_dof     3D: travel along the axis and two normals to it; twist; swing about the two normals
///                 2D: travel along the axis and its normal; angle
///     wheel       0: travel along the axis (suspension); 1: the angle about the spin axis, over turns
template <class S>
struct JointDef {
    using Real = typename S::Real;
    JointType type = JointType::Ball;  ///< 2D: ball and hinge are the same
    BodyId bodyA, bodyB;
    typename S::Vec anchorA = S::Vec::Zero(), anchorB = S::Vec::Zero();  ///< [m]
    typename S::Vec axisA = S::Vec::Unit(S::dim - 1);                    ///< unit; not of fixed and distance
    typename S::Vec axisB = S::Vec::Unit(S::dim - 1);                    ///< the same direction in B
    typename S::Vec spinAxisB = S::Vec::Unit(S::dim - 1);                ///< wheel (3D): what B spins about
    typename S::Vec normalA = S::Vec::Zero();  ///< six_dof (3D): t1 is this made normal to axisA; zero: any
    Real length = 0;                           ///< distance joint: > 0 [m]
    bool collideConnected = false;
    std::array<JointAxis<Real>, kMaxJointAxes> axes;
    /// The joint is removed at the end of a step whose mean force [N] or torque about B's anchor [N m]
    /// exceeded these, > 0.
    Real breakForce = std::numeric_limits<Real>::infinity();
    Real breakTorque = std::numeric_limits<Real>::infinity();
};

}  // namespace rigor::engine
