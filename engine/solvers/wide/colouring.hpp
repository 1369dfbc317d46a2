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
    static constexpr std::uint32_t kKinds = 4;  ///< of patches: 4 and more, 3, 2, 1 points
    static constexpr std::uint32_t kSlices =
        32;  ///< of all bodies, as they are numbered, with as much work each

    /// Blocks of lanes that may be worked on in any order: kind by kind, of a kind slice by slice.
    struct Range {
        std::uint32_t first, last;
        std::array<std::array<std::uint32_t, kSlices>, kKinds> begin;  ///< of a slice of a kind
        /// Of slices [0, slice) of a kind.
        std::uint32_t end(std::uint32_t kind, std::uint32_t slice) const {
            if (slice < kSlices) return begin[kind][slice];
            return kind + 1 < kKinds ? begin[kind + 1][0] : last;
        }
    };
    /// Where a range is cut, of each kind before this block.
    using Cut = std::array<std::uint32_t, kKinds>;

    /// Places `plans` of a world of `bodies` bodies into blocks of `lanes` lanes.
    void colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes);

    /// Where each plan comes: block * lanes + lane.
    std::span<const std::uint32_t> places() const { return places_; }
    std::uint32_t blocks() const { return blocks_; }
    /// In the order in which they are to be worked on.
    std::span<const Range> ranges() const { return ranges_; }
    /// Cuts a range where `part` (0 .. 1) of all work lies before. What lies between such cuts has the same
    /// bodies in all ranges, but for some at the seams, so that a thread finds them in its own cache; but it
    /// is never so much that others would wait for it.
    static Cut cut(const Range& range, double part);

  private:
    static constexpr std::uint32_t kColours = 64;

    void chooseColours(std::span<const PatchPlan> plans, std::size_t bodies);
    void slice(std::span<const PatchPlan> plans, std::size_t bodies);
    void place(std::span<const PatchPlan> plans, std::uint32_t lanes);
    void addRanges(std::span<const std::uint32_t> starts, bool alone, std::uint32_t first, std::uint32_t last,
                   std::uint32_t lanes);

    std::vector<std::uint64_t> taken_;  ///< colours of each body
    std::vector<std::uint8_t> colour_;  ///< of each plan: moving pairs, their rest, walls, their rest
    std::vector<std::uint32_t>
        slice_;  ///< of each body: work of the plans that it is the first of; its slice
    std::vector<std::uint32_t> bucket_, count_;  ///< of each plan; by colour, kind and slice
    std::vector<std::uint32_t> places_;
    std::vector<Range> ranges_;
    std::uint32_t blocks_ = 0;
};

}  // namespace rigor::engine
