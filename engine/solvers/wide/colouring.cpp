// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace rigor::engine {
namespace {

/// What a visit costs, about: two points half as much again as one.
constexpr std::uint32_t workOf(std::uint32_t points) {
    return 2 + points;
}
/// The body that says to which slice a contact belongs.
constexpr std::uint32_t keyOf(const PatchPlan& plan) {
    return plan.movesA ? plan.a : plan.b;
}

}  // namespace

/// Slices, regions, and the contacts of each group; no body has a colour.
void Colouring::divide(std::span<const PatchPlan> plans, std::size_t bodies, const Tasks& tasks) {
    binBits_ = std::max(0, static_cast<int>(std::bit_width(bodies) - std::bit_width(kMostBins - 1)));
    slice_.resize((bodies >> binBits_) + 1);
    for (auto& taken : taken_) taken.resize(bodies);
    parts_.resize(static_cast<std::size_t>(tasks.threads()));
    const auto start = [&](std::size_t n, std::size_t share) { return tasks.cut(n, 1, share); };
    const auto own = [&](std::size_t share) {
        const std::size_t first = start(plans.size(), share);
        return plans.subspan(first, start(plans.size(), share + 1) - first);
    };
    tasks.forStages(1, [&](std::size_t, std::size_t share) {
        weigh(own(share), parts_[share]);
        for (auto& taken : taken_)
            std::fill(taken.data() + start(bodies, share), taken.data() + start(bodies, share + 1), 0);
    });
    slice();
    contacts_ = points_ = 0;
    for (const Part& part : parts_) {
        contacts_ += part.contacts;
        points_ += part.points;
    }
    // As many regions, a power of two, as have enough contacts, few of them across; about as many as last
    // time, which is tried first.
    const std::size_t many = std::clamp<std::size_t>(contacts_ / kRegionContacts, 1, kMostRegions);
    const int most = static_cast<int>(std::bit_width(many)) - 1;
    regionBits_ = std::min(regionBits_, most);
    for (bool settled = false; !settled;) {
        makeRegions(bodies);
        tasks.forStages(1, [&](std::size_t, std::size_t share) {
            list(own(share), static_cast<std::uint32_t>(start(plans.size(), share)), parts_[share]);
        });
        const int better = betterBits(most);
        settled = better == regionBits_;
        regionBits_ = better;
    }
}

/// The work of the contacts that bodies are in.
void Colouring::weigh(std::span<const PatchPlan> plans, Part& part) const {
    part.work.assign(slice_.size(), 0);
    part.contacts = part.points = 0;
    for (const PatchPlan& plan : plans) {
        part.contacts += plan.points > 0;
        part.points += plan.points;
        const std::uint32_t work = plan.points > 0 ? workOf(plan.points) : 0;
        part.work[plan.a >> binBits_] += plan.movesA ? work : 0;
        part.work[plan.b >> binBits_] += plan.movesB ? work : 0;
    }
}

/// By work: as far as bodies are numbered as they lie, those of a slice are neighbours.
void Colouring::slice() {
    std::fill(slice_.begin(), slice_.end(), 0);
    std::uint64_t all = 0, before = 0;
    for (const Part& part : parts_)
        for (std::size_t bin = 0; bin < slice_.size(); ++bin) slice_[bin] += part.work[bin];
    for (const std::uint32_t work : slice_) all += work;
    if (all == 0) return;
    const double perWork = kSlices / static_cast<double>(all);
    for (std::uint32_t& own : slice_) {
        const auto slice = static_cast<std::uint32_t>(static_cast<double>(before) * perWork);
        before += std::exchange(own, std::min(slice, kSlices - 1));
    }
}

void Colouring::makeRegions(std::size_t bodies) {
    regions_.resize(std::size_t(1) << regionBits_);
    for (std::uint32_t r = 0; r < regions_.size(); ++r) {
        const auto bin = std::lower_bound(slice_.begin(), slice_.end(), r << sliceBits()) - slice_.begin();
        regions_[r].firstBody =
            static_cast<std::uint32_t>(std::min(bodies, static_cast<std::size_t>(bin) << binBits_));
        regions_[r].lastBody = static_cast<std::uint32_t>(bodies);
        if (r > 0) regions_[r - 1].lastBody = regions_[r].firstBody;
    }
    groups_.resize(std::max(groups_.size(), own(regions_.size())));
    for (std::size_t g = 0; g < groups_.size(); ++g) groups_[g].slices = g < own(0) ? kSlices : 1;
}

