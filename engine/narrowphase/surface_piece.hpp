// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A convex shape on a piece (segment, triangle) of a surface, without the bumps of inner edges.
//
// Taken by itself a piece has edges that its surface has not: a box that slides over two triangles of one
// floor would meet the side of the second. With m the piece's normal on the side of the shape's middle:
//
//   1. Face first. Contact points along m: the shape's supporting feature clipped to the prism over it.
//      If the shape's lowest point, depth s, is over the piece and no side of the piece is nearer than |s|,
//      no other way out is shorter: for a way u at angle theta to m, the disc of radius |s| in the piece
//      around the foot gives the separation |s| (sin theta + cos theta) >= |s|.
//   2. Else the piece alone, with its normal n. It is kept where the surface near the touching vertex v lies
//      behind the plane of contact,  n . (w - v) <= 0  for the vertices w beside the piece's touching side,
//      or around its touching corner: only there n is a normal of the surface.
//   3. Else the contact along m, if any: what is left belongs to a neighbour.
//   4. If that leaves nothing, and the piece is in the way of a sphere around the shape's middle that the shape
//      contains, the contact with that sphere. A plate that stands in a gully has no corner over either side,
//      and its shortest way out is into the other side.
// Of a shape that is deep the supporting feature is one corner, which alone would turn the shape rather than
// lift it: its other low points over the piece join the contact along m. Nothing of that is taken that is
// beyond the piece's plane but not beyond the surface, as what reaches under the border of a table is; and
// where pieces near face different ways, those count alone whose face towards the middle is on the middle's
// side (surface_side.hpp): what stands behind a ridge does not push the shape into it.
// The condition of 2 is that of the normal cones of a polyhedron [Ericson2005, ch. 12.4 for the pieces' own
// Voronoi regions]; it holds on both sides of a two-sided surface. A field that is solid below has m up, and
// a shape with its middle under the surface is pushed along m.
//
// Cost: that of a contact with each piece near; step 1 alone for most of them. Pieces in one plane are put
// together in facet_contact.cpp. Private to this folder.
#pragma once

#include <algorithm>

#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"
#include "engine/narrowphase/surface_side.hpp"
#include "engine/shapes/inner_sphere.hpp"

namespace rigor::engine {

/// Sine of the angle up to which a normal counts as perpendicular to an edge: the root of the rounding, which
/// normals of closest points are good to.
template <class R>
inline constexpr R kPerpendicular = R(6e-8);
template <>
inline constexpr float kPerpendicular<float> = 1.4e-3f;

template <class R>
Vec2<R> pieceNormal(const Segment<Space<R, 2>>& s) {
    const Vec2<R> d = s.b - s.a;
    return Vec2<R>(-d.y(), d.x()).normalized();
}
template <class R>
Vec3<R> pieceNormal(const Triangle<Space<R, 3>>& t) {
    return (t.v[1] - t.v[0]).cross(t.v[2] - t.v[0]).normalized();
}

/// Distance of x, a point on the piece, from the piece's border; < 0 beside it.
template <class R>
R insideBy(const Segment<Space<R, 2>>& s, const Vec2<R>&, const Vec2<R>& x) {
    const Vec2<R> along = (s.b - s.a).normalized();
    return std::min(along.dot(x - s.a), along.dot(s.b - x));
}
template <class R>
R insideBy(const Triangle<Space<R, 3>>& t, const Vec3<R>& n, const Vec3<R>& x) {
    R least = std::numeric_limits<R>::max();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3<R> e = t.v[(i + 1) % 3] - t.v[i];
        least = std::min(least, R(n.cross(e).dot(x - t.v[i]) / e.norm()));
    }
    return least;
}

template <class S>
struct Placed {
    const Shape<S>& convex;
    Pose<S> X;  ///< pose in the frame of the surface
    /// Furthest coordinate along n.
    typename S::Real reach(const typename S::Vec& n) const {
        using R = typename S::Real;
        const typename S::Vec p = support<S>(convex, rotateInverse<R>(X.q, n));
        return n.dot(X.p) + n.dot(rotate(X.q, p));
    }
    /// The point there.
    typename S::Vec furthest(const typename S::Vec& n) const {
        return toWorld<S>(X, support<S>(convex, rotateInverse<typename S::Real>(X.q, n)));
    }
    typename S::Vec middle() const { return toWorld<S>(X, middleOf<S>(convex)); }
    /// True where the middle is behind the plane with the normal n through `on`. Whatever else decides about sides
    /// (surface_side.hpp, contacts/surface_sides.hpp) goes by the middle as well.
    bool isUnder(const typename S::Vec& n, const typename S::Vec& on) const {
        return n.dot(middle() - on) < 0;
    }
};

