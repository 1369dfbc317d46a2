// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies put somewhere else between two steps. b2Body::SetTransform moves the boxes of the broad phase;
// contacts stay with the impulses of their points, from which the next step would start, so those are set to
// zero. The impulses that joints store are not accessible.
#include <cmath>
#include <numbers>

#include "adapters/box2d/world.hpp"

namespace rigor::box2d {
namespace {

/// The angle of a pose, in the turn nearest to where the body is: Box2D counts turns, its joints' limits too.
float angleNear(double angle, float now) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    return static_cast<float>(angle + kTurn * std::round((now - angle) / kTurn));
}

}  // namespace

void Box2dWorld::setStates(std::span<const adapter::BodyState> states) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        b2Body& body = *records_[i]->body;
        if (body.GetType() != b2_dynamicBody) continue;
        const adapter::BodyState& state = states[i];
        body.SetTransform(toBox2d(state.position, scale_),
                          angleNear(angleAboutZ(state.orientation), body.GetAngle()));
        body.SetLinearVelocity(toBox2d(state.velocity, scale_));
        body.SetAngularVelocity(static_cast<float>(state.angularVelocity.z));
        body.SetAwake(true);
    }
    for (b2Contact* contact = world_->GetContactList(); contact != nullptr; contact = contact->GetNext())
        for (b2ManifoldPoint& point : contact->GetManifold()->points)
            point.normalImpulse = point.tangentImpulse = 0.0f;
}

}  // namespace rigor::box2d
