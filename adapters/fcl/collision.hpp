// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::fcl_adapter {

/// fcl::collide and fcl::distance with the libccd solver.
class FclCollisionEngine final : public adapter::CollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::fcl_adapter
