// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "adapters/interface/tests/joint_states.hpp"

namespace rigor::test {

/// A joint of bodies a and b with anchors in their frames; `axis` is the same in both.
inline Joint joint(JointType type, int a, int b, Vec3 anchorA, Vec3 anchorB, Vec3 axis = {0, 0, 1}) {
    Joint j = jointOf(type, a, b, anchorA, anchorB);
    j.axisA = j.axisB = axis;
    return j;
}

}  // namespace rigor::test
