// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Everything that is read out of Bullet's objects: states, contacts, what was built, counters.
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/world.hpp"

namespace rigor::bullet {

using adapter::BodyState;
using adapter::ContactPoint;
using adapter::Mat3;

BodyState BulletWorld::stateOf(const BodyRecord& record) const {
    if (record.linked) {
        const int body = record.tag.body;
        const Pose pose = fromBullet(articulations_->pose(body)) * inverse(record.comFrame);
        return {pose.position, pose.orientation, fromBullet(articulations_->velocity(body)),
                fromBullet(articulations_->angularVelocity(body))};
    }
    const Pose pose = fromBullet(record.body->getWorldTransform()) * inverse(record.comFrame);
    BodyState state{pose.position, pose.orientation, fromBullet(record.body->getLinearVelocity()),
                    fromBullet(record.body->getAngularVelocity())};
    if (record.body->isKinematicObject()) {
        state.velocity = fromBullet(record.velocity);
        state.angularVelocity = fromBullet(record.angularVelocity);
    }
    return state;
}

void BulletWorld::readStates(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < records_.size(); ++i) states[i] = stateOf(*records_[i]);
}

namespace {

/// Merges the two ends of a prism's edge, which are one contact in 2D: same bodies, shapes and place.
void addPlanarContact(ContactPoint contact, std::vector<ContactPoint>& contacts, std::size_t first) {
    contact.pointA.z = contact.pointB.z = 0.0;
    contact.frictionImpulse.z = 0.0;
    const double scale = std::hypot(contact.normal.x, contact.normal.y);
    if (scale < 0.5) return;  // a normal along z says nothing about the plane
    contact.normal = Vec3{contact.normal.x, contact.normal.y, 0.0} / scale;
    for (std::size_t i = first; i < contacts.size(); ++i) {
        ContactPoint& known = contacts[i];
        const bool same = known.shapeA == contact.shapeA && known.shapeB == contact.shapeB &&
                          norm(known.pointA - contact.pointA) < 1e-5 &&
                          norm(known.pointB - contact.pointB) < 1e-5;
        if (!same) continue;
        known.normalImpulse += contact.normalImpulse;
        known.frictionImpulse += contact.frictionImpulse;
        return;
    }
    contacts.push_back(contact);
}

}  // namespace

/// Bullet's impulses act on its body 0; `towardsB` is -1 where that is the scenario's A.
void BulletWorld::readImpulses(const btManifoldPoint& point, double towardsB, ContactPoint& contact) const {
    contact.hasImpulse = true;
    contact.normalImpulse = point.m_appliedImpulse;
    contact.frictionImpulse =
        (towardsB * point.m_appliedImpulseLateral1) * fromBullet(point.m_lateralFrictionDir1);
    if (is("friction_directions", "2"))
        contact.frictionImpulse +=
            (towardsB * point.m_appliedImpulseLateral2) * fromBullet(point.m_lateralFrictionDir2);
}

void BulletWorld::appendManifold(const btPersistentManifold& manifold,
                                 std::vector<ContactPoint>& contacts) const {
    const btCollisionObject& object0 = *manifold.getBody0();
    const btCollisionObject& object1 = *manifold.getBody1();
    // A contact between sleeping bodies stays, but the step did not solve it.
    const auto awake = [](const btCollisionObject& o) { return o.isActive() && !o.isStaticObject(); };
    const bool solved = awake(object0) || awake(object1);
    const int body0 = static_cast<const BodyTag*>(object0.getUserPointer())->body;
    const int body1 = static_cast<const BodyTag*>(object1.getUserPointer())->body;
    // Bullet's normal points from its body 1 to its body 0; impulses act on body 0 along it.
    const bool ordered = body0 < body1;
    const double towardsB = ordered ? -1.0 : 1.0;
    const std::size_t first = contacts.size();
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        if (point.getDistance() > manifold.getContactProcessingThreshold()) continue;
        const int shape0 = std::max(point.m_index0, 0), shape1 = std::max(point.m_index1, 0);
        const Vec3 on0 = fromBullet(point.getPositionWorldOnA());
        const Vec3 on1 = fromBullet(point.getPositionWorldOnB());
        ContactPoint contact;
        contact.bodyA = std::min(body0, body1);
        contact.bodyB = std::max(body0, body1);
        contact.shapeA = ordered ? shape0 : shape1;
        contact.shapeB = ordered ? shape1 : shape0;
        contact.pointA = ordered ? on0 : on1;
        contact.pointB = ordered ? on1 : on0;
        contact.normal = towardsB * fromBullet(point.m_normalWorldOnB);
        contact.depth = -static_cast<double>(point.getDistance());
        if (solved) readImpulses(point, towardsB, contact);
        if (planar_)
            addPlanarContact(contact, contacts, first);
        else
            contacts.push_back(contact);
    }
}

void BulletWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    contacts.clear();
    if (steps_ == 0) return;
    for (int i = 0; i < dispatcher_->getNumManifolds(); ++i)
        appendManifold(*dispatcher_->getManifoldByIndexInternal(i), contacts);
    std::stable_sort(contacts.begin(), contacts.end(), [](const ContactPoint& a, const ContactPoint& b) {
        return std::pair(a.bodyA, a.bodyB) < std::pair(b.bodyA, b.bodyB);
    });
}

adapter::ReadBack BulletWorld::readBack() const {
    adapter::ReadBack back;
    for (const auto& record : records_) {
        const btRigidBody& body = *record->body;
        adapter::BodyReadBack entry;
        entry.mass = record->linked ? articulations_->mass(record->tag.body) : body.getMass();
        entry.centerOfMass = record->comFrame.position;
        const btVector3 moments =
            record->linked ? articulations_->moments(record->tag.body) : body.getLocalInertia();
        const Mat3 principal = Mat3::diagonal(moments.x(), moments.y(), moments.z());
        const Mat3 axes = toMatrix(record->comFrame.orientation);
        entry.inertia = axes * principal * transpose(axes);
        if (planar_) entry.inertia = Mat3::diagonal(0.0, 0.0, entry.inertia(2, 2));
        entry.state = stateOf(*record);
        if (record->linked)
            entry.gravity =
                scenario_.bodies[record->tag.body].gravityScale * fromBullet(world_->getGravity());
        else if (!body.isStaticOrKinematicObject())
            entry.gravity = fromBullet(body.getGravity());
        back.bodies.push_back(entry);
    }
    const auto bodyOf = [&](const adapter::PairTable::ShapeRef& ref) -> const btRigidBody& {
        return *records_[ref.body]->body;
    };
    for (const auto& m : pairs_.examples()) {
        const auto combined = combinedByBullet(bodyOf(m.a), m.a.shape, bodyOf(m.b), m.b.shape);
        back.pairs.push_back({m.materialA, m.materialB, combined.friction, combined.restitution});
    }
    return back;
}

bool BulletWorld::isAsleep(int body) const {
    if (records_[body]->linked) return articulations_->asleep(body);
    const btRigidBody& object = *records_[body]->body;
    return !object.isStaticOrKinematicObject() && object.getActivationState() == ISLAND_SLEEPING;
}

adapter::StepCounters BulletWorld::counters() const {
    adapter::StepCounters counters;
    counters.pairs = broadphase_->getOverlappingPairCache()->getNumOverlappingPairs();
    counters.contacts = 0;
    for (int i = 0; i < dispatcher_->getNumManifolds(); ++i)
        counters.contacts += dispatcher_->getManifoldByIndexInternal(i)->getNumContacts();
    std::set<int> islands;
    for (const auto& record : records_)
        if (!record->linked && !record->body->isStaticOrKinematicObject() && record->body->isActive())
            islands.insert(record->body->getIslandTag());
    if (steps_ > 0) counters.islands = islands.size();
    const btSolverAnalyticsData& analytics = solver_->m_analyticsData;
    if (mlcpSolver_ == nullptr && analytics.m_numIterationsUsed >= 0) {
        counters.solverIterations = analytics.m_numIterationsUsed;
        counters.residual = analytics.m_remainingLeastSquaresResidual;
    }
    return counters;
}

}  // namespace rigor::bullet
