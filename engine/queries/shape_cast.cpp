// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of first touch of a translating convex shape by conservative advancement [Mirtich1996, ch. 2]: with
// distance d and unit normal n of the closest points at fraction t and the translation T,
//   t := t + d / (n . T).
// The shapes' supporting planes across n cannot touch earlier, so that no step goes too far; n . T <= 0 means
// that those planes never touch, and so neither do the shapes. Ends when d is below the rounding of the
// coordinates. Cost: one closestPoints per step; polytopes take a few steps, curved sides gain several digits
// a step unless they graze. Limit: kMostSteps; a hit then is flagged, its fraction too early.
#include "engine/queries/shape_cast.hpp"

#include "engine/narrowphase/distance.hpp"

namespace rigor::engine {
namespace {

/// Grazing casts converge slowest: the gap falls by a constant factor a step. 64: 1e-12 at a factor of 2/3.
constexpr int kMostSteps = 64;

}  // namespace

template <class S>
CastResult<S> castConvex(const Shape<S>& a, const Pose<S>& Xa, const typename S::Vec& translation,
                         const Shape<S>& b, const Pose<S>& Xb, typename S::Real most) {
    using R = typename S::Real;
    CastResult<S> result;
    const Aabb<S> box = boundingBox<S>(a, Xa);
    const R size = std::max({(box.max - box.min).maxCoeff(), translation.cwiseAbs().maxCoeff(),
                             (Xb.p - Xa.p).cwiseAbs().maxCoeff()});
    // 64 roundings of the sizes that occur: the least distance that closestPoints distinguishes from zero.
    const R touching = R(64) * std::numeric_limits<R>::epsilon() * size;
    R t = 0;
    for (int step = 0; step < kMostSteps; ++step) {
        Pose<S> X = Xa;
        X.p += t * translation;
        const ClosestPoints<S> closest = closestPoints<S>(a, X, b, Xb);
        result.fraction = t;
        result.normal = closest.normal;
        result.point = R(0.5) * (closest.pointA + closest.pointB);
        if (closest.distance <= touching) {
            result.touches = true;
            result.startsTouching = step == 0;
            return result;
        }
        const R speed = closest.normal.dot(translation);
        if (!(speed > 0)) return result;
        t += closest.distance / speed;
        if (t > most) return result;
    }
    result.touches = true;
    result.converged = false;
    return result;
}

#define INSTANTIATE(S)                                                                                    \
    template CastResult<S> castConvex<S>(const Shape<S>&, const Pose<S>&, const S::Vec&, const Shape<S>&, \
                                         const Pose<S>&, S::Real);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
