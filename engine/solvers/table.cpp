// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/solver.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Solver<S>> factory();
#include "engine/solvers/solvers.def"

template <class S>
std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable() {
    static constexpr AlgorithmEntry<SolverFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/solvers.def"
    };
    return table;
}

template <class R>
using Vec2 = Eigen::Matrix<R, 2, 1>;
#define ALGORITHM(name, function, summary) \
    template <class R>                     \
    Vec2<R> function(R, R, R, const Vec2<R>&, const Vec2<R>&, R);
#include "engine/solvers/frictions.def"

template <class S>
std::span<const AlgorithmEntry<FrictionLaw<S>>> frictionTable() {
    static constexpr AlgorithmEntry<FrictionLaw<S>> table[] = {
#define ALGORITHM(name, function, summary) {#name, &function<typename S::Real>, summary},
#include "engine/solvers/frictions.def"
    };
    return table;
}

#define RIGOR_INSTANTIATE(S)                                                     \
    template std::span<const AlgorithmEntry<SolverFactory<S>>> solverTable<S>(); \
    template std::span<const AlgorithmEntry<FrictionLaw<S>>> frictionTable<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

#define ALGORITHM(name, factory, summary) SolverTraits factory##Traits();
#include "engine/solvers/solvers.def"

std::span<const TraitsEntry<SolverTraits>> solverTraitsTable() {
    static const TraitsEntry<SolverTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/solvers/solvers.def"
    };
    return table;
}

#define ALGORITHM(name, function, summary) FrictionTraits function##Traits();
#include "engine/solvers/frictions.def"

std::span<const TraitsEntry<FrictionTraits>> frictionTraitsTable() {
    static const TraitsEntry<FrictionTraits> table[] = {
#define ALGORITHM RIGOR_TRAITS_ENTRY
#include "engine/solvers/frictions.def"
    };
    return table;
}

}  // namespace rigor::engine
