// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hinge: the rows of a ball joint, and (3D) an axis aA of A that stays parallel to aB of B. With t1, t2
// normal to aA and fixed in A:
//     C_i = t_i . aB      C_i_dot = (wB - wA) . (aB x t_i)
// 5 rows (2D: 2). Coordinate: the angle about the axis, counted over turns. Limit: C_i also vanishes for
// opposite axes, which a joint never reaches from parallel ones unless a step turns it by more than a right
// angle.
#include "engine/constraints/joint.hpp"

namespace rigor::engine {

template <class S>
void evaluateHinge(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addAnchorRows<S>(joint, A, B, out);
    addParallelRows<S>(joint, A, B, out);
    if (!out.wantsCoordinates(joint)) return;
    addTurnCoordinate<S>(joint, A, B, out);
    addAxisRows<S>(joint, out);
}
template void evaluateHinge<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                     JointRows<Space2f>&);
template void evaluateHinge<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                     JointRows<Space2d>&);
template void evaluateHinge<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                     JointRows<Space3f>&);
template void evaluateHinge<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                     JointRows<Space3d>&);

}  // namespace rigor::engine
