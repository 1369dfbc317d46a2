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
#define RIGOR_INSTANTIATE(S) \
    template void evaluateConeTwist<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
