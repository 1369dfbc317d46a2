// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Finds the side of a piece of a surface that belongs to a point beside the surface, by a ray from the point:
// the ray changes the side of the sheet with every other piece that it passes. A piece behind a ridge faces
// the other way: nothing may be pushed out through its face towards the point. The winding of the pieces does
// not matter. Private to this folder.
#pragma once

#include <algorithm>

#include "engine/core/ids.hpp"
#include "engine/narrowphase/detail.hpp"
#include "engine/shapes/surface.hpp"

namespace rigor::engine {

/// True where o + t d, 0 < t < 1, passes the piece. Of a side that two pieces share both say the same.
template <class R>
bool passes(const Segment<Space<R, 2>>& s, const Vec2<R>& o, const Vec2<R>& d) {
    const Vec2<R> a = s.a - o, b = s.b - o;
    const auto cross = [](const Vec2<R>& v, const Vec2<R>& w) { return v.x() * w.y() - v.y() * w.x(); };
    if ((cross(d, a) < 0) == (cross(d, b) < 0)) return false;
    const Vec2<R> e = b - a;
    const R height = cross(e, a);
    return (height > 0) != (height - cross(e, d) > 0);
}
template <class R>
bool passes(const Triangle<Space<R, 3>>& s, const Vec3<R>& o, const Vec3<R>& d) {
    const Vec3<R> a = s.v[0] - o, b = s.v[1] - o, c = s.v[2] - o;
    const bool u = d.dot(a.cross(b)) < 0, v = d.dot(b.cross(c)) < 0, w = d.dot(c.cross(a)) < 0;
    if (u != v || v != w) return false;
    const Vec3<R> n = (b - a).cross(c - a);
    const R height = n.dot(a);
    return (height > 0) != (height - n.dot(d) > 0);
}

/// Pieces that the way from `o` to o + d passes, beside `but`.
template <class S, class Data>
int passed(const Data& data, const typename S::Vec& o, const typename S::Vec& d,
           std::uint32_t but = kNullIndex) {
    int count = 0;
    const typename S::Real limit = 1;
    data.ray(o, d, limit, [&](std::uint32_t piece) {
        if (piece != but && passes<typename S::Real>(data.piece(piece), o, d)) ++count;
    });
    return count;
}

template <class R>
Vec2<R> nearestOn(const Segment<Space<R, 2>>& s, const Vec2<R>& x) {
    const Vec2<R> e = s.b - s.a;
    return s.a + std::clamp(e.dot(x - s.a) / e.squaredNorm(), R(0), R(1)) * e;
}
/// [Ericson2005, ch. 5.1.5].
template <class R>
Vec3<R> nearestOn(const Triangle<Space<R, 3>>& s, const Vec3<R>& x) {
    const Vec3<R> n = (s.v[1] - s.v[0]).cross(s.v[2] - s.v[0]);
    Vec3<R> best = x - (n.dot(x - s.v[0]) / n.squaredNorm()) * n;
    R least = std::numeric_limits<R>::max();
    bool over = true;
    const Vec3<R> foot = best;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3<R>&a = s.v[i], e = s.v[(i + 1) % 3] - a;
        if (n.cross(e).dot(foot - a) >= 0) continue;
        over = false;
        const Vec3<R> on = a + std::clamp(e.dot(x - a) / e.squaredNorm(), R(0), R(1)) * e;
        if (const R far = (x - on).squaredNorm(); far < least) {
            best = on;
            least = far;
        }
    }
    return over ? foot : best;
}

template <class R>
Vec2<R> centerOf(const Segment<Space<R, 2>>& s) {
    return R(0.5) * (s.a + s.b);
}
template <class R>
Vec3<R> centerOf(const Triangle<Space<R, 3>>& s) {
    return (s.v[0] + s.v[1] + s.v[2]) / R(3);
}

/// True where the face of the piece that looks towards x is on x's side of the surface.
template <class S, class Data>
bool facesItsSide(const Data& data, std::uint32_t index, const typename S::Vec& x) {
    using R = typename S::Real;
    const auto piece = data.piece(index);
    // The point is not quite at the border of the piece, which its neighbours share.
    const typename S::Vec on = nearestOn<R>(piece, x);
    const typename S::Vec there = on + R(0.01) * (centerOf<R>(piece) - on);
    return passed<S>(data, x, typename S::Vec(there - x), index) % 2 == 0;
}

}  // namespace rigor::engine
