// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions that every integrator uses: damping solved exactly over a step, and motion at constant velocity.
#include <cmath>

#include "engine/integrators/integrator.hpp"

#include "engine/math/portable.hpp"

namespace rigor::engine {

template <class R>
DampedStep<R> dampedStep(R keptPerSecond, R h) {
    if (keptPerSecond == R(1)) return {R(1), h};
    const double rate = portable::log(static_cast<double>(keptPerSecond));  // < 0
    const double change = portable::expm1(rate * static_cast<double>(h));
    return {static_cast<R>(1.0 + change), static_cast<R>(change / rate)};
}
template DampedStep<float> dampedStep(float, float);
template DampedStep<double> dampedStep(double, double);

template <class S>
void moveWith(BodyArrays<S>& bodies, std::span<const Velocity<S>> velocities, typename S::Real h,
              TurnRotation<S> turn, const Tasks& tasks) {
    tasks.forEach(bodies.size(), kBodyGrain, [&](std::size_t i) {
        if (bodies.constants[i].type == BodyType::Static) return;
        // A sleeping body does not change, not even by the rounding of a zero rotation.
        if (i < bodies.asleep.size() && bodies.asleep[i]) return;
        bodies.pose[i].p += h * velocities[i].v;
        bodies.pose[i].q = turn(bodies.pose[i].q, typename S::Ang(h * velocities[i].w));
    });
}
#define RIGOR_INSTANTIATE(S)                                                                          \
    template void moveWith<S>(BodyArrays<S>&, std::span<const Velocity<S>>, S::Real, TurnRotation<S>, \
                              const Tasks&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
