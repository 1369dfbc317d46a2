// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The Gilbert-Johnson-Keerthi algorithm: the point v of the Minkowski difference D nearest to the origin.
//   w = support of D along -v;   |v| >= distance >= v . w / |v|
//   v := nearest point of conv(simplex + w), the simplex reduced to the points that v needs
// Source: [Gilbert1988], sub-problem by [Montanari2017] (simplex.cpp), bounds of [Bergen2003, sec. 4.3].
//
// Ends when the bounds meet within a few roundings of |v|, when the support point is known already, or when
// |v| has not fallen for a few steps: then nothing is left but rounding, and the step with the least gap is
// the result. No looser tolerance: the error of the normal grows as the square root of the gap over the
// distance. A distance below the rounding of D's own coordinates counts as overlap, and EPA decides. Cost: a
// few support points for polytopes; linear convergence on curved shapes.
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

/// Polytopes end by themselves after about 20; curved sides gain at least a bit per step. [-]
constexpr int kMostIterations = 128;
/// Steps without a shorter v before giving up: the length is flat where the direction is still wrong by the
/// square root of the rounding, so a few of them do turn it right.
constexpr int kIdleSteps = 8;

template <class S>
bool holds(const Simplex<S>& simplex, const typename S::Vec& w) {
    for (int i = 0; i < simplex.count; ++i)
        if (simplex.points[i].w == w) return true;
    return false;
}

}  // namespace

template <class S>
GjkResult<S> gjk(const Minkowski<S>& D, const typename S::Vec& start) {
    using R = typename S::Real;
    using V = typename S::Vec;
    GjkResult<S> r;
    r.simplex.points[0] = D.point(start);
    r.simplex.weights[0] = 1;
    r.simplex.count = 1;
    r.v = r.simplex.points[0].w;
    R size = std::max(r.simplex.points[0].a.norm(), r.simplex.points[0].b.norm());
    GjkResult<S> best = r;
    R least = std::numeric_limits<R>::max();  // gap between the bounds
    int idle = 0;
    int& queries = best.iterations;
    for (queries = 1; queries < kMostIterations && idle < kIdleSteps; ++queries) {
        const R length = r.v.norm();
        best.overlap = length <= kRounding<R> * size;
        if (best.overlap) break;
        const DifferencePoint<S> p = D.point(-r.v);
        size = std::max({size, p.a.norm(), p.b.norm()});
        const R gap = length - r.v.dot(p.w) / length;
        const bool known = holds(r.simplex, p.w);
        if (gap < least || known) {
            best.simplex = r.simplex;
            best.v = r.v;
            least = known ? R(0) : gap;
        }
        if (known || gap <= R(4) * std::numeric_limits<R>::epsilon() * length) break;
        r.simplex.points[r.simplex.count++] = p;
        const V v = reduceSimplex<S>(r.simplex, V::Zero());
        best.overlap = r.simplex.count == S::dim + 1;
        if (best.overlap) break;
        idle = v.squaredNorm() < r.v.squaredNorm() ? 0 : idle + 1;
        r.v = v;
    }
    if (best.overlap) {
        best.simplex = r.simplex;
        best.v.setZero();
    }
    best.converged = best.overlap || least <= R(8) * kRounding<R> * size;
    return best;
}

#define RIGOR_INSTANTIATE(S) template GjkResult<S> gjk(const Minkowski<S>&, const S::Vec&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
