// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::dart_adapter {

/// Queries of two shapes by one of DART's narrow phases.
class DartCollisionEngine final : public adapter::CollisionEngine {
  public:
    std::vector<std::string> algorithms() const override;
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::dart_adapter
