// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random pairs of convex shapes in the arrangements that collision algorithms get wrong.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/loader/collision_cases.hpp"

namespace rigor::validation {

struct RandomPairs {
    int count = 100;  ///< > 0; kinds take turns, pairs are drawn
    std::uint64_t seed = 1;
    int dimension = 3;                ///< 2 or 3
    std::vector<std::string> kinds;   ///< names of randomPairKinds(); empty: all
    std::vector<std::string> shapes;  ///< names of randomPairShapes(dimension), in pairs of any two; empty:
                                      ///< all
    std::vector<std::string> pairs;   ///< "box-hull", A first; not beside `shapes`
};

/// "generic", "touching", "grazing", "parallel", "deep", "thin", "tiny", "huge", "far", "concentric",
/// "identical"; the README describes them.
const std::vector<std::string>& randomPairKinds();
/// Names as in files: sphere, box, capsule, hull, cylinder, cone; circle, box, capsule, polygon.
const std::vector<std::string>& randomPairShapes(int dimension);

/// The same cases for the same request, on every platform but for the last digit of a position. Each case
/// has its kind as its first tag and the names of its shapes behind it. Throws std::invalid_argument with
/// what was found and what is known.
scenario::CollisionFile makeRandomPairs(const RandomPairs& request);

/// The cases as a file that `rigor collide` reads. Throws std::runtime_error where it cannot be written.
void writeCollisionFile(const scenario::CollisionFile& file, const std::filesystem::path& path);

}  // namespace rigor::validation
