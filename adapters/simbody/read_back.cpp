// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of Simbody: states, what was built, counters.
#include <limits>

#include "adapters/simbody/world.hpp"

namespace rigor::simbody {

using adapter::BodyState;
using scenario::BodyType;

BodyState SimbodyWorld::stateOf(int body) const {
    const scenario::Body& of = scenario_.bodies[body];
    if (of.type == BodyType::Static) return {of.pose.position, of.pose.orientation, {}, {}};
    if (lost_ && of.type == BodyType::Dynamic) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const Vec3 none{nan, nan, nan};
        return {none, {nan, nan, nan, nan}, none, none};
    }
    const SimTK::MobilizedBody& mobilizer = model_->bodies[body];
    const Pose pose =
        fromSimbody(mobilizer.getBodyTransform(state_)) * inverse(model_->forest.links[body].frame);
    return {pose.position, pose.orientation, fromSimbody(mobilizer.getBodyOriginVelocity(state_)),
            fromSimbody(mobilizer.getBodyAngularVelocity(state_))};
}

void SimbodyWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = stateOf(static_cast<int>(i));
}

adapter::ReadBack SimbodyWorld::readBack() const {
    adapter::ReadBack back;
    const Vec3 gravity = fromSimbody(model_->gravity.getGravityVector(state_));
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
        const scenario::Body& body = scenario_.bodies[i];
        adapter::BodyReadBack entry;
        entry.state = stateOf(static_cast<int>(i));
        entry.centerOfMass = body.massProperties.centerOfMass;
        if (body.type == BodyType::Dynamic) {
            const SimTK::MassProperties& mass = model_->bodies[i].getBodyMassProperties(state_);
            const Link& link = model_->forest.links[i];
            entry.mass = mass.getMass();
            entry.centerOfMass = link.frame * fromSimbody(mass.getMassCenter());
            const SimTK::Vec3 moments = mass.calcCentralInertia().getMoments();
            const Mat3 axes = toMatrix(link.frame.orientation);
            const Mat3 all = axes * Mat3::diagonal(moments[0], moments[1], moments[2]) * transpose(axes);
            if (planar_)
                entry.inertia(2, 2) = all(2, 2);
            else
                entry.inertia = all;
            const bool own = model_->gravity.getBodyIsExcluded(state_, model_->bodies[i]);
            entry.gravity = own ? body.gravityScale * scenario_.gravity : gravity;
        }
        back.bodies.push_back(entry);
    }
    return back;
}

adapter::StepCounters SimbodyWorld::counters() const {
    adapter::StepCounters counters;
    counters.contacts = 0;
    counters.solverIterations = internalSteps_;
    return counters;
}

}  // namespace rigor::simbody
