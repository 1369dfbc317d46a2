// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/elimination_order.hpp"

#include <algorithm>
#include <tuple>

#include "engine/core/ids.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine {

bool EliminationOrder::Key::operator<(const Key& other) const {
    return std::tie(later, earlier, block) < std::tie(other.later, other.earlier, other.block);
}

/// Numbers the bodies of the part and finds their neighbours.
template <class S>
void EliminationOrder::connect(std::span<const Block<S>> blocks, std::span<const std::uint32_t> part,
                               std::size_t bodies) {
    local_.resize(bodies, kNullIndex);
    queue_.clear();  // global indices while they are numbered
    const auto number = [this](std::uint32_t body, bool moves) {
        if (!moves) return kNullIndex;
        if (local_[body] == kNullIndex) {
            local_[body] = static_cast<std::uint32_t>(queue_.size());
            queue_.push_back(body);
        }
        return local_[body];
    };
    first_.clear();
    second_.clear();
    for (const std::uint32_t k : part) {
        first_.push_back(number(blocks[k].a, blocks[k].invMassA > 0));
        second_.push_back(number(blocks[k].b, blocks[k].invMassB > 0));
    }
    const std::size_t n = queue_.size();
    for (const std::uint32_t body : queue_) local_[body] = kNullIndex;
    start_.assign(n + 1, 0);
    const auto forEachEdge = [this](const auto& use) {
        for (std::size_t k = 0; k < first_.size(); ++k) {
            if (first_[k] == kNullIndex || second_[k] == kNullIndex) continue;
            use(first_[k], second_[k]);
            use(second_[k], first_[k]);
        }
    };
    forEachEdge([this](std::uint32_t from, std::uint32_t) { ++start_[from + 1]; });
    for (std::size_t b = 0; b < n; ++b) start_[b + 1] += start_[b];
    other_.resize(start_[n]);
    place_.assign(start_.begin(), start_.end());
    forEachEdge([this](std::uint32_t from, std::uint32_t to) { other_[place_[from]++] = to; });
}

/// Visits all bodies breadth first. Returns the last of them.
std::uint32_t EliminationOrder::visitFrom(std::uint32_t start) {
    place_.assign(start_.size() - 1, kNullIndex);
    queue_.assign(1, start);
    place_[start] = 0;
    for (std::size_t next = 0; next < queue_.size(); ++next)
        for (std::uint32_t e = start_[queue_[next]]; e < start_[queue_[next] + 1]; ++e) {
            if (place_[other_[e]] != kNullIndex) continue;
            place_[other_[e]] = static_cast<std::uint32_t>(queue_.size());
            queue_.push_back(other_[e]);
        }
    return queue_.back();
}

/// Sum over the rows of the square of the number of rows behind them that elimination meets.
template <class S>
void EliminationOrder::estimate(std::span<const Block<S>> blocks) {
    lastRow_.assign(place_.size(), 0);
    std::uint32_t row = 0;
    for (const Key& key : keys_) {
        row += static_cast<std::uint32_t>(blocks[key.block].rows);
        if (key.later == kNullIndex) continue;
        lastRow_[key.later] = row;
        lastRow_[key.earlier] = row;
    }
    cost_ = 0;
    row = 0;
    std::uint32_t end = 0;
    for (const Key& key : keys_) {
        if (key.later != kNullIndex) end = std::max({end, lastRow_[key.later], lastRow_[key.earlier]});
        const double width = end > row ? end - row : 0;
        cost_ += static_cast<double>(blocks[key.block].rows) * width * width;
        row += static_cast<std::uint32_t>(blocks[key.block].rows);
    }
}

template <class S>
void EliminationOrder::apply(std::span<const Block<S>> blocks, std::size_t bodies,
                             std::vector<std::uint32_t>& part) {
    connect(blocks, part, bodies);
    if (start_.size() > 1) visitFrom(visitFrom(0));
    keys_.clear();
    for (std::size_t k = 0; k < part.size(); ++k) {
        // A block with one body that moves counts as of that body twice.
        const std::uint32_t a = first_[k] != kNullIndex ? first_[k] : second_[k];
        const std::uint32_t b = second_[k] != kNullIndex ? second_[k] : first_[k];
        if (a == kNullIndex)
            keys_.push_back({kNullIndex, kNullIndex, part[k]});
        else
            keys_.push_back({std::max(place_[a], place_[b]), std::min(place_[a], place_[b]), part[k]});
    }
    std::sort(keys_.begin(), keys_.end());
    for (std::size_t k = 0; k < part.size(); ++k) part[k] = keys_[k].block;
    estimate(blocks);
}

#define RIGOR_INSTANTIATE(S)                                                         \
    template void EliminationOrder::apply<S>(std::span<const Block<S>>, std::size_t, \
                                             std::vector<std::uint32_t>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
