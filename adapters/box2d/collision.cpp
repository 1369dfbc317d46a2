// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two posed shapes through Box2D's own functions. Both are moved near the origin in double precision first
// and scaled so that the larger bounded one spans a few lengths, where floats and Box2D's tolerances (welding
// 2.5 mm, face preference 0.5 mm) matter least. Polygons get no skin: with a radius of 0 the result is that
// of the true surfaces. A capsule is b2Distance's segment with a radius; Box2D has no result once the other
// shape reaches its core.
#include "adapters/box2d/collision.hpp"

#include <box2d/b2_collision.h>
#include <box2d/b2_distance.h>
#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>

#include "adapters/box2d/shapes.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"

namespace rigor::box2d {
namespace {

using adapter::CollisionAnswer;
using adapter::CollisionQuery;
using adapter::ContactPoint;
using adapter::notInLibrary;
using adapter::PosedShape;
using scenario::Capsule;
using scenario::HalfSpace;
using scenario::Segment;

constexpr const char* kShapes = "b2_shape.h, b2Shape::Type: circle, edge, polygon, chain";
constexpr const char* kPairs = "b2_collision.h, the b2Collide functions: none takes two edges";

/// Distance from the shape's origin to its farthest point [m]; 0 for a half-plane.
struct Extent {
    double operator()(const scenario::Sphere& s) const { return s.radius; }
    double operator()(const scenario::Box& b) const { return std::hypot(b.halfExtents.x, b.halfExtents.y); }
    double operator()(const Capsule& c) const { return c.radius + c.halfLength; }
    double operator()(const scenario::ConvexHull& h) const {
        double most = 0.0;
        for (const Vec3& v : h.vertices) most = std::max(most, norm(v));
        return most;
    }
    double operator()(const Segment& s) const { return std::max(norm(s.a), norm(s.b)); }
    double operator()(const HalfSpace&) const { return 0.0; }
    double operator()(const scenario::Chain& c) const { return (*this)(scenario::ConvexHull{c.vertices}); }
    template <class Other>
    double operator()(const Other& other) const {
        throw adapter::notInAdapter("box2d",
                                    std::string("query of shape '") + scenario::geometryName(other, 2) + "'");
    }
};

/// A query in Box2D's terms: where its origin lies in the world and how long a metre is.
struct Frame {
    Vec3 origin;
    double scale = 1.0;
    Pose local(const Pose& pose) const { return {pose.position - origin, pose.orientation}; }
    Vec3 world(const b2Vec2& p) const { return origin + fromBox2d(p, scale); }
};

Frame frameOf(const CollisionQuery& query) {
    Frame frame;
    double extent = 0.0;
    int bounded = 0;
    for (const PosedShape* shape : {&query.a, &query.b}) {
        if (std::holds_alternative<HalfSpace>(*shape->geometry)) continue;
        extent = std::max(extent, std::visit(Extent{}, *shape->geometry));
        frame.origin += shape->pose.position;
        ++bounded;
    }
    if (bounded > 0) frame.origin = frame.origin / bounded;
    if (extent > 0.0) frame.scale = 4.0 / extent;
    return frame;
}

/// One side: its shape, or for a capsule the core segment and radius.
struct Side {
    std::unique_ptr<b2Shape> shape;
    bool capsule = false;
    b2Vec2 core[2];
    float radius = 0.0f;
    b2Transform pose;

    /// One link of a chain, which both stay with.
    Side(const b2ChainShape& chain, int32 link, const b2Transform& where) : pose(where) {
        auto edge = std::make_unique<b2EdgeShape>();
        chain.GetChildEdge(edge.get(), link);
        shape = std::move(edge);
    }
    Side(const PosedShape& posed, const Frame& frame) {
        const Pose local = frame.local(posed.pose);
        pose = toBox2d(local, frame.scale);
        if (const auto* c = std::get_if<Capsule>(posed.geometry)) {
            capsule = true;
            core[0] = toBox2d(Vec3{0.0, -c->halfLength, 0.0}, frame.scale);
            core[1] = toBox2d(Vec3{0.0, c->halfLength, 0.0}, frame.scale);
            radius = static_cast<float>(frame.scale * c->radius);
            return;
        }
        shape = std::move(buildGeometry(*posed.geometry, {}, local, settingsOf(frame)).front());
    }
    static ShapeSettings settingsOf(const Frame& frame) {
        ShapeSettings settings;
        settings.scale = frame.scale;
        settings.skin = {0.0f, 0.0f};
        settings.halfPlaneReach = settings.halfPlaneDepth = 40.0 / frame.scale;
        return settings;
    }

