// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance of two solids with round sides. With K = A + (-B), the Minkowski sum,
//
//   sd(A, B) = max over unit n of f(n) = -h_K(n) = -h_A(n) - h_B(-n)        [CameronCulley1986]
//
// holds apart and overlapping. h_K is smooth inside the regions of the sphere of directions that belong to
// one feature (point or disc) of each solid, so that its least value is at one of these:
//   face or cap of either              that direction
//   circle of A and circle of B        their two intersections           (edge-edge, edge-side, side-side)
//   circle of one, point of the other  q . n on the circle               (closed form)
//   circle of one, disc of the other   q . n + r |n x u| on the circle   (roots of its derivative)
//   point and point, point and disc    q . n + r |n x u| on the sphere   (closed form)
//   disc and disc                      q . n + r |n x u| + s |n x v| on the sphere: stationary where the
//   point
//                                      of K that n supports lies along n, one equation in the place on one
//                                      rim
// All of them are evaluated by f itself, which bounds the distance from below for whatever direction; the
// witness points, which have to touch when B is moved by -sd n, bound it from above where the solids are
// apart, and show the direction to be stationary where they overlap. Cost: about a millisecond.
#include <algorithm>

#include "validation/oracle/directions.hpp"
#include "validation/oracle/roots.hpp"
#include "validation/oracle/solid.hpp"

namespace rigor::validation::oracle {
namespace {

/// Tolerance for points of the supporting face, relative to the size.
constexpr Real kOnFace = 1e-12L;

Vec without(Vec v, Vec axis) {
    return v - dot(v, axis) * axis;
}

/// Unit vector of the part of v across the axis; any, where that part is rounding.
Vec unitAcross(Vec v, Vec axis) {
    const Vec rest = without(v, axis);
    if (norm(rest) <= 1e-18L * norm(v)) return anyNormalTo(axis);
    return unit(without(unit(rest), axis));  // once more: a short rest is not across to all digits
}

class Directions {
  public:
    Directions(const Solid& a, const Solid& minusB) {
        for (const Solid* s : {&a, &minusB})
            for (const Vec& n : s->faceNormals) both(n);
        for (const auto& c : a.circles)
            for (const auto& d : minusB.circles) circles(c, d);
        mixed(a, minusB);
        mixed(minusB, a);
        for (const Vec& p : a.points)
            for (const Vec& q : minusB.points) both(p + q);
    }
    const std::vector<Vec>& all() const { return all_; }

  private:
    void mixed(const Solid& s, const Solid& t) {
        for (const auto& c : s.circles) {
            for (const Vec& p : t.points) circlePoint(c, p);
            for (const Disc& d : t.discs) circleDisc(c, d);
        }
        for (const Disc& d : s.discs) {
            for (const Vec& p : t.points) discPoint(d, p);
            for (const Disc& e : t.discs) discs(d, e);
        }
    }

    void both(Vec v) {
        if (const Real length = norm(v); length > 0) {
            all_.push_back((1 / length) * v);
            all_.push_back((-1 / length) * v);
        }
    }

    void circles(const DirectionCircle& c, const DirectionCircle& d) {
        const Vec line = cross(c.axis, d.axis);
        const Real ll = dot(line, line), cosine = dot(c.axis, d.axis);
        if (ll <= 1e-30L) return;  // parallel: the same circle or none in common
        const Vec base =
            ((c.height - d.height * cosine) / ll) * c.axis + ((d.height - c.height * cosine) / ll) * d.axis;
        const Real left = 1 - dot(base, base);
        if (left < 0) return;
        for (const Real sign : {-1.0L, 1.0L}) all_.push_back(unit(base + sign * std::sqrt(left / ll) * line));
    }

    struct Basis {
        Vec x, y;
        Real radius;
        explicit Basis(const DirectionCircle& c)
            : x(anyNormalTo(c.axis)), y(cross(c.axis, x)), radius(std::sqrt(1 - c.height * c.height)) {}
    };

    void circlePoint(const DirectionCircle& c, Vec point) {
        const Vec e = unitAcross(c.anchor + point, c.axis);
        const Real radius = std::sqrt(1 - c.height * c.height);
        for (const Real sign : {-1.0L, 1.0L}) all_.push_back(unit(c.height * c.axis + sign * radius * e));
    }

