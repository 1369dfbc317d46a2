// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/manifolds.hpp"

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

}  // namespace rigor::engine
