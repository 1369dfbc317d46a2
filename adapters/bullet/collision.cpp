// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts come from btCollisionDispatcher::findAlgorithm with BT_CONTACT_POINT_ALGORITHMS, the path that
// stepping takes (contactPairTest, query_path=contact_pair_test, takes another one and rounds edges by the
// margin). SAT and margins are
// those of the settings; without any, hulls and boxes carry polyhedral features, SAT is on, and margins are
// 0, which SAT ignores and GJK pairs need to be exact. The distance of separated shapes is GJK's
// (btGjkPairDetector), the support of the plane for half-spaces.
#include "adapters/bullet/collision.hpp"

#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>

#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/shapes.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"

namespace rigor::bullet {
namespace {

using adapter::CollisionAnswer;
using adapter::CollisionQuery;
using adapter::ContactPoint;
using adapter::Geometry;

/// Distance from a bounded shape's origin to its farthest point in x and y [m].
double planarExtent(const Geometry& geometry) {
    if (const auto* sphere = std::get_if<scenario::Sphere>(&geometry)) return sphere->radius;
    if (const auto* capsule = std::get_if<scenario::Capsule>(&geometry))
        return capsule->radius + capsule->halfLength;
    if (const auto* box = std::get_if<scenario::Box>(&geometry))
        return std::hypot(box->halfExtents.x, box->halfExtents.y);
    double most = 0.0;
    if (const auto* segment = std::get_if<scenario::Segment>(&geometry))
        most = std::max(std::hypot(segment->a.x, segment->a.y), std::hypot(segment->b.x, segment->b.y));
    if (const auto* chain = std::get_if<scenario::Chain>(&geometry))
        for (const Vec3& v : chain->vertices) most = std::max(most, std::hypot(v.x, v.y));
    if (const auto* hull = std::get_if<scenario::ConvexHull>(&geometry))
        for (const Vec3& v : hull->vertices) most = std::max(most, std::hypot(v.x, v.y));
    return most;
}

Geometry lifted(const Geometry& geometry, double halfDepth) {
    Geometry solid;
    try {
        solid = adapter::planarGeometry(geometry);
    } catch (const std::invalid_argument&) {
        throw adapter::notInAdapter("bullet",
                                    std::string("shape '") + scenario::geometryName(geometry, 2) + "' in 2D");
    }
    if (auto* box = std::get_if<scenario::Box>(&solid)) box->halfExtents.z = halfDepth;
    if (auto* hull = std::get_if<scenario::ConvexHull>(&solid))
        for (Vec3& v : hull->vertices) v.z = std::copysign(halfDepth, v.z);
    if (auto* strip = std::get_if<scenario::TriangleMesh>(&solid))
        for (Vec3& v : strip->vertices) v.z = std::copysign(halfDepth, v.z);
    return solid;
}

/// Shape settings of a world with these settings, except for half-spaces; without settings those of the
/// matched preset.
ShapeSettings shapeSettings(const adapter::Settings* given) {
    ShapeSettings settings;
    settings.polyhedralFeatures = given == nullptr || given->at("sat") == "on";
    const auto margin = [&](const char* key) {
        return given == nullptr ? 0.0 : adapter::numberSetting(*given, key);
    };
    settings.boxMargin = margin("box_margin");
    settings.cylinderMargin = margin("cylinder_margin");
    settings.hullMargin = margin("hull_margin");
    return settings;
}

/// One side of a query as a collision object.
struct Side {
    /// `halfDepth` of the prisms of a two-dimensional query; 0 for three dimensions.
    Side(const adapter::PosedShape& posed, double halfDepth, const ShapeSettings& settings) {
        BuiltShape built = buildGeometry(
            halfDepth > 0.0 ? lifted(*posed.geometry, halfDepth) : *posed.geometry, posed.pose, settings);
        shape = std::move(built.shape);
        surface = std::move(built.surface);
        object.setCollisionShape(shape.get());
        object.setWorldTransform(toBullet(posed.pose * built.offset));
    }
    bool isPlane() const { return shape->getShapeType() == STATIC_PLANE_PROXYTYPE; }
    const btConvexShape& convex() const { return static_cast<const btConvexShape&>(*shape); }

