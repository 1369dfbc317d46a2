// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bound on the extent of a scenario: engines without a suitable half-space get a box in its place, which has
// to be large enough, and in single precision no larger than that.
#pragma once

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

struct Reach {
    Vec3 middle;            ///< mean initial position of the bodies that move [m]
    double distance = 0.0;  ///< twice the farthest any of them gets from there in free flight [m]
};

/// `distance` is clamped to [least, most].
Reach reachOf(const Scenario& scenario, double least, double most);

}  // namespace rigor::adapter
