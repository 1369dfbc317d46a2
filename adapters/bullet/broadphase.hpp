// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::bullet {

/// Bullet's broad phases by themselves: dbvt, axis_sweep_3, simple.
class BulletBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"axis_sweep_3", "dbvt", "simple"}; }
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::bullet
