// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Explicit Euler: x_1 = x_0 + h v_0, v_1 = v_0 + h a(x_0). Order 1; in free fall
//     v_n = v_0 + n h g,   x_n = x_0 + n h v_0 + h^2 g n (n - 1) / 2
// Oscillators gain energy at every step, and constraints act one step late: for comparison only.
#include <algorithm>

#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
void moveExplicitly(BodyArrays<S>& bodies, std::span<const Velocity<S>> start, std::span<Velocity<S>> used,
                    typename S::Real h, TurnRotation<S> turn, const Tasks& tasks) {
    std::copy(start.begin(), start.end(), used.begin());
    moveWith<S>(bodies, used, h, turn, tasks);
}

}  // namespace

IntegratorTraits integratorExplicitEulerTraits() {
    return {.scheme = FlightScheme::ExplicitEuler};
}

template <class S>
Integrator<S> integratorExplicitEuler() {
    return {&moveExplicitly<S>, false};
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorExplicitEuler<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
