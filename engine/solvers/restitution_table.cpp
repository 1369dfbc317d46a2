// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/restitution.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Restitution<S>> factory();
#include "engine/solvers/restitutions.def"
#undef ALGORITHM

template <class S>
std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable() {
    static constexpr AlgorithmEntry<RestitutionFactory<S>> table[] = {
#define ALGORITHM(name, factory, summary) {#name, &factory<S>, summary},
#include "engine/solvers/restitutions.def"
#undef ALGORITHM
    };
    return table;
}
template std::span<const AlgorithmEntry<RestitutionFactory<Space2f>>> restitutionTable<Space2f>();
template std::span<const AlgorithmEntry<RestitutionFactory<Space2d>>> restitutionTable<Space2d>();
template std::span<const AlgorithmEntry<RestitutionFactory<Space3f>>> restitutionTable<Space3f>();
template std::span<const AlgorithmEntry<RestitutionFactory<Space3d>>> restitutionTable<Space3d>();

}  // namespace rigor::engine
