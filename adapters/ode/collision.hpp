// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::ode {

/// dCollide on two geoms. No distances: ODE gives results for overlapping shapes only.
class OdeCollisionEngine final : public adapter::TimedCollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
    std::unique_ptr<adapter::CollisionBatch> batch(
        std::span<const adapter::CollisionQuery> queries) const override;
};

}  // namespace rigor::ode
