// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parallel Gauss-Seidel sweeps with the bits of one thread. A sweep solves units (rows, blocks or groups of
// them) one after the other, and each uses the velocities that its predecessors have left. Units that move no
// common body do not see each other, so that only the order between those that do matters:
//     level(k) = 1 + max over the bodies i that unit k moves of (level of the last unit before k that moves i)
// Units of one level have no body in common, and those that share a body keep their order. Level after level,
// all units of a level at once, is the sweep itself; the levels backwards are the sweep backwards. Level
// scheduling comes from the solution of sparse triangular systems [AndersonSaad1989]. Islands share no body
// and fill the same levels side by side, and so does one large pile: its levels are the layers that a front
// running through the sweep's order leaves behind.
//
// Bodies that impulses do not move are read by all threads and never written. Cost: O(units + bodies) to
// find the levels, nothing for one thread. Known limits: a chain whose units come in order has as many levels
// as units; threads are of no use to it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/constraints/row.hpp"
#include "engine/core/tasks.hpp"

namespace rigor::engine {

class SweepOrder {
  public:
    /// Forgets all units. The next ones move some of the bodies 0 .. bodies - 1; up to `grain` >= 1 of them
    /// are not worth sharing. `tasks` outlives the sweeps.
    void begin(const Tasks& tasks, std::size_t bodies, std::size_t grain);
    /// The next unit: it moves the bodies of these blocks.
    template <class S>
    void add(std::span<const Block<S>> unit);
    /// Must be called after the last unit.
    void finish();

    /// Calls work(unit) for every unit.
    template <class Work>
    void sweep(bool backwards, const Work& work) const {
        if (!shared_) {
            for (std::size_t k = 0; k < units_; ++k) work(backwards ? units_ - 1 - k : k);
            return;
        }
        const std::size_t levels = start_.size() - 1;
        for (std::size_t l = 0; l < levels; ++l) {
            const std::size_t level = backwards ? levels - 1 - l : l, first = start_[level];
            tasks_->forEach(start_[level + 1] - first, grain_,
                            [&](std::size_t i) { work(order_[first + i]); });
        }
    }
    /// Calls R work(unit) for every unit and returns the largest result, or zero.
    template <class R, class Work>
    R largest(bool backwards, const Work& work) {
        R most = 0;
        if (!shared_) {
            sweep(backwards, [&](std::size_t unit) { most = std::max(most, R(work(unit))); });
            return most;
        }
        results_.resize(units_);
        sweep(backwards, [&](std::size_t unit) { results_[unit] = static_cast<double>(work(unit)); });
        for (const double result : results_) most = std::max(most, static_cast<R>(result));
        return most;
    }

    std::size_t units() const { return units_; }
    std::size_t levels() const { return shared_ ? start_.size() - 1 : units_; }

  private:
    const Tasks* tasks_ = nullptr;
    bool shared_ = false;
    std::size_t units_ = 0, grain_ = 1;
    std::vector<std::uint32_t> next_;   ///< least level of the next unit of each body
    std::vector<std::uint32_t> level_;  ///< level of each unit
    std::vector<std::size_t> start_;    ///< first element of each level in order_
    std::vector<std::size_t> order_;    ///< units by level
    std::vector<double> results_;       ///< result of each unit
};

}  // namespace rigor::engine
