// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points of two segments that support a normal: edges, or lines of round sides (feature.hpp). Where they lie side by
// side they have the ends of their common stretch. Round sides that cross at an angle do so as well where they overlap: at x
// beside its line a side of radius r is lower by r - sqrt(r^2 - x^2), so that the separation there is exact. Private to this
// folder.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/narrowphase/3d/feature.hpp"

namespace rigor::engine {

/// Sine of the largest angle between segments that lie side by side: about 3 degrees.
template <class R>
inline constexpr R kParallelEdges = R(0.05);
/// The same for a line of a round side and another that crosses it above or below: 26 degrees.
template <class R>
inline constexpr R kParallelSides = R(0.436);
/// Sine of the largest angle between the normal and the plane across such a line.
template <class R>
inline constexpr R kSquare = R(1e-3);

/// The ends of the common stretch of two segments; nothing where they cross. `round`: `ref` is a line of a round side, which is
/// lower by r - sqrt(r^2 - x^2) at x beside the line, under the ends on `inc`.
template <class R>
void alongSegments(const Vec3<R>& normal, R speculative, const SupportFeature<R>& ref,
                   const SupportFeature<R>& inc, bool refIsA, bool round, Manifold<Space<R, 3>>& out) {
    const Vec3<R> d = ref.at[1] - ref.at[0], e = inc.at[1] - inc.at[0];
    const Vec3<R> outward = refIsA ? normal : Vec3<R>(-normal);
    const R dd = d.squaredNorm(), de = d.dot(e), r = ref.radius;
    const R most = round ? kParallelSides<R> : kParallelEdges<R>;
    if (!(d.cross(e).squaredNorm() <= most * most * dd * e.squaredNorm())) return;
    const R t0 = d.dot(inc.at[0] - ref.at[0]) / dd, slope = de / dd, t1 = t0 + slope;
    const R low = std::max(R(0), std::min(t0, t1)), high = std::min(R(1), std::max(t0, t1));
    if (!(high - low > R(1e-3) * std::min(R(1), std::abs(slope)))) return;
    for (const R t : {low, high}) {
        const R u = std::clamp((t - t0) / slope, R(0), R(1));
        Vec3<R> p = ref.at[0] + t * d;
        const Vec3<R> q = inc.at[0] + u * e;
        R s = outward.dot(q - p);
        if (round) {
            const Vec3<R> beside = q - p - s * outward;
            const R x = beside.norm();
            if (!(x < R(0.9) * r)) continue;
            const R lower = r - std::sqrt(r * r - x * x);
            s += lower;
            p = q - s * outward;
        }
        if (s > speculative) continue;
        const bool endOfRef = t == R(0) || t == R(1);
        const auto end = static_cast<std::size_t>((endOfRef ? t : u) > R(0.5) ? 1 : 0);
        const Vec3<R> other = p + s * outward;
        addPoint<Space<R, 3>>(out, refIsA ? p : other, refIsA ? other : p, s,
                              vertexFeature(endOfRef == refIsA, endOfRef ? ref.index[end] : inc.index[end]));
    }
}

/// Whether a segment is a line of a round side that the normal stands on.
template <class R>
bool isRound(const SupportFeature<R>& f, const Vec3<R>& n) {
    if (f.count != 2 || !(f.radius > 0)) return false;
    const Vec3<R> d = f.at[1] - f.at[0];
    return std::abs(d.dot(n)) <= kSquare<R> * d.norm();
}

/// Cosine of the angle between the contact normal and that of a face, or of the best face through a segment.
template <class R>
R flatness(const SupportFeature<R>& f, const Vec3<R>& n) {
    if (f.count > 2) return std::abs(f.normal.dot(n));
    if (f.count < 2) return R(0);
    const R slope = (f.at[1] - f.at[0]).normalized().dot(n);
    return std::sqrt(std::max(R(0), R(1) - slope * slope));
}

}  // namespace rigor::engine
