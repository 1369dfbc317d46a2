// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rules of collision: two shapes collide if their filters agree (state/shape_filter.hpp), their bodies both have
// collisions enabled, at least one of these is dynamic, no joint excludes the two bodies, no callback has refused the
// two in this step, and none is a sensor.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/contacts/shape_record.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

template <class S>
class CollisionFilter {
  public:
    /// Bodies that a joint keeps from colliding: sorted keys (pairKey, contact.hpp).
    void setExcluded(std::vector<std::uint64_t> pairs) { excluded_ = std::move(pairs); }
    bool mayCollide(const BodyArrays<S>& bodies, const ShapeRecord<S>& a, const ShapeRecord<S>& b) const {
        return lets(a.filter, b.filter) && !a.sensor && !b.sensor && !isVetoed(a, b) &&
               bodiesMayCollide(bodies, a.body, b.body);
    }
    /// True if a sensor finds another shape that overlaps it: the same rules, but the bodies may be of any types, if
    /// they are not both static.
    bool mayFind(const BodyArrays<S>& bodies, const ShapeRecord<S>& sensor,
                 const ShapeRecord<S>& other) const;
    /// Pairs of shapes that do not collide in this step: keys (vetoKey), sorted.
    void setVetoed(std::vector<std::uint64_t> pairs) { vetoed_ = std::move(pairs); }
    static std::uint64_t vetoKey(const ShapeRecord<S>& a, const ShapeRecord<S>& b) {
        return std::uint64_t(std::min(a.id.index, b.id.index)) << 32 | std::max(a.id.index, b.id.index);
    }

  private:
    bool bodiesMayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

    bool connects(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;
    bool isVetoed(const ShapeRecord<S>& a, const ShapeRecord<S>& b) const {
        return !vetoed_.empty() && std::binary_search(vetoed_.begin(), vetoed_.end(), vetoKey(a, b));
    }

    std::vector<std::uint64_t> excluded_, vetoed_;
};

}  // namespace rigor::engine
