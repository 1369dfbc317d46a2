// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/reach.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::adapter {

Reach reachOf(const Scenario& scenario, double least, double most) {
    Reach reach;
    int count = 0;
    for (const auto& body : scenario.bodies)
        if (body.type != scenario::BodyType::Static) {
            reach.middle += body.pose.position;
            ++count;
        }
    if (count > 0) reach.middle = reach.middle / count;
    double spread = 0.0, speed = 0.0, gravity = 0.0;
    for (const auto& body : scenario.bodies) {
        if (body.type == scenario::BodyType::Static) continue;
        spread = std::max(spread, norm(body.pose.position - reach.middle));
        speed = std::max(speed, norm(body.velocity));
        gravity = std::max(gravity, std::abs(body.gravityScale) * norm(scenario.gravity));
    }
    const double t = scenario.duration;
    reach.distance = std::clamp(2.0 * (spread + speed * t + 0.5 * gravity * t * t), least, most);
    return reach;
}

}  // namespace rigor::adapter