    std::unique_ptr<SurfaceData> surface;
    std::unique_ptr<btCollisionShape> shape;
    btCollisionObject object;
};

ContactPoint toContact(const btManifoldPoint& point, bool ordered) {
    const Vec3 on0 = fromBullet(point.getPositionWorldOnA());
    const Vec3 on1 = fromBullet(point.getPositionWorldOnB());
    ContactPoint contact;
    contact.bodyB = 1;
    contact.pointA = ordered ? on0 : on1;
    contact.pointB = ordered ? on1 : on0;
    contact.normal = (ordered ? -1.0 : 1.0) * fromBullet(point.m_normalWorldOnB);
    contact.depth = -static_cast<double>(point.getDistance());
    return contact;
}
void append(const btPersistentManifold& manifold, const btCollisionObject& objectA,
            std::vector<ContactPoint>& contacts) {
    const bool ordered = manifold.getBody0() == &objectA;
    for (int i = 0; i < manifold.getNumContacts(); ++i)
        contacts.push_back(toContact(manifold.getContactPoint(i), ordered));
}

/// Pairs with the algorithms that a world keeps for them; their manifolds are emptied before every query.
class BulletBatch final : public adapter::CollisionBatch {
  public:
    BulletBatch(std::span<const CollisionQuery> queries, const ShapeSettings& settings)
        : dispatcher_(&configuration_) {
        info_.m_enableSatConvex = settings.polyhedralFeatures;
        for (const CollisionQuery& query : queries)
            pairs_.push_back(std::make_unique<BatchPair>(query, settings, dispatcher_));
        for (const auto& pair : pairs_) {
            pair->runQuery(info_);  // makes the manifold
            pair->algorithm->getAllContactManifolds(pair->manifolds);
        }
    }
    std::size_t run() override {
        std::size_t contacts = 0;
        for (const auto& pair : pairs_) contacts += pair->runQuery(info_);
        return contacts;
    }
    std::vector<ContactPoint> contacts(std::size_t i) override {
        std::vector<ContactPoint> all;
        pairs_[i]->runQuery(info_);
        for (int k = 0; k < pairs_[i]->manifolds.size(); ++k)
            append(*pairs_[i]->manifolds[k], pairs_[i]->a.object, all);
        return all;
    }

  private:
    struct BatchPair {
        BatchPair(const CollisionQuery& query, const ShapeSettings& settings, btDispatcher& owner)
            : a(query.a, 0.0, settings),
              b(query.b, 0.0, settings),
              wrapA(nullptr, a.shape.get(), &a.object, a.object.getWorldTransform(), -1, -1),
              wrapB(nullptr, b.shape.get(), &b.object, b.object.getWorldTransform(), -1, -1),
              dispatcher(owner),
              algorithm(owner.findAlgorithm(&wrapA, &wrapB, nullptr, BT_CONTACT_POINT_ALGORITHMS)) {}
        ~BatchPair() {
            algorithm->~btCollisionAlgorithm();
            dispatcher.freeCollisionAlgorithm(algorithm);
        }
        std::size_t runQuery(const btDispatcherInfo& info) {
            for (int k = 0; k < manifolds.size(); ++k) manifolds[k]->clearManifold();
            btManifoldResult result(&wrapA, &wrapB);
            algorithm->processCollision(&wrapA, &wrapB, info, &result);
            int contacts = 0;
            for (int k = 0; k < manifolds.size(); ++k) contacts += manifolds[k]->getNumContacts();
            return contacts;
        }
        Side a, b;
        btCollisionObjectWrapper wrapA, wrapB;
        btDispatcher& dispatcher;
        btCollisionAlgorithm* algorithm;
        btManifoldArray manifolds;
    };
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDispatcherInfo info_;
    std::vector<std::unique_ptr<BatchPair>> pairs_;
};

/// Contacts of the stepping path: every manifold point, overlapping or not.
class ContactFinder {
  public:
    /// `wholeFaces`: a polyhedron on a plane, which gets one point per call, is also queried in slightly
    /// turned poses: with eight directions each corner of a square face is found at least once.
    explicit ContactFinder(bool wholeFaces) : configuration_(smallPools()), dispatcher_(&configuration_) {
        if (wholeFaces) configuration_.setPlaneConvexMultipointIterations(8, 5);
    }

