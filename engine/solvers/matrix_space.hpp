// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts without bodies: problems that are given as the matrix W and the vector q of
//     w = W lambda + q
// alone, as collections of frozen contact problems give them. Solvers are written over a space S and reach
// velocities and impulses through rowVelocity, applyRowImpulse and rowCoupling only; in a MatrixSpace these
// read and write w itself:
//     J v + bias = w_i,    v += M^-1 J^T lambda  becomes  w += W e_i lambda,    J_i M^-1 J_j^T = W_ij
// so that it is the same solver, with n operations for a row instead of some forty. W may be unsymmetric.
// Every block has the one "body" 0. Solvers that use the bodies of contacts (pairs of bodies as units, masses
// to split, positions) have no meaning here; matrix_solvers.def lists those that do.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/solvers/solver.hpp"

namespace rigor::engine {

/// D - 1 tangents per contact.
template <int D>
struct MatrixSpace : Space<double, D> {
    static constexpr bool isMatrix = true;
};
template <class S>
concept OnMatrix = S::isMatrix;

/// w of all rows.
template <int D>
struct Velocity<MatrixSpace<D>> {
    std::vector<double> w;
};

template <int D>
struct Row<MatrixSpace<D>> {
    std::size_t index = 0;           ///< index of the row in W
    const double* column = nullptr;  ///< W e_index, contiguous, as long as w; the maker of the row keeps it
    double bias = 0, softness = 0, impulse = 0, invK = 0;  ///< members as in Row<S>
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    double error = 0, relaxedBias = 0, relaxedSoftness = 0;
};

template <OnMatrix S>
double rowVelocity(const Row<S>& row, const Velocity<S>&, const Velocity<S>& all) {
    return all.w[row.index];
}
template <OnMatrix S>
double rowMotion(const Row<S>& row, const Velocity<S>&, const Velocity<S>& all) {
    return std::abs(all.w[row.index]);
}
template <OnMatrix S>
void applyRowImpulse(const Row<S>& row, const Block<S>&, double lambda, Velocity<S>&, Velocity<S>& all) {
    if (lambda == 0) return;
    for (std::size_t i = 0; i < all.w.size(); ++i) all.w[i] += row.column[i] * lambda;
}
template <OnMatrix S>
double rowCoupling(const Row<S>& r1, const Row<S>& r2, const Block<S>&) {
    return r2.column[r1.index];
}

/// The solvers of solvers.def that work on rows alone; the same code. Instantiated for D = 2 and 3.
template <OnMatrix S>
std::span<const AlgorithmEntry<SolverFactory<S>>> matrixSolverTable();

}  // namespace rigor::engine

/// Beside RIGOR_INSTANTIATE_FACTORY( make, Solver ), for the solvers in matrix_solvers.def.
#define RIGOR_INSTANTIATE_ON_MATRIX(make)                                    \
    template std::unique_ptr<Solver<MatrixSpace<2>>> make<MatrixSpace<2>>(); \
    template std::unique_ptr<Solver<MatrixSpace<3>>> make<MatrixSpace<3>>()
