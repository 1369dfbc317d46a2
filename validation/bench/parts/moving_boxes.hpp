// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes that all move, for broad phases, and the pairs that they really have.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapters/interface/types.hpp"
#include "scenarios/generators/generator.hpp"

namespace rigor::validation {

enum class BoxOrder { Random, Spatial };  ///< Spatial: by the Morton code of where they start

/// Unit boxes, uniform in a cube of side (8 n)^(1/3) m (2D: a square of side (4 n)^(1/2)), so that there are
/// about n/2 overlaps; velocities U(-3, 3) m/s per axis, thrown back by the walls; 1/60 s apart. All
/// coordinates are single-precision numbers: engines of both precisions have exactly the same boxes.
class MovingBoxes {
  public:
    MovingBoxes(int dimension, std::size_t count, BoxOrder order, std::uint64_t seed);
    const std::vector<adapter::Aabb>& boxes() const { return boxes_; }
    void advance();

  private:
    struct Mover {
        float center[3] = {0, 0, 0}, velocity[3] = {0, 0, 0};
    };
    std::uint64_t morton(const Mover& mover) const;
    void place();

    int dimension_;
    float side_;
    scenario::PortableRandom random_;
    std::vector<Mover> movers_;
    std::vector<adapter::Aabb> boxes_;
};

/// All pairs that overlap, touching ones included, sorted: those of adapter::bruteForcePairs, by sorting the
/// boxes along x.
std::vector<adapter::Pair> exactPairs(const std::vector<adapter::Aabb>& boxes);

struct PairCheck {
    std::size_t exact = 0;   ///< pairs that overlap
    std::size_t held = 0;    ///< different pairs that the engine holds
    std::size_t missed = 0;  ///< overlap and are not held
    std::size_t excess() const { return held + missed - exact; }
};
PairCheck checkPairs(const std::vector<adapter::Aabb>& boxes, std::vector<adapter::Pair> held);

}  // namespace rigor::validation
