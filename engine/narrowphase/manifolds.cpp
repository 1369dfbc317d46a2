// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"

namespace rigor::engine {

template <class S>
std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable() {
    static constexpr AlgorithmEntry<ManifoldFunction<S>> kTable[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/narrowphase/manifolds.def"
    };
    return kTable;
}

#define RIGOR_INSTANTIATE(S) template std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

#define ALGORITHM(name, function, summary) ManifoldTraits function##Traits();
#include "engine/narrowphase/manifolds.def"

std::span<const TraitsEntry<ManifoldTraits>> manifoldTraitsTable() {
    static const TraitsEntry<ManifoldTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/narrowphase/manifolds.def"
    };
    return table;
}

}  // namespace rigor::engine
