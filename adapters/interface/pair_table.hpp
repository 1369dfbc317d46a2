// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Table of the pairs that may collide, with their coefficients: looked up by adapters from inside engine
// callbacks.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// Friction and restitution of every pair of materials, and which bodies may touch; constant-time or nearly
/// so, where scenario::pairCoefficients and scenario::mayCollide search.
class PairTable {
  public:
    explicit PairTable(const Scenario& scenario);

    /// Lets the joints for which `holds` is true keep their bodies from colliding, and no others: bodies that a joint
    /// kept apart collide once it has broken. `scenario` is that of the table.
    void keepApart(const Scenario& scenario, const std::function<bool(std::size_t joint)>& holds);

    const scenario::PairCoefficients& coefficients(int materialA, int materialB) const {
        return table_[materialA * materials_ + materialB];
    }

    /// Same as scenario::mayCollide; bodies without shapes never collide.
    bool mayCollide(int bodyA, int bodyB) const;
    /// True where the filters of two shapes let them touch, of bodies that may collide.
    bool shapesMayTouch(int bodyA, int shapeA, int bodyB, int shapeB) const {
        return !filtered_ || mayTouch(filtersOf_[bodyA][shapeA], filtersOf_[bodyB][shapeB]);
    }
    /// True where all shapes of each body have one filter, so that mayCollide decides for the shapes, too.
    bool filtersByBody() const { return filtersByBody_; }

    /// One shape of one body.
    struct ShapeRef {
        int body = 0, shape = 0;
    };
    /// Two shapes that may touch.
    struct Example {
        int materialA = 0, materialB = 0;  ///< materialA <= materialB
        ShapeRef a, b;                     ///< shapes of materialA and of materialB
    };
    /// One example for every unordered pair of materials that can touch, sorted by materials.
    std::vector<Example> examples() const;

    /// True where some shape that may touch `body` has a restitution > 0 with it.
    bool mayBounce(int body) const;

  private:
    bool someShapesMayTouch(std::size_t a, std::size_t b) const;

    std::size_t materials_ = 0;
    std::vector<scenario::PairCoefficients> table_;
    std::vector<bool> collides_, dynamic_;
    bool filtered_ = false;  ///< some filter is not the default
    bool filtersByBody_ = true;
    std::vector<std::vector<scenario::ContactFilter>> filtersOf_;  ///< filters by body and shape
    std::vector<std::vector<int>> materialsOf_;                    ///< materials by body and shape
    std::vector<std::pair<int, int>> connected_;  ///< sorted pairs that a joint keeps from colliding
};

}  // namespace rigor::adapter