/// Step 1: is the contact along m the shortest penetration vector? `out` in the frame of the surface.
template <class S, class Piece>
bool faceIsShortest(const Piece& piece, const typename S::Vec& n, typename S::Real s,
                    const Manifold<S>& out) {
    using R = typename S::Real;
    if (out.count == 0) return false;
    typename S::Vec foot = S::Vec::Zero();
    R size = 0, used = 0;
    for (int i = 0; i < out.count; ++i) size = std::max(size, out.points[i].pointB.cwiseAbs().maxCoeff());
    // The lowest points, and those hardly higher: a flat contact's middle.
    const R bound = s + R(0.1) * std::abs(s) + kRounding<R> * size;
    for (int i = 0; i < out.count; ++i) {
        const ManifoldPoint<S>& p = out.points[i];
        if (p.separation <= bound) {
            foot += p.pointA;
            used += 1;
        }
    }
    return used > 0 && insideBy<R>(piece, n, foot / used) >= std::abs(s);
}

/// Step 2. `n` in the frame of the surface.
template <class S, class Data>
bool isSurfaceNormal(const Data& data, std::uint32_t piece, const typename S::Vec& n) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const auto corners = data.corners(piece);
    constexpr int kCorners = S::dim;
    const auto at = [&](int i) { return V(data.point(corners[i % kCorners])); };
    int top = 0;
    for (int i = 1; i < kCorners; ++i)
        if (at(i).dot(n) > at(top).dot(n)) top = i;
    const auto level = [&](const V& x) {  // true if x is as high as the top, by angle
        const V d = at(top) - x;
        return n.dot(d) <= kPerpendicular<R> * d.norm();
    };
    const auto behind = [&](std::uint32_t w) {
        if (w == kNullIndex) return true;
        const V d = data.point(w) - at(top);
        return n.dot(d) <= kPerpendicular<R> * d.norm();
    };
    int touching = 0, other = top;
    for (int i = 0; i < kCorners; ++i)
        if (i == top || level(at(i))) {
            touching += 1;
            other = i == top ? other : i;
        }
    if (touching == kCorners) return true;
    if (touching == 2) {
        const int side = (top + 1) % 3 == other ? top : other;  // the side from corner `side` to the next
        return behind(data.across(piece, side));
    }
    bool all = true;
    data.ring(corners[top], [&](std::uint32_t w) { all = all && behind(w); });
    return all;
}

/// A shape that overlaps a piece by more than this share of what it has on either side of its middle is deep.
template <class R>
inline constexpr R kDeep = R(0.1);

/// Adds the other low points of a deep shape to its contact along m: the support points half-way between -m
/// and each of its axes.
template <class S, class Data, class Piece>
void addLowPoints(const Data& data, const Piece& piece, const Placed<S>& placed, typename S::Real s,
                  const typename S::Vec& n, Manifold<S>& along) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V m = along.normal, corner = centerOf<R>(piece), middle = placed.middle();
    const auto beyond = [&](const V& x) {
        return Data::kSolidBelow || passed<S>(data, middle, V(x - middle)) > 0;
    };
    if (along.count > 0 && !beyond(along.points[0].pointB)) along.count = 0;
    for (std::uint32_t k = 0; k < 2 * S::dim && along.count < S::maxManifoldPoints; ++k) {
        const V axis = rotate(placed.X.q, V(V::Unit(k / 2)));
        const V x = placed.furthest(V((k % 2 == 0 ? axis : V(-axis)) - m));
        const R depth = -m.dot(x - corner);
        if (depth <= 0 || insideBy<R>(piece, n, V(x + depth * m)) < 0) continue;
        bool known = false;
        for (int i = 0; i < along.count; ++i)
            known = known || (along.points[i].pointB - x).norm() < R(0.1) * std::abs(s);
        if (!known && beyond(x)) addPoint<S>(along, x + depth * m, x, -depth, crossingFeature(k, 0));
    }
}

