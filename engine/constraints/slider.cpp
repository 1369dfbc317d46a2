// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Slider: d = xB + rB - xA - rA may grow along the axis of A only, and there is no relative rotation. With t
// normal to the axis and fixed in A:
//     C = t . d      C_dot = t . (vB - vA) + wB . (rB x t) - wA . ((rA + d) x t)
// 5 rows (2D: 2). Coordinate: the travel aA . d.
#include "engine/constraints/joint.hpp"

namespace rigor::engine {

template <class S>
void evaluateSlider(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addLineRows<S>(joint, A, B, out);
    addOrientationRows<S>(joint, A, B, out);
    if (!out.wantsCoordinates(joint)) return;
    addTravelCoordinate<S>(joint, A, B, joint.axisA, out);
    addAxisRows<S>(joint, out);
}
#define RIGOR_INSTANTIATE(S) \
    template void evaluateSlider<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
