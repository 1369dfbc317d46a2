// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision queries by the in-house narrow phase, in double precision.
//
// Signed distance: exact for every overlapping pair, and for separated pairs with a ball, capsule or
// half-space. The separating axis of two separated polytopes only bounds their distance from below: there
// the answer is left empty.
#include <algorithm>
#include <limits>

#include "adapters/interface/input_check.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "adapters/rigor/parts.hpp"
#include "engine/narrowphase/manifold.hpp"

namespace rigor::adapter {
namespace {

bool isPolytope(const Geometry& g) {
    return std::holds_alternative<scenario::Box>(g) || std::holds_alternative<scenario::ConvexHull>(g);
}

template <class S>
CollisionAnswer collideIn(const CollisionQuery& query) {
    const engine::Shape<S> a = toEngineShape<S>(*query.a.geometry), b = toEngineShape<S>(*query.b.geometry);
    const engine::Pose<S> Xa = toEnginePose<S>(query.a.pose), Xb = toEnginePose<S>(query.b.pose);
    const bool bound = isPolytope(*query.a.geometry) && isPolytope(*query.b.geometry);
    // With an unbounded speculative distance separated pairs are answered too.
    const double reach = bound ? 0.0 : std::numeric_limits<double>::max();
    engine::Manifold<S> manifold;
    engine::findNarrowPhase<S>("sat")(a, Xa, b, Xb, reach, manifold);

    CollisionAnswer answer;
    std::vector<ContactPoint> points;
    for (int i = 0; i < manifold.count; ++i) {
        const auto& p = manifold.points[static_cast<std::size_t>(i)];
        ContactPoint c;
        c.bodyA = 0;
        c.bodyB = 1;
        c.pointA = fromEngineVec(p.pointA);
        c.pointB = fromEngineVec(p.pointB);
        c.normal = fromEngineVec(manifold.normal);
        c.depth = -p.separation;
        points.push_back(c);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const ContactPoint& x, const ContactPoint& y) { return x.depth > y.depth; });
    if (!points.empty()) {
        answer.overlap = points.front().depth >= 0;
        answer.signedDistance = -points.front().depth;
        answer.witnessA = points.front().pointA;
        answer.witnessB = points.front().pointB;
    }
    for (const ContactPoint& c : points)
        if (c.depth >= 0 && static_cast<int>(answer.contacts.size()) < query.maxContacts)
            answer.contacts.push_back(c);
    return answer;
}

class RigorCollision final : public CollisionEngine {
  public:
    CollisionAnswer collide(const CollisionQuery& query) const override {
        checkQueryInput(query);
        return query.dimension == 2 ? collideIn<engine::Space2d>(query) : collideIn<engine::Space3d>(query);
    }
};

}  // namespace

std::unique_ptr<CollisionEngine> makeRigorCollision() {
    return std::make_unique<RigorCollision>();
}

}  // namespace rigor::adapter
