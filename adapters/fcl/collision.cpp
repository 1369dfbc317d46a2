// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Two calls of the library per query. fcl::collide gives contacts: by closed forms, by SAT with clipping for
// boxes, by libccd's MPR for the rest. MPR's depths of hulls are off by more than 1% in one pair of twenty,
// so those are taken from the signed distance of libccd's EPA, exact to rounding for polytopes. Shapes that
// are apart have their distance from GJK.
#include "adapters/fcl/collision.hpp"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>

#include "adapters/fcl/separation.hpp"
#include "adapters/fcl/shapes.hpp"
#include "adapters/fcl/surface.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"

namespace rigor::fcl_adapter {
namespace {

using adapter::CollisionAnswer;
using adapter::CollisionQuery;
using adapter::ContactPoint;
using adapter::Geometry;
using adapter::PosedShape;
using adapter::Vec3;

/// More than any pair gives: with fewer, FCL drops contacts in no particular order.
constexpr std::size_t kMostContacts = 64;
constexpr double kSamePoint = 1e-9;  ///< corners of a prism's two edges agree to rounding [m]

template <class Kind>
bool is(const Geometry& geometry) {
    return std::holds_alternative<Kind>(geometry);
}

/// True if libccd's EPA may be called for an overlap: only for polytopes (two boxes have SAT with clipping),
/// and not for touching ones. About 40 of 2 million queries around the first touch, with a round shape,
/// failed an assertion in it, which ends the process; coaxial capsules and coinciding cylinders keep it busy
/// for ever.
bool mayCallEpa(const Geometry& a, const Geometry& b, double depth) {
    const bool boxes = is<scenario::Box>(a) && is<scenario::Box>(b);
    return isPolytope(a) && isPolytope(b) && !boxes && depth > kLeastDepth;
}

std::vector<ContactPoint> contactsOf(const fcl::CollisionResultd& result, const PosedShape& a,
                                     const PosedShape& b) {
    std::vector<ContactPoint> contacts;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
        const fcl::Contactd& found = result.getContact(i);
        ContactPoint contact;
        contact.bodyB = 1;
        contact.normal = fromFcl(found.normal);
        contact.depth = found.penetration_depth;
        // Coinciding centres come with a zero normal: an overlap without a contact.
        const double length = norm(contact.normal);
        if (!(std::abs(length - 1.0) < 1e-3) || !std::isfinite(contact.depth)) continue;
        contact.normal = contact.normal / length;
        const auto points = adapter::surfacePoints(a, b, fromFcl(found.pos), contact.normal, contact.depth);
        contact.pointA = points.onA;
        contact.pointB = points.onB;
        contacts.push_back(contact);
    }
    adapter::orderDeepestFirst(contacts);
    return contacts;
}

/// Largest depth, including contacts that had no direction. Negative if FCL's own solver reports it so.
double deepest(const fcl::CollisionResultd& result) {
    if (result.numContacts() == 0) return 0.0;
    double depth = result.getContact(0).penetration_depth;
    for (std::size_t i = 1; i < result.numContacts(); ++i)
        depth = std::max(depth, result.getContact(i).penetration_depth);
    return depth;
}

/// Adds the signed distance to a result of fcl::collide, and the contact of overlapping polytopes.
void answerDistance(const FclShape& a, const FclShape& b, bool unbounded, bool exactInside, double depth,
                    fcl::GJKSolverType solver, CollisionAnswer& answer) {
    std::optional<Separation> found;
    if (answer.overlap) {
        answer.signedDistance = -depth;
        if (!exactInside) return;
        found = separation(a, b, true);
        if (!found || found->distance >= 0.0 || !pointsAgree(*found)) return;
        answer.contacts.assign(1, contactOf(*found));
    } else {
        if (unbounded) return;
        found = separation(a, b, false, solver);
        if (!found) return;
        // GJK may find an overlap within its tolerance where fcl::collide saw none.
        found->distance = std::max(found->distance, 0.0);
    }
    answer.signedDistance = found->distance;
    if (pointsAgree(*found)) {
        answer.witnessA = found->onA;
        answer.witnessB = found->onB;
    }
}

/// The two edges of a prism are one corner of a polygon: one contact in the plane z = 0.
void bringIntoPlane(std::vector<ContactPoint>& contacts) {
    std::vector<ContactPoint> flat;
    for (ContactPoint c : contacts) {
        c.normal.z = c.pointA.z = c.pointB.z = 0.0;
        // the normal is out of the plane: deeper than the prisms are thick
        if (norm(c.normal) < 0.5) continue;
        c.normal = c.normal / norm(c.normal);
        const bool known = std::any_of(flat.begin(), flat.end(), [&](const ContactPoint& f) {
            return norm(f.pointA - c.pointA) < kSamePoint && norm(f.pointB - c.pointB) < kSamePoint;
        });
        if (!known) flat.push_back(c);
    }
    contacts.swap(flat);
}

/// Contacts and witnesses as the query wants them.
void finish(const CollisionQuery& query, CollisionAnswer& answer) {
    if (query.dimension == 2) {
        bringIntoPlane(answer.contacts);
        if (answer.witnessA) answer.witnessA->z = answer.witnessB->z = 0.0;
    }
    adapter::keepFirst(answer.contacts, query.maxContacts);
}

Geometry solidOf(const Geometry& geometry, int dimension) {
    if (dimension == 3) return geometry;
    return adapter::planarGeometry(geometry);
}

fcl::GJKSolverType solverOf(const std::string& algorithm) {
    const std::vector<std::string> known = FclCollisionEngine().algorithms();
    if (!algorithm.empty() && std::find(known.begin(), known.end(), algorithm) == known.end())
        throw adapter::BadInput("fcl: found narrow phase '" + algorithm +
                                "', expected one of indep, libccd, libccd_collide");
    return algorithm == "indep" ? fcl::GST_INDEP : fcl::GST_LIBCCD;
}

/// fcl::collide with contacts, alone: depths of hulls are libccd's own, without EPA.
class FclBatch final : public adapter::CollisionBatch {
  public:
    explicit FclBatch(std::span<const CollisionQuery> queries)
        : request_(std::max(1, queries.front().maxContacts), true) {
        request_.gjk_solver_type = solverOf(queries.front().algorithm);
        for (const CollisionQuery& query : queries) {
            sides_.push_back(toFcl(solidOf(*query.a.geometry, query.dimension), query.a.pose));
            sides_.push_back(toFcl(solidOf(*query.b.geometry, query.dimension), query.b.pose));
        }
    }
    std::size_t run() override {
        std::size_t contacts = 0;
        for (std::size_t i = 0; 2 * i < sides_.size(); ++i) contacts += runQuery(i);
        return contacts;
    }
    std::vector<ContactPoint> contacts(std::size_t i) override {
        runQuery(i);
        std::vector<ContactPoint> all;
        for (std::size_t k = 0; k < result_.numContacts(); ++k) {
            const fcl::Contactd& found = result_.getContact(k);
            ContactPoint contact;
            contact.bodyB = 1;
            contact.pointA = contact.pointB = fromFcl(found.pos);
            // FCL takes a mesh first.
            const bool ordered = found.o1 == sides_[2 * i].geometry.get();
            contact.normal = (ordered ? 1.0 : -1.0) * fromFcl(found.normal);
            contact.depth = found.penetration_depth;
            all.push_back(contact);
        }
        return all;
    }