/// A single region would be one thread's: all contacts are shared then as those across regions are.
void Colouring::list(std::span<const PatchPlan> plans, std::uint32_t first, Part& part) const {
    part.members.resize(groups_.size());
    for (auto& members : part.members) members.clear();
    part.pairs = part.across = part.finer = 0;
    for (std::uint32_t i = 0; i < plans.size(); ++i) {
        const PatchPlan& plan = plans[i];
        if (plan.points == 0) continue;
        const bool wall = !plan.movesA || !plan.movesB;
        const std::uint32_t a = sliceOf(wall ? keyOf(plan) : plan.a), b = wall ? a : sliceOf(plan.b);
        const bool across = (a ^ b) >> sliceBits() != 0, inside = regions_.size() > 1 && !across;
        part.pairs += !wall;
        part.across += across;
        part.finer += (a ^ b) >> (sliceBits() - 1) != 0;
        part.members[(inside ? own(a >> sliceBits()) : 0) + wall].push_back(first + i);
    }
}

/// Of the number of regions, after they were listed: one less where too many pairs are across, one more where
/// few would be.
int Colouring::betterBits(int most) const {
    std::size_t pairs = 0, across = 0, finer = 0;
    for (const Part& part : parts_) {
        pairs += part.pairs;
        across += part.across;
        finer += part.finer;
    }
    if (5 * across > pairs) return regionBits_ - 1;
    return regionBits_ < most && 5 * finer <= pairs ? regionBits_ + 1 : regionBits_;
}

/// And the bucket of each contact, of which begin gets the sizes.
void Colouring::chooseColours(std::span<const PatchPlan> plans, std::size_t g) {
    Group& group = groups_[g];
    const bool inside = g >= own(0), wall = g % 2 == 1;
    group.members.clear();
    group.colours = 0;
    group.begin.assign(group.perColour(), 0);
    std::vector<std::uint64_t>& taken = taken_[wall ? 2 : inside];
    const auto add = [&](std::uint32_t i) {
        const PatchPlan& plan = plans[i];
        const std::uint64_t of = (plan.movesA ? taken[plan.a] : 0) | (plan.movesB ? taken[plan.b] : 0);
        const auto colour = static_cast<std::uint32_t>(std::countr_one(of));
        const std::uint32_t kind = kKinds - std::min<std::uint32_t>(plan.points, kKinds);
        const std::uint32_t slice = inside ? 0 : sliceOf(keyOf(plan));
        const std::uint32_t bucket = (colour * kKinds + kind) * group.slices + slice;
        group.members.push_back({i, bucket});
        if (bucket >= group.begin.size()) group.begin.resize((colour + 1) * group.perColour(), 0);
        ++group.begin[bucket];
        if (colour == kColours) return;
        const std::uint64_t bit = std::uint64_t(1) << colour;
        if (plan.movesA) taken[plan.a] |= bit;
        if (plan.movesB) taken[plan.b] |= bit;
        group.colours = std::max(group.colours, colour + 1);
    };
    for (const Part& part : parts_)
        for (const std::uint32_t i : part.members[g]) add(i);
    group.begin.resize((group.colours + 1) * group.perColour(), 0);
}

/// Colours one after the other, of a colour by falling number of points, of a kind by slices, then in their
/// order; at last what is left over, each in a block of its own.
void Colouring::count(Group& group, std::uint32_t lanes) {
    std::uint32_t place = 0;
    for (std::uint32_t k = 0; k < group.begin.size(); ++k) {
        if (k % group.perColour() == 0) place = (place + lanes - 1) / lanes * lanes;
        place += (k < group.colours * group.perColour() ? 1 : lanes) * std::exchange(group.begin[k], place);
    }
    group.blocks = (place + lanes - 1) / lanes;
}