    void circleDisc(const DirectionCircle& c, const Disc& d) {
        const Vec q = c.anchor + d.center;
        const Basis basis(c);
        const auto direction = [&](Real angle) {
            return c.height * c.axis + basis.radius * (std::cos(angle) * basis.x + std::sin(angle) * basis.y);
        };
        const auto slope = [&](Real angle) {
            const Vec n = direction(angle);
            const Vec along = std::cos(angle) * basis.y - std::sin(angle) * basis.x;
            const Real sine = norm(cross(n, d.axis));
            const Real turn = sine > 0 ? dot(n, d.axis) * dot(d.axis, along) / sine : 0;
            return dot(q, along) - d.radius * turn;
        };
        forRoots(slope, [&](Real angle) { all_.push_back(unit(direction(angle))); });
    }

    /// Rim point nearest to and farthest from the line through the point along the disc's axis.
    void discPoint(const Disc& d, Vec point) {
        const Vec q = d.center + point, e = unitAcross(q, d.axis);
        both(q + d.radius * e);
        both(q - d.radius * e);
    }

    /// x = q + e's rim point is along the direction it is supported by: in the plane of the axis of e and x,
    /// which gives the place on e's rim for one on d's, and in that of the axis of d.
    void discs(const Disc& d, const Disc& e) {
        const Vec across = anyNormalTo(d.axis), other = cross(d.axis, across);
        for (const Real side : {-1.0L, 1.0L}) {
            const auto spoke = [&](Real angle) { return std::cos(angle) * across + std::sin(angle) * other; };
            const auto sum = [&](Real angle) {
                const Vec q = d.center + d.radius * spoke(angle) + e.center;
                return q + side * e.radius * unitAcross(q, e.axis);
            };
            const auto turn = [&](Real angle) { return dot(cross(d.axis, spoke(angle)), sum(angle)); };
            forRoots(turn, [&](Real angle) { both(sum(angle)); });
        }
    }

