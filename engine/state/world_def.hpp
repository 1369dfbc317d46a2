// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What a world is told before it starts: settings, bodies, shapes and joints. Bad values are refused with an
// EngineError when they are used.
#pragma once

#include <cstdint>
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
    std::string broadPhase = "dynamic_aabb_tree";
    std::string narrowPhase = "sat";
    /// In place of `narrowPhase` where set; shared by copies of the world.
    std::shared_ptr<const NarrowPhase<S>> customNarrowPhase;
    std::string solver = "pgs";
    std::string positionCorrection = "ngs";
    std::string friction = "cone";

    int substeps = 1;             ///< equal parts a step is solved in, contacts found once, >= 1
    int velocityIterations = 50;  ///< of each sub-step, at most, >= 1
    int positionIterations = 10;  ///< of each sub-step, >= 0
    /// Iterations end early when one changes less than this share of the speed that gravity adds in a
    /// (sub-)step, or than the precision resolves; 0: never. >= 0
    Real velocityTolerance = Real(1e-6);
    int firstStepIterations = 400;  ///< of the first step, which has no impulses to start from, >= 1
    bool warmStarting = true;       ///< start from the impulses of the last step
    /// Joint rows aim at the constraint at the end of the step instead of its linearisation at the start:
    /// pendulums keep their energy.
    bool curvedJoints = true;
    /// Soft contacts and joints as damped springs, where the solver or the position correction wants them:
    /// frequency [Hz], > 0, at most a quarter of the sub-step rate is used; damping ratio >= 0.
    Real contactFrequency = 30, contactDampingRatio = 10;
    Real jointFrequency = 60, jointDampingRatio = 2;
    Real restitutionThreshold = Real(0.01);  ///< slower approaches do not bounce [m/s], >= 0
    Real slop = Real(1e-5);                  ///< overlap that position correction leaves alone [m], >= 0
    /// A gap up to this counts as closed [m], >= 0: where position correction has lifted a corner, closing
    /// the gap by velocity would start stacks rocking. Impacts close it all the same.
    Real gapSlop = Real(5e-4);
    /// Contacts are found up to this separation [m], >= 0, so that resting bodies land without overlap.
    Real speculativeDistance = Real(1e-3);
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
    typename S::Real restitution = 0;  ///< Newton, in [0, 1]
};

enum class JointType : std::uint8_t { Ball, Hinge, Slider, Fixed, Distance };

/// Anchors and axes are in body frames; a null body is the world. Ball, hinge, slider and fixed joints hold
/// the relative pose of the moment they are added as their zero.
template <class S>
struct JointDef {
    JointType type = JointType::Ball;  ///< 2D: ball and hinge are the same
    BodyId bodyA, bodyB;
    typename S::Vec anchorA = S::Vec::Zero(), anchorB = S::Vec::Zero();  ///< [m]
    typename S::Vec axisA = S::Vec::Unit(S::dim - 1);                    ///< unit; hinge (3D), slider
    typename S::Vec axisB = S::Vec::Unit(S::dim - 1);                    ///< the same direction in B
    typename S::Real length = 0;                                         ///< distance joint: > 0 [m]
    bool collideConnected = false;
};

}  // namespace rigor::engine
