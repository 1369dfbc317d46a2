// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// States of bodies as coordinates of Simbody's joints.
#include <cmath>
#include <numbers>

#include "adapters/simbody/model.hpp"

namespace rigor::simbody {
namespace {

using adapter::BodyState;
using scenario::JointType;

/// The angle in the turn nearest to where the coordinate is: springs count turns.
double near(double angle, double now) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return angle + kTurn * std::round((now - angle) / kTurn);
}

}  // namespace

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
    // A reversed wheel or six_dof slides along its own axis, everything else along one of its parent's.
    const JointType type = scenario.joints[link.joint].type;
    const bool byItself = link.reversed && (type == JointType::Wheel || type == JointType::SixDof);
    for (const auto& [kind, axis, mobilizer] : model.coordinates[body]) {
        if (kind == Coordinate::Kind::Ball) {
            mobilizer.setQToFitRotation(to, toSimbody(motion.turned));
            mobilizer.setUToFitAngularVelocity(to, toSimbody(rotate(motion.turned, motion.turn)));
        } else if (kind == Coordinate::Kind::Turn) {
            const Quat& q = motion.turned;
            const double angle = 2.0 * std::atan2(dot(Vec3{q.x, q.y, q.z}, axis), q.w);
            mobilizer.setOneQ(to, 0, near(angle, mobilizer.getOneQ(to, 0)));
            mobilizer.setOneU(to, 0, dot(motion.turn, axis));
        } else {
            const Vec3 along = rotate(byItself ? Quat{} : link.rest.orientation, axis);
            const Vec3 moved = byItself
                                   ? motion.anchor - inverse(motion.relative) * (link.rest * motion.anchor)
                                   : motion.relative * motion.anchor - link.rest * motion.anchor;
            const Quat& axes = byItself ? motion.pose.orientation : motion.parent.orientation;
            mobilizer.setOneQ(to, 0, dot(moved, along));
            mobilizer.setOneU(to, 0, dot(motion.speed, rotate(axes, along)));
        }
    }
}

}  // namespace rigor::simbody
