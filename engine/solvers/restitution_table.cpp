// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/restitution.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Restitution<S>> factory();
#include "engine/solvers/restitutions.def"

template <class S>
std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable() {
    static constexpr AlgorithmEntry<RestitutionFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/restitutions.def"
    };
    return table;
}
#define RIGOR_INSTANTIATE(S) \
    template std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