    std::vector<Vec> all_;
};

Vec turned(Vec v, Vec axis, Real angle) {
    const Real c = std::cos(angle), s = std::sin(angle);
    return c * v + s * cross(axis, v) + (1 - c) * dot(axis, v) * axis;
}

bool isKnown(const std::vector<Vec>& list, Vec n) {
    return std::any_of(list.begin(), list.end(), [&](Vec k) { return norm(k - n) < 1e-9L; });
}

/// Directions as good as the first: a ring of them where the solids look the same from all around an axis.
void addRings(const Solid& a, const Solid& minusB, Real least, SolidContact& contact) {
    const Vec best = contact.normals.front();
    const auto good = [&](Vec n) { return -supportOf(a, n) - supportOf(minusB, n) >= least; };
    for (const Solid* s : {&a, &minusB})
        for (const DirectionCircle& c : s->circles) {
            if (norm(cross(c.axis, best)) < 1e-6L) continue;
            constexpr Real kTurn = 0.05L;
            const bool ring = good(turned(best, c.axis, kTurn)) || good(turned(best, c.axis, -kTurn));
            if (!ring) continue;
            contact.continuum = true;
            for (int i = 1; i < 16 && contact.normals.size() < kMostNormals; ++i) {
                const Vec n = turned(best, c.axis, static_cast<Real>(i) * std::numbers::pi_v<Real> / 8);
                if (good(n) && !isKnown(contact.normals, n)) contact.normals.push_back(n);
            }
        }
}

// ------------------------------------------------------------------------------------------ witness points

/// Supporting set of a solid along a direction: a disc, otherwise that of the core.
struct Patch {
    std::optional<Disc> disc;
    std::optional<Disc> rim;  ///< one of the points is on the rim of it
    std::vector<Vec> points;
};

Patch patchAlong(const Solid& s, Vec n) {
    const Real level = supportOf(s, n) - s.radius - kOnFace * s.size;
    Patch patch;
    for (const Vec& p : s.points)
        if (dot(p, n) >= level) patch.points.push_back(p);
    for (const Disc& d : s.discs) {
        const Real reach = d.radius * norm(cross(n, d.axis));
        if (dot(d.center, n) + reach < level) continue;
        if (2 * reach <= kOnFace * s.size)
            patch.disc = d;
        else {
            patch.rim = d;
            patch.points.push_back(d.center + d.radius * unitAcross(n, d.axis));
        }
    }
    return patch;
}

/// The supporting face of a polyhedron, or the point or edge that `points` are.
Core coreOf(const std::vector<Vec>& points, const Core* whole) {
    Core core;
    core.vertices = points;
    if (points.size() == 1) core.edges = {{0, 0}};
    if (points.size() == 2) core.edges = {{0, 1}};
    if (points.size() <= 2 || !whole) return core;
    core.vertices = whole->vertices;
    for (const Face& f : whole->faces) {
        const auto has = [&](Vec p) {
            return std::any_of(f.vertices.begin(), f.vertices.end(),
                               [&](int i) { return norm(whole->vertices[i] - p) == 0; });
        };
        if (!std::all_of(points.begin(), points.end(), has)) continue;
        core.faces = {f};
        core.edges = f.edges;
        return core;
    }
    return *whole;
}

/// A point of the disc as near as may be to y.
Vec nearestOnDisc(const Disc& d, Vec y) {
    const Vec out = without(y - d.center, d.axis);
    const Real length = norm(out);
    return d.center + (length > d.radius ? d.radius / length : 1) * out;
}

/// Points of the two cores that coincide once B is moved by `shift`.
Pair meetingPoints(const Patch& a, const Core* coreA, const Patch& b, const Core* coreB, Vec shift) {
    Pair pair;
    if (a.disc && b.disc) {
        const Vec onB = nearestOnDisc(*b.disc, a.disc->center - shift);
        pair.consider(nearestOnDisc(*a.disc, onB + shift), onB + shift);
    } else if (a.disc) {
        const Pair near = closestFeatures(coreOf({a.disc->center}, nullptr), coreOf(b.points, coreB), shift);
        pair.consider(nearestOnDisc(*a.disc, near.onB), near.onB);
    } else if (b.disc) {
        const Pair near = closestFeatures(coreOf(a.points, coreA), coreOf({b.disc->center}, nullptr), shift);
        pair.consider(near.onA, nearestOnDisc(*b.disc, near.onA - shift) + shift);
    } else {
        pair = closestFeatures(coreOf(a.points, coreA), coreOf(b.points, coreB), shift);
    }
    // The place on the rim of a cap that is nearly flat against n is uncertain by rounding over the tilt; the
    // cap itself is not.
    if (b.rim) pair.consider(pair.onA, nearestOnDisc(*b.rim, pair.onA - shift) + shift);
    if (a.rim) pair.consider(nearestOnDisc(*a.rim, pair.onB), pair.onB);
    pair.onB = pair.onB - shift;
    return pair;
}

}  // namespace

Vec supportPoint(const Solid& solid, Vec n) {
    const Patch patch = patchAlong(solid, n);
    if (patch.disc) return patch.disc->center + solid.radius * n;
    Vec sum;
    for (const Vec& p : patch.points) sum = sum + p;
    return (1 / static_cast<Real>(patch.points.size())) * sum + solid.radius * n;
}

SolidContact solidContact(const Solid& a, const Core* coreA, const Solid& b, const Core* coreB, Real tie) {
    const Solid minusB = mirrored(b);
    std::vector<std::pair<Real, Vec>> found;
    const Directions directions(a, minusB);
    for (const Vec& n : directions.all()) found.emplace_back(-supportOf(a, n) - supportOf(minusB, n), n);
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& x, const auto& y) { return x.first > y.first; });

    SolidContact contact;
    contact.distance = found.front().first;
    const Real least = contact.distance - tie * std::max(a.size, b.size);
    for (const auto& [value, n] : found) {
        if (value < least || contact.normals.size() >= kMostNormals) break;
        if (!isKnown(contact.normals, n)) contact.normals.push_back(n);
    }
    addRings(a, minusB, least, contact);

    const Vec n = contact.normals.front();
    const Vec shift = -(contact.distance + a.radius + b.radius) * n;
    const Pair pair = meetingPoints(patchAlong(a, n), coreA, patchAlong(b, -1 * n), coreB, shift);
    contact.onA = pair.onA + a.radius * n;
    contact.onB = pair.onB - b.radius * n;
    contact.residual = norm(contact.onB - contact.onA - contact.distance * n);
    return contact;
}

}  // namespace rigor::validation::oracle
