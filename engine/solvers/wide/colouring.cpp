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

/// Cuts each colour in slices of as many plans, in their order: threads that share a colour get slices, and
/// so the same bodies in every colour as far as bodies are numbered as they lie, and as much work.
void Colouring::slice(std::uint32_t lanes) {
    constexpr std::uint32_t kLeastBlocks = 8;  // of a slice
    std::array<std::uint32_t, kAll> size{}, seen{};
    for (const std::uint8_t c : colour_) ++size[c];
    bucket_.resize(colour_.size());
    for (std::size_t i = 0; i < colour_.size(); ++i) {
        const std::uint32_t c = colour_[i], n = size[c];
        const std::uint32_t slices = std::clamp<std::uint32_t>(n / (lanes * kLeastBlocks), 1, kSlices);
        bucket_[i] = c * kSlices + static_cast<std::uint32_t>(std::uint64_t(seen[c]++) * slices / n);
    }
}

/// By counting: colours one after the other, slices of a colour, within a slice by falling number of points,
/// then in their order.
void Colouring::place(std::span<const PatchPlan> plans, std::uint32_t lanes) {
    slice(lanes);
    constexpr std::uint32_t kBuckets = kSlices * kKinds;  // of a colour
    count_.assign(kAll * kBuckets, 0);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        bucket_[i] = bucket_[i] * kKinds + (kKinds - std::min<std::uint32_t>(plans[i].points, kKinds));
        ++count_[bucket_[i]];
    }
    ranges_.clear();
    std::uint32_t place = 0;
    for (std::uint32_t c = 0; c < kAll; ++c) {
        const std::uint32_t first = place / lanes;
        const bool alone = c == kRest || c == kWallRest;
        for (std::uint32_t k = 0; k < kBuckets; ++k) {
            const std::uint32_t n = std::exchange(count_[c * kBuckets + k], place);
            place += alone ? n * lanes : n;
        }
        place = (place + lanes - 1) / lanes * lanes;
        const std::uint32_t last = place / lanes;
        if (alone)
            for (std::uint32_t block = first; block < last; ++block) ranges_.push_back({block, block + 1});
        else if (last > first)
            ranges_.push_back({first, last});
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
    place(plans, lanes);
}

}  // namespace rigor::engine
