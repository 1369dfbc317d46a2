// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::box2d {

/// Box2D's broad phase by itself: dynamic_tree, two-dimensional.
class Box2dBroadPhaseEngine final : public adapter::TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"dynamic_tree"}; }
    std::string option() const override { return {}; }
    std::unique_ptr<adapter::TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                          const adapter::Settings* settings) const override;
};

}  // namespace rigor::box2d
