// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of Chipmunk's objects: states, contacts, what was built, counters.
#include <chipmunk/chipmunk_structs.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adapters/chipmunk/world.hpp"

namespace rigor::chipmunk {

using adapter::BodyState;
using adapter::ContactPoint;

BodyState ChipmunkWorld::stateOf(const BodyRecord& record) const {
    const cpBody* body = record.body.get();
    BodyState state{fromChipmunk(cpBodyGetPosition(body)),
                    scenario::fromAxisAngle({0.0, 0.0, 1.0}, cpBodyGetAngle(body)),
                    {},
                    {}};
    if (record.moves) {
        state.velocity = fromChipmunk(cpBodyGetVelocity(body));
        state.angularVelocity = {0.0, 0.0, cpBodyGetAngularVelocity(body)};
    }
    return state;
}

void ChipmunkWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < records_.size(); ++i) states[i] = stateOf(*records_[i]);
}

/// The impulse of a single point is in cpContact alone, which Chipmunk's headers count to its private ones. Its
/// points are kept as offsets from the centres of mass, so they are placed by those of the time they were found.
void ChipmunkWorld::appendContacts(const cpArbiter& arbiter, std::vector<ContactPoint>& contacts) const {
    const auto& tagA = *static_cast<const ShapeTag*>(cpShapeGetUserData(arbiter.a));
    const auto& tagB = *static_cast<const ShapeTag*>(cpShapeGetUserData(arbiter.b));
    const bool ordered = tagA.body < tagB.body;
    const double sign = ordered ? 1.0 : -1.0;
    const Vec3 normal = fromChipmunk(arbiter.n), tangent = fromChipmunk(cpvperp(arbiter.n));
    for (int i = 0; i < arbiter.count; ++i) {
        const cpContact& c = arbiter.contacts[i];
        const Vec3 onA = fromChipmunk(cpvadd(centers_[tagA.body], c.r1));
        const Vec3 onB = fromChipmunk(cpvadd(centers_[tagB.body], c.r2));
        ContactPoint point;
        point.bodyA = std::min(tagA.body, tagB.body);
        point.bodyB = std::max(tagA.body, tagB.body);
        point.shapeA = ordered ? tagA.shape : tagB.shape;
        point.shapeB = ordered ? tagB.shape : tagA.shape;
        point.pointA = ordered ? onA : onB;
        point.pointB = ordered ? onB : onA;
        point.normal = sign * normal;
        point.depth = dot(onA - onB, normal);
        point.hasImpulse = true;
        point.normalImpulse = c.jnAcc;
        point.frictionImpulse = sign * c.jtAcc * tangent;
        contacts.push_back(point);
    }
}

void ChipmunkWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    contacts.clear();
    for (const cpArbiter* arbiter : touching_) appendContacts(*arbiter, contacts);
    std::stable_sort(contacts.begin(), contacts.end(), [](const ContactPoint& a, const ContactPoint& b) {
        return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
    });
}

/// Coefficients that a contact of these two materials ends up with: two discs that overlap, of the bodies and shapes of
/// an example, go through the handler of this world in a space of their own.
scenario::PairCoefficients ChipmunkWorld::probe(int materialA, int materialB) const {
    struct Found {
        const ChipmunkWorld* world;
        scenario::PairCoefficients pair;
        bool touched = false;
    } found{this, {}, false};
    Owned<cpSpace> space(cpSpaceNew());
    cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space.get());
    handler->userData = &found;
    handler->preSolveFunc = [](cpArbiter* arbiter, cpSpace* in, cpDataPointer data) -> cpBool {
        auto* self = const_cast<ChipmunkWorld*>(static_cast<Found*>(data)->world);
        return preSolve(arbiter, in, self);
    };
    handler->postSolveFunc = [](cpArbiter* arbiter, cpSpace*, cpDataPointer data) {
        auto& result = *static_cast<Found*>(data);
        result.pair.friction = cpArbiterGetFriction(arbiter);
        result.pair.restitution = cpArbiterGetRestitution(arbiter);
        result.touched = true;
    };
    for (const auto& example : pairs_.examples()) {
        if (example.materialA != materialA || example.materialB != materialB) continue;
        ShapeTag tags[2] = {{example.a.body, example.a.shape, materialA},
                            {example.b.body, example.b.shape, materialB}};
        Owned<cpBody> bodies[2];
        Owned<cpShape> discs[2];
        for (int i = 0; i < 2; ++i) {
            bodies[i].reset(cpBodyNew(1.0, 1.0));
            cpBodySetPosition(bodies[i].get(), cpv(0.0, 1.9 * i));
            discs[i].reset(cpCircleShapeNew(bodies[i].get(), 1.0, cpvzero));
            cpShapeSetUserData(discs[i].get(), &tags[i]);
            cpSpaceAddBody(space.get(), bodies[i].get());
            cpSpaceAddShape(space.get(), discs[i].get());
        }
        cpSpaceStep(space.get(), dt_);
        space.reset();
        if (!found.touched) throw std::logic_error("chipmunk: the probe bodies did not meet");
    }
    return found.pair;
}

adapter::ReadBack ChipmunkWorld::readBack() const {
    adapter::ReadBack back;
    for (const auto& record : records_) {
        cpBody* body = record->body.get();
        adapter::BodyReadBack entry;
        entry.state = stateOf(*record);
        entry.centerOfMass = fromChipmunk(cpBodyGetCenterOfGravity(body));
        if (record->dynamic) {
            entry.mass = cpBodyGetMass(body);
            entry.inertia(2, 2) = cpBodyGetMoment(body);
            entry.gravity = record->gravityScale * fromChipmunk(cpSpaceGetGravity(space_.get()));
        }
        back.bodies.push_back(entry);
    }
    for (const auto& m : pairs_.examples()) {
        const auto used = probe(m.materialA, m.materialB);
        back.pairs.push_back({m.materialA, m.materialB, used.friction, used.restitution});
    }
    return back;
}

adapter::StepCounters ChipmunkWorld::counters() const {
    adapter::StepCounters counters;
    counters.pairs = static_cast<std::int64_t>(touching_.size());
    counters.contacts = 0;
    for (const cpArbiter* arbiter : touching_) counters.contacts += cpArbiterGetCount(arbiter);
    counters.solverIterations = cpSpaceGetIterations(space_.get());
    return counters;
}

}  // namespace rigor::chipmunk
