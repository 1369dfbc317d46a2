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

/// By the work of the contacts that bodies are in: as far as bodies are numbered as they lie, those of a
/// slice are neighbours.
void Colouring::slice(std::span<const PatchPlan> plans, std::size_t bodies) {
    slice_.assign(bodies, 0);
    std::uint64_t all = 0, before = 0;
    for (const PatchPlan& plan : plans) {
        const std::uint32_t work = plan.points > 0 ? workOf(plan.points) : 0;
        if (plan.movesA) slice_[plan.a] += work, all += work;
        if (plan.movesB) slice_[plan.b] += work, all += work;
    }
    if (all == 0) return;
    const double perWork = kSlices / static_cast<double>(all);
    for (std::uint32_t& own : slice_) {
        const auto slice = static_cast<std::uint32_t>(static_cast<double>(before) * perWork);
        before += std::exchange(own, std::min(slice, kSlices - 1));
    }
}

/// How many regions there are, as a power of two: as many as have enough contacts, few of them across.
int Colouring::regionBits(std::span<const PatchPlan> plans) const {
    // The highest bit in which slices differ says how far regions may be divided before they part two bodies.
    std::array<std::size_t, std::bit_width(kSlices)> parted{};
    std::size_t contacts = 0, pairs = 0;
    for (const PatchPlan& plan : plans) {
        if (plan.points == 0) continue;
        ++contacts;
        if (!plan.movesA || !plan.movesB) continue;
        ++pairs;
        ++parted[static_cast<std::size_t>(std::bit_width(slice_[plan.a] ^ slice_[plan.b]))];
    }
    const std::size_t many = std::clamp<std::size_t>(contacts / kRegionContacts, 1, kMostRegions);
    const int most = static_cast<int>(std::bit_width(many)) - 1;
    int bits = 0;
    for (std::size_t across = 0; bits < most; ++bits) {
        across += parted[parted.size() - 1 - static_cast<std::size_t>(bits)];
        if (5 * across > pairs) break;
    }
    return bits;
}

/// Regions, and the contacts of each group in their order. A single region would be one thread's: its
/// contacts are shared as those across regions are.
void Colouring::group(std::span<const PatchPlan> plans, std::size_t bodies) {
    const int bits = regionBits(plans), sliceBits = std::countr_zero(kSlices) - bits;
    const std::uint32_t regions = 1u << bits;
    regions_.resize(regions);
    for (std::uint32_t r = 0; r < regions; ++r) {
        const auto first = std::lower_bound(slice_.begin(), slice_.end(), r << sliceBits);
        regions_[r].firstBody = static_cast<std::uint32_t>(first - slice_.begin());
        regions_[r].lastBody = static_cast<std::uint32_t>(bodies);
        if (r > 0) regions_[r - 1].lastBody = regions_[r].firstBody;
    }

    groups_.resize(regions + 2);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        groups_[g].members.clear();
        groups_[g].slices = g < regions ? 1 : kSlices;
    }
    for (std::uint32_t i = 0; i < plans.size(); ++i) {
        const PatchPlan& plan = plans[i];
        if (plan.points == 0) continue;
        const std::uint32_t a = slice_[plan.a] >> sliceBits, b = slice_[plan.b] >> sliceBits;
        const bool inside = a == b && regions > 1;
        const std::uint32_t g = !plan.movesA || !plan.movesB ? regions + 1 : inside ? a : regions;
        groups_[g].members.push_back({i, 0});
    }
}

/// And the bucket of each contact, of which begin gets the sizes.
void Colouring::chooseColours(std::span<const PatchPlan> plans, std::size_t g) {
    Group& group = groups_[g];
    const bool inside = g < regions_.size();
    std::vector<std::uint64_t>& taken = taken_[inside ? 0 : g - regions_.size() + 1];
    const auto begin = taken.begin() + (inside ? regions_[g].firstBody : 0);
    std::fill(begin, inside ? taken.begin() + regions_[g].lastBody : taken.end(), 0);
    group.colours = 0;
    group.begin.assign(group.perColour(), 0);
    for (Group::Member& member : group.members) {
        const PatchPlan& plan = plans[member.plan];
        const std::uint64_t of = (plan.movesA ? taken[plan.a] : 0) | (plan.movesB ? taken[plan.b] : 0);
        const auto colour = static_cast<std::uint32_t>(std::countr_one(of));
        const std::uint32_t kind = kKinds - std::min<std::uint32_t>(plan.points, kKinds);
        const std::uint32_t slice = inside ? 0 : slice_[keyOf(plan)];
        member.bucket = (colour * kKinds + kind) * group.slices + slice;
        if (member.bucket >= group.begin.size()) group.begin.resize((colour + 1) * group.perColour(), 0);
        ++group.begin[member.bucket];
        if (colour == kColours) continue;
        const std::uint64_t bit = std::uint64_t(1) << colour;
        if (plan.movesA) taken[plan.a] |= bit;
        if (plan.movesB) taken[plan.b] |= bit;
        group.colours = std::max(group.colours, colour + 1);
    }
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
    std::fill_n(occupants, group.blocks * lanes, kNobody);
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
        ranges_.push_back({block, block + 1, kAlone});
}

void Colouring::colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes,
                       const Tasks& tasks) {
    slice(plans, bodies);
    group(plans, bodies);
    for (auto& taken : taken_) taken.resize(bodies);
    tasks.forEach(groups_.size(), 1, [&](std::size_t g) {
        chooseColours(plans, g);
        count(groups_[g], lanes);
    });
    blocks_ = 0;
    for (Group& group : groups_) group.block = blocks_, blocks_ += group.blocks;
    for (std::size_t r = 0; r < regions_.size(); ++r)
        regions_[r].first = groups_[r].block, regions_[r].last = groups_[r].block + groups_[r].blocks;
    ranges_.clear(), tables_.clear();
    for (std::size_t g = regions_.size(); g < groups_.size(); ++g) addRanges(groups_[g], lanes);
    occupants_.resize(blocks_ * lanes);
    tasks.forEach(groups_.size(), 1, [&](std::size_t g) { place(groups_[g], lanes); });
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
    if (range.table == kAlone) {
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
        all += work * (last - begin), sliced += work * (at[kind] - begin);
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