void Colouring::place(Group& group, std::uint32_t lanes) {
    std::uint32_t* const occupants = occupants_.data() + group.block * lanes;
    std::fill_n(occupants, group.blocks * lanes, kNullIndex);
    const std::uint32_t alone = group.colours * group.perColour();
    for (const auto& [plan, bucket] : group.members) {
        std::uint32_t& next = group.begin[bucket];
        occupants[std::exchange(next, next + (bucket < alone ? 1 : lanes))] = plan;
    }
}

/// Of a group that has slices, before its plans are placed.
void Colouring::addRanges(const Group& group, std::uint32_t lanes) {
    const std::uint32_t perColour = group.perColour();
    const auto blockAt = [&](std::uint32_t colour) {
        return group.block + group.begin[colour * perColour] / lanes;
    };
    for (std::uint32_t c = 0; c < group.colours; ++c) {
        ranges_.push_back({blockAt(c), blockAt(c + 1), static_cast<std::uint32_t>(tables_.size())});
        Table& table = tables_.emplace_back();
        for (std::uint32_t k = 0; k < perColour; ++k)
            table[k / kSlices][k % kSlices] =
                group.block + (group.begin[c * perColour + k] + lanes / 2) / lanes;
    }
    for (std::uint32_t block = blockAt(group.colours); block < group.block + group.blocks; ++block)
        ranges_.push_back({block, block + 1, kNullIndex});
}

void Colouring::colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes,
                       const Tasks& tasks) {
    divide(plans, bodies, tasks);
    tasks.forEach(groups().size(), 1, [&](std::size_t g) {
        chooseColours(plans, g);
        count(groups_[g], lanes);
    });
    blocks_ = 0;
    for (Group& group : groups()) {
        group.block = blocks_;
        blocks_ += group.blocks;
    }
    for (std::size_t r = 0; r < regions_.size(); ++r) {
        const Group &own = groups_[Colouring::own(r)], &walls = groups_[Colouring::own(r) + 1];
        regions_[r].first = own.block;
        regions_[r].last = walls.block + walls.blocks;
    }
    ranges_.clear();
    tables_.clear();
    for (std::size_t g = 0; g < own(0); ++g) addRanges(groups_[g], lanes);
    occupants_.resize(blocks_ * lanes);
    tasks.forEach(groups().size(), 1, [&](std::size_t g) { place(groups_[g], lanes); });
}

/// Where a slice of a kind begins; slice kSlices: the next kind.
std::uint32_t Colouring::end(const Range& range, std::uint32_t kind, std::uint32_t slice) const {
    const Table& begin = tables_[range.table];
    if (slice < kSlices) return begin[kind][slice];
    return kind + 1 < kKinds ? begin[kind + 1][0] : range.last;
}

/// At the slices' bodies, or, where that would leave threads waiting for one that has much more to do in this
/// range, as far from there towards a cut of every kind by itself as needed.
Colouring::Cut Colouring::cut(const Range& range, double part) const {
    constexpr double kUneven = 1.0 / 16;           // a share may be larger by this part of a range,
    constexpr double kLeast = workOf(kKinds) / 2;  // or by half a block
    Cut at;
    if (range.table == kNullIndex) {
        at.fill(range.last);
        if (part < 1) at[0] = range.first;
        return at;
    }
    const auto slices = static_cast<std::uint32_t>(part * kSlices + 0.5);
    double all = 0, sliced = 0;
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
        const std::uint32_t begin = end(range, kind, 0), last = end(range, kind, kSlices);
        const double work = workOf(kKinds - kind);
        at[kind] = end(range, kind, slices);
        all += work * (last - begin);
        sliced += work * (at[kind] - begin);
    }
    const double off = std::abs(sliced - part * all), slack = std::max(kUneven * all, kLeast);
    if (part == 0 || part == 1 || off <= slack) return at;
    const double rest = slack / off;
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
        const double begin = end(range, kind, 0), even = begin + part * (end(range, kind, kSlices) - begin);
        at[kind] = static_cast<std::uint32_t>(even + rest * (at[kind] - even) + 0.5);
    }
    return at;
}

}  // namespace rigor::engine
