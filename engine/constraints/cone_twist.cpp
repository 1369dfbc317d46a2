// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cone-twist joint (3D): the rows of a ball joint. Coordinates: the twist about the axis, counted over turns,
// and the swing, the angle between the two axes (swing.hpp). 3 rows, and those of its limits, motor and
// springs.
#include "engine/constraints/joint.hpp"
#include "engine/constraints/swing.hpp"

namespace rigor::engine {

template <class S>
void evaluateConeTwist(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    out.clear();
    addAnchorRows<S>(joint, A, B, out);
    if constexpr (S::dim == 3) {
        if (!out.wantsCoordinates(joint)) return;
        addTwistCoordinate<S>(joint, A, B, out);
        addConeCoordinate<S>(joint, A, B, out);
        addAxisRows<S>(joint, out);
    }
}
template void evaluateConeTwist<Space2f>(const Joint<Space2f>&, const Pose<Space2f>&, const Pose<Space2f>&,
                                         JointRows<Space2f>&);
template void evaluateConeTwist<Space2d>(const Joint<Space2d>&, const Pose<Space2d>&, const Pose<Space2d>&,
                                         JointRows<Space2d>&);
template void evaluateConeTwist<Space3f>(const Joint<Space3f>&, const Pose<Space3f>&, const Pose<Space3f>&,
                                         JointRows<Space3f>&);
template void evaluateConeTwist<Space3d>(const Joint<Space3d>&, const Pose<Space3d>&, const Pose<Space3d>&,
                                         JointRows<Space3d>&);

}  // namespace rigor::engine
