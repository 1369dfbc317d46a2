// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/contact_rules.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

namespace rigor::bullet {

using scenario::PairCoefficients;

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
