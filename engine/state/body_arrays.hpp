// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bodies of a world as structure of arrays, split by access pattern: what every solver iteration touches
// (velocities), what a step touches (poses, masses), and what is read once. Index 0 is the world itself, a
// static body at the origin that joints may attach to.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"
#include "engine/state/island_kind.hpp"

namespace rigor::engine {

enum class BodyType : std::uint8_t { Static, Kinematic, Dynamic };

/// Whether a body takes part in continuous collision (ccd/).
enum class ContinuousMode : std::uint8_t {
    World,  ///< as WorldDef::continuousCollision says
    On,     ///< also in a world without: then by conservative_advancement
    Off,    ///< only with bodies that do
};

/// Bodies for which a range of them is worth sharing among threads: some microseconds of work. The same
/// wherever bodies are shared, so that a thread gets the same ones again.
inline constexpr std::size_t kBodyGrain = 64;

/// Velocity of the centre of mass [m/s] and angular velocity [rad/s], world frame. The layout is groups of
/// four numbers, with gaps of 0, that SIMD loads as they are: (v, gap), (w, gap) in 3D, (v, w, gap) in 2D.
template <class S>
struct Velocity;
template <class R>
struct alignas(4 * sizeof(R)) Velocity<Space<R, 3>> {
    using S = Space<R, 3>;
    Velocity() = default;
    Velocity(const typename S::Vec& linear, const typename S::Ang& angular) : v(linear), w(angular) {}
    typename S::Vec v = S::Vec::Zero();
    R gapV = 0;
    typename S::Ang w = zeroAng<S>();
    R gapW = 0;
};
template <class R>
struct alignas(4 * sizeof(R)) Velocity<Space<R, 2>> {
    using S = Space<R, 2>;
    Velocity() = default;
    Velocity(const typename S::Vec& linear, const typename S::Ang& angular) : v(linear), w(angular) {}
    typename S::Vec v = S::Vec::Zero();
    typename S::Ang w = zeroAng<S>();
    R gap = 0;
};

/// Force [N] at the centre of mass and torque [N m], world frame.
template <class S>
struct Wrench {
    typename S::Vec force = S::Vec::Zero();
    typename S::Ang torque = zeroAng<S>();
};

/// Properties that no step changes.
template <class S>
struct BodyConstants {
    BodyType type = BodyType::Static;
    bool collides = true;
    ContinuousMode continuousMode = ContinuousMode::World;
    bool continuous = false;    ///< continuous collision looks at the motion of this body
    typename S::Real mass = 0;  ///< [kg]; 0 unless dynamic
    typename S::Inertia inertia = zeroInertia<S>();  ///< inertia about the centre of mass, body axes [kg m^2]
    typename S::Vec centerOfMass = S::Vec::Zero();   ///< centre of mass in the body frame [m]
    typename S::Real gravityScale = 1;               ///< factor on the world's gravity
    typename S::Real linearVelocityKept = 1;         ///< v(t) = v0 kept^t, (0, 1], per second
    typename S::Real angularVelocityKept = 1;        ///< fraction kept per second for the angular velocity
};

/// Places of the bodies half a (sub-)step after the end of the last step: state of integrators that step
/// from midpoint to midpoint. Arrays by dense index; empty with other integrators.
template <class S>
struct Midpoints {
    std::vector<Pose<S>> pose;
    std::vector<Velocity<S>> velocity;  ///< the angular velocity is that of the orientation there
    std::vector<std::uint8_t> valid;    ///< 0: to be found anew from the body's pose and velocity
    /// A value of `valid`: the body bounces between the end of the step and its midpoint (pipeline/step_bounces.cpp).
    static constexpr std::uint8_t kBounces = 2;
};

template <class S>
struct BodyArrays {
    // --- state (state_fields.def)
    std::vector<Pose<S>> pose;  ///< origin at the centre of mass, axes of the body frame
    std::vector<Velocity<S>> velocity;
    std::vector<Wrench<S>> wrench;            ///< acts during the next step, then cleared
    std::vector<std::uint8_t> asleep;         ///< 1: left out of the step (sleep.hpp)
    std::vector<typename S::Real> stillTime;  ///< time at rest, if bodies may sleep [s]
    std::vector<IslandKind> islands;          ///< kind of the island that each had in the last step
    Midpoints<S> midpoints;
    // --- constant
    std::vector<BodyConstants<S>> constants;
    std::vector<typename S::Real> invMass;             ///< [1/kg]; 0 unless dynamic and awake
    std::vector<typename S::Inertia> invInertiaLocal;  ///< body axes; 0 unless dynamic
    std::vector<BodyId> id;
    // --- recomputed every step
    std::vector<typename S::Inertia> invInertia;  ///< world axes, at the start-of-step pose

    std::size_t size() const { return pose.size(); }
    /// Called when the velocity of body i has been changed from outside a step. Where it would have bounced, it and what it
    /// meets go on from the velocities that are shown.
    void leaveMidpoint(std::size_t i) {
        if (i >= midpoints.valid.size()) return;
        if (midpoints.valid[i] == Midpoints<S>::kBounces)
            std::replace(midpoints.valid.begin(), midpoints.valid.end(), Midpoints<S>::kBounces,
                         std::uint8_t{0});
        midpoints.valid[i] = 0;
    }
};

}  // namespace rigor::engine
