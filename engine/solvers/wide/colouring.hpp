// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// In what order contacts are worked on, in lanes and by threads, without a change of the result. Bodies are
// divided into regions, as they are numbered. Contacts across regions come first. Then come those within the
// regions, and each region's contacts with walls, which have the last word: regions have no moving body in
// common, so that a thread works on its own ones without waiting for others.
//
// Among the contacts of each of these groups, graph colouring: those of one colour have no moving body in
// common, so that they can be solved side by side. Greedy: in their order, the lowest colour that neither
// body has yet. A body with more than kColours contacts of a group leaves the rest over; those are solved one
// by one. All this depends on the contacts and their order alone.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/ids.hpp"
#include "engine/core/tasks.hpp"

namespace rigor::engine {

/// A contact to be placed.
struct PatchPlan {
    std::uint32_t a, b;   ///< bodies
    bool movesA, movesB;  ///< they take impulses; one of them does
    std::uint8_t points;  ///< 0: to be passed over; contacts of as many come together in a colour
    bool operator==(const PatchPlan&) const = default;
};

class Colouring {
  public:
    /// Of patches: 4 and more, 3, 2, 1 points.
    static constexpr std::uint32_t kKinds = 4;
    /// Of all bodies, as they are numbered, with as much work each; a region has some of them.
    static constexpr std::uint32_t kSlices = 32;
    /// A region has at least as many contacts, on average: threads wait for each other less, but blocks are
    /// filled less well.
    static constexpr std::size_t kRegionContacts = 512;
    static constexpr std::uint32_t kMostRegions = 16;

    /// Bodies [firstBody, lastBody), and the blocks of their contacts with each other, to be worked on in
    /// order.
    struct Region {
        std::uint32_t first = 0, last = 0, firstBody = 0, lastBody = 0;
    };
    /// Blocks of lanes that may be worked on in any order: kind by kind, of a kind slice by slice.
    struct Range {
        std::uint32_t first, last;
        std::uint32_t table;  ///< where its slices begin; kNullIndex: a single block
    };
    /// Where a range is cut, of each kind before this block.
    using Cut = std::array<std::uint32_t, kKinds>;

    /// Places `plans` of a world of `bodies` bodies into blocks of `lanes` lanes.
    void colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes,
                const Tasks& tasks);

    /// The plan in each lane of the blocks, one block after the other, or kNullIndex.
    std::span<const std::uint32_t> occupants() const { return occupants_; }
    std::uint32_t blocks() const { return blocks_; }
    /// That have been placed, and their points.
    std::size_t contacts() const { return contacts_; }
    std::size_t points() const { return points_; }
    /// The first blocks, in the order in which they are to be worked on.
    std::span<const Range> ranges() const { return ranges_; }
    /// They have the other blocks; at least one, all together have all bodies.
    std::span<const Region> regions() const { return regions_; }
    /// Cuts a range where `part` (0 .. 1) of all work lies before. What lies between such cuts has the same
    /// bodies in all ranges, but for some at the seams, so that a thread finds them in its own cache; but it
    /// is never so much that others would wait for it.
    Cut cut(const Range& range, double part) const;

  private:
    static constexpr std::uint32_t kColours = 64;
    /// Where a slice of a kind begins.
    using Table = std::array<std::array<std::uint32_t, kSlices>, kKinds>;
    /// Contacts that are coloured by themselves.
    struct Group {
        struct Member {
            std::uint32_t plan, bucket;  ///< by colour, kind and slice
        };
        std::vector<Member> members;
        std::uint32_t slices = 1;   ///< that its buckets are divided into
        std::uint32_t colours = 0;  ///< beside those that are left over
        std::uint32_t block = 0, blocks = 0;
        std::vector<std::uint32_t> begin;  ///< places in the group, by bucket
        std::uint32_t perColour() const { return kKinds * slices; }
    };
    /// What a thread finds in its part of the plans. All that is made of it is the same for other parts.
    struct alignas(64) Part {
        std::vector<std::uint32_t> work;  ///< of the bodies of each bin
        std::size_t contacts, points;
        std::size_t pairs, across, finer;  ///< of two bodies; in two regions; if there were twice as many
        std::vector<std::vector<std::uint32_t>> members;  ///< of each group
    };
    /// Bodies go to slices by bins, a power of two of neighbours in each, at most as many bins as this.
    static constexpr std::uint32_t kMostBins = 1024;
    std::uint32_t sliceOf(std::uint32_t body) const { return slice_[body >> binBits_]; }
    /// The groups of a region that are no ranges.
    static constexpr std::size_t own(std::size_t region) { return 2 + 2 * region; }

    void divide(std::span<const PatchPlan> plans, std::size_t bodies, const Tasks& tasks);
    void weigh(std::span<const PatchPlan> plans, Part& part) const;
    void slice();
    void makeRegions(std::size_t bodies);
    int sliceBits() const { return std::countr_zero(kSlices) - regionBits_; }
    std::span<Group> groups() { return {groups_.data(), own(regions_.size())}; }
    void list(std::span<const PatchPlan> plans, std::uint32_t first, Part& part) const;
    int betterBits(int most) const;
    void chooseColours(std::span<const PatchPlan> plans, std::size_t g);
    static void count(Group& group, std::uint32_t lanes);
    void place(Group& group, std::uint32_t lanes);
    void addRanges(const Group& group, std::uint32_t lanes);
    std::uint32_t end(const Range& range, std::uint32_t kind, std::uint32_t slice) const;

    int binBits_ = 0;                   ///< of the number of bodies in a bin
    std::vector<std::uint32_t> slice_;  ///< of each bin
    std::vector<Part> parts_;           ///< of each thread
    int regionBits_ = 0;                ///< of the number of regions
    std::vector<Region> regions_ = std::vector<Region>(1);
    /// Across regions; with walls, if there is one region; then of each region its own and those with walls.
    std::vector<Group> groups_;                        ///< own(regions_.size()) of them are in use
    std::array<std::vector<std::uint64_t>, 3> taken_;  ///< colours of each body: across, in regions, of walls
    std::vector<std::uint32_t> occupants_;
    std::vector<Range> ranges_;
    std::vector<Table> tables_;
    std::uint32_t blocks_ = 0;
    std::size_t contacts_ = 0, points_ = 0;
};

}  // namespace rigor::engine
