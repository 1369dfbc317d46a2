// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::fcl_adapter {

/// fcl::collide and fcl::distance. Algorithms: "libccd" (the default; depths of overlapping hulls and boxes
/// by EPA), "libccd_collide" (what fcl::collide says, alone), "indep" (FCL's own solver, GST_INDEP).
class FclCollisionEngine final : public adapter::CollisionEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"indep", "libccd", "libccd_collide"}; }
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::fcl_adapter
