// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See linear_system.hpp.
#include "validation/references/numerics/linear_system.hpp"

#include <Eigen/LU>

namespace rigor::validation::numerics {

std::optional<Vector> solveDense(Matrix m, Vector f) {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        const Real largest = m.row(i).cwiseAbs().maxCoeff();
        if (!(largest > 0)) return std::nullopt;
        m.row(i) /= largest;
        f[i] /= largest;
    }
    const Eigen::FullPivLU<Matrix> lu(m);
    if (!lu.isInvertible()) return std::nullopt;
    return lu.solve(f);
}

}  // namespace rigor::validation::numerics
