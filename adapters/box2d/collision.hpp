// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::box2d {

/// Box2D's narrow phase by itself: b2Collide* for contacts, b2Distance for separated shapes.
class Box2dCollisionEngine final : public adapter::TimedCollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
    std::unique_ptr<adapter::CollisionBatch> batch(
        std::span<const adapter::CollisionQuery> queries) const override;
};

}  // namespace rigor::box2d
