// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance of two convex cores, less their rounding radii.
//
//   sd(A, B) = max over unit n of  min_{b in B} n.b - max_{a in A} n.a      (Cameron and Culley, ICRA 1986)
//
// Cores apart: the least distance over all pairs of features; the normal joins the closest points.
// Cores overlapping: the maximum is at a facet normal of the Minkowski difference B - A. Every facet is
// parallel to a face of A, a face of B, or an edge of A and one of B (in 2D: to an edge of either), so all of
// these, with both signs, are tried; further directions can not exceed the maximum and do no harm.
// A difference that is flat (two balls, two capsules, a ball in a segment) has no inside: touching cores are
// at distance 0, and every direction orthogonal to the difference is a minimising normal.
// Cylinders and cones: solid_contact.cpp. Ellipsoids: ellipsoid_contact.cpp.
#include <algorithm>
#include <limits>

#include "validation/oracle/ellipsoid_contact.hpp"
#include "validation/oracle/oracle.hpp"
#include "validation/oracle/solid.hpp"

namespace rigor::validation {
namespace {

using namespace oracle;

/// Distance relative to the size below which cores count as touching: long double leaves 1e-19.
constexpr Real kTouching = 1e-16L;

Real supportAlong(const Core& c, Vec n) {
    Real best = -std::numeric_limits<Real>::max();
    for (const Vec& v : c.vertices) best = std::max(best, dot(n, v));
    return best;
}
Real separation(const Core& a, const Core& b, Vec n) {
    return -supportAlong(b, -1 * n) - supportAlong(a, n);
}

void addDirection(Vec n, Real scale, std::vector<Vec>& directions) {
    const Real length = norm(n);
    // 1e-12: the vectors come from coordinates with 16 digits; a thinner cross product is rounding only.
    if (length <= 1e-12L * scale) return;
    directions.push_back((1 / length) * n);
    directions.push_back((-1 / length) * n);
}

std::vector<Vec> candidateDirections(const Core& a, const Core& b, int dimension) {
    std::vector<Vec> directions;
    for (const Core* c : {&a, &b})
        for (const Face& f : c->faces) addDirection(f.normal, 1, directions);
    if (dimension == 2) {
        for (const Core* c : {&a, &b})
            for (const auto& e : c->edges)
                addDirection(cross({0, 0, 1}, edgeVector(*c, e)), c->size, directions);
        return directions;
    }
    for (const auto& ea : a.edges)
        for (const auto& eb : b.edges) {
            const Vec u = edgeVector(a, ea), v = edgeVector(b, eb);
            addDirection(cross(u, v), norm(u) * norm(v), directions);
        }
    return directions;
}

/// Orthonormal basis of the directions the Minkowski difference extends in (Gram-Schmidt with pivoting).
std::vector<Vec> spanOf(const Core& a, const Core& b) {
    std::vector<Vec> vectors, basis;
    for (const Core* c : {&a, &b})
        for (const Vec& v : c->vertices) vectors.push_back(v - c->vertices.front());
    const Real size = std::max(a.size, b.size);
    while (basis.size() < 3) {
        const auto longest = std::max_element(vectors.begin(), vectors.end(),
                                              [](Vec u, Vec v) { return dot(u, u) < dot(v, v); });
        if (norm(*longest) <= 1e-12L * size) break;
        const Vec unit = (1 / norm(*longest)) * *longest;
        basis.push_back(unit);
        for (Vec& v : vectors) v = v - dot(v, unit) * unit;
    }
    return basis;
}

Vec anyOrthogonal(Vec u) {
    const Vec axis =
        std::abs(u.x) < 0.6L ? Vec{1, 0, 0} : (std::abs(u.y) < 0.6L ? Vec{0, 1, 0} : Vec{0, 0, 1});
    const Vec n = cross(u, axis);
    return (1 / norm(n)) * n;
}

/// Directions orthogonal to a flat difference: all of them (rank one short), or samples of them.
std::vector<Vec> orthogonalDirections(const std::vector<Vec>& span, int dimension, bool& continuum) {
    std::vector<Vec> one;
    const int missing = dimension - static_cast<int>(span.size());
    continuum = missing > 1;
    if (dimension == 2)
        one = span.empty() ? std::vector<Vec>{{1, 0, 0}, {0, 1, 0}}
                           : std::vector<Vec>{cross({0, 0, 1}, span[0])};
    else if (span.empty())
        one = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    else if (span.size() == 1)
        one = {anyOrthogonal(span[0]), cross(span[0], anyOrthogonal(span[0]))};
    else
        one = {cross(span[0], span[1])};
    std::vector<Vec> both;
    for (const Vec& n : one) {
        both.push_back(n);
        both.push_back(-1 * n);
    }
    return both;
}

void addNormal(Vec n, std::vector<scenario::Vec3>& normals) {
    const scenario::Vec3 v = narrow(n);
    // Facets found from several edge pairs give one normal to many digits.
    for (const scenario::Vec3& known : normals)
        if (scenario::norm(known - v) < 1e-9) return;
    normals.push_back(v);
}

struct CoreContact {
    Real distance = 0;
    std::vector<scenario::Vec3> normals;
    bool continuum = false;
    Vec onA, onB, normal;
};

CoreContact coreContact(const Core& a, const Core& b, int dimension, Real tie) {
    CoreContact contact;
    std::vector<Vec> candidates = candidateDirections(a, b, dimension);
    const std::vector<Vec> span = spanOf(a, b);
    const bool flat = static_cast<int>(span.size()) < dimension;
    const Real size = std::max(a.size, b.size);
    Real best = -std::numeric_limits<Real>::max();
    for (const Vec& n : candidates) best = std::max(best, separation(a, b, n));

    if (flat || best > 0) {
        const Pair closest = closestFeatures(a, b);
        contact.distance = best = closest.distance;
        contact.onA = closest.onA;
        contact.onB = closest.onB;
        if (best > kTouching * size) {
            contact.normal = (1 / best) * (closest.onB - closest.onA);
            addNormal(contact.normal, contact.normals);
        } else if (flat) {
            candidates = orthogonalDirections(span, dimension, contact.continuum);
        }
    } else {
        contact.distance = best;
    }
    for (const Vec& n : candidates) {
        if (separation(a, b, n) < best - tie * size) continue;
        if (contact.normals.empty()) contact.normal = n;
        addNormal(n, contact.normals);
    }
    if (best < 0) {
        // The best candidate first, and a common point of both surfaces once B is moved out along it.
        for (const Vec& n : candidates)
            if (separation(a, b, n) > separation(a, b, contact.normal)) contact.normal = n;
        const Vec out = -best * contact.normal;
        const Pair touching = closestFeatures(a, b, out);
        contact.onA = touching.onA;
        contact.onB = touching.onB - out;
    }
    // The normal of a tie that the points belong to comes first.
    const scenario::Vec3 first = narrow(contact.normal);
    const auto nearer = [&](const scenario::Vec3& m, const scenario::Vec3& n) {
        return scenario::norm(m - first) < scenario::norm(n - first);
    };
    if (const auto at = std::min_element(contact.normals.begin(), contact.normals.end(), nearer);
        at != contact.normals.end())
        std::iter_swap(contact.normals.begin(), at);
    return contact;
}

/// Normal and offset of a half-space in the world, relative to `origin`.
struct Plane {
    Vec normal;
    Real offset;
};
std::optional<Plane> makePlane(const scenario::Geometry& g, const scenario::Pose& pose,
                               scenario::Vec3 origin) {
    const auto* h = std::get_if<scenario::HalfSpace>(&g);
    if (!h) return std::nullopt;
    const Vec n = rotate(pose.orientation, widen(h->normal));
    const Vec unit = (1 / norm(n)) * n;
    return Plane{unit, h->offset + dot(unit, widen(pose.position) - widen(origin))};
}

OracleAnswer planeAnswer(Real sd, Vec onShape, const Plane& plane, bool shapeIsA, scenario::Vec3 origin) {
    const Vec onPlane = onShape - sd * plane.normal, shift = widen(origin);
    OracleAnswer answer;
    answer.signedDistance = static_cast<double>(sd);
    answer.normals = {narrow((shapeIsA ? -1 : 1) * plane.normal)};
    answer.witnessA = narrow((shapeIsA ? onShape : onPlane) + shift);
    answer.witnessB = narrow((shapeIsA ? onPlane : onShape) + shift);
    return answer;
}

/// Core over a half-space; `coreIsA` decides the direction of the normal.
OracleAnswer planeContact(const Core& c, const Plane& plane, bool coreIsA, scenario::Vec3 origin) {
    const Real low = -supportAlong(c, -1 * plane.normal);
    Vec deepest;
    Real count = 0;
    for (const Vec& v : c.vertices)
        if (dot(plane.normal, v) <= low + 1e-12L * c.size) {
            deepest = deepest + v;
            count += 1;
        }
    return planeAnswer(low - plane.offset - c.radius, (1 / count) * deepest - c.radius * plane.normal, plane,
                       coreIsA, origin);
}
OracleAnswer planeContact(const Solid& s, const Plane& plane, bool solidIsA, scenario::Vec3 origin) {
    const Vec down = -1 * plane.normal;
    return planeAnswer(-supportOf(s, down) - plane.offset, supportPoint(s, down), plane, solidIsA, origin);
}

/// Pairs with a cylinder or a cone.
std::optional<OracleAnswer> roundContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                         const scenario::Geometry& b, const scenario::Pose& poseB,
                                         double tie) {
    const scenario::Vec3 origin = poseA.position;
    const std::optional<Solid> solidA = makeSolid(a, poseA, origin), solidB = makeSolid(b, poseB, origin);
    if (solidA)
        if (const std::optional<Plane> plane = makePlane(b, poseB, origin))
            return planeContact(*solidA, *plane, true, origin);
    if (solidB)
        if (const std::optional<Plane> plane = makePlane(a, poseA, origin))
            return planeContact(*solidB, *plane, false, origin);
    if (!solidA || !solidB) return std::nullopt;
    const std::optional<Core> coreA = makeCore(a, poseA, 3, origin), coreB = makeCore(b, poseB, 3, origin);
    const SolidContact c =
        solidContact(*solidA, coreA ? &*coreA : nullptr, *solidB, coreB ? &*coreB : nullptr, tie);
    const Vec shift = widen(origin);
    OracleAnswer answer;
    answer.signedDistance = static_cast<double>(c.distance);
    for (const Vec& n : c.normals) answer.normals.push_back(narrow(n));
    answer.continuum = c.continuum;
    answer.witnessA = narrow(c.onA + shift);
    answer.witnessB = narrow(c.onB + shift);
    return answer;
}

bool isEllipsoid(const scenario::Geometry& g) {
    return std::holds_alternative<scenario::Ellipsoid>(g);
}

bool isRound(const scenario::Geometry& g) {
    return std::holds_alternative<scenario::Cylinder>(g) || std::holds_alternative<scenario::Cone>(g);
}

}  // namespace

