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
template void evaluateSixDof<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                      JointRows<Space2f>&);
template void evaluateSixDof<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                      JointRows<Space2d>&);
template void evaluateSixDof<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                      JointRows<Space3f>&);
template void evaluateSixDof<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                      JointRows<Space3d>&);

}  // namespace rigor::engine
