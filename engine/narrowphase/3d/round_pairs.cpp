// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Closed forms of cylinder and cone (axis local y) against sphere and half-space, and of a sphere against a
// triangle.
//
//   sphere: in the half-plane (rho, y) through the axis and the sphere's centre the solid is a convex
//     polygon, the rectangle 0..r x -h..h or the triangle (0, h), (r, -h), (0, -h); its nearest point, or
//     for a centre inside the least penetration, is the contact.
//   half-space: the extreme points along -n are on the rims (and the apex). Each rim's lowest point is
//     r u, u = -n_xz / |n_xz|. A rim that lies nearly flat on the plane gets four points: fixed in the body,
//     the nearest of them moved to the lowest point once that is lower by more than rounding. A standing
//     cylinder so keeps its four points from step to step, and a tilted one rolls on its lowest point.
#include "engine/math/portable.hpp"
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/3d/feature.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// The point of the profile nearest to (rho, y), out of the solid: unit normal and signed distance.
template <class R>
struct Nearest {
    Vec2<R> point, normal;
    R distance;
};

template <class R>
Nearest<R> nearestOnProfile(const Cylinder<Space<R, 3>>& s, const Vec2<R>& c) {
    const Vec2<R> p(std::min(c.x(), s.radius), std::clamp(c.y(), -s.halfLength, s.halfLength));
    const R distance = (c - p).norm();
    if (distance > kRounding<R> * std::max(s.radius, s.halfLength)) return {p, (c - p) / distance, distance};
    const R side = c.x() - s.radius, cap = std::abs(c.y()) - s.halfLength;
    if (side > cap) return {{s.radius, c.y()}, {1, 0}, side};
    const R up = c.y() < 0 ? R(-1) : R(1);
    return {{c.x(), up * s.halfLength}, {0, up}, cap};
}

template <class R>
Nearest<R> nearestOnProfile(const Cone<Space<R, 3>>& s, const Vec2<R>& c) {
    const Vec2<R> apex(0, s.halfLength), rim(s.radius, -s.halfLength), e = apex - rim;
    const Vec2<R> sideNormal = Vec2<R>(e.y(), -e.x()).normalized();
    const R side = sideNormal.dot(c - rim), base = -s.halfLength - c.y();
    if (side <= 0 && base <= 0) {
        if (side > base) return {c - side * sideNormal, sideNormal, side};
        return {{c.x(), -s.halfLength}, {0, -1}, base};
    }
    const Vec2<R> onBase(std::min(c.x(), s.radius), -s.halfLength);
    const R t = e.dot(c - rim) / e.squaredNorm();
    const Vec2<R> onSide = rim + std::clamp(t, R(0), R(1)) * e;
    const bool below = (c - onBase).squaredNorm() < (c - onSide).squaredNorm();
    // The normal over a face is the face's own: exact however near the centre is.
    if (below && c.x() <= s.radius) return {onBase, {0, -1}, base};
    if (!below && t >= 0 && t <= 1) return {onSide, sideNormal, side};
    const Vec2<R> p = below ? onBase : onSide;
    const R distance = (c - p).norm();
    if (distance > kRounding<R> * std::max(s.radius, s.halfLength)) return {p, (c - p) / distance, distance};
    return {p, sideNormal, side};
}

template <class R, class Round>
void ballAgainst(const Sphere<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Round& b,
                 const Pose<Space<R, 3>>& Xb, R speculative, Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const V c = rotateInverse<R>(Xb.q, Xa.p - Xb.p);
    const R rho = portable::hypot(c.x(), c.z());
    const V radial = rho > 0 ? V(c.x() / rho, 0, c.z() / rho) : V(V::UnitX());
    const Nearest<R> nearest = nearestOnProfile<R>(b, {rho, c.y()});
    const R separation = nearest.distance - a.radius;
    if (separation > speculative) return;
    const V n = nearest.normal.x() * radial + nearest.normal.y() * V::UnitY();
    out.normal = -n;
    addPoint<S>(out, c - a.radius * n, nearest.point.x() * radial + nearest.point.y() * V::UnitY(),
                separation, 0);
    toWorldFrame<S>(out, Xb);
}

