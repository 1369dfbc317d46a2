// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/bullet/contact_rules.hpp"
#include "adapters/bullet/convert.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

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

/// Velocity of a surface over its body at a point.
Vec3 surfaceVelocity(const btCollisionObject& object, const BodyTag& tag, int shape, const Vec3& point) {
    if (tag.source == nullptr) return {};
    const auto index = static_cast<std::size_t>(std::max(shape, 0));
    return surfaceVelocityAt(tag.source->shapes[index], fromBullet(object.getWorldTransform()) * tag.frame,
                             point);
}

Vec3 velocityAt(const btCollisionObject& object, const Vec3& point) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    if (body == nullptr) return {};
    const Vec3 r = point - fromBullet(body->getCenterOfMassPosition());
    return fromBullet(body->getLinearVelocity()) + cross(fromBullet(body->getAngularVelocity()), r);
}

/// Bullet's velocities of a contact, m_contactMotion1 and 2, are what (vA - vB) should be along two directions that
/// belong to the point. The first one points where the surfaces slide.
void setSurfaceMotion(btManifoldPoint& point, const btCollisionObject& a, const BodyTag& tagA,
                      const btCollisionObject& b, const BodyTag& tagB) {
    const Vec3 p = fromBullet(point.getPositionWorldOnB()), n = fromBullet(point.m_normalWorldOnB);
    const auto tangential = [&](const Vec3& v) { return v - dot(v, n) * n; };
    const Vec3 belt =
        tangential(surfaceVelocity(b, tagB, point.m_index1, p) - surfaceVelocity(a, tagA, point.m_index0, p));
    const Vec3 slip = tangential(velocityAt(b, p) - velocityAt(a, p)) + belt;
    constexpr double kStill = 1e-6;  // [m/s]
    const Vec3 along = norm(slip) > kStill ? slip : belt;
    if (norm(along) == 0.0) return;
    const Vec3 t1 = along / norm(along), t2 = cross(n, t1);
    point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
    point.m_lateralFrictionDir1 = toBullet(t1);
    point.m_lateralFrictionDir2 = toBullet(t2);
    point.m_contactMotion1 = static_cast<btScalar>(dot(belt, t1));
    point.m_contactMotion2 = static_cast<btScalar>(dot(belt, t2));
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
    // Without rolling friction Bullet makes no rows of spinning friction (plain_programs/bullet/rolling.cpp).
    constexpr double kLeast = 1e-12;  // [m]
    const double least = pair.torsionalFriction > 0.0 ? kLeast : 0.0;
    point.m_combinedRollingFriction = static_cast<btScalar>(std::max(pair.rollingFriction, least));
    point.m_combinedSpinningFriction = static_cast<btScalar>(pair.torsionalFriction);
    if (tagA->source != nullptr || tagB->source != nullptr)
        setSurfaceMotion(point, *a->getCollisionObject(), *tagA, *b->getCollisionObject(), *tagB);
    return true;
}

/// True where the filters of two shapes let them touch. Bullet calls it with the shapes of two compounds, or of a
/// compound and another shape; those of worlds carry their filters, those of collision queries none.
bool childrenMayTouch(const btCollisionShape* a, const btCollisionShape* b) {
    const auto* filterA = static_cast<const scenario::ContactFilter*>(a->getUserPointer());
    const auto* filterB = static_cast<const scenario::ContactFilter*>(b->getUserPointer());
    return filterA == nullptr || filterB == nullptr || mayTouch(*filterA, *filterB);
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
    gCompoundChildShapePairCallback = childrenMayTouch;
    gCompoundCompoundChildShapePairCallback = childrenMayTouch;
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
