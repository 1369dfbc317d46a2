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
template void evaluateSlider<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                      JointRows<Space2f>&);
template void evaluateSlider<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                      JointRows<Space2d>&);
template void evaluateSlider<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                      JointRows<Space3f>&);
template void evaluateSlider<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                      JointRows<Space3d>&);

}  // namespace rigor::engine
