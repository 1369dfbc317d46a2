// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// fcl::collide finds the triangles in touch. Its contacts with them are poor (README.md), so depth, normal and points are
// those of fcl::distance of each triangle:
// - Spheres and capsules are their centre or axis, of which a triangle is at a distance less than the radius. Axes that cross
//   a triangle are measured as boxes are.
// - Boxes and hulls overlap a triangle as much as the less deep of two prisms, of which the triangle is one face: the
//   direction in which they get free of it leads away from one of the two. EPA fails an assertion at flat triangles.
// Cylinders, cones and ellipsoids keep the contacts of fcl::collide.
#include "adapters/fcl/surface.hpp"

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/fcl/separation.hpp"
#include "adapters/fcl/shapes.hpp"
#include "adapters/interface/deepest_first.hpp"
#include "adapters/interface/planar.hpp"
#include "adapters/interface/surface_points.hpp"
#include "scenarios/model/surfaces.hpp"

namespace rigor::fcl_adapter {
namespace {

using adapter::CollisionAnswer;
using adapter::ContactPoint;
using adapter::Geometry;
using adapter::Pose;
using adapter::PosedShape;
using adapter::Vec3;
using Corners = std::vector<Vec3>;

/// Distance [m] below which a centre or an axis lies on a triangle: then it has no direction.
constexpr double kOnTriangle = 1e-9;

/// Overlaps [m] of prisms below which EPA is not called: 1e-6 m deep in a polygon its assertion failed in two of three runs of
/// 200 000 poses. Of so shallow ones fcl::collide has the depth.
constexpr double kLeastPrismDepth = 1e-4;

/// The convex shape of some points around their middle.
FclShape convexOf(const Corners& points, const std::vector<int>& faces, int count, const Pose& pose) {
    Vec3 middle;
    for (const Vec3& p : points) middle += p / points.size();
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3& p : points) vertices->push_back(toFcl(p - middle));
    return {std::make_shared<fcl::Convexd>(vertices, count, std::make_shared<std::vector<int>>(faces)),
            transformOf(pose * Pose{middle, {}})};
}

/// A triangle, or the rectangle of a strip, in the frame of its mesh.
class Piece {
  public:
    Piece(Corners corners, const Pose& pose) : corners_(std::move(corners)), pose_(pose) {
        const Vec3 across = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
        normal_ = across / norm(across);
        for (const Vec3& c : corners_) size_ = std::max(size_, norm(c - corners_[0]));
    }
    FclShape flat() const {
        std::vector<int> face{static_cast<int>(corners_.size())};
        for (std::size_t i = 0; i < corners_.size(); ++i) face.push_back(static_cast<int>(i));
        return convexOf(corners_, face, 1, pose_);
    }
    /// The prism whose face towards `side` (1 or -1) times the normal is the piece.
    FclShape prism(double side) const {
        Corners points = corners_;
        if (side < 0.0) std::reverse(points.begin(), points.end());
        const int count = static_cast<int>(points.size());
        for (int i = 0; i < count; ++i) points.push_back(points[i] - side * size_ * normal_);
        std::vector<int> faces{count};
        for (int i = 0; i < count; ++i) faces.push_back(i);
        faces.push_back(count);
        for (int i = 0; i < count; ++i) faces.push_back(2 * count - 1 - i);
        for (int i = 0; i < count; ++i) {
            const int next = (i + 1) % count;
            faces.insert(faces.end(), {4, i, count + i, count + next, next});
        }
        return convexOf(points, faces, count + 2, pose_);
    }

