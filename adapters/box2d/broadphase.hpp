// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::box2d {

/// Box2D's broad phase by itself: dynamic_tree, two-dimensional.
class Box2dBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"dynamic_tree"}; }
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::box2d
