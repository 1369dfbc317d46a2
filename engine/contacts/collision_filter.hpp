// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rules of collision: two bodies collide if both have collisions enabled, at least one of them is dynamic,
// and no joint excludes the pair.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

template <class S>
class CollisionFilter {
  public:
    /// Bodies that a joint keeps from colliding: sorted keys (pairKey, contact.hpp).
    void setExcluded(std::vector<std::uint64_t> pairs) { excluded_ = std::move(pairs); }
    bool mayCollide(const BodyArrays<S>& bodies, std::uint32_t a, std::uint32_t b) const;

  private:
    std::vector<std::uint64_t> excluded_;
};

}  // namespace rigor::engine
