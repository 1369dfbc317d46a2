// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/lcp/assembled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solvers/matrix_space.hpp"

namespace rigor::engine {
namespace {

/// The part of one row that acts on one body.
struct Half {
    double lin[3] = {0, 0, 0}, ang[3] = {0, 0, 0}, invIAng[3] = {0, 0, 0};
};
template <class R>
void putAng(R value, double* out) {
    out[0] = static_cast<double>(value);
}
template <class R>
void putAng(const Eigen::Matrix<R, 3, 1>& value, double* out) {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<double>(value[i]);
}
template <class S>
Half half(const Row<S>& row, bool ofB) {
    Half h;
    for (int i = 0; i < S::dim; ++i) h.lin[i] = (ofB ? 1 : -1) * static_cast<double>(row.lin[i]);
    putAng(ofB ? row.angB : row.angA, h.ang);
    putAng(ofB ? row.invIAngB : row.invIAngA, h.invIAng);
    return h;
}

}  // namespace

template <class S>
void AssembledProblem::assemble(const ConstraintRows<S>& rows, std::size_t bodies) {
    n = rows.rows.size();
    if (W.size() < n * n) W.resize(n * n);
    std::fill_n(W.begin(), n * n, 0.0);
    w.resize(n);
    q.resize(n);
    lambda.resize(n);
    lower.resize(n);
    upper.resize(n);
    kind.resize(n);
    contacts.clear();
    if constexpr (OnMatrix<S>)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i) W[i * n + j] = rows.rows[j].column[i];
    else
        sortByBody(rows, bodies);
    readRows(rows);
    if constexpr (!OnMatrix<S>) coupleBodies(rows, bodies);
    for (std::size_t i = 0; i < n; ++i)
        if (!(W[i * n + i] > 0)) W[i * n + i] = 1;
    findEnds();
}

void AssembledProblem::findEnds() {
    ends_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double* entries = W.data() + i * n;
        Ends ends{0, n};
        while (entries[ends.end - 1] == 0) --ends.end;
        while (entries[ends.first] == 0) ++ends.first;
        ends_[i] = ends;
    }
}

/// start_, entry_: rows by body, in the order of the rows; after it start_[b] is the end of body b.
template <class S>
void AssembledProblem::sortByBody(const ConstraintRows<S>& rows, std::size_t bodies) {
    start_.assign(bodies + 1, 0);
    const auto forEachEnd = [&](auto action) {
        for (const Block<S>& block : rows.blocks)
            for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
                if (block.invMassA > 0) action(block.a, 2 * i);
                if (block.invMassB > 0) action(block.b, 2 * i + 1);
            }
    };
    invMass_.assign(bodies, 0.0);
    for (const Block<S>& block : rows.blocks) {
        invMass_[block.a] = static_cast<double>(block.invMassA);
        invMass_[block.b] = static_cast<double>(block.invMassB);
    }
    forEachEnd([&](std::uint32_t body, std::uint32_t) { ++start_[body + 1]; });
    for (std::size_t b = 0; b < bodies; ++b) start_[b + 1] += start_[b];
    entry_.resize(start_[bodies]);
    forEachEnd([&](std::uint32_t body, std::uint32_t entry) { entry_[start_[body]++] = entry; });
}

/// Kinds and bounds of the rows, the contacts, and softness on the diagonal.
template <class S>
void AssembledProblem::readRows(const ConstraintRows<S>& rows) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const Block<S>& block : rows.blocks) {
        for (std::uint32_t i = block.first; i < block.first + block.rows; ++i) {
            const Row<S>& row = rows.rows[i];
            kind[i] = RowKind::Free;
            lower[i] = -kInfinity;
            upper[i] = kInfinity;
            if (block.kind == BlockKind::Bounded) {
                lower[i] = static_cast<double>(row.lower);
                upper[i] = static_cast<double>(row.upper);
                if (lower[i] > -kInfinity || upper[i] < kInfinity) kind[i] = RowKind::Bounded;
            } else if (block.kind == BlockKind::Contact) {
                kind[i] = i == block.first ? RowKind::Normal : RowKind::Tangent;
                lower[i] = 0;
            } else if (block.kind == BlockKind::Moment) {
                kind[i] = RowKind::Tangent;
            }
            W[i * n + i] += static_cast<double>(row.softness);
        }
        if (block.kind == BlockKind::Contact) {
            const auto mu = static_cast<double>(block.friction);
            contacts.push_back({block.first, block.rows - std::size_t(1), block.first + std::size_t(1), mu,
                                std::max(mu, static_cast<double>(block.staticFriction)),
                                static_cast<double>(block.appliedNormal)});
        } else if (block.kind == BlockKind::Moment) {
            const auto rho = static_cast<double>(block.friction);
            contacts.push_back({block.normal, block.rows, block.first, rho, rho,
                                static_cast<double>(block.appliedNormal), true});
        }
    }
}

/// Adds J M^-1 J^T, body by body.
template <class S>
void AssembledProblem::coupleBodies(const ConstraintRows<S>& rows, std::size_t bodies) {
    std::uint32_t begin = 0;
    for (std::size_t b = 0; b < bodies; ++b) {
        for (std::uint32_t e = begin; e < start_[b]; ++e) {
            const std::uint32_t i = entry_[e] / 2;
            const bool ofB = entry_[e] % 2 != 0;
            const Half hi = half<S>(rows.rows[i], ofB);
            const double invMass = invMass_[b];
            for (std::uint32_t f = begin; f <= e; ++f) {
                const std::uint32_t j = entry_[f] / 2;
                const Half hj = half<S>(rows.rows[j], entry_[f] % 2 != 0);
                double sum = 0;
                for (int k = 0; k < 3; ++k)
                    sum += invMass * hi.lin[k] * hj.lin[k] + hi.ang[k] * hj.invIAng[k];
                W[i * n + j] += sum;
                if (i != j) W[j * n + i] += sum;
            }
        }
        begin = start_[b];
    }
}

template <class S>
void AssembledProblem::readVelocities(const ConstraintRows<S>& rows,
                                      std::span<const Velocity<S>> velocities) {
    for (std::size_t i = 0; i < n; ++i) lambda[i] = static_cast<double>(rows.rows[i].impulse);
    for (const Block<S>& block : rows.blocks)
        for (std::size_t i = block.first; i < block.first + std::size_t(block.rows); ++i) {
            const Row<S>& row = rows.rows[i];
            if (!(row.invK > 0)) {
                w[i] = 0;
                continue;
            }
            w[i] = static_cast<double>(rowVelocity<S>(row, velocities[block.a], velocities[block.b])) +
                   static_cast<double>(row.bias) + static_cast<double>(row.softness) * lambda[i];
        }
}

void AssembledProblem::findOffsets() {
    for (std::size_t i = 0; i < n; ++i) q[i] = -addCoupled(-w[i], i, lambda);
}

#define RIGOR_INSTANTIATE(S)                                                            \
    template void AssembledProblem::assemble<S>(const ConstraintRows<S>&, std::size_t); \
    template void AssembledProblem::readVelocities<S>(const ConstraintRows<S>&, std::span<const Velocity<S>>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
RIGOR_INSTANTIATE(MatrixSpace<2>)
RIGOR_INSTANTIATE(MatrixSpace<3>)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
