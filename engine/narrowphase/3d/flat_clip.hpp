// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A polygon in the two coordinates of a reference face, with its height over the face: clipping to an
// interval of a coordinate, and the choice of four of its corners. Private to this folder.
#pragma once

#include <array>

#include "engine/narrowphase/detail.hpp"

namespace rigor::engine {

/// Corners that a polygon can have: a quadrilateral cut by four lines has eight.
inline constexpr int kFlatMost = 8;

/// A corner of the polygon.
template <class R>
struct FlatVertex {
    R u, v, h;    ///< place on the reference face and height over it [m]
    int in, out;  ///< line before and after this vertex
};

/// Corners as a structure of arrays, so that all edges are cut at the same time.
template <class R>
struct FlatPolygon {
    /// Room for what one step of clipping may write: three corners per edge and one more.
    static constexpr std::size_t kRoom = 3 * kFlatMost + 1;
    std::array<R, kRoom> u, v, h;
    std::array<int, kRoom> in, out;
    int count = 0;

    void set(std::size_t i, R atU, R atV, R height, int before, int after) {
        u[i] = atU;
        v[i] = atV;
        h[i] = height;
        in[i] = before;
        out[i] = after;
    }
    FlatVertex<R> operator[](int i) const {
        const auto k = static_cast<std::size_t>(i);
        return {u[k], v[k], h[k], in[k], out[k]};
    }
};

/// Keeps what is between the lines x = -limit and x = limit, numbered `low` and `high`; x is u or v, y the
/// other. Sutherland and Hodgman's loop over the edges, for both lines at once and without a branch: every
/// edge may give its first end, the point where it comes in and the one where it goes out.
template <class R, std::array<R, FlatPolygon<R>::kRoom> FlatPolygon<R>::*X,
          std::array<R, FlatPolygon<R>::kRoom> FlatPolygon<R>::*Y>
void clipFlat(FlatPolygon<R>& from, R limit, int low, int high, FlatPolygon<R>& to) {
    std::array<R, kFlatMost> inY, inH, outY, outH;
    const auto n = static_cast<std::size_t>(from.count);
    auto &x = from.*X, &y = from.*Y, &h = from.h;
    x[n] = x[0];
    y[n] = y[0];
    h[n] = h[0];
    for (std::size_t i = 0; i < kFlatMost; ++i) {
        // Each from the end that is nearer the inside: the same points whichever way round.
        const R step = x[i + 1] - x[i];
        const R in = (x[i + 1] - std::copysign(limit, x[i])) / step;
        const R out = (std::copysign(limit, x[i + 1]) - x[i]) / step;
        inY[i] = y[i + 1] - in * (y[i + 1] - y[i]);
        inH[i] = h[i + 1] - in * (h[i + 1] - h[i]);
        outY[i] = y[i] + out * (y[i + 1] - y[i]);
        outH[i] = h[i] + out * (h[i + 1] - h[i]);
    }
    std::size_t count = 0;
    const auto add = [&](R atX, R atY, R height, int before, int after, bool really) {
        (to.*X)[count] = atX;
        (to.*Y)[count] = atY;
        to.h[count] = height;
        to.in[count] = before;
        to.out[count] = after;
        count += really;
    };
    const auto beyond = [&](R at) { return static_cast<int>(at > limit) - static_cast<int>(at < -limit); };
    int a = beyond(x[0]);
    for (std::size_t i = 0; i < n; ++i) {
        const int b = beyond(x[i + 1]);
        add(x[i], y[i], h[i], from.in[i], from.out[i], a == 0);
        const bool crosses = a != b;
        add(a < 0 ? -limit : limit, inY[i], inH[i], a < 0 ? low : high, from.out[i], crosses && a != 0);
        add(b < 0 ? -limit : limit, outY[i], outH[i], from.out[i], b < 0 ? low : high, crosses && b != 0);
        a = b;
    }
    to.count = std::min(static_cast<int>(count), kFlatMost);
}

/// reducePoints (detail.hpp) for the first `count` of `corners`: the same rules, with candidates that differ
/// by rounding alone taken as equal, of which the first wins. `size` is that of the smaller shape, `extent`
/// that of the polygon; `side` 1 or -1: u, v and the contact normal are right-handed or not. `name(corner)`;
/// `emit(corner)`.
template <class R, class Name, class Emit>
void reduceFlat(const FlatPolygon<R>& polygon, const std::array<int, kFlatMost>& corners, int count, R side,
                R size, R extent, const ManifoldMemory<Space<R, 3>>& memory, Name name, Emit emit) {
    constexpr int kMost = Space<R, 3>::maxManifoldPoints;
    if (count <= kMost) {
        for (int i = 0; i < count; ++i) emit(polygon[corners[i]]);
        return;
    }
    std::array<R, kFlatMost> score, u, v;
    std::array<std::uint32_t, kFlatMost> names;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const FlatVertex<R> x = polygon[corners[i]];
        u[i] = x.u;
        v[i] = x.v;
        score[i] = -x.h;
        if (memory.count > 0) names[i] = name(x);
    }
    const auto best = [&](R share, R tolerance, R rounding, R& top) {
        top = score[0];
        for (int i = 1; i < count; ++i) {
            const R s = score[i];
            top = s > top ? s : top;
        }
        const R enough = (R(1) - share) * top - tolerance;
        for (std::uint32_t k = 0; k < memory.count; ++k)
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                if (names[i] == memory.names[k] && score[i] >= enough) return i;
        std::size_t i = 0;
        while (score[i] < top - rounding) ++i;
        return i;
    };
    R top;
    const R unit = kRounding<R> * extent;
    const std::size_t p0 = best(R(0), kKeep<R> * size, unit, top);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const R du = u[i] - u[p0], dv = v[i] - v[p0];
        score[i] = du * du + dv * dv;
    }
    const std::size_t p1 = best(R(2) * kKeepSpread<R>, R(0), unit * extent, top);
    emit(polygon[corners[p0]]);
    if (p1 == p0) return;
    emit(polygon[corners[p1]]);
    const R acrossU = side * (v[p0] - v[p1]), acrossV = side * (u[p1] - u[p0]);
    const R flat = kRounding<R> * (acrossU * acrossU + acrossV * acrossV);
    const R rounding = unit * (std::abs(acrossU) + std::abs(acrossV));
    for (const R way : {R(1), R(-1)}) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            score[i] = way * (acrossU * (u[i] - u[p0]) + acrossV * (v[i] - v[p0]));
        const std::size_t p = best(kKeepSpread<R>, R(0), rounding, top);
        if (top > flat) emit(polygon[corners[p]]);
    }
}

}  // namespace rigor::engine
