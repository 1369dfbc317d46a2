// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/sleeping/islands.hpp"

namespace rigor::engine {

void Islands::finish(std::span<const std::uint8_t> member, std::span<const BodyId> ids) {
    const std::uint32_t n = sets_.size();
    island_.assign(n, kNullIndex);
    starts_.reserve(n + 2);
    starts_.assign(1, 0);
    // Sizes first; a root comes before its bodies, so its number is known when they need it.
    for (std::uint32_t i = 0; i < n; ++i) {
        if (!member[i]) continue;
        const std::uint32_t root = sets_.rootOf(i);
        if (root == i) {
            island_[i] = static_cast<std::uint32_t>(starts_.size() - 1);
            starts_.push_back(0);
        }
        island_[i] = island_[root];
        ++starts_[island_[i] + 1];
    }
    for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    members_.resize(starts_.back());
    ids_.resize(starts_.back());
    // Backwards from the ends, which become the starts.
    for (std::uint32_t i = n; i-- > 0;) {
        if (island_[i] == kNullIndex) continue;
        const std::uint32_t place = --starts_[island_[i] + 1];
        members_[place] = i;
        ids_[place] = ids[i];
    }
    starts_.erase(starts_.begin());
    starts_.push_back(static_cast<std::uint32_t>(members_.size()));
}

}  // namespace rigor::engine