/// Points of a shape over a plane, in the frame of the shape.
template <class R>
struct Candidates {
    std::array<Vec3<R>, 5> at;
    std::array<std::uint32_t, 5> id;
    int count = 0;
    void add(const Vec3<R>& x, std::uint32_t name) {
        at[count] = x;
        id[count++] = name;
    }
};

/// The rim at height y, facing along `outward` = +-1: its lowest point, or four where it lies flat. `down`:
/// into the plane, unit.
template <class R>
void addRim(R radius, R y, R outward, const Vec3<R>& down, std::uint32_t firstId, Candidates<R>& out) {
    using V = Vec3<R>;
    const R tilt = portable::hypot(down.x(), down.z());
    const V lowest = tilt > 0 ? V(radius * down.x() / tilt, y, radius * down.z() / tilt) : V(radius, y, 0);
    if (outward * down.y() < kFlat<R>) {
        out.add(lowest, firstId);
        return;
    }
    const std::array<V, 4> fixed{V(radius, y, 0), V(0, y, radius), V(-radius, y, 0), V(0, y, -radius)};
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < 4; ++i)
        if (fixed[i].dot(down) > fixed[nearest].dot(down)) nearest = i;
    const bool moved =
        lowest.dot(down) > fixed[nearest].dot(down) + std::max(kRimNoise<R>, kRounding<R>) * radius;
    for (std::size_t i = 0; i < 4; ++i)
        out.add(moved && i == nearest ? lowest : fixed[i], firstId + static_cast<std::uint32_t>(i));
}

template <class R>
Candidates<R> lowPoints(const Cylinder<Space<R, 3>>& s, const Vec3<R>& down) {
    Candidates<R> c;
    // A cap that lies flat has the other far away.
    if (down.y() < kFlat<R>) addRim<R>(s.radius, -s.halfLength, R(-1), down, 0, c);
    if (down.y() > -kFlat<R>) addRim<R>(s.radius, s.halfLength, R(1), down, 4, c);
    return c;
}
template <class R>
Candidates<R> lowPoints(const Cone<Space<R, 3>>& s, const Vec3<R>& down) {
    Candidates<R> c;
    addRim<R>(s.radius, -s.halfLength, R(-1), down, 0, c);
    c.add({0, s.halfLength, 0}, 4);
    return c;
}

template <class R, class Round>
void roundAgainstPlane(const Round& a, const Pose<Space<R, 3>>& Xa, const HalfSpace<Space<R, 3>>& b,
                       const Pose<Space<R, 3>>& Xb, R speculative, Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const V n = rotate(Xb.q, b.normal), local = rotateInverse<R>(Xa.q, n);
    const R height = n.dot(Xa.p - Xb.p) - b.offset;
    const Candidates<R> all = lowPoints<R>(a, -local);
    Candidates<R> near;
    for (std::size_t i = 0; i < static_cast<std::size_t>(all.count); ++i)
        if (height + local.dot(all.at[i]) <= speculative) near.add(all.at[i], all.id[i]);
    if (near.count == 0) return;
    out.normal = -n;
    const auto separation = [&](int i) { return R(height + local.dot(near.at[i])); };
    const auto emit = [&](int i) {
        const V x = toWorld<S>(Xa, near.at[i]);
        const R s = separation(i);
        addPoint<S>(out, x, x - s * n, s, vertexFeature(true, static_cast<int>(near.id[i])));
    };
    const auto name = [&](int i) { return vertexFeature(true, static_cast<int>(near.id[i])); };
    reducePoints<S>(
        near.count, local, std::max(a.radius, a.halfLength), out.memory, separation,
        [&](int i) { return near.at[i]; }, name, emit);
}