std::optional<OracleAnswer> exactContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                         const scenario::Geometry& b, const scenario::Pose& poseB,
                                         int dimension, double tie) {
    if (isEllipsoid(a) || isEllipsoid(b))
        return dimension == 3 ? ellipsoidContact(a, poseA, b, poseB, tie) : std::nullopt;
    if (isRound(a) || isRound(b))
        return dimension == 3 ? roundContact(a, poseA, b, poseB, tie) : std::nullopt;
    const scenario::Vec3 origin = poseA.position;
    const std::optional<Core> coreA = makeCore(a, poseA, dimension, origin);
    const std::optional<Core> coreB = makeCore(b, poseB, dimension, origin);
    if (coreA)
        if (const std::optional<Plane> plane = makePlane(b, poseB, origin))
            return planeContact(*coreA, *plane, true, origin);
    if (coreB)
        if (const std::optional<Plane> plane = makePlane(a, poseA, origin))
            return planeContact(*coreB, *plane, false, origin);
    if (!coreA || !coreB) return std::nullopt;

    const CoreContact c = coreContact(*coreA, *coreB, dimension, tie);
    const Vec shift = widen(origin);
    OracleAnswer answer;
    answer.signedDistance = static_cast<double>(c.distance - coreA->radius - coreB->radius);
    answer.normals = c.normals;
    answer.continuum = c.continuum;
    answer.witnessA = narrow(c.onA + coreA->radius * c.normal + shift);
    answer.witnessB = narrow(c.onB - coreB->radius * c.normal + shift);
    return answer;
}

