// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An auditor without a fault.
#include "validation/runner/tests/doubles/ball_collisions.hpp"

namespace rigor::doubles {
namespace {}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAuditor<rigor::doubles::BallCollisions>)
