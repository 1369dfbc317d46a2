// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/wide/colouring.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace rigor::engine {
namespace {

/// Colours of walls follow those of moving pairs and of what is left over of them.
constexpr std::uint8_t kRest = 64, kWalls = 65, kWallRest = kWalls + 64, kAll = kWallRest + 1;

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

/// By the plans' first bodies that move, so that each slice has as many plans: as far as bodies are numbered
/// as they lie, those of a slice are neighbours.
void Colouring::slice(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes) {
    constexpr std::uint32_t kLeastBlocks = 48;  // of a slice: smaller ones only mix the kinds
    const auto n = static_cast<std::uint32_t>(plans.size());
    const std::uint32_t slices = std::clamp<std::uint32_t>(n / (lanes * kLeastBlocks), 1, kSlices);
    const auto key = [](const PatchPlan& plan) { return plan.movesA ? plan.a : plan.b; };
    slice_.assign(bodies, 0);
    for (const PatchPlan& plan : plans) ++slice_[key(plan)];
    std::uint32_t before = 0;
    for (std::uint32_t& own : slice_) {
        const std::uint32_t count =
            std::exchange(own, static_cast<std::uint32_t>(std::uint64_t(before) * slices / std::max(n, 1u)));
        before += count;
    }
    bucket_.resize(plans.size());
    for (std::size_t i = 0; i < plans.size(); ++i) bucket_[i] = colour_[i] * kSlices + slice_[key(plans[i])];
    slices_ = slices;
}

/// By counting: colours one after the other, slices of a colour, within a slice by falling number of points,
/// then in their order.
void Colouring::place(std::span<const PatchPlan> plans, std::uint32_t lanes) {
    constexpr std::uint32_t kBuckets = kSlices * kKinds;  // of a colour
    count_.assign(kAll * kBuckets, 0);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        bucket_[i] = bucket_[i] * kKinds + (kKinds - std::min<std::uint32_t>(plans[i].points, kKinds));
        ++count_[bucket_[i]];
    }
    ranges_.clear();
    std::uint32_t place = 0;
    for (std::uint32_t c = 0; c < kAll; ++c) {
        const bool alone = c == kRest || c == kWallRest;
        Range range;
        range.slices = slices_;
        for (std::uint32_t k = 0; k < kBuckets; ++k) {
            if (k % kKinds == 0) range.cut[k / kKinds] = (place + lanes / 2) / lanes;
            const std::uint32_t n = std::exchange(count_[c * kBuckets + k], place);
            place += alone ? n * lanes : n;
        }
        place = (place + lanes - 1) / lanes * lanes;
        range.cut[slices_] = place / lanes;
        if (alone)
            for (std::uint32_t block = range.first(); block < range.last(); ++block)
                ranges_.push_back({1, {block, block + 1}});
        else if (range.last() > range.first())
            ranges_.push_back(range);
    }
    blocks_ = place / lanes;
    places_.resize(plans.size());
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const bool alone = colour_[i] == kRest || colour_[i] == kWallRest;
        std::uint32_t& next = count_[bucket_[i]];
        places_[i] = next;
        next += alone ? lanes : 1;
    }
}

void Colouring::colour(std::span<const PatchPlan> plans, std::size_t bodies, std::uint32_t lanes) {
    chooseColours(plans, bodies);
    slice(plans, bodies, lanes);
    place(plans, lanes);
}

}  // namespace rigor::engine