    /// The proxy for b2Distance: vertices and radius.
    b2DistanceProxy proxy() const {
        b2DistanceProxy p;
        if (capsule)
            p.Set(core, 2, radius);
        else
            p.Set(shape.get(), 0);
        return p;
    }
};

/// Sides of a shape that a query covers: the shape itself, or every link of a chain from both of its sides.
std::vector<Side> sidesOf(const PosedShape& posed, const Frame& frame) {
    std::vector<Side> sides;
    if (!std::holds_alternative<scenario::Chain>(*posed.geometry)) {
        sides.emplace_back(posed, frame);
        return sides;
    }
    const Pose local = frame.local(posed.pose);
    const b2Transform pose = toBox2d(local, frame.scale);
    for (const auto& shape : buildGeometry(*posed.geometry, {}, local, Side::settingsOf(frame))) {
        const auto& chain = static_cast<const b2ChainShape&>(*shape);
        for (int32 link = 0; link < chain.GetChildCount(); ++link) sides.emplace_back(chain, link, pose);
    }
    return sides;
}

/// The manifold of two shapes that both are Box2D's, in the order that Box2D requires; false if it requires
/// the other order.
bool collideOrdered(const Side& a, const Side& b, b2Manifold& manifold) {
    const auto typeA = a.shape->GetType(), typeB = b.shape->GetType();
    const auto circle = [](const Side& s) { return static_cast<const b2CircleShape*>(s.shape.get()); };
    const auto polygon = [](const Side& s) { return static_cast<const b2PolygonShape*>(s.shape.get()); };
    const auto edge = [](const Side& s) { return static_cast<const b2EdgeShape*>(s.shape.get()); };
    if (typeA == b2Shape::e_circle && typeB == b2Shape::e_circle)
        b2CollideCircles(&manifold, circle(a), a.pose, circle(b), b.pose);
    else if (typeA == b2Shape::e_polygon && typeB == b2Shape::e_circle)
        b2CollidePolygonAndCircle(&manifold, polygon(a), a.pose, circle(b), b.pose);
    else if (typeA == b2Shape::e_polygon && typeB == b2Shape::e_polygon)
        b2CollidePolygons(&manifold, polygon(a), a.pose, polygon(b), b.pose);
    else if (typeA == b2Shape::e_edge && typeB == b2Shape::e_circle)
        b2CollideEdgeAndCircle(&manifold, edge(a), a.pose, circle(b), b.pose);
    else if (typeA == b2Shape::e_edge && typeB == b2Shape::e_polygon)
        b2CollideEdgeAndPolygon(&manifold, edge(a), a.pose, polygon(b), b.pose);
    else
        return false;
    return true;
}

void appendManifold(const b2Manifold& manifold, const Side& a, const Side& b, bool swapped,
                    const Frame& frame, std::vector<ContactPoint>& contacts) {
    b2WorldManifold placed;
    placed.Initialize(&manifold, a.pose, a.shape->m_radius, b.pose, b.shape->m_radius);
    for (int i = 0; i < manifold.pointCount; ++i) {
        const float separation = placed.separations[i];
        const Vec3 onA = frame.world(placed.points[i] - 0.5f * separation * placed.normal);
        const Vec3 onB = frame.world(placed.points[i] + 0.5f * separation * placed.normal);
        ContactPoint contact;
        contact.bodyB = 1;
        contact.pointA = swapped ? onB : onA;
        contact.pointB = swapped ? onA : onB;
        contact.normal = (swapped ? -1.0 : 1.0) * fromBox2d(placed.normal, 1.0);
        contact.depth = -static_cast<double>(separation) / frame.scale;
        contacts.push_back(contact);
    }
}

/// b2Collide* on pairs of Box2D's own shapes.
class Box2dBatch final : public adapter::CollisionBatch {
  public:
    explicit Box2dBatch(std::span<const CollisionQuery> queries) : manifolds_(queries.size()) {
        for (const CollisionQuery& query : queries) {
            for (const PosedShape* posed : {&query.a, &query.b})
                if (std::holds_alternative<scenario::Chain>(*posed->geometry))
                    throw adapter::notInAdapter("box2d", "timed query of shape 'chain'");
            const Frame frame = frameOf(query);
            BatchPair pair{{query.a, frame}, {query.b, frame}, frame, false};
            if (pair.first.capsule || pair.second.capsule)
                throw notInLibrary("box2d", "contacts of a capsule, only its distance", kShapes);
            b2Manifold manifold;
            if (!collideOrdered(pair.first, pair.second, manifold)) {
                std::swap(pair.first, pair.second);
                pair.swapped = true;
                if (!collideOrdered(pair.first, pair.second, manifold))
                    throw notInLibrary("box2d", "contacts of segment with segment", kPairs);
            }
            pairs_.push_back(std::move(pair));
        }
    }
    std::size_t run() override {
        std::size_t contacts = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) contacts += runQuery(i);
        return contacts;
    }
    std::vector<ContactPoint> contacts(std::size_t i) override {
        std::vector<ContactPoint> all;
        const BatchPair& pair = pairs_[i];
        if (runQuery(i) > 0)
            appendManifold(manifolds_[i], pair.first, pair.second, pair.swapped, pair.frame, all);
        return all;
    }

