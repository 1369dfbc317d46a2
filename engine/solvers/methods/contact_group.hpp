// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sweeps over the contacts between two bodies by themselves: projected Gauss-Seidel (sequential_impulses.hpp) on
//     w = J v + bias + softness lambda,    w += W_j (change of lambda_j),    W = J M^-1 J^T + diag(softness)
// of their rows alone, W kept from the first use in a step on. A row then costs n multiplications for its change,
// and the velocities of the bodies get the sum of all changes at the end.
// Cost: n^2 / 2 row products once, then n^2 multiplications a sweep. Groups with moments or of more than kMostRows
// rows are not taken.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/solvers/solver.hpp"

namespace rigor::engine {

template <class S>
class ContactGroups {
  public:
    using Real = typename S::Real;
    static constexpr std::uint32_t kMostRows = 24;

    /// Group g is the blocks starts[g] .. starts[g + 1] - 1.
    void begin(const ConstraintRows<S>& constraints, std::span<const std::uint32_t> starts) {
        offset_.assign(starts.size(), kNone);
        std::size_t all = 0;
        for (std::size_t g = 0; g + 1 < starts.size(); ++g) {
            const std::uint32_t n = rowsOf(constraints, starts[g], starts[g + 1]);
            if (n > kMostRows) continue;
            offset_[g] = all;
            all += std::size_t(n) * n;
        }
        made_.assign(starts.size(), 0);
        if (matrices_.size() < all) matrices_.resize(all);
    }
    bool takes(std::size_t group) const { return offset_[group] != kNone; }

    /// Up to `sweeps` sweeps, until one changes less than `enough` [m/s].
    void sweep(const SolverInput<S>& input, std::size_t group, std::span<const Block<S>> blocks, int sweeps,
               Real enough) {
        Group g = load(input, group, blocks);
        const std::array<Real, kMostRows> before = g.impulse;
        for (int k = 0; k < sweeps; ++k) {
            Real largest = 0;
            std::uint32_t row = 0;
            for (const Block<S>& block : blocks) {
                largest = std::max({largest, solveNormal(g, row), solveTangents(input, g, block, row)});
                row += static_cast<std::uint32_t>(block.rows);
            }
            if (largest <= enough) break;
        }
        store(input, g, before, blocks);
    }

  private:
    static constexpr std::size_t kNone = ~std::size_t(0);

    /// The rows of a group. Row r of it is row first + r of the world's: those of a group follow each other.
    struct Group {
        std::uint32_t n = 0, first = 0;
        const Real* W = nullptr;
        std::array<Real, kMostRows> w, impulse, invK;
    };

    /// More than kMostRows for groups that are not taken.
    static std::uint32_t rowsOf(const ConstraintRows<S>& constraints, std::uint32_t first,
                                std::uint32_t last) {
        std::uint32_t n = 0;
        if (last - first < 2) return kMostRows + 1;
        for (std::uint32_t k = first; k < last; ++k) {
            const Block<S>& block = constraints.blocks[k];
            if (block.kind != BlockKind::Contact || block.first != constraints.blocks[first].first + n)
                return kMostRows + 1;
            n += static_cast<std::uint32_t>(block.rows);
        }
        return n;
    }

    Group load(const SolverInput<S>& input, std::size_t group, std::span<const Block<S>> blocks) {
        Group g;
        g.first = blocks.front().first;
        g.n = static_cast<std::uint32_t>(blocks.back().first + blocks.back().rows) - g.first;
        Real* W = matrices_.data() + offset_[group];
        g.W = W;
        const Row<S>* rows = input.constraints.rows.data() + g.first;
        const Block<S>& block = blocks.front();
        const Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
        for (std::uint32_t i = 0; i < g.n; ++i) {
            g.impulse[i] = rows[i].impulse;
            g.invK[i] = rows[i].invK;
            g.w[i] = rowVelocity<S>(rows[i], a, b) + rows[i].bias;
        }
        for (const Block<S>& contact : blocks) {
            const std::uint32_t i = contact.first - g.first;
            g.w[i] += rows[i].softness * rows[i].impulse;
        }
        if (made_[group]) return g;
        made_[group] = 1;
        for (std::uint32_t i = 0; i < g.n; ++i)
            for (std::uint32_t j = 0; j <= i; ++j)
                W[i * g.n + j] = W[j * g.n + i] = rowCoupling<S>(rows[i], rows[j], block);
        for (const Block<S>& contact : blocks) {
            const std::uint32_t i = contact.first - g.first;
            W[i * g.n + i] += rows[i].softness;
        }
        return g;
    }

    static void change(Group& g, std::uint32_t row, Real step) {
        g.impulse[row] += step;
        const Real* column = g.W + row * g.n;
        for (std::uint32_t i = 0; i < g.n; ++i) g.w[i] += column[i] * step;
    }

    /// The normal of a contact.
    static Real solveNormal(Group& g, std::uint32_t row) {
        const Real step = std::max(Real(0), g.impulse[row] - g.invK[row] * g.w[row]) - g.impulse[row];
        change(g, row, step);
        return std::abs(step) / g.invK[row];
    }

    /// Its tangents, behind the normal.
    static Real solveTangents(const SolverInput<S>& input, Group& g, const Block<S>& block,
                              std::uint32_t normal) {
        if (block.rows < 2) return 0;
        using Vec2 = Eigen::Matrix<Real, 2, 1>;
        Vec2 impulse = Vec2::Zero(), velocity = Vec2::Zero();
        for (int t = 0; t < S::tangents; ++t) {
            const std::uint32_t i = normal + 1 + static_cast<std::uint32_t>(t);
            impulse[t] = g.impulse[i];
            velocity[t] = g.w[i];
        }
        const Vec2 next = contactFriction<S>(input.friction, block, impulse, velocity, g.impulse[normal]);
        Real largest = 0;
        for (int t = 0; t < S::tangents; ++t) {
            const std::uint32_t i = normal + 1 + static_cast<std::uint32_t>(t);
            const Real step = next[t] - impulse[t];
            change(g, i, step);
            largest = std::max(largest, std::abs(step) / g.invK[i]);
        }
        return largest;
    }

    static void store(const SolverInput<S>& input, const Group& g, const std::array<Real, kMostRows>& before,
                      std::span<const Block<S>> blocks) {
        const Block<S>& block = blocks.front();
        Velocity<S>&a = input.velocities[block.a], &b = input.velocities[block.b];
        for (std::uint32_t i = 0; i < g.n; ++i) {
            Row<S>& row = input.constraints.rows[g.first + i];
            applyRowImpulse<S>(row, block, g.impulse[i] - before[i], a, b);
            row.impulse = g.impulse[i];
        }
    }

    std::vector<std::size_t> offset_;  ///< place of each group's matrix; kNone: it is not taken
    std::vector<std::uint8_t> made_;   ///< 1: there is one
    std::vector<Real> matrices_;       ///< W of one group after another, row by row
};

}  // namespace rigor::engine
