// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/ode/collision.hpp"

#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"
#include "adapters/ode/contacts.hpp"
#include "adapters/ode/library.hpp"
#include "adapters/ode/shapes.hpp"

namespace rigor::ode {
namespace {

adapter::Geometry solidOf(const adapter::Geometry& geometry, int dimension) {
    if (dimension == 3) return geometry;
    if (std::holds_alternative<scenario::Segment>(geometry) ||
        std::holds_alternative<scenario::Chain>(geometry))
        throw adapter::Unsupported(std::string("ode has no shape '") + scenario::geometryName(geometry, 2) +
                                   "'");
    return adapter::planarGeometry(geometry);
}

bool isHalfSpace(const adapter::Geometry& geometry) {
    return std::holds_alternative<scenario::HalfSpace>(geometry);
}

}  // namespace

adapter::CollisionAnswer OdeCollisionEngine::collide(const adapter::CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    useLibrary();
    if (isHalfSpace(*query.a.geometry) && isHalfSpace(*query.b.geometry))
        throw adapter::Unsupported("ode has no collider for two half-spaces");
    const adapter::Geometry solidA = solidOf(*query.a.geometry, query.dimension);
    const adapter::Geometry solidB = solidOf(*query.b.geometry, query.dimension);
    const Geom a(solidA, query.a.pose), b(solidB, query.b.pose);
    std::vector<FoundPoint> points;
    collideGeoms(a.id(), b.id(), query.dimension == 2, points);
    reducePoints(static_cast<std::size_t>(query.maxContacts), points);

    adapter::CollisionAnswer answer;
    answer.overlap = !points.empty();
    for (const FoundPoint& point : points) {
        const auto [onA, onB] = adapter::surfacePoints({&solidA, query.a.pose}, {&solidB, query.b.pose},
                                                       point.position, point.normal, point.depth);
        adapter::ContactPoint contact;
        contact.bodyA = 0, contact.bodyB = 1;
        contact.pointA = onA, contact.pointB = onB;
        contact.normal = point.normal;
        contact.depth = point.depth;
        answer.contacts.push_back(contact);
    }
    return answer;
}

}  // namespace rigor::ode