  private:
    Corners corners_;
    Pose pose_;
    Vec3 normal_;
    double size_ = 0.0;  ///< [m]
};

/// The pieces of a mesh: its triangles, or the rectangles that two of them make.
class Pieces {
  public:
    /// `halfDepth` of the rectangles [m], so that the way out of none leads out of the plane; 0 for triangles.
    Pieces(const scenario::TriangleMesh& mesh, const Pose& pose, double halfDepth)
        : mesh_(mesh), pose_(pose), halfDepth_(halfDepth) {}
    int pieceOf(int triangle) const { return areStrips() ? triangle / 2 : triangle; }
    Piece piece(int index) const {
        const auto& v = mesh_.vertices;
        const auto& first = mesh_.triangles[areStrips() ? 2 * index : index];
        if (!areStrips()) return {{v[first[0]], v[first[1]], v[first[2]]}, pose_};
        Corners corners{v[first[0]], v[first[1]], v[mesh_.triangles[2 * index + 1][2]], v[first[2]]};
        for (Vec3& c : corners) c.z = std::copysign(halfDepth_, c.z);
        return {std::move(corners), pose_};
    }

  private:
    bool areStrips() const { return halfDepth_ > 0.0; }
    const scenario::TriangleMesh& mesh_;
    const Pose& pose_;
    double halfDepth_;
};

/// The centre of a sphere or the axis of a capsule.
struct Core {
    FclShape shape;
    double radius = 0.0;  ///< [m]
};
std::optional<Core> coreOf(const PosedShape& posed) {
    if (const auto* s = std::get_if<scenario::Sphere>(posed.geometry))
        return Core{convexOf({{0, 0, 0}}, {}, 0, posed.pose), s->radius};
    if (const auto* c = std::get_if<scenario::Capsule>(posed.geometry))
        return Core{convexOf({{0, -c->halfLength, 0}, {0, c->halfLength, 0}}, {}, 0, posed.pose), c->radius};
    return std::nullopt;
}

/// Distance and points of the rounded shape from those of its core.
std::optional<Separation> rounded(std::optional<Separation> found, double radius) {
    if (!found || found->distance <= kOnTriangle || !pointsAgree(*found)) return std::nullopt;
    found->onB += radius / found->distance * (found->onA - found->onB);
    found->distance -= radius;
    return found;
}

/// True where fcl::collide finds more than a touch, as EPA needs.
bool overlapDeeply(const FclShape& a, const FclShape& b) {
    const fcl::CollisionRequestd request(1, true);
    fcl::CollisionResultd result;
    fcl::collide(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request, result);
    return result.isCollision() && result.getContact(0).penetration_depth > kLeastPrismDepth;
}

/// `other` is a box, a hull, or an axis, grown by `radius` [m].
std::optional<ContactPoint> contactWithPolytope(const Piece& piece, const FclShape& other, double radius) {
    std::optional<Separation> least;
    for (const double side : {1.0, -1.0}) {
        const FclShape prism = piece.prism(side);
        if (!overlapDeeply(prism, other)) return std::nullopt;
        const auto found = separation(prism, other, true);
        if (!found || found->distance >= 0.0 || !pointsAgree(*found)) return std::nullopt;
        if (!least || found->distance > least->distance) least = found;
    }
    ContactPoint contact = contactOf(*least);
    contact.depth += radius;
    contact.pointB -= radius * contact.normal;
    return contact;
}

std::optional<ContactPoint> contactWithCore(const Piece& piece, const Core& core) {
    const auto apart = separation(piece.flat(), core.shape, false);
    if (apart && apart->distance <= kOnTriangle) return contactWithPolytope(piece, core.shape, core.radius);
    const auto found = rounded(apart, core.radius);
    if (!found || found->distance > 0.0) return std::nullopt;
    ContactPoint contact;
    contact.bodyB = 1;
    contact.depth = -found->distance;
    contact.normal = (apart->onB - apart->onA) / apart->distance;
    contact.pointA = found->onA;
    contact.pointB = found->onB;
    return contact;
}

/// The contact that fcl::collide reports of one triangle. Its depths of spheres have the other sign.
std::optional<ContactPoint> contactAsFound(const fcl::Contactd& found, const PosedShape& surface,
                                           const PosedShape& other, bool positive) {
    ContactPoint contact;
    contact.bodyB = 1;
    contact.normal = fromFcl(found.normal);
    contact.depth = positive ? std::abs(found.penetration_depth) : found.penetration_depth;
    const double length = norm(contact.normal);
    if (!(std::abs(length - 1.0) < 1e-3) || !std::isfinite(contact.depth)) return std::nullopt;
    contact.normal = contact.normal / length;
    const auto points =
        adapter::surfacePoints(surface, other, fromFcl(found.pos), contact.normal, contact.depth);
    contact.pointA = points.onA;
    contact.pointB = points.onB;
    return contact;
}

/// The surface is A.
std::vector<ContactPoint> contactsOf(const fcl::CollisionResultd& result, const PosedShape& surface,
                                     const PosedShape& other, const FclShape& otherShape, bool strips,
                                     bool exact) {
    otherShape.geometry->computeLocalAABB();
    const double halfDepth =
        strips ? 2.0 * otherShape.geometry->aabb_radius + adapter::kPlanarHalfDepth : 0.0;
    const Pieces pieces(std::get<scenario::TriangleMesh>(*surface.geometry), surface.pose, halfDepth);
    const auto core = exact ? coreOf(other) : std::nullopt;
    std::vector<ContactPoint> contacts;
    std::set<int> seen;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
        const fcl::Contactd& found = result.getContact(i);
        const int index = pieces.pieceOf(static_cast<int>(found.b1));
        if (exact && !seen.insert(index).second) continue;
        std::optional<ContactPoint> contact;
        if (core)
            contact = contactWithCore(pieces.piece(index), *core);
        else if (exact && isPolytope(*other.geometry))
            contact = contactWithPolytope(pieces.piece(index), otherShape, 0.0);
        if (!contact) contact = contactAsFound(found, surface, other, exact);
        if (contact) contacts.push_back(*contact);
    }
    adapter::orderDeepestFirst(contacts);
    return contacts;
}

