// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Fixed joint: the rows of a ball joint, and no relative rotation: C = log(qB (qA q_rel)^-1) = 0.
//     C_dot = wB - wA + O(C)
// 6 rows (2D: 3).
#include "engine/constraints/joint.hpp"

namespace rigor::engine {

template <class S>
void evaluateFixed(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addAnchorRows<S>(joint, A, B, out);
    addOrientationRows<S>(joint, A, B, out);
}
template void evaluateFixed<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                     JointRows<Space2f>&);
template void evaluateFixed<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                     JointRows<Space2d>&);
template void evaluateFixed<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                     JointRows<Space3f>&);
template void evaluateFixed<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                     JointRows<Space3d>&);

}  // namespace rigor::engine
