// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::ode {

/// dCollide on two geoms. No distances: ODE answers for overlapping shapes only.
class OdeCollisionEngine final : public adapter::CollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::ode