CollisionAnswer collideOrdered(const PosedShape& surface, const PosedShape& other, bool strips, bool exact,
                               fcl::GJKSolverType solver) {
    const FclShape mesh = toFcl(*surface.geometry, surface.pose), shape = toFcl(*other.geometry, other.pose);
    const auto& triangles = std::get<scenario::TriangleMesh>(*surface.geometry).triangles;
    fcl::CollisionRequestd request(triangles.size(), true);
    request.gjk_solver_type = solver;
    fcl::CollisionResultd result;
    fcl::collide(mesh.geometry.get(), mesh.pose, shape.geometry.get(), shape.pose, request, result);

    CollisionAnswer answer;
    answer.overlap = result.isCollision();
    answer.contacts = contactsOf(result, surface, other, shape, strips, exact);
    if (answer.overlap) {
        answer.signedDistance = answer.contacts.empty() ? 0.0 : -answer.contacts.front().depth;
        return answer;
    }
    const auto core = exact ? coreOf(other) : std::nullopt;
    const auto found = core ? rounded(separation(mesh, core->shape, false), core->radius)
                            : separation(mesh, shape, false, solver);
    if (!found) return answer;
    answer.signedDistance = std::max(found->distance, 0.0);
    if (pointsAgree(*found)) {
        answer.witnessA = found->onA;
        answer.witnessB = found->onB;
    }
    return answer;
}

}  // namespace

CollisionAnswer collideSurface(const PosedShape& a, const PosedShape& b, bool strips, bool exact,
                               fcl::GJKSolverType solver) {
    if (scenario::isStaticOnly(*a.geometry) && scenario::isStaticOnly(*b.geometry))
        throw adapter::notInAdapter("fcl", "contact points of two shapes that cannot move");
    if (std::holds_alternative<scenario::TriangleMesh>(*a.geometry))
        return collideOrdered(a, b, strips, exact, solver);
    CollisionAnswer answer = collideOrdered(b, a, strips, exact, solver);
    for (ContactPoint& c : answer.contacts) {
        std::swap(c.pointA, c.pointB);
        c.normal = -c.normal;
    }
    std::swap(answer.witnessA, answer.witnessB);
    return answer;
}

}  // namespace rigor::fcl_adapter