/// Kind of contact that a piece by itself has with a shape.
enum class PieceContact : std::uint8_t {
    None,
    Along,     ///< along the piece's normal
    OwnNormal  ///< along another normal of the surface: at a border, a ridge or a corner
};

/// Cosine of the angle up to which a normal is the piece's own: a milliradian.
template <class R>
inline constexpr R kOwnNormal = R(1) - R(1e-6);

/// Steps 1 to 3; 4 is left to the caller. `collide`: a narrow phase.
template <class S, class Collide, class Data>
PieceContact collideWith(Collide collide, const Data& data, std::uint32_t index, bool ridge,
                         const Pose<S>& Xs, const Shape<S>& convex, const Pose<S>& Xc,
                         typename S::Real speculative, Manifold<S>& out) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const auto piece = data.piece(index);
    const Placed<S> placed{convex, relativePose<S>(Xs, Xc)};
    const V n = pieceNormal<R>(piece), corner = data.point(data.corners(index)[0]);
    const R top = placed.reach(n) - n.dot(corner), bottom = -placed.reach(-n) - n.dot(corner);
    const bool under = placed.isUnder(n, corner);
    const bool front = Data::kSolidBelow || !under;
    const R s = front ? bottom : -top;
    if (s > speculative) return PieceContact::None;
    if (ridge && !facesItsSide<S>(data, index, placed.middle())) return PieceContact::None;
    Manifold<S> along;
    along.memory = out.memory;
    collideAlong<R>(piece, front, convex, placed.X, speculative, along);
    if (s < -kDeep<R> * R(0.5) * (top - bottom)) {
        along.normal = front ? n : V(-n);
        addLowPoints<S>(data, piece, placed, s, n, along);
    }
    if (faceIsShortest<S>(piece, n, s, along) || (Data::kSolidBelow && under)) {
        out = along;
        toWorldFrame<S>(out, Xs);
        remember(out);
        return PieceContact::Along;
    }
    collide(Shape<S>(piece), Xs, convex, Xc, speculative, out);
    if (out.count == 0) return PieceContact::None;
    const V found = rotateInverse<R>(Xs.q, out.normal);
    const R up = front ? found.dot(n) : -found.dot(n);
    if (up >= -kPerpendicular<R> && isSurfaceNormal<S>(data, index, found))
        return up > kOwnNormal<R> ? PieceContact::Along : PieceContact::OwnNormal;
    out = along;
    toWorldFrame<S>(out, Xs);
    remember(out);
    return PieceContact::Along;
}

/// Step 4. `out` in the frame of the surface. Returns how deep it is, 0: no contact.
template <class S, class Data>
typename S::Real collideMiddle(const Data& data, std::uint32_t index, const Placed<S>& placed,
                               Manifold<S>& out) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V middle = placed.middle(), on = nearestOn<R>(data.piece(index), middle);
    const R radius = inscribedRadiusOf<S>(placed.convex), distance = (middle - on).norm();
    if (!(distance > 0 && distance < (1 - kDeep<R>)*radius)) return 0;
    if (Data::kSolidBelow && placed.isUnder(pieceNormal<R>(data.piece(index)), on)) return 0;
    const V n = (middle - on) / distance;
    if (!isSurfaceNormal<S>(data, index, n)) return 0;
    out.count = 0;
    out.normal = n;
    addPoint<S>(out, on, middle - radius * n, distance - radius, crossingFeature(index, 0));
    return radius - distance;
}

/// True where a side (end) of the piece that is no inner side of its facet is in reach of the box.
template <class S, class Data>
bool isBorderNear(const Data& data, std::uint32_t index, const Aabb<S>& box) {
    const auto corners = data.corners(index);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (data.facets.innerSides(index) >> k & 1u) continue;
        const typename S::Vec a = data.point(corners[k]),
                              b = S::dim == 2 ? a : data.point(corners[(k + 1) % corners.size()]);
        if (box.overlaps(Aabb<S>{a.cwiseMin(b), a.cwiseMax(b)})) return true;
    }
    return false;
}

}  // namespace rigor::engine
