// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::chipmunk {

/// Chipmunk's spatial indices by themselves: bb_tree, spatial_hash and sweep (one axis); two-dimensional.
class ChipmunkBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"bb_tree", "spatial_hash", "sweep"}; }
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::chipmunk
