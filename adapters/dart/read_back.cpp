// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of DART: states, contacts, what was built, counters.
#include <algorithm>
#include <dart/collision/CollisionObject.hpp>
#include <limits>

#include "adapters/dart/world.hpp"
#include "adapters/interface/surface_points.hpp"

namespace rigor::dart_adapter {

using adapter::BodyState;
using adapter::ContactPoint;
using scenario::BodyType;

BodyState DartWorld::stateOf(int body) const {
    const BodyState& start = prescribed_[body];
    switch (scenario_.bodies[body].type) {
        case BodyType::Static:
            return {start.position, start.orientation, {}, {}};
        case BodyType::Kinematic:
            return start;
        default: {
            if (escaped_) {
                const double nan = std::numeric_limits<double>::quiet_NaN();
                const Vec3 none{nan, nan, nan};
                return {none, {nan, nan, nan, nan}, none, none};
            }
            const dart::dynamics::BodyNode& node = *model_.bodies[body];
            const Pose pose = fromDart(node.getWorldTransform()) * inverse(model_.forest.links[body].frame);
            return {pose.position, pose.orientation, fromDart(node.getLinearVelocity()),
                    fromDart(node.getAngularVelocity())};
        }
    }
}

void DartWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = stateOf(static_cast<int>(i));
}

void DartWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    contacts.clear();
    for (const dart::collision::Contact& c : found_.getContacts()) {
        if (!isContact(c)) continue;
        const auto &first = model_.shapes.at(c.collisionObject1->getShapeFrame()),
                   &second = model_.shapes.at(c.collisionObject2->getShapeFrame());
        // The normal points to the first body, on which the force acts.
        const bool ordered = first.body < second.body;
        const auto &a = ordered ? first : second, &b = ordered ? second : first;
        const Vec3 normal = fromDart(c.normal), force = fromDart(c.force);
        const double along = dot(force, normal);
        const double sign = ordered ? -1.0 : 1.0;
        ContactPoint point;
        point.bodyA = a.body;
        point.bodyB = b.body;
        point.shapeA = a.shape;
        point.shapeB = b.shape;
        point.normal = sign * normal;
        point.depth = c.penetrationDepth;
        const scenario::Shape &shapeA = scenario_.bodies[a.body].shapes[a.shape],
                              &shapeB = scenario_.bodies[b.body].shapes[b.shape];
        const auto [onA, onB] = adapter::surfacePoints({&shapeA.geometry, before_[a.body] * shapeA.pose},
                                                       {&shapeB.geometry, before_[b.body] * shapeB.pose},
                                                       fromDart(c.point), point.normal, point.depth);
        point.pointA = onA;
        point.pointB = onB;
        point.hasImpulse = true;
        point.normalImpulse = dt_ * along;
        point.frictionImpulse = sign * dt_ * (force - along * normal);
        contacts.push_back(point);
    }
    std::stable_sort(contacts.begin(), contacts.end(), [](const ContactPoint& p, const ContactPoint& q) {
        return std::pair(p.bodyA, p.bodyB) < std::pair(q.bodyA, q.bodyB);
    });
}

adapter::ReadBack DartWorld::readBack() const {
    adapter::ReadBack back;
    for (std::size_t i = 0; i < scenario_.bodies.size(); ++i) {
        const scenario::Body& body = scenario_.bodies[i];
        const Link& link = model_.forest.links[i];
        adapter::BodyReadBack entry;
        entry.state = stateOf(static_cast<int>(i));
        entry.centerOfMass = body.massProperties.centerOfMass;
        if (body.type == BodyType::Dynamic) {
            const dart::dynamics::Inertia& inertia = model_.bodies[i]->getInertia();
            entry.mass = inertia.getMass();
            entry.centerOfMass = link.frame * fromDart(inertia.getLocalCOM());
            const Eigen::Matrix3d moment = inertia.getMoment();
            const Mat3 axes = toMatrix(link.frame.orientation);
            const Mat3 all =
                axes * Mat3::diagonal(moment(0, 0), moment(1, 1), moment(2, 2)) * transpose(axes);
            if (planar_)
                entry.inertia(2, 2) = all(2, 2);
            else
                entry.inertia = all;
            const Vec3 gravity = fromDart(world_->getGravity());
            entry.gravity = model_.bodies[i]->getGravityMode() ? gravity : body.gravityScale * gravity;
        }
        back.bodies.push_back(entry);
    }
    for (const auto& example : pairs_.examples()) {
        const auto* one = model_.shapeNodes[example.a.body][example.a.shape];
        const auto* two = model_.shapeNodes[example.b.body][example.b.shape];
        setCoefficients(*one, *two);
        const auto *a = one->getDynamicsAspect(), *b = two->getDynamicsAspect();
        back.pairs.push_back({example.materialA, example.materialB,
                              std::min(a->getFrictionCoeff(), b->getFrictionCoeff()),
                              a->getRestitutionCoeff() * b->getRestitutionCoeff()});
    }
    return back;
}

adapter::StepCounters DartWorld::counters() const {
    adapter::StepCounters counters;
    counters.contacts = static_cast<std::int64_t>(found_.getNumContacts());
    counters.islands = static_cast<std::int64_t>(solver_->groups());
    return counters;
}

}  // namespace rigor::dart_adapter
