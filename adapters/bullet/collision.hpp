// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::bullet {

/// Bullet's narrow phase by itself: the algorithms that stepping uses, on two posed shapes. Two-dimensional
/// queries are answered by prisms.
class BulletCollisionEngine final : public adapter::CollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::bullet
