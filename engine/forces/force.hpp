// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Forces that the engine evaluates itself, at every stage of an integrator: functions of time and of the
// bodies' poses and velocities. One file per kind of force; adding one is a struct here, a file and a line in
// forces.def.
#pragma once

#include <limits>
#include <span>
#include <variant>

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Force and torque, world frame, at the centre of mass during [start, end).
template <class S>
struct ConstantForce {
    BodyId body;                                           ///< dynamic
    typename S::Vec force = S::Vec::Zero();                ///< [N]
    typename S::Ang torque = zeroAng<S>();                 ///< [N m]
    double start = 0;                                      ///< [s] of World::time()
    double end = std::numeric_limits<double>::infinity();  ///< [s], >= start
};

/// Linear spring and damper between two anchors.
template <class S>
struct LinearSpring {
    BodyId bodyA, bodyB;  ///< null: the world; at least one is dynamic
    typename S::Vec anchorA = S::Vec::Zero(), anchorB = S::Vec::Zero();  ///< anchors in the body frames [m]
    typename S::Real stiffness = 0;                                      ///< [N/m], >= 0
    typename S::Real damping = 0;                                        ///< [N s/m], >= 0
    typename S::Real restLength = 0;                                     ///< [m], >= 0
};

/// F = -coefficient v at the centre of mass.
template <class S>
struct LinearDrag {
    BodyId body;                       ///< dynamic
    typename S::Real coefficient = 0;  ///< [N s/m], >= 0
};

/// F = -coefficient |v| v at the centre of mass.
template <class S>
struct QuadraticDrag {
    BodyId body;                       ///< dynamic
    typename S::Real coefficient = 0;  ///< [N s^2/m^2], >= 0
};

/// The bodies that a force depends on and acts on, by dense index, and the time during which it does.
template <class S>
struct ForceMoment {
    double begin, end;  ///< [s]; begin < end
    std::span<const Pose<S>> pose;
    std::span<const Velocity<S>> velocity;
    std::span<Wrench<S>> wrench;  ///< forces add to it
};

/// Place at which a force acts: dense indices and arms from the centres of mass in body axes [m].
template <class S>
struct ForcePlace {
    std::uint32_t a = 0, b = 0;
    typename S::Vec armA = S::Vec::Zero(), armB = S::Vec::Zero();
};

// The alternatives, in the order of forces.def.
template <class S, class... Kinds>
using VariantAfterFirst = std::variant<Kinds...>;
template <class S>
using ForceDef = VariantAfterFirst<S
#define FORCE(name, Kind, summary) , Kind<S>
#include "engine/forces/forces.def"
#undef FORCE
                                   >;

// Each kind, in its own file: whether its values are in range (throws EngineError), which bodies it joins,
// and what it does.
#define FORCE(name, Kind, summary)         \
    template <class S>                     \
    void checkForce(const Kind<S>& force); \
    template <class S>                     \
    void addForce(const Kind<S>& force, const ForcePlace<S>& place, const ForceMoment<S>& moment);
#include "engine/forces/forces.def"
#undef FORCE

/// Instantiates both functions of a kind of force for all spaces; used at the end of its file.
#define RIGOR_INSTANTIATE_FORCE_IN(Kind, S)      \
    template void checkForce<S>(const Kind<S>&); \
    template void addForce<S>(const Kind<S>&, const ForcePlace<S>&, const ForceMoment<S>&)
#define RIGOR_INSTANTIATE_FORCE(Kind)          \
    RIGOR_INSTANTIATE_FORCE_IN(Kind, Space2f); \
    RIGOR_INSTANTIATE_FORCE_IN(Kind, Space2d); \
    RIGOR_INSTANTIATE_FORCE_IN(Kind, Space3f); \
    RIGOR_INSTANTIATE_FORCE_IN(Kind, Space3d)

}  // namespace rigor::engine
