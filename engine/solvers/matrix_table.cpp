// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/matrix_space.hpp"

namespace rigor::engine {

#define ALGORITHM(name, factory, summary) \
    template <class S>                    \
    std::unique_ptr<Solver<S>> factory();
#include "engine/solvers/matrix_solvers.def"

template <OnMatrix S>
std::span<const AlgorithmEntry<SolverFactory<S>>> matrixSolverTable() {
    static constexpr AlgorithmEntry<SolverFactory<S>> table[] = {
#define ALGORITHM RIGOR_ALGORITHM_ENTRY
#include "engine/solvers/matrix_solvers.def"
    };
    return table;
}
template std::span<const AlgorithmEntry<SolverFactory<MatrixSpace<2>>>> matrixSolverTable<MatrixSpace<2>>();
template std::span<const AlgorithmEntry<SolverFactory<MatrixSpace<3>>>> matrixSolverTable<MatrixSpace<3>>();

}  // namespace rigor::engine
