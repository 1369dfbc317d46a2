// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wheel: B's anchor stays on a line of A (the suspension axis), and (3D) B turns about its spin axis only,
// whose direction is fixed in A. Rows as in slider.cpp and hinge.cpp: 4 (2D: 1). Coordinates: the travel
// along the suspension axis, usually with a spring, and the angle about the spin axis, counted over turns.
#include "engine/constraints/joint.hpp"

namespace rigor::engine {

template <class S>
void evaluateWheel(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addLineRows<S>(joint, A, B, out);
    addParallelRows<S>(joint, A, B, out);
    if (!out.wantsCoordinates(joint)) return;
    addTravelCoordinate<S>(joint, A, B, joint.axisA, out);
    addTurnCoordinate<S>(joint, A, B, out);
    addAxisRows<S>(joint, out);
}
template void evaluateWheel<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                     JointRows<Space2f>&);
template void evaluateWheel<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                     JointRows<Space2d>&);
template void evaluateWheel<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                     JointRows<Space3f>&);
template void evaluateWheel<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                     JointRows<Space3d>&);

}  // namespace rigor::engine
