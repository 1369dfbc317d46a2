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
#include <algorithm>
#include <limits>

#include "validation/oracle/core.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace oracle;

/// Below this, relative to the size, cores count as touching: long double leaves 1e-19.
constexpr Real kTouching = 1e-16L;

Real supportAlong(const Core& c, Vec n) {
    Real best = -std::numeric_limits<Real>::max();
    for (const Vec& v : c.vertices) best = std::max(best, dot(n, v));
    return best;
}
Real separation(const Core& a, const Core& b, Vec n) {
    return -supportAlong(b, -1 * n) - supportAlong(a, n);
}

Vec edgeVector(const Core& c, const std::array<int, 2>& e) {
    return c.vertices[static_cast<std::size_t>(e[1])] - c.vertices[static_cast<std::size_t>(e[0])];
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

struct Pair {
    Real distance = std::numeric_limits<Real>::max();
    Vec onA, onB;
    void consider(Vec a, Vec b) {
        if (const Real d = norm(b - a); d < distance) *this = {d, a, b};
    }
};

/// Nearest point to x of the segment from p along d.
Vec nearestOnSegment(Vec x, Vec p, Vec d) {
    const Real dd = dot(d, d);
    return dd > 0 ? p + std::clamp(dot(x - p, d) / dd, 0.0L, 1.0L) * d : p;
}

/// All cases of two segments: the four ends against the other segment, and the two lines' common
/// perpendicular where its feet are inside both.
void segments(Vec p, Vec d, Vec q, Vec e, Pair& best) {
    for (const Vec& x : {p, p + d}) best.consider(x, nearestOnSegment(x, q, e));
    for (const Vec& y : {q, q + e}) best.consider(nearestOnSegment(y, p, d), y);
    const Vec n = cross(d, e);
    const Real nn = dot(n, n);
    if (nn <= 0) return;
    const Real s = dot(cross(q - p, e), n) / nn, t = dot(cross(q - p, d), n) / nn;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best.consider(p + s * d, q + t * e);
}

/// Foot of x on the plane of a face, if inside the face: on the inner side of all its edges.
bool footInFace(const Core& c, const Face& f, Vec x, Vec& foot) {
    Vec middle;
    for (int v : f.vertices)
        middle =
            middle + (1.0L / static_cast<Real>(f.vertices.size())) * c.vertices[static_cast<std::size_t>(v)];
    foot = x - dot(f.normal, x - middle) * f.normal;
    for (const auto& e : f.edges) {
        const Vec p = c.vertices[static_cast<std::size_t>(e[0])];
        const Vec across = cross(f.normal, edgeVector(c, e));
        if (dot(across, foot - p) * dot(across, middle - p) < 0) return false;
    }
    return true;
}

Pair closestFeatures(const Core& a, const Core& b, Vec shiftB = {}) {
    Pair best;
    for (const auto& ea : a.edges)
        for (const auto& eb : b.edges)
            segments(a.vertices[static_cast<std::size_t>(ea[0])], edgeVector(a, ea),
                     b.vertices[static_cast<std::size_t>(eb[0])] + shiftB, edgeVector(b, eb), best);
    Vec foot;
    for (const Face& f : a.faces)
        for (const Vec& v : b.vertices)
            if (footInFace(a, f, v + shiftB, foot)) best.consider(foot, v + shiftB);
    for (const Face& f : b.faces)
        for (const Vec& v : a.vertices)
            if (footInFace(b, f, v - shiftB, foot)) best.consider(v, foot + shiftB);
    return best;
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
    for (const Vec& n : one) both.push_back(n), both.push_back(-1 * n);
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
        // The best candidate first, and a point that both surfaces share once B is moved out along it.
        for (const Vec& n : candidates)
            if (separation(a, b, n) > separation(a, b, contact.normal)) contact.normal = n;
        const Vec out = -best * contact.normal;
        const Pair touching = closestFeatures(a, b, out);
        contact.onA = touching.onA;
        contact.onB = touching.onB - out;
    }
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

/// Core over a half-space; `coreIsA` tells the direction of the normal.
OracleAnswer planeContact(const Core& c, const Plane& plane, bool coreIsA, scenario::Vec3 origin) {
    const Real low = -supportAlong(c, -1 * plane.normal);
    Vec deepest;
    Real count = 0;
    for (const Vec& v : c.vertices)
        if (dot(plane.normal, v) <= low + 1e-12L * c.size) deepest = deepest + v, count += 1;
    const Real sd = low - plane.offset - c.radius;
    const Vec onCore = (1 / count) * deepest - c.radius * plane.normal;
    const Vec onPlane = onCore - sd * plane.normal;
    const Vec shift = widen(origin);
    OracleAnswer answer;
    answer.signedDistance = static_cast<double>(sd);
    answer.normals = {narrow((coreIsA ? -1 : 1) * plane.normal)};
    answer.witnessA = narrow((coreIsA ? onCore : onPlane) + shift);
    answer.witnessB = narrow((coreIsA ? onPlane : onCore) + shift);
    return answer;
}

}  // namespace

std::optional<OracleAnswer> exactContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                         const scenario::Geometry& b, const scenario::Pose& poseB,
                                         int dimension, double tie) {
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
