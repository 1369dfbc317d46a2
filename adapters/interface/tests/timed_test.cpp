// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of bruteForcePairs(), the oracle of broad phases, by counting.
#include "adapters/interface/timed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rigor::adapter {
namespace {

/// Unit boxes of a lattice share faces, edges and corners: along an axis of n boxes there are n + 2 (n - 1)
/// ordered pairs that touch, each with itself among them.
TEST(BruteForcePairs, TouchingIsOverlap) {
    std::vector<Aabb> boxes;
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 3; ++z)
                boxes.push_back({Vec3{1.0 * x, 1.0 * y, 1.0 * z}, Vec3{x + 1.0, y + 1.0, z + 1.0}});
    const auto pairs = bruteForcePairs(boxes);
    EXPECT_EQ(pairs.size(), ((4u + 6u) * (4u + 6u) * (3u + 4u) - 48u) / 2u);
    for (const Pair& pair : pairs) EXPECT_LT(pair.a, pair.b);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

/// A gap along one axis, on either side, is enough; however small.
TEST(BruteForcePairs, AGapAlongAnyAxisParts) {
    const double least = std::nextafter(1.0, 2.0);
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        Aabb other = box;
        other.min.*axis = 1.0;
        other.max.*axis = 2.0;
        EXPECT_TRUE(overlap(box, other) && overlap(other, box));
        other.min.*axis = least;
        EXPECT_FALSE(overlap(box, other) || overlap(other, box));
        EXPECT_TRUE(bruteForcePairs(std::vector{box, other}).empty());
    }
    EXPECT_EQ(bruteForcePairs(std::vector{box, box}).size(), 1u);
}

}  // namespace
}  // namespace rigor::adapter
