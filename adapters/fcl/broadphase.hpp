// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::fcl_adapter {

/// FCL's broad-phase managers over moving boxes.
class FclBroadPhaseEngine final : public adapter::TimedBroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override;
    std::string option() const override { return "broad_phase"; }
    std::unique_ptr<adapter::TimedBroadPhase> createTimed(const std::string& algorithm, int dimension,
                                                          const adapter::Settings* settings) const override;
};

}  // namespace rigor::fcl_adapter
