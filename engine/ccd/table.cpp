// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/traits.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<ContinuousCollision<S>> factory();
#include "engine/ccd/continuous_collisions.def"
#undef ALGORITHM

template <class S>
std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable() {
    static constexpr AlgorithmEntry<ContinuousCollisionFactory<S>> table[] = {
#define ALGORITHM(name, factory, summary) {#name, &factory<S>, summary},
#include "engine/ccd/continuous_collisions.def"
#undef ALGORITHM
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) \
    template std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

#define ALGORITHM(name, factory, summary) ContinuousCollisionTraits factory##Traits();
#include "engine/ccd/continuous_collisions.def"
#undef ALGORITHM

std::span<const TraitsEntry<ContinuousCollisionTraits>> continuousCollisionTraitsTable() {
    static const TraitsEntry<ContinuousCollisionTraits> table[] = {
#define ALGORITHM(name, factory, summary) {#name, factory##Traits()},
#include "engine/ccd/continuous_collisions.def"
#undef ALGORITHM
    };
    return table;
}

}  // namespace rigor::engine
