// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ball joint: C = xB + rB - xA - rA = 0, with r the anchors from the centres of mass in world axes.
//     C_dot = vB - vA + wB x rB - wA x rA      J = [-1, [rA]x, 1, -[rB]x]
// 3 rows (2D: 2) [Catto2009]. Coordinate in 3D: the angle between the joint's axes, for a cone limit
// (swing.hpp).
#include "engine/constraints/joint.hpp"
#include "engine/constraints/swing.hpp"

namespace rigor::engine {

template <class S>
void evaluateBall(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addAnchorRows<S>(joint, A, B, out);
    if constexpr (S::dim == 3) {
        if (!out.wantsCoordinates(joint)) return;
        addConeCoordinate<S>(joint, A, B, out);
        addAxisRows<S>(joint, out);
    }
}
#define RIGOR_INSTANTIATE(S) \
    template void evaluateBall<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
