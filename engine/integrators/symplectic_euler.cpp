// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Symplectic (semi-implicit) Euler: v_1 = v_0 + h a(x_0), x_1 = x_0 + h v_1. Order 1; in free fall
//     v_n = v_0 + n h g,   x_n = x_0 + n h v_0 + h^2 g n (n + 1) / 2
// and oscillators keep their energy bounded [HairerLubichWanner2006, section I.1].
#include <algorithm>

#include "engine/integrators/integrator.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

template <class S>
void moveSymplectically(BodyArrays<S>& bodies, std::span<const Velocity<S>> start,
                        std::span<Velocity<S>> used, typename S::Real h, TurnRotation<S> turn,
                        const Tasks& tasks) {
    (void)start;
    std::copy(bodies.velocity.begin(), bodies.velocity.end(), used.begin());
    moveWith<S>(bodies, used, h, turn, tasks);
}

}  // namespace

IntegratorTraits integratorSymplecticEulerTraits() {
    return {.scheme = FlightScheme::SymplecticEuler, .inBlocks = true};
}

template <class S>
Integrator<S> integratorSymplecticEuler() {
    return {&moveSymplectically<S>, true};
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorSymplecticEuler<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
