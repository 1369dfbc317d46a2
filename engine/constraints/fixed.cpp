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
#define RIGOR_INSTANTIATE(S) \
    template void evaluateFixed<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
