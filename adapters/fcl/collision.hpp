// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/timed.hpp"

namespace rigor::fcl_adapter {

/// fcl::collide and fcl::distance. Algorithms: "libccd" (the default; depths of overlapping hulls and boxes
/// by EPA), "libccd_collide" (what fcl::collide says, alone), "indep" (FCL's own solver, GST_INDEP).
class FclCollisionEngine final : public adapter::TimedCollisionEngine {
  public:
    std::vector<std::string> algorithms() const override { return {"indep", "libccd", "libccd_collide"}; }
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
    std::unique_ptr<adapter::CollisionBatch> batch(
        std::span<const adapter::CollisionQuery> queries) const override;
};

}  // namespace rigor::fcl_adapter