    std::vector<ContactPoint> find(const Side& a, const Side& b, bool sat) {
        const btCollisionObjectWrapper wrapA(nullptr, a.shape.get(), &a.object, a.object.getWorldTransform(),
                                             -1, -1);
        const btCollisionObjectWrapper wrapB(nullptr, b.shape.get(), &b.object, b.object.getWorldTransform(),
                                             -1, -1);
        btCollisionAlgorithm* algorithm =
            dispatcher_.findAlgorithm(&wrapA, &wrapB, nullptr, BT_CONTACT_POINT_ALGORITHMS);
        btDispatcherInfo info;
        info.m_enableSatConvex = sat;
        btManifoldResult result(&wrapA, &wrapB);
        algorithm->processCollision(&wrapA, &wrapB, info, &result);
        btManifoldArray manifolds;
        algorithm->getAllContactManifolds(manifolds);
        std::vector<ContactPoint> contacts;
        for (int i = 0; i < manifolds.size(); ++i) append(*manifolds[i], a.object, contacts);
        algorithm->~btCollisionAlgorithm();
        dispatcher_.freeCollisionAlgorithm(algorithm);
        return contacts;
    }

    /// btCollisionWorld::contactPairTest, which requests closest points instead of contacts.
    std::vector<ContactPoint> findByPairTest(Side& a, Side& b) {
        btDbvtBroadphase broadphase;
        btCollisionWorld world(&dispatcher_, &broadphase, &configuration_);
        PairTestResult result(a.object);
        world.contactPairTest(&a.object, &b.object, result);
        return result.contacts;
    }

  private:
    struct PairTestResult final : btCollisionWorld::ContactResultCallback {
        explicit PairTestResult(const btCollisionObject& a) : objectA(a) {}
        btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
                                 const btCollisionObjectWrapper*, int, int) override {
            contacts.push_back(toContact(point, first->getCollisionObject() == &objectA));
            return 0;
        }
        const btCollisionObject& objectA;
        std::vector<ContactPoint> contacts;
    };

    /// One pair at a time: the library's pools of 4096 manifolds would cost more than the query.
    static btDefaultCollisionConstructionInfo smallPools() {
        btDefaultCollisionConstructionInfo info;
        info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = 4;
        return info;
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
};

struct Closest {
    double distance = 0.0;
    Vec3 onA, onB;
};

/// Closest points of two separated convex shapes.
std::optional<Closest> gjkDistance(const Side& a, const Side& b) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(&a.convex(), &b.convex(), &simplex, &depth);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = a.object.getWorldTransform();
    input.m_transformB = b.object.getWorldTransform();
    btPointCollector closest;
    detector.getClosestPoints(input, closest, nullptr);
    if (!closest.m_hasResult) return std::nullopt;
    const btVector3 onA = closest.m_pointInWorld + closest.m_normalOnBInWorld * closest.m_distance;
    return Closest{closest.m_distance, fromBullet(onA), fromBullet(closest.m_pointInWorld)};
}

/// Signed distance of a convex shape from a plane, by its support point.
Closest planeDistance(const Side& plane, const Side& convex, bool planeIsA) {
    const auto& shape = static_cast<const btStaticPlaneShape&>(*plane.shape);
    const btTransform& toWorld = plane.object.getWorldTransform();
    const btVector3 normal = toWorld.getBasis() * shape.getPlaneNormal();
    const btVector3 onPlane = toWorld * (shape.getPlaneNormal() * shape.getPlaneConstant());
    const btTransform& pose = convex.object.getWorldTransform();
    const btVector3 deepest =
        pose * convex.convex().localGetSupportingVertex(pose.getBasis().transpose() * -normal);
    const btScalar distance = normal.dot(deepest - onPlane);
    const Vec3 foot = fromBullet(deepest - normal * distance), tip = fromBullet(deepest);
    return {distance, planeIsA ? foot : tip, planeIsA ? tip : foot};
}

/// Closest points of two sides; empty for a surface, since GJK needs convex shapes.
std::optional<Closest> closestPoints(const Side& a, const Side& b) {
    if (a.surface || b.surface) return std::nullopt;
    if (a.isPlane()) return planeDistance(a, b, true);
    if (b.isPlane()) return planeDistance(b, a, false);
    return gjkDistance(a, b);
}

/// Drops what a prism says about z and the doubled ends of its edges; of a strip of triangles also what its
/// diagonals say, whose normals lean towards z.
std::vector<ContactPoint> projected(const std::vector<ContactPoint>& contacts, bool strip) {
    std::vector<ContactPoint> planar;
    for (ContactPoint c : contacts) {
        const double inPlane = std::hypot(c.normal.x, c.normal.y);
        if (inPlane < (strip ? 0.999 : 0.5)) continue;
        c.normal = Vec3{c.normal.x, c.normal.y, 0.0} / inPlane;
        c.pointA.z = c.pointB.z = 0.0;
        const bool known = std::any_of(planar.begin(), planar.end(), [&](const ContactPoint& other) {
            return norm(other.pointA - c.pointA) < 1e-6 && norm(other.pointB - c.pointB) < 1e-6;
        });
        if (!known) planar.push_back(c);
    }
    return planar;
}

}  // namespace

