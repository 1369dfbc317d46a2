// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<BroadPhase<S>> factory();
#include "engine/broadphase/broadphases.def"

template <class S>
std::span<const AlgorithmEntry<BroadPhaseFactory<S>>> broadPhaseTable() {
    static constexpr AlgorithmEntry<BroadPhaseFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/broadphase/broadphases.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) \
    template std::span<const AlgorithmEntry<BroadPhaseFactory<S>>> broadPhaseTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
