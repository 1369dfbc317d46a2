// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::chipmunk {

/// cpShapesCollide: contacts of shapes that overlap, two-dimensional.
class ChipmunkCollisionEngine final : public adapter::CollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::chipmunk
