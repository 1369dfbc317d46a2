// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::ode {

/// ODE's spaces over moving boxes.
class OdeBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"simple", "hash", "sap", "quadtree"}; }
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::ode
