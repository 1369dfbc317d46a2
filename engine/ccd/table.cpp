// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/ccd/continuous_collision.hpp"
#include "engine/ccd/traits.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<ContinuousCollision<S>> factory();
#include "engine/ccd/continuous_collisions.def"

template <class S>
std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable() {
    static constexpr AlgorithmEntry<ContinuousCollisionFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/ccd/continuous_collisions.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) \
    template std::span<const AlgorithmEntry<ContinuousCollisionFactory<S>>> continuousCollisionTable();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

#define ALGORITHM(name, factory, summary) ContinuousCollisionTraits factory##Traits();
#include "engine/ccd/continuous_collisions.def"

std::span<const TraitsEntry<ContinuousCollisionTraits>> continuousCollisionTraitsTable() {
    static const TraitsEntry<ContinuousCollisionTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/ccd/continuous_collisions.def"
    };
    return table;
}

}  // namespace rigor::engine
