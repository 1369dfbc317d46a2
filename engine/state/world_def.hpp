// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Definition of a world before it starts: settings, bodies, shapes and joints. Bad values are refused with an
// EngineError when they are used.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"
#include "engine/shapes/shape.hpp"
#include "engine/state/body_arrays.hpp"
#include "engine/state/shape_filter.hpp"

namespace rigor::engine {

template <class S>
class NarrowPhase;  // narrowphase/manifold.hpp

/// Settings of a world, constant after construction: settings.def describes each. Algorithms are named as in
/// the tables of their folders.
template <class S>
struct WorldDef {
    using Real = typename S::Real;
    typename S::Vec gravity = S::Vec::Zero();  ///< [m/s^2]
#define CHOICE(member, key, byDefault, help) std::string member = byDefault;
#define INTEGER(member, key, byDefault, min, max, help) int member = byDefault;
#define REAL(member, key, byDefault, min, max, help) Real member = static_cast<Real>(byDefault);
#define SWITCH(member, key, byDefault, help) bool member = byDefault;
#include "engine/state/settings.def"
    /// Narrow phase used in place of `narrowPhase` if set; shared by copies of the world.
    std::shared_ptr<const NarrowPhase<S>> customNarrowPhase;

    /// Settings by name, as state/presets.def lists them: "default", "fast", ... Gravity is zero. Throws EngineError
    /// "preset" for another name.
    static WorldDef preset(std::string_view name);
};

/// Name of a preset, and what it is for.
struct PresetInfo {
    std::string name, summary;
};
/// All of them, sorted by name.
const std::vector<PresetInfo>& presets();

template <class S>
struct BodyDef {
    using Real = typename S::Real;
    BodyType type = BodyType::Dynamic;
    Pose<S> pose = {};                               ///< pose of the body frame in the world frame
    typename S::Vec velocity = S::Vec::Zero();       ///< velocity of the centre of mass in the world frame
                                                     ///< [m/s]
    typename S::Ang angularVelocity = zeroAng<S>();  ///< world frame [rad/s]
    /// Mass properties of a dynamic body; others have none. By default they are those of its shapes, by their
    /// densities, and change with these. Until a shape has a mass they are 1 kg, a unit inertia and the centre of
    /// mass given here.
    ///     mass and inertia given    all three are as given
    ///     mass given alone          those of the shapes, scaled to this mass
    Real mass = 0;                                  ///< [kg], > 0; 0: that of the shapes
    typename S::Vec centerOfMass = S::Vec::Zero();  ///< centre of mass in the body frame [m]
    typename S::Inertia inertia =
        zeroInertia<S>();          ///< about the centre of mass, body axes [kg m^2]; positive
                                   ///< definite; zero: that of the shapes
    Real linearVelocityKept = 1;   ///< fraction kept per second, in (0, 1]
    Real angularVelocityKept = 1;  ///< fraction kept per second, in (0, 1]
    Real gravityScale = 1;         ///< factor on the world's gravity
    bool collides = true;          ///< false: no contacts for any of its shapes, and no sensor finds them
    ContinuousMode continuous = ContinuousMode::World;  ///< On: a bullet
};

/// The materials that each world has.
inline constexpr std::uint32_t kFrictionless = 0;   ///< friction 0, restitution 0
inline constexpr std::uint32_t kUsualMaterial = 1;  ///< friction 0.6, restitution 0

template <class S>
struct ShapeDef {
    Shape<S> shape;
    Pose<S> pose = {};                        ///< shape frame in the body frame
    std::uint32_t material = kUsualMaterial;  ///< index from World::addMaterial, or one of the above
    /// Velocity at which the surface moves over the body, as of a conveyor belt or a turntable: that of the point
    /// at the origin of the body frame [m/s], and the angular velocity [rad/s], in the axes of the body frame. A
    /// point x of the surface moves with v + w x x. Friction sees it, the normal does not.
    Velocity<S> surfaceVelocity = {};
    ShapeFilter filter = {};          ///< shapes that it collides with; by default, all
    typename S::Real density = 1000;  ///< [kg/m^3] (2D: [kg/m^2]), >= 0: mass of its body (BodyDef::mass)
    /// A sensor finds the shapes that overlap it (World::sensorOverlaps) and touches none; it has no mass.
    bool sensor = false;
};

/// Coefficients of a pair of touching surfaces.
template <class S>
struct PairCoefficients {
    typename S::Real friction = 0;     ///< Coulomb, >= 0
    typename S::Real restitution = 0;  ///< coefficient in [0, 1]
    /// Contacts stick up to this and slide at `friction`; 0: at `friction` too. Else >= friction.
    typename S::Real staticFriction = 0;
    /// Rolling resistance [m], >= 0: a moment of up to rollingFriction times the normal force opposes the relative
    /// angular velocity in the tangent plane (2D: all of it).
    typename S::Real rollingFriction = 0;
    /// 3D, the same about the normal [m], >= 0: resistance to spinning.
    typename S::Real torsionalFriction = 0;
    bool hasMoments() const { return rollingFriction > 0 || (S::dim == 3 && torsionalFriction > 0); }
};

enum class JointType : std::uint8_t { Ball, ConeTwist, Distance, Fixed, Hinge, SixDof, Slider, Wheel };

/// Mode of a joint's coordinate.
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
    R motorMaxForce = 0;  ///< maximum force or torque of the motor [N] or [N m]; 0: no motor
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