  private:
    std::size_t runQuery(std::size_t i) {
        const FclShape &a = sides_[2 * i], &b = sides_[2 * i + 1];
        result_.clear();
        fcl::collide(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request_, result_);
        return result_.numContacts();
    }
    fcl::CollisionRequestd request_;
    fcl::CollisionResultd result_;
    std::vector<FclShape> sides_;
};

}  // namespace

std::unique_ptr<adapter::CollisionBatch> FclCollisionEngine::batch(
    std::span<const CollisionQuery> queries) const {
    if (queries.empty()) throw adapter::BadInput("a batch of no pairs");
    for (const CollisionQuery& query : queries) adapter::checkQueryInput(query);
    return std::make_unique<FclBatch>(queries);
}

CollisionAnswer FclCollisionEngine::collide(const CollisionQuery& query) const {
    adapter::checkQueryInput(query);
    const std::string algorithm = query.algorithm.empty() ? "libccd" : query.algorithm;
    const fcl::GJKSolverType solver = solverOf(algorithm);
    const Geometry solidA = solidOf(*query.a.geometry, query.dimension);
    const Geometry solidB = solidOf(*query.b.geometry, query.dimension);
    if (is<scenario::TriangleMesh>(solidA) || is<scenario::TriangleMesh>(solidB)) {
        CollisionAnswer answer = collideSurface({&solidA, query.a.pose}, {&solidB, query.b.pose},
                                                query.dimension == 2, algorithm == "libccd", solver);
        finish(query, answer);
        return answer;
    }
    const bool unboundedA = is<scenario::HalfSpace>(solidA), unboundedB = is<scenario::HalfSpace>(solidB);
    if (unboundedA && unboundedB) throw adapter::notInAdapter("fcl", "contact points of two half-spaces");
    const FclShape a = toFcl(solidA, query.a.pose), b = toFcl(solidB, query.b.pose);

    fcl::CollisionRequestd request(kMostContacts, true);
    request.gjk_solver_type = solver;
    fcl::CollisionResultd result;
    fcl::collide(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request, result);

    CollisionAnswer answer;
    answer.overlap = result.isCollision();
    answer.contacts = contactsOf(result, {&solidA, query.a.pose}, {&solidB, query.b.pose});
    const double depth = deepest(result);
    const bool exactInside = algorithm == "libccd" && mayCallEpa(solidA, solidB, depth);
    answerDistance(a, b, unboundedA || unboundedB, exactInside, depth, solver, answer);
    finish(query, answer);
    return answer;
}

}  // namespace rigor::fcl_adapter
