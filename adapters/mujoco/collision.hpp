// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::mujoco {

/// mj_collision of two geoms, each on a body of its own.
class MujocoCollisionEngine final : public adapter::CollisionEngine {
  public:
    adapter::CollisionAnswer collide(const adapter::CollisionQuery& query) const override;
};

}  // namespace rigor::mujoco
