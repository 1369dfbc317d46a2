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
#define RIGOR_INSTANTIATE(S) \
    template void evaluateWheel<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
