// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies put somewhere else between two steps. ODE makes the contacts of every step anew, and moves a body's
// geoms with it; of its joints it keeps nothing from step to step unless a flag is set.
#include "adapters/ode/convert.hpp"
#include "adapters/ode/library.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {

void OdeWorld::setStates(std::span<const adapter::BodyState> states) {
    useLibrary();
    for (std::size_t i = 0; i < records_.size(); ++i) {
        BodyRecord& record = *records_[i];
        if (!record.dynamic) continue;
        const adapter::BodyState& state = states[i];
        const Vec3 com = state.position + rotate(state.orientation, record.com);
        dBodySetPosition(record.body, com.x, com.y, com.z);
        dQuaternion q;
        toOde(state.orientation, q);
        dBodySetQuaternion(record.body, q);
        dBodySetLinearVel(record.body, state.velocity.x, state.velocity.y, state.velocity.z);
        dBodySetAngularVel(record.body, state.angularVelocity.x, state.angularVelocity.y,
                           state.angularVelocity.z);
        dBodyEnable(record.body);
        record.turnPending = false;  // the velocity given is that of now
    }
}

}  // namespace rigor::ode
