// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::chipmunk {

/// Chipmunk's spatial indices by themselves: bb_tree and spatial_hash, the two that a cpSpace can use; two-dimensional.
class ChipmunkBroadPhaseEngine final : public adapter::BroadPhaseEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"bb_tree", "spatial_hash"}; }
    std::unique_ptr<adapter::BroadPhase> create(const std::string& algorithm, int dimension) const override;
};

}  // namespace rigor::chipmunk
