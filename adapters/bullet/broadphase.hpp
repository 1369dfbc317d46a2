// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::bullet {

/// Bullet's broad phases by themselves: dbvt, axis_sweep_3, simple.
class BulletBroadPhaseEngine final : public adapter::TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"axis_sweep_3", "dbvt", "simple"}; }
    std::string option() const override { return "broadphase"; }
    std::unique_ptr<adapter::TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                          const adapter::Settings* settings) const override;
};

}  // namespace rigor::bullet
