// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distance joint without mass: coordinate |d| with d = xB + rB - xA - rA and u = d/|d|.
//     |d|_dot = u . (vB - vA) + wB . (rB x u) - wA . (rA x u)
// Locked (usual) it is a rod, 1 row C = |d| - L = 0; with an upper limit a rope, C = L - |d| >= 0; with a
// spring a spring. Limit: where the anchors coincide the direction is taken as x.
#include "engine/constraints/joint.hpp"

namespace rigor::engine {

template <class S>
void evaluateDistance(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    const typename S::Vec rA = rotate(A.q, joint.anchorA), rB = rotate(B.q, joint.anchorB);
    const typename S::Vec d = (B.p + rB) - (A.p + rA);
    const typename S::Real distance = d.norm();
    const typename S::Vec u = distance > std::numeric_limits<typename S::Real>::min()
                                  ? typename S::Vec(d / distance)
                                  : typename S::Vec(S::Vec::Unit(0));
    Row<S>& row = out.coordinate(distance);
    row.lin = u;
    row.angA = -cross(rA, u);
    row.angB = cross(rB, u);
    addAxisRows<S>(joint, out);
}
#define RIGOR_INSTANTIATE(S) \
    template void evaluateDistance<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
