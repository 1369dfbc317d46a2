// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"

namespace rigor::engine {

template <class S>
std::span<const AlgorithmEntry<ManifoldFunction<S>>> manifoldTable() {
    static constexpr AlgorithmEntry<ManifoldFunction<S>> kTable[] = {
#define ALGORITHM(name, function, summary) {#name, &function<S>, summary},
#include "engine/narrowphase/manifolds.def"
#undef ALGORITHM
    };
    return kTable;
}

template std::span<const AlgorithmEntry<ManifoldFunction<Space2f>>> manifoldTable();
template std::span<const AlgorithmEntry<ManifoldFunction<Space2d>>> manifoldTable();
template std::span<const AlgorithmEntry<ManifoldFunction<Space3f>>> manifoldTable();
template std::span<const AlgorithmEntry<ManifoldFunction<Space3d>>> manifoldTable();

#define ALGORITHM(name, function, summary) ManifoldTraits function##Traits();
#include "engine/narrowphase/manifolds.def"
#undef ALGORITHM

std::span<const TraitsEntry<ManifoldTraits>> manifoldTraitsTable() {
    static const TraitsEntry<ManifoldTraits> table[] = {
#define ALGORITHM(name, function, summary) {#name, function##Traits()},
#include "engine/narrowphase/manifolds.def"
#undef ALGORITHM
    };
    return table;
}

}  // namespace rigor::engine