std::optional<double> separationAlong(const scenario::Geometry& a, const scenario::Pose& poseA,
                                      const scenario::Geometry& b, const scenario::Pose& poseB, int dimension,
                                      scenario::Vec3 direction) {
    const scenario::Vec3 origin = poseA.position;
    const Vec raw = widen(direction), n = (1 / norm(raw)) * raw;
    Real gap = 0;  // min over B of n.x, less the max over A
    const auto reach = [&](const scenario::Geometry& g, const scenario::Pose& pose,
                           Vec d) -> std::optional<Real> {
        if (const std::optional<Core> c = makeCore(g, pose, dimension, origin, false))
            return supportAlong(*c, d) + c->radius;
        if (const auto* e = std::get_if<scenario::Ellipsoid>(&g); e != nullptr && dimension == 3)
            return ellipsoidReach(*e, pose, origin, d);
        if (dimension == 3 && isRound(g)) return supportOf(*makeSolid(g, pose, origin), d);
        if (const std::optional<Plane> p = makePlane(g, pose, origin)) {
            // Bounded along its own normal alone; 1e-8 rad of rounding in a reported normal is no other
            // direction.
            if (dot(p->normal, d) > 1 - 1e-16L) return p->offset;
            return std::numeric_limits<Real>::infinity();
        }
        return std::nullopt;
    };
    const std::optional<Real> reachA = reach(a, poseA, n), reachB = reach(b, poseB, -1 * n);
    if (!reachA || !reachB) return std::nullopt;
    gap = -*reachB - *reachA;
    return static_cast<double>(gap);
}

}  // namespace rigor::validation
