// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::fcl_adapter {

/// FCL's broad-phase managers over moving boxes.
class FclBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override;
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::fcl_adapter
