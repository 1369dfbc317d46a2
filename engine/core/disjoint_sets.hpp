// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Disjoint sets of the numbers 0..n-1 by union-find [Tarjan1975]. The root of a set is its lowest number; paths
// are halved on the way up. O((n + joins) log n), no allocation once n has stopped growing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rigor::engine {

class DisjointSets {
  public:
    /// Numbers 0..n-1, each alone.
    void begin(std::uint32_t n) {
        parent_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) parent_[i] = i;
    }
    std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }
    std::uint32_t rootOf(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = rootOf(a);
        b = rootOf(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace rigor::engine
