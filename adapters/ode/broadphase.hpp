// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::ode {

/// ODE's spaces over moving boxes.
class OdeBroadPhaseEngine final : public adapter::TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"simple", "hash", "sap", "quadtree"}; }
    std::string option() const override { return "space"; }
    std::unique_ptr<adapter::TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                          const adapter::Settings* settings) const override;
};

}  // namespace rigor::ode
