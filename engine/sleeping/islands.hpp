// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Islands: dynamic bodies that contacts and joints connect, directly or through others. Events in one island
// do not affect another within the step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/disjoint_sets.hpp"
#include "engine/core/ids.hpp"

namespace rigor::engine {

/// begin, join per contact and joint, finish. O((bodies + joins) log bodies), no allocation once the number of
/// bodies has stopped growing.
class Islands {
  public:
    /// Bodies 0..n-1, each alone.
    void begin(std::uint32_t n) { sets_.begin(n); }
    void join(std::uint32_t a, std::uint32_t b) { sets_.join(a, b); }
    /// Numbers the islands of the bodies with member[i] != 0, by their lowest body.
    void finish(std::span<const std::uint8_t> member, std::span<const BodyId> ids);

    std::size_t count() const { return starts_.size() - 1; }
    /// Members of island k, in ascending dense order.
    std::span<const std::uint32_t> members(std::size_t k) const {
        return {members_.data() + starts_[k], starts_[k + 1] - starts_[k]};
    }
    std::span<const BodyId> bodies(std::size_t k) const {
        return {ids_.data() + starts_[k], starts_[k + 1] - starts_[k]};
    }
    /// Island of the body with this dense index; kNullIndex where it is in none.
    std::uint32_t islandOf(std::uint32_t body) const {
        return body < island_.size() ? island_[body] : kNullIndex;
    }

  private:
    DisjointSets sets_;
    std::vector<std::uint32_t> island_;
    std::vector<std::uint32_t> starts_ = {0}, members_;
    std::vector<BodyId> ids_;
};

}  // namespace rigor::engine
