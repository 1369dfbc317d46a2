// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Projected Gauss-Seidel on velocities, known as sequential impulses [Catto2005]: each iteration solves the
// rows one after the other, always in the same order, and gives each the impulse that satisfies it alone at
// the velocities its predecessors have led to (sequential_impulses.hpp). For the linear complementarity problem
//     w = A lambda + b,   A = J M^-1 J^T,   0 <= lambda _|_ w >= 0
// this is lambda_i := max(0, lambda_i - w_i / A_ii) in turn, with w kept up to date through the velocities.
// Friction goes before the normal, with the limit that the normal's impulse of the iteration before sets, so
// that the normal has the last word [Catto2005, section 4]. The two tangents of a contact are the one
// exception to row by row: the friction law couples them.
//
// Warm starting is the world's setting: rows arrive with the impulses of the last step.
// Cost: iterations * rows, the cheapest of all per iteration.
// Known limits: linear convergence, at a rate that falls with the height of stacks and with the mass ratio
// [Erleben2004]; corners of a box solved one by one leave it turning, which is what makes tall stacks rock.
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/sequential_impulses.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::engine {

SolverTraits makePgsTraits() {
    return {};
}

template <class S>
std::unique_ptr<Solver<S>> makePgs() {
    return std::make_unique<RowByRow<S>>(ContactOrder::FrictionFirst);
}
RIGOR_INSTANTIATE_FACTORY(makePgs, Solver);
RIGOR_INSTANTIATE_ON_MATRIX(makePgs);

}  // namespace rigor::engine
