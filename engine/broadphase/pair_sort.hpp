// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs found in any order, by any number of threads, into one sorted list.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {

/// A counting sort by a, then each a's few pairs by b: O(proxies + pairs), where a sort by comparisons of the
/// 50 000 pairs of 100 000 boxes costs as much as finding them. No allocation once the numbers have stopped
/// growing.
class PairSort {
  public:
    /// Replaces `sorted` by all pairs of all parts, sorted; all indices are below `proxies`.
    void sort(std::span<const std::vector<ProxyPair>> parts, std::size_t proxies,
              std::vector<ProxyPair>& sorted, const Tasks& tasks);

  private:
    struct Range {
        std::uint32_t begin = 0, end = 0, first = 0, count = 0;  ///< proxies a in [begin, end); first place
                                                                 ///< and number of their pairs
    };
    void count(std::span<const std::vector<ProxyPair>> parts, Range& range);
    void place(std::span<const std::vector<ProxyPair>> parts, const Range& range,
               std::vector<ProxyPair>& sorted);

    std::vector<std::uint32_t> ends_;  ///< number of pairs of each a, then the place of its next pair
    std::vector<Range> ranges_;
};

}  // namespace rigor::engine
