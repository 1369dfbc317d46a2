// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::bullet {

/// Bullet's narrow phase by itself: the algorithms that stepping uses, on two posed shapes. Two-dimensional
/// queries are computed with prisms.
class BulletCollisionEngine final : public adapter::TimedCollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
    std::unique_ptr<adapter::CollisionBatch> batch(
        std::span<const adapter::CollisionQuery> queries) const override;
};

}  // namespace rigor::bullet
