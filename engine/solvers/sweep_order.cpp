// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/sweep_order.hpp"

#include "engine/solvers/matrix_space.hpp"

namespace rigor::engine {

void SweepOrder::begin(const Tasks& tasks, std::size_t bodies, std::size_t grain) {
    tasks_ = &tasks;
    shared_ = tasks.threads() > 1;
    units_ = 0;
    grain_ = grain;
    level_.clear();
    if (shared_) next_.assign(bodies, 0);
}

template <class S>
void SweepOrder::add(std::span<const Block<S>> unit) {
    ++units_;
    if (!shared_) return;
    std::uint32_t level = 0;
    const auto forEachMoved = [&](auto action) {
        for (const Block<S>& block : unit) {
            if (block.invMassA > 0) action(next_[block.a]);
            if (block.invMassB > 0) action(next_[block.b]);
        }
    };
    forEachMoved([&](std::uint32_t next) { level = std::max(level, next); });
    forEachMoved([&](std::uint32_t& next) { next = level + 1; });
    level_.push_back(level);
}

void SweepOrder::finish() {
    if (!shared_) return;
    // Sorted by counting, so that units keep their order within a level.
    start_.assign(1, 0);
    for (const std::uint32_t level : level_) {
        if (start_.size() < level + std::size_t(2)) start_.resize(level + std::size_t(2), 0);
        ++start_[level + 1];
    }
    for (std::size_t l = 1; l < start_.size(); ++l) start_[l] += start_[l - 1];
    order_.resize(units_);
    for (std::size_t unit = 0; unit < units_; ++unit) order_[start_[level_[unit]]++] = unit;
    // Every start has moved on to the next one.
    for (std::size_t l = start_.size() - 1; l > 0; --l) start_[l] = start_[l - 1];
    start_[0] = 0;
}

#define RIGOR_INSTANTIATE(S) template void SweepOrder::add<S>(std::span<const Block<S>>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
RIGOR_INSTANTIATE(MatrixSpace<2>)
RIGOR_INSTANTIATE(MatrixSpace<3>)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
