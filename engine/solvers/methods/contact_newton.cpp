// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/contact_newton.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::engine {

bool ContactNewton::step(const AssembledProblem& p, double sigma, std::vector<double>& next) {
    const std::size_t n = p.n;
    double* A = lu_.reset(n);
    w_.resize(n);
    right_.resize(n);
    next.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double* W = p.W.data() + i * n;
        w_[i] = p.velocity(i, p.lambda);
        // The row is set as if w = 0 were its equation, and changed below if it is not.
        std::copy_n(W, n, A + i * n);
        A[i * n + i] = p.damped(i, sigma);
        right_[i] = -w_[i];
    }
    // Elimination mixes the rows: by its solution, open contacts would have impulses of the size of rounding.
    pinned_.assign(n, 0);
    const auto pin = [&](std::size_t i, double value) {
        pinned_[i] = 1;
        next[i] = value;
        std::fill_n(A + i * n, n, 0.0);
        A[i * n + i] = 1;
        right_[i] = value - p.lambda[i];
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (p.kind[i] != RowKind::Bounded && p.kind[i] != RowKind::Normal) continue;
        const double z = p.lambda[i] - w_[i] / p.scale(i);
        if (z <= p.lower[i]) pin(i, p.lower[i]);
        if (z >= p.upper[i]) pin(i, p.upper[i]);
    }
    for (const AssembledContact& contact : p.contacts) {
        const std::size_t normal = contact.normal;
        const bool open = p.lambda[normal] - w_[normal] / p.scale(normal) <= 0;
        if (open && !(contact.applied > 0)) {
            for (std::size_t t = 0; t < contact.tangents; ++t) pin(contact.first + t, 0.0);
        } else if (contact.tangents > 0) {
            tangentRows(p, contact, A);
        }
    }
    if (!lu_.factor()) return false;
    lu_.solve(right_.data());
    for (std::size_t i = 0; i < n; ++i) {
        if (!pinned_[i]) next[i] = p.lambda[i] + right_[i];
        if (!std::isfinite(next[i])) return false;
    }
    return true;
}

/// Sticking keeps w_t = 0. Sliding, with e = z_t / |z_t| and R = mu (lambda_n + applied):
///     d_t - e mu d_n - (R / |z_t|) (I - e e^T) (d_t - rho W_t d) = -(lambda_t - R e)
void ContactNewton::tangentRows(const AssembledProblem& p, const AssembledContact& contact, double* A) {
    const std::size_t n = p.n, first = contact.first, m = contact.tangents;
    const double load = std::max(0.0, p.lambda[contact.normal]) + contact.applied;
    const double rho = 1 / p.scale(first);
    double z[2] = {0, 0}, length = 0;
    for (std::size_t t = 0; t < m; ++t) z[t] = p.lambda[first + t] - rho * w_[first + t];
    length = std::sqrt(z[0] * z[0] + z[1] * z[1]);
    if (length <= contact.muStatic * load) return;
    const double R = contact.mu * load, e[2] = {z[0] / length, z[1] / length};
    const double scale = R / length;
    for (std::size_t t = 0; t < m; ++t) {
        double* row = A + (first + t) * n;
        std::fill_n(row, n, 0.0);
        for (std::size_t s = 0; s < m; ++s) {
            const double projected = scale * ((s == t ? 1.0 : 0.0) - e[s] * e[t]);
            // 2D has a single tangent, so that I - e e^T = 0.
            if (m == 1) break;
            const double* W = p.W.data() + (first + s) * n;
            for (std::size_t j = 0; j < n; ++j) row[j] += projected * rho * W[j];
            row[first + s] -= projected;
        }
        row[first + t] += 1;
        row[contact.normal] -= contact.mu * e[t];
        right_[first + t] = -(p.lambda[first + t] - R * e[t]);
    }
}

}  // namespace rigor::engine
