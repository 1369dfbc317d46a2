// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/pair_table.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <algorithm>

namespace rigor::bullet {

using scenario::PairCoefficients;

PairTable::PairTable(const adapter::Scenario& scenario) : materials_(scenario.materials.size()) {
    for (std::size_t a = 0; a < materials_; ++a)
        for (std::size_t b = 0; b < materials_; ++b)
            table_.push_back(pairCoefficients(scenario, static_cast<int>(a), static_cast<int>(b)));
    for (const auto& body : scenario.bodies) {
        collides_.push_back(body.collides && !body.shapes.empty());
        dynamic_.push_back(body.type == scenario::BodyType::Dynamic);
    }
    for (const auto& joint : scenario.joints)
        if (!joint.collideConnected && joint.bodyA != scenario::kNone)
            connected_.emplace_back(std::minmax(joint.bodyA, joint.bodyB));
    std::sort(connected_.begin(), connected_.end());
}

const PairCoefficients& PairTable::coefficients(int materialA, int materialB) const {
    return table_[static_cast<std::size_t>(materialA) * materials_ + static_cast<std::size_t>(materialB)];
}

bool PairTable::mayCollide(int bodyA, int bodyB) const {
    const auto a = static_cast<std::size_t>(bodyA), b = static_cast<std::size_t>(bodyB);
    if (!collides_[a] || !collides_[b] || !(dynamic_[a] || dynamic_[b])) return false;
    const std::pair<int, int> key = std::minmax(bodyA, bodyB);
    return !std::binary_search(connected_.begin(), connected_.end(), key);
}

bool PairTable::mayBounce(const adapter::Scenario& scenario, int body) const {
    for (std::size_t other = 0; other < scenario.bodies.size(); ++other) {
        if (static_cast<int>(other) == body || !mayCollide(body, static_cast<int>(other))) continue;
        for (const auto& mine : scenario.bodies[static_cast<std::size_t>(body)].shapes)
            for (const auto& theirs : scenario.bodies[other].shapes)
                if (coefficients(mine.material, theirs.material).restitution > 0.0) return true;
    }
    return false;
}

int BodyTag::materialOf(int child) const {
    const auto index = child < 0 ? 0u : static_cast<std::size_t>(child);
    return materials[index < materials.size() ? index : 0u];
}

namespace {

bool onContactAdded(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int childA,
                    const btCollisionObjectWrapper* b, int, int childB) {
    const auto* tagA = static_cast<const BodyTag*>(a->getCollisionObject()->getUserPointer());
    const auto* tagB = static_cast<const BodyTag*>(b->getCollisionObject()->getUserPointer());
    if (tagA == nullptr || tagB == nullptr || tagA->table != tagB->table) return false;
    const PairCoefficients& pair =
        tagA->table->coefficients(tagA->materialOf(childA), tagB->materialOf(childB));
    point.m_combinedFriction = static_cast<btScalar>(pair.friction);
    point.m_combinedRestitution = static_cast<btScalar>(pair.restitution);
    return true;
}

}  // namespace

void installContactCallback() {
    gContactAddedCallback = onContactAdded;
}

PairCoefficients combinedByBullet(const btCollisionObject& a, int childA, const btCollisionObject& b,
                                  int childB) {
    const btCollisionObjectWrapper wrapA(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrapB(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
    btPersistentManifold manifold(&a, &b, 0, btScalar(0.02), btScalar(0.02));
    btManifoldResult result(&wrapA, &wrapB);
    result.setPersistentManifold(&manifold);
    result.setShapeIdentifiersA(-1, childA);
    result.setShapeIdentifiersB(-1, childB);
    result.addContactPoint(btVector3(0, 1, 0), b.getWorldTransform().getOrigin(), btScalar(0.0));
    const btManifoldPoint& point = manifold.getContactPoint(0);
    return {static_cast<double>(point.m_combinedFriction), static_cast<double>(point.m_combinedRestitution)};
}

}  // namespace rigor::bullet
