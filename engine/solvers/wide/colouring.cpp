// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace rigor::engine {
namespace {

/// Relative cost of a patch in a pass: two points cost about a third more than one.
constexpr std::uint32_t workOf(std::uint32_t points) {
    return 2 + points;
}
/// The body whose interval a contact is sorted by.
constexpr std::uint32_t keyOf(const PatchDescriptor& descriptor) {
    return descriptor.movesA ? descriptor.a : descriptor.b;
}

}  // namespace

/// Makes intervals and partitions, collects the members of each group, and clears the colours of all bodies.
void Colouring::divide(std::span<const PatchDescriptor> descriptors, std::size_t bodies, const Tasks& tasks) {
    binBits_ = std::max(0, static_cast<int>(std::bit_width(bodies) - std::bit_width(kMaxBins - 1)));
    interval_.resize((bodies >> binBits_) + 1);
    for (auto& taken : taken_) taken.resize(bodies);
    results_.resize(static_cast<std::size_t>(tasks.threads()));
    const auto start = [&](std::size_t n, std::size_t chunk) { return tasks.chunkBegin(n, 1, chunk); };
    const auto own = [&](std::size_t chunk) {
        const std::size_t first = start(descriptors.size(), chunk);
        return descriptors.subspan(first, start(descriptors.size(), chunk + 1) - first);
    };
    tasks.forStages(1, [&](std::size_t, std::size_t chunk) {
        sumWork(own(chunk), results_[chunk]);
        for (auto& taken : taken_)
            std::fill(taken.data() + start(bodies, chunk), taken.data() + start(bodies, chunk + 1), 0);
    });
    makeIntervals();
    contacts_ = points_ = 0;
    for (const ThreadResult& result : results_) {
        contacts_ += result.contacts;
        points_ += result.points;
    }
    // The number of partitions is the largest power of two with enough contacts in each and few cut ones. The
    // number of the last call is tried first.
    const std::size_t many = std::clamp<std::size_t>(contacts_ / kPartitionContacts, 1, kMaxPartitions);
    const int most = static_cast<int>(std::bit_width(many)) - 1;
    partitionBits_ = std::min(partitionBits_, most);
    for (bool converged = false; !converged;) {
        makePartitions(bodies);
        tasks.forStages(1, [&](std::size_t, std::size_t chunk) {
            collectMembers(own(chunk), static_cast<std::uint32_t>(start(descriptors.size(), chunk)),
                           results_[chunk]);
        });
        const int better = betterBits(most);
        converged = better == partitionBits_;
        partitionBits_ = better;
    }
}

/// Sums the work of the contacts of each bin of bodies.
void Colouring::sumWork(std::span<const PatchDescriptor> descriptors, ThreadResult& result) const {
    result.work.assign(interval_.size(), 0);
    result.contacts = result.points = 0;
    for (const PatchDescriptor& descriptor : descriptors) {
        result.contacts += descriptor.points > 0;
        result.points += descriptor.points;
        const std::uint32_t work = descriptor.points > 0 ? workOf(descriptor.points) : 0;
        result.work[descriptor.a >> binBits_] += descriptor.movesA ? work : 0;
        result.work[descriptor.b >> binBits_] += descriptor.movesB ? work : 0;
    }
}

/// Intervals of about equal work. The bodies of an interval are neighbours if bodies are numbered by
/// position.
void Colouring::makeIntervals() {
    std::fill(interval_.begin(), interval_.end(), 0);
    std::uint64_t all = 0, before = 0;
    for (const ThreadResult& result : results_)
        for (std::size_t bin = 0; bin < interval_.size(); ++bin) interval_[bin] += result.work[bin];
    for (const std::uint32_t work : interval_) all += work;
    if (all == 0) return;
    const double perWork = kIntervals / static_cast<double>(all);
    for (std::uint32_t& own : interval_) {
        const auto interval = static_cast<std::uint32_t>(static_cast<double>(before) * perWork);
        before += std::exchange(own, std::min(interval, kIntervals - 1));
    }
}

void Colouring::makePartitions(std::size_t bodies) {
    partitions_.resize(std::size_t(1) << partitionBits_);
    for (std::uint32_t r = 0; r < partitions_.size(); ++r) {
        const auto bin =
            std::lower_bound(interval_.begin(), interval_.end(), r << intervalBits()) - interval_.begin();
        partitions_[r].firstBody =
            static_cast<std::uint32_t>(std::min(bodies, static_cast<std::size_t>(bin) << binBits_));
        partitions_[r].lastBody = static_cast<std::uint32_t>(bodies);
        if (r > 0) partitions_[r - 1].lastBody = partitions_[r].firstBody;
    }
    groups_.resize(std::max(groups_.size(), own(partitions_.size())));
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].intervals = g < own(0) ? kIntervals : 1;
}