/// Point of a triangle nearest to x: over the face its foot, else the nearest point of the sides.
template <class R>
Vec3<R> nearestOnTriangle(const Triangle<Space<R, 3>>& t, const Vec3<R>& n, const Vec3<R>& x,
                          bool& overFace) {
    overFace = true;
    Vec3<R> best = Vec3<R>::Zero();
    R least = std::numeric_limits<R>::max();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3<R>& v = t.v[i];
        const Vec3<R> e = t.v[(i + 1) % 3] - v;
        overFace = overFace && n.cross(e).dot(x - v) >= 0;
        const Vec3<R> p = v + std::clamp(e.dot(x - v) / e.squaredNorm(), R(0), R(1)) * e;
        if (const R d = (x - p).squaredNorm(); d < least) {
            least = d;
            best = p;
        }
    }
    return overFace ? Vec3<R>(x - n.dot(x - t.v[0]) * n) : best;
}

}  // namespace

/// The normal over the face is the face's own: exact however thin the gap, and the same on either side.
template <class R>
void collidePair(const Sphere<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Triangle<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    const Vec3<R> c = rotateInverse<R>(Xb.q, Xa.p - Xb.p);
    const Vec3<R> n = (b.v[1] - b.v[0]).cross(b.v[2] - b.v[0]).normalized();
    bool overFace = false;
    const Vec3<R> p = nearestOnTriangle<R>(b, n, c, overFace);
    const R height = n.dot(c - b.v[0]);
    const Vec3<R> up = height < 0 ? Vec3<R>(-n) : n;
    if (overFace) {
        if (std::abs(height) - a.radius > speculative) return;
        out.normal = -up;
        addPoint<S>(out, c - a.radius * up, p, std::abs(height) - a.radius, 0);
    } else {
        roundedPoint<S>(c, a.radius, p, R(0), Vec3<R>(-up), speculative, 0, out);
    }
    toWorldFrame<S>(out, Xb);
}
template void collidePair<float>(const Sphere<Space3f>&, const Pose<Space3f>&, const Triangle<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Sphere<Space3d>&, const Pose<Space3d>&, const Triangle<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

#define PAIR(Round)                                                                                          \
    template <class R>                                                                                       \
    void collidePair(const Sphere<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Round<Space<R, 3>>& b, \
                     const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,                    \
                     Manifold<Space<R, 3>>& out) {                                                           \
        ballAgainst<R>(a, Xa, b, Xb, speculative, out);                                                      \
    }                                                                                                        \
    template <class R>                                                                                       \
    void collidePair(const Round<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa,                               \
                     const HalfSpace<Space<R, 3>>& b, const Pose<Space<R, 3>>& Xb,                           \
                     typename Space<R, 3>::Real speculative, Manifold<Space<R, 3>>& out) {                   \
        roundAgainstPlane<R>(a, Xa, b, Xb, speculative, out);                                                \
    }                                                                                                        \
    template void collidePair<float>(const Sphere<Space3f>&, const Pose<Space3f>&, const Round<Space3f>&,    \
                                     const Pose<Space3f>&, float, Manifold<Space3f>&);                       \
    template void collidePair<double>(const Sphere<Space3d>&, const Pose<Space3d>&, const Round<Space3d>&,   \
                                      const Pose<Space3d>&, double, Manifold<Space3d>&);                     \
    template void collidePair<float>(const Round<Space3f>&, const Pose<Space3f>&, const HalfSpace<Space3f>&, \
                                     const Pose<Space3f>&, float, Manifold<Space3f>&);                       \
    template void collidePair<double>(const Round<Space3d>&, const Pose<Space3d>&,                           \
                                      const HalfSpace<Space3d>&, const Pose<Space3d>&, double,               \
                                      Manifold<Space3d>&);
PAIR(Cylinder)
PAIR(Cone)
#undef PAIR

}  // namespace rigor::engine
