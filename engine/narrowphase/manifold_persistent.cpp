// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The incremental manifold [Coumans2010]: each step gives one point, the deepest, and a cache of points in
// body frames grows to a full manifold over a few steps. With pA, pB a cached point carried along by its
// bodies and n the normal of this step:
//   refresh   separation s = (pB - pA) . n
//   drop      s > speculative distance, or |pB - pA - s n| > drift: the bodies have slid
//   merge     a new point within `drift` of a cached one takes its place and its name
//   reduce    of one too many the deepest stays, and those that span the largest area
// The drift allowed is a fraction of the smaller shape's size; the source uses an absolute 2 cm.
//
// Deviation: any narrow phase may feed it; of more points found at once only the deepest is taken. Known
// limits: a body needs several steps of rocking before a face is held; points out of date by up to the drift
// make torques that a clipped manifold does not. O(points^2) per contact.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"

namespace rigor::engine {
namespace {

/// Share of the smaller shape's size: 1 cm for a box of 0.5 m.
template <class R>
inline constexpr R kDrift = R(0.02);

template <class S>
using Candidates = std::array<ManifoldPoint<S>, S::maxManifoldPoints + 1>;

/// The lowest name that no cached point has.
template <class S>
std::uint32_t freeName(const Candidates<S>& points, int count) {
    std::uint32_t name = 0;
    for (int i = 0; i < count; ++i)
        if (points[i].feature == name) {
            ++name;
            i = -1;
        }
    return name;
}

}  // namespace

ManifoldTraits manifoldPersistentTraits() {
    return {.remembers = true};
}

template <class S>
void manifoldPersistent(const ManifoldPair<S>& pair, ManifoldCache<S>& cache, Manifold<S>& manifold) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V n = manifold.normal;
    const R drift = kDrift<R> * pair.size;
    ManifoldPoint<S> fresh = manifold.points[0];
    for (int i = 1; i < manifold.count; ++i)
        if (manifold.points[i].separation < fresh.separation) fresh = manifold.points[i];

    Candidates<S> points;
    int count = 0, nearest = -1;
    R least = drift * drift;
    for (int i = 0; i < cache.count; ++i) {
        const auto& kept = cache.points[i];
        const V pA = toWorld<S>(pair.Xa, kept.onA), pB = toWorld<S>(pair.Xb, kept.onB), gap = pB - pA;
        const R separation = gap.dot(n);
        if (separation > pair.speculativeDistance) continue;
        if ((gap - separation * n).squaredNorm() > drift * drift) continue;
        const R squared = (pB - fresh.pointB).squaredNorm();
        if (squared < least) {
            least = squared;
            nearest = count;
        }
        points[count++] = {pA, pB, separation, kept.name};
    }
    fresh.feature = nearest < 0 ? freeName<S>(points, count) : points[nearest].feature;
    points[nearest < 0 ? count++ : nearest] = fresh;

    manifold.count = 0;
    cache.count = 0;
    reducePoints<S>(
        count, n, [&](int i) { return points[i].separation; }, [&](int i) { return points[i].pointB; },
        [&](int i) {
            const ManifoldPoint<S>& p = points[i];
            cache.points[cache.count++] = {toLocal<S>(pair.Xa, p.pointA), toLocal<S>(pair.Xb, p.pointB),
                                           p.feature};
            manifold.points[manifold.count++] = p;
        });
}

RIGOR_INSTANTIATE_MANIFOLD(manifoldPersistent);

}  // namespace rigor::engine