std::unique_ptr<adapter::CollisionBatch> BulletCollisionEngine::batch(
    std::span<const CollisionQuery> queries) const {
    if (queries.empty()) throw adapter::BadInput("a batch of no pairs");
    if (queries.front().dimension != 3)
        throw adapter::notInAdapter("bullet", "batches of two-dimensional shapes");
    for (const CollisionQuery& query : queries) adapter::checkQueryInput(query);
    return std::make_unique<BulletBatch>(queries, shapeSettings(queries.front().settings));
}

CollisionAnswer BulletCollisionEngine::collide(const CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    // Deeper than any overlap in 2D, so that the least penetration is never along z, and no longer than that:
    // EPA loses digits on slender prisms.
    const double halfDepth =
        query.dimension == 2 ? planarExtent(*query.a.geometry) + planarExtent(*query.b.geometry) : 0.0;
    const ShapeSettings settings = shapeSettings(query.settings);
    Side a(query.a, halfDepth, settings), b(query.b, halfDepth, settings);
    if (a.shape->isConcave() && b.shape->isConcave() && !(a.isPlane() && b.isPlane()))
        throw adapter::notInLibrary("bullet", "contact of two surfaces",
                                    "btDefaultCollisionConfiguration.h: concave shapes meet convex ones");
    if (a.isPlane() && b.isPlane())
        throw adapter::notInLibrary("bullet", "contact of half-space with half-space",
                                    "btDefaultCollisionConfiguration.h: concave shapes meet convex ones");
    ContactFinder finder(query.settings == nullptr);
    const bool pairTest =
        query.settings != nullptr && query.settings->at("query_path") == "contact_pair_test";
    std::vector<ContactPoint> contacts =
        pairTest ? finder.findByPairTest(a, b) : finder.find(a, b, settings.polyhedralFeatures);
    if (query.dimension == 2) contacts = projected(contacts, a.surface || b.surface);
    std::erase_if(contacts, [](const ContactPoint& c) { return c.depth < 0.0; });
    adapter::orderDeepestFirst(contacts);
    CollisionAnswer answer;
    answer.overlap = !contacts.empty();
    if (answer.overlap) {
        const ContactPoint& deepest = contacts.front();
        answer.signedDistance = -deepest.depth;
        answer.witnessA = deepest.pointA;
        answer.witnessB = deepest.pointB;
    } else if (auto closest = closestPoints(a, b)) {
        if (query.dimension == 2) closest->onA.z = closest->onB.z = 0.0;
        answer.signedDistance = closest->distance;
        answer.witnessA = closest->onA;
        answer.witnessB = closest->onB;
    }
    adapter::keepFirst(contacts, query.maxContacts);
    answer.contacts = std::move(contacts);
    return answer;
}

}  // namespace rigor::bullet