/// A single partition would be solved by one thread: all contacts are treated as cut contacts then, and
/// static contacts as a second group of ranges.
void Colouring::collectMembers(std::span<const PatchDescriptor> descriptors, std::uint32_t first,
                               ThreadResult& result) const {
    result.members.resize(groups_.size());
    for (auto& members : result.members) members.clear();
    result.pairs = result.cutPairs = result.finerCutPairs = 0;
    for (std::uint32_t i = 0; i < descriptors.size(); ++i) {
        const PatchDescriptor& descriptor = descriptors[i];
        if (descriptor.points == 0) continue;
        const bool isStatic = !descriptor.movesA || !descriptor.movesB;
        const std::uint32_t a = intervalOf(isStatic ? keyOf(descriptor) : descriptor.a),
                            b = isStatic ? a : intervalOf(descriptor.b);
        const bool isCut = (a ^ b) >> intervalBits() != 0, inside = partitions_.size() > 1 && !isCut;
        result.pairs += !isStatic;
        result.cutPairs += isCut;
        result.finerCutPairs += (a ^ b) >> (intervalBits() - 1) != 0;
        result.members[(inside ? own(a >> intervalBits()) : 0) + isStatic].push_back(first + i);
    }
}

/// The better number of partitions, as its log2: half as many where too many pairs are cut, twice as many
/// where few would be cut.
int Colouring::betterBits(int most) const {
    std::size_t pairs = 0, cutPairs = 0, finerCutPairs = 0;
    for (const ThreadResult& result : results_) {
        pairs += result.pairs;
        cutPairs += result.cutPairs;
        finerCutPairs += result.finerCutPairs;
    }
    if (5 * cutPairs > pairs) return partitionBits_ - 1;
    return partitionBits_ < most && 5 * finerCutPairs <= pairs ? partitionBits_ + 1 : partitionBits_;
}

/// Chooses the colour and the bucket of each contact of a group; `begin` gets the sizes of the buckets.
void Colouring::chooseColours(std::span<const PatchDescriptor> descriptors, std::size_t g) {
    Group& group = groups_[g];
    const bool inside = g >= own(0), isStatic = g % 2 == 1;
    group.members.clear();
    group.colours = 0;
    group.begin.assign(group.perColour(), 0);
    std::vector<std::uint64_t>& taken = taken_[isStatic ? 2 : inside];
    const auto add = [&](std::uint32_t i) {
        const PatchDescriptor& descriptor = descriptors[i];
        const std::uint64_t of =
            (descriptor.movesA ? taken[descriptor.a] : 0) | (descriptor.movesB ? taken[descriptor.b] : 0);
        const auto colour = static_cast<std::uint32_t>(std::countr_one(of));
        const std::uint32_t sizeClass =
            kSizeClasses - std::min<std::uint32_t>(descriptor.points, kSizeClasses);
        const std::uint32_t interval = inside ? 0 : intervalOf(keyOf(descriptor));
        const std::uint32_t bucket = (colour * kSizeClasses + sizeClass) * group.intervals + interval;
        group.members.push_back({i, bucket});
        if (bucket >= group.begin.size()) group.begin.resize((colour + 1) * group.perColour(), 0);
        ++group.begin[bucket];
        if (colour == kColours) return;
        const std::uint64_t bit = std::uint64_t(1) << colour;
        if (descriptor.movesA) taken[descriptor.a] |= bit;
        if (descriptor.movesB) taken[descriptor.b] |= bit;
        group.colours = std::max(group.colours, colour + 1);
    };
    for (const ThreadResult& result : results_)
        for (const std::uint32_t i : result.members[g]) add(i);
    group.begin.resize((group.colours + 1) * group.perColour(), 0);
}

/// First lane of each bucket: sorted by colour, then by falling number of points, then by interval; at last
/// the overflow, one contact per block.
void Colouring::countLanes(Group& group, std::uint32_t lanes) {
    std::uint32_t place = 0;
    for (std::uint32_t k = 0; k < group.begin.size(); ++k) {
        if (k % group.perColour() == 0) place = (place + lanes - 1) / lanes * lanes;
        place += (k < group.colours * group.perColour() ? 1 : lanes) * std::exchange(group.begin[k], place);
    }
    group.blocks = (place + lanes - 1) / lanes;
}

