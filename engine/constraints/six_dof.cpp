// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Six degrees of freedom (2D: three), each free, locked or limited. Coordinates: the travel of B's anchor
// along the axis of A and its normals t1, t2 (C as in slider.cpp); the twist about the axis, counted over
// turns; the swing vector's components along t1 and t2 (swing.hpp). 2D: two travels and the angle. Locked
// alike it is a fixed joint, a slider (axis free), a hinge (twist free) or a ball joint.
#include "engine/constraints/joint.hpp"
#include "engine/constraints/swing.hpp"

namespace rigor::engine {

template <class S>
void evaluateSixDof(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addTravelCoordinate<S>(joint, A, B, joint.axisA, out);
    addTravelCoordinate<S>(joint, A, B, joint.perpA1, out);
    if constexpr (S::dim == 2) {
        addTurnCoordinate<S>(joint, A, B, out);
    } else {
        addTravelCoordinate<S>(joint, A, B, joint.perpA2, out);
        addTwistCoordinate<S>(joint, A, B, out);
        addSwingCoordinates<S>(joint, A, B, out);
    }
    addAxisRows<S>(joint, out);
}
#define RIGOR_INSTANTIATE(S) \
    template void evaluateSixDof<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
