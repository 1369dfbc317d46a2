// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Assigns contacts to SIMD lanes and blocks, in an order that threads can follow without changing the result.
//
//     bodies by index    | interval 0 | interval 1 | interval 2 | ... | interval 31 |   equal work each
//                        |<----- partition 0 ----->|<----- partition 1 -----> ...       1 to 16 of them
//
//     blocks    | cut contacts: colour 0 | colour 1 | .. | overflow | partition 0          | partition 1 ..
//               |   split among the threads, barrier after each     | pairs, then static   | one thread each
//
// Cut contacts join bodies of two partitions and come first. Then come the contacts within each partition, at
// last those with static bodies, so that a Gauss-Seidel pass ends with them. Partitions have no moving body
// in common: a thread solves its own without a barrier.
//
// Each of these groups is coloured as a graph: contacts of one colour have no moving body in common, so that
// they can be solved in parallel, in lanes or by threads. The colouring is greedy, in the contacts' order:
// the lowest colour that neither body has yet. A body has at most kColours colours per group; further
// contacts are overflow constraints, solved one by one in blocks of their own. Invariant: the result depends
// only on the contacts and their order, not on the number of threads.
//
// The partitions are a domain decomposition whose interface (the cut contacts) is solved first.
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

/// A contact to be assigned to a lane.
struct PatchDescriptor {
    std::uint32_t a, b;   ///< bodies
    bool movesA, movesB;  ///< the body takes impulses; true for at least one of them
    std::uint8_t points;  ///< 0: no lane; contacts with equally many points are neighbours within a colour
    bool operator==(const PatchDescriptor&) const = default;
};

class Colouring {
  public:
    /// Size classes of patches: 4 and more, 3, 2, 1 points.
    static constexpr std::uint32_t kSizeClasses = 4;
    /// Intervals of consecutive bodies with about equal work; a partition is a run of intervals.
    static constexpr std::uint32_t kIntervals = 32;
    /// Least mean number of contacts of a partition. More partitions mean fewer barriers, but blocks with
    /// more empty lanes.
    static constexpr std::size_t kPartitionContacts = 512;
    static constexpr std::uint32_t kMaxPartitions = 16;

    /// Bodies [firstBody, lastBody), and the blocks [first, last) of the contacts within them, to be solved
    /// in order.
    struct Partition {
        std::uint32_t first = 0, last = 0, firstBody = 0, lastBody = 0;
    };
    /// Blocks of one colour, which may be solved in any order. They are sorted by size class, within a class
    /// by interval.
    struct Range {
        std::uint32_t first, last;
        std::uint32_t table;  ///< index of the table of its intervals; kNullIndex: a single overflow block
    };
    /// Split of a range between two threads: the block of each size class before which it is.
    using Split = std::array<std::uint32_t, kSizeClasses>;

    /// Assigns the contacts of a world of `bodies` bodies to blocks of `lanes` lanes.
    void colour(std::span<const PatchDescriptor> descriptors, std::size_t bodies, std::uint32_t lanes,
                const Tasks& tasks);

    /// Index of the descriptor in each lane, block after block; kNullIndex: an empty lane.
    std::span<const std::uint32_t> laneContents() const { return laneContents_; }
    std::uint32_t blocks() const { return blocks_; }
    /// Contacts with a lane, and their points.
    std::size_t contacts() const { return contacts_; }
    std::size_t points() const { return points_; }
    /// The first blocks, those of the cut contacts, in the order in which they are to be solved.
    std::span<const Range> ranges() const { return ranges_; }
    /// The other blocks. There is at least one partition; together they have all bodies.
    std::span<const Partition> partitions() const { return partitions_; }
    /// Splits a range where the `fraction` (0 .. 1) of its work is before. The work between two such splits
    /// belongs, but for some at the ends, to the same bodies in all ranges, so that a thread finds them in
    /// its own cache; it is moved as far as needed to keep the threads' work even.
    Split split(const Range& range, double fraction) const;

  private:
    static constexpr std::uint32_t kColours = 64;
    /// First block of each interval in each size class.
    using Table = std::array<std::array<std::uint32_t, kIntervals>, kSizeClasses>;
    /// A set of contacts with a colouring of its own.
    struct Group {
        struct Member {
            std::uint32_t descriptor, bucket;  ///< bucket: by colour, size class and interval
        };
        std::vector<Member> members;
        std::uint32_t intervals = 1;  ///< intervals in each size class of a colour
        std::uint32_t colours = 0;    ///< number of colours without the overflow
        std::uint32_t block = 0, blocks = 0;
        std::vector<std::uint32_t> begin;  ///< first lane of each bucket in the group
        std::uint32_t perColour() const { return kSizeClasses * intervals; }
    };
    /// Result of one thread on its range of the descriptors. Sums over the threads do not depend on the
    /// ranges.
    struct alignas(64) ThreadResult {
        std::vector<std::uint32_t> work;  ///< work of the bodies of each bin
        std::size_t contacts, points;
        std::size_t pairs;                                ///< contacts of two moving bodies
        std::size_t cutPairs;                             ///< pairs of two partitions
        std::size_t finerCutPairs;                        ///< the same if there were twice as many partitions
        std::vector<std::vector<std::uint32_t>> members;  ///< members of each group
    };
    /// Bodies are assigned to intervals by bins of 2^binBits_ consecutive bodies; the most bins there are.
    static constexpr std::uint32_t kMaxBins = 1024;
    std::uint32_t intervalOf(std::uint32_t body) const { return interval_[body >> binBits_]; }
    /// Index of the first of the two groups of a partition; the groups before own(0) are ranges.
    static constexpr std::size_t own(std::size_t partition) { return 2 + 2 * partition; }

    void divide(std::span<const PatchDescriptor> descriptors, std::size_t bodies, const Tasks& tasks);
    void sumWork(std::span<const PatchDescriptor> descriptors, ThreadResult& result) const;
    void makeIntervals();
    void makePartitions(std::size_t bodies);
    int intervalBits() const { return std::countr_zero(kIntervals) - partitionBits_; }
    std::span<Group> groups() { return {groups_.data(), own(partitions_.size())}; }
    void collectMembers(std::span<const PatchDescriptor> descriptors, std::uint32_t first,
                        ThreadResult& result) const;
    int betterBits(int most) const;
    void chooseColours(std::span<const PatchDescriptor> descriptors, std::size_t g);
    static void countLanes(Group& group, std::uint32_t lanes);
    void assignLanes(Group& group, std::uint32_t lanes);
    void addRanges(const Group& group, std::uint32_t lanes);
    std::uint32_t end(const Range& range, std::uint32_t sizeClass, std::uint32_t interval) const;

    int binBits_ = 0;                      ///< log2 of the number of bodies in a bin
    std::vector<std::uint32_t> interval_;  ///< interval of each bin
    std::vector<ThreadResult> results_;    ///< result of each thread
    int partitionBits_ = 0;                ///< log2 of the number of partitions
    std::vector<Partition> partitions_ = std::vector<Partition>(1);
    /// Cut contacts; static contacts, if there is one partition; then of each partition its pairs and its
    /// static contacts.
    std::vector<Group> groups_;                        ///< own(partitions_.size()) of them are in use
    std::array<std::vector<std::uint64_t>, 3> taken_;  ///< colours of each body: cut, in partitions, static
    std::vector<std::uint32_t> laneContents_;
    std::vector<Range> ranges_;
    std::vector<Table> tables_;
    std::uint32_t blocks_ = 0;
    std::size_t contacts_ = 0, points_ = 0;
};

}  // namespace rigor::engine
