// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hinge: the rows of a ball joint, and (3D) an axis aA of A that stays parallel to aB of B. Rows for t1, t2
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
#define RIGOR_INSTANTIATE(S) \
    template void evaluateHinge<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
