// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Graph colouring of contacts: those of one colour have no moving body in common, so that they can be solved
// side by side, in lanes and by threads, without a change of the result. Greedy: in their order, the lowest
// colour that neither body has yet. Contacts between two moving bodies come first, those with a wall after
// them, which then have the last word. The result depends on the contacts and their order alone.
//
// A body with more than kColours contacts leaves the rest over; those are solved one by one, after their
// kind.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rigor::engine {

/// A contact to be placed.
struct PatchPlan {
    std::uint32_t a, b;   ///< bodies
    bool movesA, movesB;  ///< they take impulses; one of them does
    std::uint8_t points;  ///< 1..; contacts of as many points come together in a colour
    bool operator==(const PatchPlan&) const = default;
};

class Colouring {
  public:
    static constexpr std::uint32_t kSlices = 4;   ///< at most
    static constexpr std::uint32_t kUneven = 16;  ///< a share may be larger by this part of a range

    /// Blocks of lanes that may be worked on in any order. Their slices are those of all ranges: a thread
    /// that takes the same ones in each meets the same bodies again, but for few where slices meet, and has
    /// about as much to do as the others.
    struct Range {
        std::uint32_t slices = 1;
        std::array<std::uint32_t, kSlices + 1> cut{};  ///< slice k is [cut[k], cut[k + 1])
        std::uint32_t first() const { return cut[0]; }
        std::uint32_t last() const { return cut[slices]; }
        /// Where the share of thread `share` <= of begins: at the slices' bodies, or, where that would leave
        /// threads waiting for one that has much more to do in this range, not far from an even cut.
        std::uint32_t begin(std::size_t share, std::size_t of) const {
            const std::size_t at = share * slices, k = at / of, rest = at % of;
            const std::size_t sliced = cut[k] + (rest == 0 ? 0 : (cut[k + 1] - cut[k]) * rest / of);
            const std::size_t n = last() - first(), slack = n / kUneven, even = first() + n * share / of;
            if (share == 0 || share == of) return static_cast<std::uint32_t>(even);
            return static_cast<std::uint32_t>(
                std::clamp(sliced, even - std::min(slack, even - first()), even + slack));
        }
    };

    /// Places `plans` of a world of `bodies` bodies into blocks of `lanes` lanes.
    void colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes);

    /// Where each plan comes: block * lanes + lane.
    std::span<const std::uint32_t> places() const { return places_; }
    std::uint32_t blocks() const { return blocks_; }
    /// In the order in which they are to be worked on.
    std::span<const Range> ranges() const { return ranges_; }

  private:
    static constexpr std::uint32_t kColours = 64;
    static constexpr std::uint32_t kKinds = 4;  ///< by number of points, at least that many

    void chooseColours(std::span<const PatchPlan> plans, std::size_t bodies);
    void slice(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes);
    void place(std::span<const PatchPlan> plans, std::uint32_t lanes);

    std::vector<std::uint64_t> taken_;  ///< colours of each body
    std::vector<std::uint8_t> colour_;  ///< of each plan: moving pairs, their rest, walls, their rest
    std::vector<std::uint32_t> bucket_, count_;  ///< of each plan; by colour, slice and kind
    std::vector<std::uint32_t> slice_;           ///< of each body: plans that it is the first of; their slice
    std::vector<std::uint32_t> places_;
    std::vector<Range> ranges_;
    std::uint32_t blocks_ = 0, slices_ = 1;
};

}  // namespace rigor::engine
