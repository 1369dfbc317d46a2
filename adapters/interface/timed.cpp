// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs are tested against the exact boxes before they are returned, for all additions of an engine.
#include "adapters/interface/timed.hpp"

#include <algorithm>

namespace rigor::adapter {

bool overlap(const Aabb& a, const Aabb& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

std::vector<Pair> bruteForcePairs(std::span<const Aabb> boxes) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b)
            if (overlap(boxes[a], boxes[b])) pairs.push_back({static_cast<int>(a), static_cast<int>(b)});
    return pairs;
}

void TimedBroadPhase::update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) {
    for (const Aabb& box : boxes)
        if (!isFinite(box.min) || !isFinite(box.max)) throw BadInput("box: not finite");
    pairs.clear();
    take(boxes);
    if (boxes.empty()) return;
    run();
    held(pairs);
    std::erase_if(pairs, [boxes](const Pair& pair) { return !overlap(boxes[pair.a], boxes[pair.b]); });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace rigor::adapter
