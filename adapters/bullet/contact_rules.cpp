// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/contact_rules.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>

namespace rigor::bullet {

using scenario::PairCoefficients;

int BodyTag::materialOf(int shape) const {
    const auto index = static_cast<std::size_t>(std::max(shape, 0));
    return materials[index < materials.size() ? index : 0u];
}

namespace {

/// The scenario's shape that a point lies on. Bullet's own index is that of a compound's child or, where the
/// child is a surface, of its triangle; the shapes themselves carry the scenario's index.
int shapeIndex(const btCollisionObjectWrapper& innermost) {
    for (const btCollisionObjectWrapper* wrapper = &innermost; wrapper != nullptr;
         wrapper = wrapper->m_parent)
        if (wrapper->getCollisionShape()->getUserIndex() >= 0)
            return wrapper->getCollisionShape()->getUserIndex();
    return 0;
}

/// Gives a contact with an inner edge the face's normal, where the surface was built with its edges. Bullet
/// keeps a surface as the second body of a manifold.
void adjustInternalEdge(btManifoldPoint& point, const btCollisionObjectWrapper& other,
                        const btCollisionObjectWrapper& surface, int part, int triangle) {
    if (surface.getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE)
        btAdjustInternalEdgeContacts(point, &surface, &other, part, triangle,
                                     BT_TRIANGLE_CONVEX_DOUBLE_SIDED | BT_TRIANGLE_CONCAVE_DOUBLE_SIDED);
}

bool onContactAdded(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                    const btCollisionObjectWrapper* b, int partB, int indexB) {
    const auto* tagA = static_cast<const BodyTag*>(a->getCollisionObject()->getUserPointer());
    const auto* tagB = static_cast<const BodyTag*>(b->getCollisionObject()->getUserPointer());
    if (tagA == nullptr || tagB == nullptr || tagA->table != tagB->table) return false;
    adjustInternalEdge(point, *a, *b, partB, indexB);
    point.m_index0 = shapeIndex(*a);
    point.m_index1 = shapeIndex(*b);
    const PairCoefficients& pair =
        tagA->table->coefficients(tagA->materialOf(point.m_index0), tagB->materialOf(point.m_index1));
    point.m_combinedFriction = static_cast<btScalar>(pair.friction);
    point.m_combinedRestitution = static_cast<btScalar>(pair.restitution);
    return true;
}

/// The part of an object that stands for shape `index`.
const btCollisionShape* partOf(const btCollisionObject& object, int index) {
    const btCollisionShape* shape = object.getCollisionShape();
    if (!shape->isCompound()) return shape;
    return static_cast<const btCompoundShape*>(shape)->getChildShape(index);
}

}  // namespace

void installContactCallback() {
    gContactAddedCallback = onContactAdded;
}

PairCoefficients combinedByBullet(const btCollisionObject& a, int childA, const btCollisionObject& b,
                                  int childB) {
    const btCollisionObjectWrapper wrapA(nullptr, partOf(a, childA), &a, a.getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrapB(nullptr, partOf(b, childB), &b, b.getWorldTransform(), -1, -1);
    btPersistentManifold manifold(&a, &b, 0, btScalar(0.02), btScalar(0.02));
    btManifoldResult result(&wrapA, &wrapB);
    result.setPersistentManifold(&manifold);
    result.setShapeIdentifiersA(-1, childA);
    result.setShapeIdentifiersB(-1, childB);
    result.addContactPoint(btVector3(0, 1, 0), b.getWorldTransform().getOrigin(), btScalar(0.0));
    const btManifoldPoint& point = manifold.getContactPoint(0);
    return {point.m_combinedFriction, point.m_combinedRestitution};
}

}  // namespace rigor::bullet
