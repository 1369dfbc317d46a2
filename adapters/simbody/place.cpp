// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of bodies as coordinates of Simbody's joints.
#include "adapters/simbody/model.hpp"

namespace rigor::simbody {

using adapter::BodyState;

void placeBody(const Model& model, const adapter::Scenario& scenario, int body,
               std::span<const BodyState> states, SimTK::State& to) {
    const Link& link = model.forest.links[body];
    if (link.fixed) return;
    if (link.joint == kNone) {
        const BodyState& state = states[body];
        const SimTK::MobilizedBody& free = model.bodies[body];
        free.setQToFitTransform(to, toSimbody(Pose{state.position, state.orientation} * link.frame));
        free.setUToFitVelocity(to, {toSimbody(state.angularVelocity), toSimbody(state.velocity)});
        return;
    }
    const adapter::LinkMotion motion = adapter::motionOf(model.forest, scenario, body, states);
    for (const auto& [kind, axis, mobilizer] : model.coordinates[body]) {
        if (kind == Coordinate::Kind::Ball) {
            mobilizer.setQToFitRotation(to, toSimbody(motion.turned));
            mobilizer.setUToFitAngularVelocity(to, toSimbody(rotate(motion.turned, motion.turn)));
        } else if (kind == Coordinate::Kind::Turn) {
            const double now = mobilizer.getOneQ(to, 0);
            mobilizer.setOneQ(to, 0, adapter::nearestTurn(adapter::turnAbout(motion, axis), now));
            mobilizer.setOneU(to, 0, dot(motion.turn, axis));
        } else {
            const adapter::Travel travel = adapter::travelOf(link, motion, axis);
            mobilizer.setOneQ(to, 0, travel.length);
            mobilizer.setOneU(to, 0, travel.speed);
        }
    }
}

}  // namespace rigor::simbody