  private:
    struct BatchPair {
        Side first, second;
        Frame frame;
        bool swapped;
    };
    std::size_t runQuery(std::size_t i) {
        manifolds_[i].pointCount = 0;
        collideOrdered(pairs_[i].first, pairs_[i].second, manifolds_[i]);
        return manifolds_[i].pointCount;
    }
    std::vector<BatchPair> pairs_;
    std::vector<b2Manifold> manifolds_;
};

std::vector<ContactPoint> shapeContacts(const Side& a, const Side& b, const Frame& frame) {
    std::vector<ContactPoint> contacts;
    b2Manifold manifold;
    manifold.pointCount = 0;
    if (collideOrdered(a, b, manifold))
        appendManifold(manifold, a, b, false, frame, contacts);
    else if (collideOrdered(b, a, manifold))
        appendManifold(manifold, b, a, true, frame, contacts);
    else
        throw notInLibrary("box2d", "contacts of segment with segment", kPairs);
    return contacts;
}

struct Closest {
    double distance = 0.0;  ///< distance of the surfaces, < 0 where the radii overlap [m]
    bool coresApart = false;
    Vec3 onA, onB, normal;
};

/// GJK between the cores, radii taken off afterwards.
Closest closestPoints(const Side& a, const Side& b, const Frame& frame) {
    b2DistanceInput input;
    input.proxyA = a.proxy();
    input.proxyB = b.proxy();
    input.transformA = a.pose;
    input.transformB = b.pose;
    input.useRadii = false;
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input);
    Closest closest;
    closest.coresApart = output.distance > 10.0f * b2_epsilon;
    if (!closest.coresApart) return closest;
    const b2Vec2 normal = (1.0f / output.distance) * (output.pointB - output.pointA);
    const float rA = input.proxyA.m_radius, rB = input.proxyB.m_radius;
    closest.distance = (output.distance - rA - rB) / frame.scale;
    closest.normal = fromBox2d(normal, 1.0);
    closest.onA = frame.world(output.pointA + rA * normal);
    closest.onB = frame.world(output.pointB - rB * normal);
    return closest;
}

/// Adds the contacts of two sides to `answer`, and their closest points where they are nearer than what it
/// has.
void runQuery(const Side& a, const Side& b, const Frame& frame, CollisionAnswer& answer) {
    const Closest closest = closestPoints(a, b, frame);
    if (a.capsule || b.capsule) {
        if (!closest.coresApart)
            throw notInLibrary("box2d", "depth of a capsule once its core is reached", kShapes);
        if (closest.distance <= 0.0) {
            ContactPoint contact;
            contact.bodyB = 1;
            contact.pointA = closest.onA;
            contact.pointB = closest.onB;
            contact.normal = closest.normal;
            contact.depth = -closest.distance;
            answer.contacts.push_back(contact);
        }
    } else {
        for (const ContactPoint& contact : shapeContacts(a, b, frame))
            if (contact.depth >= 0.0) answer.contacts.push_back(contact);
    }
    if (closest.coresApart && !(answer.signedDistance && *answer.signedDistance <= closest.distance)) {
        answer.signedDistance = closest.distance;
        answer.witnessA = closest.onA;
        answer.witnessB = closest.onB;
    }
}

}  // namespace

std::unique_ptr<adapter::CollisionBatch> Box2dCollisionEngine::batch(
    std::span<const CollisionQuery> queries) const {
    if (queries.empty()) throw adapter::BadInput("a batch of no pairs");
    if (queries.front().dimension != 2)
        throw notInLibrary("box2d", "three-dimensional shapes", kTwoDimensions);
    for (const CollisionQuery& query : queries) adapter::checkQueryInput(query);
    return std::make_unique<Box2dBatch>(queries);
}

CollisionAnswer Box2dCollisionEngine::collide(const CollisionQuery& query) const {
    if (query.dimension != 2) throw notInLibrary("box2d", "three-dimensional shapes", kTwoDimensions);
    adapter::checkQueryInput(query);
    const Frame frame = frameOf(query);
    CollisionAnswer answer;
    const std::vector<Side> sidesB = sidesOf(query.b, frame);
    for (const Side& a : sidesOf(query.a, frame))
        for (const Side& b : sidesB) runQuery(a, b, frame, answer);
    adapter::orderDeepestFirst(answer.contacts);
    answer.overlap = !answer.contacts.empty();
    if (answer.overlap) {
        const ContactPoint& deepest = answer.contacts.front();
        answer.signedDistance = -deepest.depth;
        answer.witnessA = deepest.pointA;
        answer.witnessB = deepest.pointB;
    }
    adapter::keepFirst(answer.contacts, query.maxContacts);
    return answer;
}

}  // namespace rigor::box2d
