// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rules of collision: two shapes collide if their filters agree (state/shape_filter.hpp), their bodies both have
// collisions enabled, at least one of these is dynamic, and no joint excludes the two bodies.
#pragma once

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
        return lets(a.filter, b.filter) && bodiesMayCollide(bodies, a.body, b.body);
    }

  private:
    bool bodiesMayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

    std::vector<std::uint64_t> excluded_;
};

}  // namespace rigor::engine