void Colouring::assignLanes(Group& group, std::uint32_t lanes) {
    std::uint32_t* const contents = laneContents_.data() + group.block * lanes;
    std::fill_n(contents, group.blocks * lanes, kNullIndex);
    const std::uint32_t overflow = group.colours * group.perColour();
    for (const auto& [descriptor, bucket] : group.members) {
        std::uint32_t& next = group.begin[bucket];
        contents[std::exchange(next, next + (bucket < overflow ? 1 : lanes))] = descriptor;
    }
}

/// Adds a range for each colour of a group and for each overflow block; called before assignLanes.
void Colouring::addRanges(const Group& group, std::uint32_t lanes) {
    const std::uint32_t perColour = group.perColour();
    const auto blockAt = [&](std::uint32_t colour) {
        return group.block + group.begin[colour * perColour] / lanes;
    };
    for (std::uint32_t c = 0; c < group.colours; ++c) {
        ranges_.push_back({blockAt(c), blockAt(c + 1), static_cast<std::uint32_t>(tables_.size())});
        Table& table = tables_.emplace_back();
        for (std::uint32_t k = 0; k < perColour; ++k)
            table[k / kIntervals][k % kIntervals] =
                group.block + (group.begin[c * perColour + k] + lanes / 2) / lanes;
    }
    for (std::uint32_t block = blockAt(group.colours); block < group.block + group.blocks; ++block)
        ranges_.push_back({block, block + 1, kNullIndex});
}

void Colouring::colour(std::span<const PatchDescriptor> descriptors, std::size_t bodies, std::uint32_t lanes,
                       const Tasks& tasks) {
    divide(descriptors, bodies, tasks);
    tasks.forEach(groups().size(), 1, [&](std::size_t g) {
        chooseColours(descriptors, g);
        countLanes(groups_[g], lanes);
    });
    blocks_ = 0;
    for (Group& group : groups()) {
        group.block = blocks_;
        blocks_ += group.blocks;
    }
    for (std::size_t r = 0; r < partitions_.size(); ++r) {
        const Group &own = groups_[Colouring::own(r)], &statics = groups_[Colouring::own(r) + 1];
        partitions_[r].first = own.block;
        partitions_[r].last = statics.block + statics.blocks;
    }
    ranges_.clear();
    tables_.clear();
    for (std::size_t g = 0; g < own(0); ++g) addRanges(groups_[g], lanes);
    laneContents_.resize(blocks_ * lanes);
    tasks.forEach(groups().size(), 1, [&](std::size_t g) { assignLanes(groups_[g], lanes); });
}

/// First block of an interval in a size class; interval kIntervals: end of the size class.
std::uint32_t Colouring::end(const Range& range, std::uint32_t sizeClass, std::uint32_t interval) const {
    const Table& begin = tables_[range.table];
    if (interval < kIntervals) return begin[sizeClass][interval];
    return sizeClass + 1 < kSizeClasses ? begin[sizeClass + 1][0] : range.last;
}

/// Splits at the border of an interval. If a thread would then have much more work than others in this range,
/// the split moves as far as needed towards an even split of every size class.
Colouring::Split Colouring::split(const Range& range, double fraction) const {
    constexpr double kUneven = 1.0 / 16;  // a chunk may exceed its size by this fraction of a range
    constexpr double kLeast = workOf(kSizeClasses) / 2;  // or by half a block, if that is more
    Split at;
    if (range.table == kNullIndex) {
        at.fill(range.last);
        if (fraction < 1) at[0] = range.first;
        return at;
    }
    const auto intervals = static_cast<std::uint32_t>(fraction * kIntervals + 0.5);
    double all = 0, bySplit = 0;
    for (std::uint32_t sizeClass = 0; sizeClass < kSizeClasses; ++sizeClass) {
        const std::uint32_t begin = end(range, sizeClass, 0), last = end(range, sizeClass, kIntervals);
        const double work = workOf(kSizeClasses - sizeClass);
        at[sizeClass] = end(range, sizeClass, intervals);
        all += work * (last - begin);
        bySplit += work * (at[sizeClass] - begin);
    }
    const double off = std::abs(bySplit - fraction * all), slack = std::max(kUneven * all, kLeast);
    if (fraction == 0 || fraction == 1 || off <= slack) return at;
    const double rest = slack / off;
    for (std::uint32_t sizeClass = 0; sizeClass < kSizeClasses; ++sizeClass) {
        const double begin = end(range, sizeClass, 0),
                     even = begin + fraction * (end(range, sizeClass, kIntervals) - begin);
        at[sizeClass] = static_cast<std::uint32_t>(even + rest * (at[sizeClass] - even) + 0.5);
    }
    return at;
}

}  // namespace rigor::engine
