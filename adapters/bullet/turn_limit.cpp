// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/turn_limit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rigor::bullet {

void TurnLimit::update() {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    constexpr double kReach = 3.0;  // [rad], twice of it less than a turn
    const double angle = hinge->getHingeAngle();
    counted = angle + kTurn * std::round((counted - angle) / kTurn);
    const double turns = counted - angle;
    setHingeLimit(*hinge, std::max(lower, counted - kReach) - turns,
                  std::min(upper, counted + kReach) - turns);
}

}  // namespace rigor::bullet
