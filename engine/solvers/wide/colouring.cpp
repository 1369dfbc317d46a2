// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace rigor::engine {
namespace {

/// Colours of walls follow those of moving pairs and of what is left over of them.
constexpr std::uint8_t kRest = 64, kWalls = 65, kWallRest = kWalls + 64, kAll = kWallRest + 1;
/// Of these each is a range of its own.
constexpr bool isAlone(std::uint32_t colour) {
    return colour == kRest || colour == kWallRest;
}

/// What a visit costs, about: two points half as much again as one.
constexpr std::uint32_t workOf(std::uint32_t points) {
    return 2 + points;
}

}  // namespace

void Colouring::chooseColours(std::span<const PatchPlan> plans, std::size_t bodies) {
    const auto lowest = [](std::uint64_t taken) { return static_cast<std::uint8_t>(std::countr_one(taken)); };
    colour_.resize(plans.size());
    taken_.assign(bodies, 0);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const PatchPlan& plan = plans[i];
        if (!plan.movesA || !plan.movesB) continue;
        const std::uint8_t c = lowest(taken_[plan.a] | taken_[plan.b]);
        colour_[i] = c < kColours ? c : kRest;
        if (c == kColours) continue;
        taken_[plan.a] |= std::uint64_t(1) << c, taken_[plan.b] |= std::uint64_t(1) << c;
    }
    std::fill(taken_.begin(), taken_.end(), 0);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const PatchPlan& plan = plans[i];
        if (plan.movesA && plan.movesB) continue;
        std::uint64_t& taken = taken_[plan.movesA ? plan.a : plan.b];
        const std::uint8_t c = lowest(taken);
        colour_[i] = c < kColours ? static_cast<std::uint8_t>(kWalls + c) : kWallRest;
        if (c < kColours) taken |= std::uint64_t(1) << c;
    }
}

/// By the plans' first bodies that move, so that each slice has as much work: as far as bodies are numbered
/// as they lie, those of a slice are neighbours.
void Colouring::slice(std::span<const PatchPlan> plans, std::size_t bodies) {
    const auto key = [](const PatchPlan& plan) { return plan.movesA ? plan.a : plan.b; };
    slice_.assign(bodies, 0);
    std::uint64_t all = 0, before = 0;
    for (const PatchPlan& plan : plans) all += workOf(plan.points), slice_[key(plan)] += workOf(plan.points);
    if (all == 0) return;
    const double perWork = kSlices / static_cast<double>(all);
    for (std::uint32_t& own : slice_) {
        const auto slice = static_cast<std::uint32_t>(static_cast<double>(before) * perWork);
        before += std::exchange(own, std::min(slice, kSlices - 1));
    }
    for (std::size_t i = 0; i < plans.size(); ++i) bucket_[i] += slice_[key(plans[i])];
}

/// By counting: colours one after the other, of a colour by falling number of points, of a kind by slices,
/// then in their order.
void Colouring::place(std::span<const PatchPlan> plans, std::uint32_t lanes) {
    std::array<std::uint32_t, kAll> stage{};  // of each colour there is
    std::array<bool, kAll> alone{};           // of each stage
    for (const std::uint8_t c : colour_) stage[c] = 1;
    std::uint32_t stages = 0;
    for (std::uint32_t c = 0; c < kAll; ++c)
        if (std::exchange(stage[c], stages) != 0) alone[stages++] = isAlone(c);

    bucket_.resize(plans.size());
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const std::uint32_t kind = kKinds - std::min<std::uint32_t>(plans[i].points, kKinds);
        bucket_[i] = (stage[colour_[i]] * kKinds + kind) * kSlices;
    }
    slice(plans, taken_.size());
    count_.assign(stages * kKinds * kSlices, 0);
    for (const std::uint32_t bucket : bucket_) ++count_[bucket];
    ranges_.clear();
    std::uint32_t place = 0;
    for (std::uint32_t s = 0; s < stages; ++s) {
        const std::span<std::uint32_t> count =
            std::span(count_).subspan(s * kKinds * kSlices, kKinds * kSlices);
        const std::uint32_t first = place / lanes;
        for (std::uint32_t& n : count) place += (alone[s] ? lanes : 1) * std::exchange(n, place);
        place = (place + lanes - 1) / lanes * lanes;
        addRanges(count, alone[s], first, place / lanes, lanes);
    }
    blocks_ = place / lanes;
    places_.resize(plans.size());
    for (std::size_t i = 0; i < plans.size(); ++i) {
        std::uint32_t& next = count_[bucket_[i]];
        places_[i] = std::exchange(next, next + (isAlone(colour_[i]) ? lanes : 1));
    }
}

/// What there is of a colour in the blocks [first, last): starts[k] is the place where its bucket k begins.
void Colouring::addRanges(std::span<const std::uint32_t> starts, bool alone, std::uint32_t first,
                          std::uint32_t last, std::uint32_t lanes) {
    for (std::uint32_t block = first; alone && block < last; ++block) {
        Range& range = ranges_.emplace_back(Range{block, block + 1, {}});
        for (auto& kind : range.begin) kind.fill(block + 1);
        range.begin[0][0] = block;
    }
    if (alone) return;
    Range& range = ranges_.emplace_back(Range{first, last, {}});
    for (std::uint32_t k = 0; k < kKinds * kSlices; ++k)
        range.begin[k / kSlices][k % kSlices] = (starts[k] + lanes / 2) / lanes;
}

/// At the slices' bodies, or, where that would leave threads waiting for one that has much more to do in this
/// range, as far from there towards a cut of every kind by itself as needed.
Colouring::Cut Colouring::cut(const Range& range, double part) {
    constexpr double kUneven = 1.0 / 16;           // a share may be larger by this part of a range,
    constexpr double kLeast = workOf(kKinds) / 2;  // or by half a block
    Cut at;
    const auto slices = static_cast<std::uint32_t>(part * kSlices + 0.5);
    double all = 0, sliced = 0;
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
        const std::uint32_t begin = range.begin[kind][0], end = range.end(kind, kSlices);
        const double work = workOf(kKinds - kind);
        at[kind] = range.end(kind, slices);
        all += work * (end - begin), sliced += work * (at[kind] - begin);
    }
    const double off = std::abs(sliced - part * all), slack = std::max(kUneven * all, kLeast);
    if (part == 0 || part == 1 || off <= slack) return at;
    const double rest = slack / off;
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
        const double begin = range.begin[kind][0], even = begin + part * (range.end(kind, kSlices) - begin);
        at[kind] = static_cast<std::uint32_t>(even + rest * (at[kind] - even) + 0.5);
    }
    return at;
}

void Colouring::colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes) {
    chooseColours(plans, bodies);
    place(plans, lanes);
}

}  // namespace rigor::engine
