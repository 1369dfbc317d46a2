// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Constant force and torque during [start, end). In an interval that the window covers in part, the force is
// its mean over the interval: the impulse is exact whatever the step. (An integrator of several stages splits
// its step at the edges, see ForceSet::edges.)
#include <algorithm>

#include "engine/core/error.hpp"
#include "engine/forces/force.hpp"

namespace rigor::engine {

template <class S>
void checkForce(const ConstantForce<S>& force) {
    if (!force.force.allFinite() || !finiteAng(force.torque))
        throw EngineError("force", "forces and torques must be finite");
    // Written so that NaN fails; end may be infinite.
    if (!(std::isfinite(force.start) && force.start <= force.end))
        throw EngineError("force_time", "a force must start at a finite time and not end before");
}

template <class S>
void addForce(const ConstantForce<S>& force, const ForcePlace<S>& place, const ForceMoment<S>& moment) {
    using Real = typename S::Real;
    Wrench<S>& wrench = moment.wrench[place.b];
    if (force.start <= moment.begin && force.end >= moment.end) {
        wrench.force += force.force;
        wrench.torque += force.torque;
        return;
    }
    const double overlap = std::min(force.end, moment.end) - std::max(force.start, moment.begin);
    if (!(overlap > 0)) return;
    const auto part = static_cast<Real>(overlap / (moment.end - moment.begin));
    wrench.force += part * force.force;
    wrench.torque += part * force.torque;
}

RIGOR_INSTANTIATE_FORCE(ConstantForce);

}  // namespace rigor::engine
