// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/chipmunk/collision.hpp"

#include <algorithm>

#include "adapters/chipmunk/shapes.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::chipmunk {
namespace {

using adapter::CollisionAnswer;
using adapter::CollisionQuery;
using adapter::ContactPoint;
using adapter::PosedShape;

/// Shapes of one side, placed in the world.
struct Side {
    Owned<cpBody> body;
    std::vector<Owned<cpShape>> shapes;

    Side(const PosedShape& posed, const Vec3& origin) : body(cpBodyNewStatic()) {
        const Pose pose{posed.pose.position - origin, posed.pose.orientation};
        shapes = buildShapes(body.get(), *posed.geometry, {}, pose, {});
        for (const auto& shape : shapes) cpShapeUpdate(shape.get(), toChipmunk(pose));
    }
};

}  // namespace

CollisionAnswer ChipmunkCollisionEngine::collide(const CollisionQuery& query) const {
    if (query.dimension != 2)
        throw adapter::notInLibrary("chipmunk", "three-dimensional shapes", kTwoDimensions);
    adapter::checkQueryInput(query);
    if (scenario::isStaticOnly(*query.a.geometry) && scenario::isStaticOnly(*query.b.geometry))
        throw adapter::notInAdapter("chipmunk", "collisions of two surfaces without inside");
    const Vec3 origin = query.a.pose.position;
    const Side a(query.a, origin), b(query.b, origin);
    CollisionAnswer answer;
    for (const auto& shapeA : a.shapes)
        for (const auto& shapeB : b.shapes) {
            const cpContactPointSet set = cpShapesCollide(shapeA.get(), shapeB.get());
            for (int i = 0; i < set.count; ++i) {
                ContactPoint contact;
                contact.bodyB = 1;
                contact.pointA = origin + fromChipmunk(set.points[i].pointA);
                contact.pointB = origin + fromChipmunk(set.points[i].pointB);
                contact.normal = fromChipmunk(set.normal);
                // points[i].distance has the wrong sign where Chipmunk has exchanged the shapes.
                contact.depth = dot(contact.pointA - contact.pointB, contact.normal);
                answer.contacts.push_back(contact);
            }
        }
    adapter::orderDeepestFirst(answer.contacts);
    answer.overlap = !answer.contacts.empty();
    adapter::keepFirst(answer.contacts, query.maxContacts);
    return answer;
}

}  // namespace rigor::chipmunk
