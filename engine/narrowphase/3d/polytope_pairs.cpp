// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Hull against box and hull: the best separating axis, then its contact points, both in the frame of A, so
// that distance from the world's origin costs no digits. Two boxes: box_box.cpp.
#include "engine/narrowphase/3d/polytope.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

template <class R>
Relative<R> relative(const Pose<Space<R, 3>>& Xa, const Pose<Space<R, 3>>& Xb) {
    const Pose<Space<R, 3>> X = relativePose<Space<R, 3>>(Xa, Xb);
    return {toMatrix(X.q), X.p};
}

template <class R, class A, class B>
void collidePolytopes(const A& a, const Pose<Space<R, 3>>& Xa, const B& b, const Pose<Space<R, 3>>& Xb,
                      R speculative, Manifold<Space<R, 3>>& out) {
    BoxStorage<R> storeA, storeB;
    const Polytope<R> pa = polytopeOf<R>(a, storeA), pb = polytopeOf<R>(b, storeB);
    const Relative<R> X = relative<R>(Xa, Xb);
    PolytopeAxis<R> axis;
    if (!polytopeAxis<R>(pa, pb, X, speculative, axis)) {
        out.separationLowerBound = axis.separation;
        return;
    }
    keepAxis<R>(pa, pb, X, out.memory, axis);
    polytopeManifold<R>(pa, pb, X, axis, speculative, out);
    toWorldFrame<Space<R, 3>>(out, Xa);
}

}  // namespace

#define PAIR(A, B)                                                                                  \
    template <class R>                                                                              \
    void collidePair(const A<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const B<Space<R, 3>>& b, \
                     const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,           \
                     Manifold<Space<R, 3>>& out) {                                                  \
        collidePolytopes<R>(a, Xa, b, Xb, speculative, out);                                        \
    }                                                                                               \
    template void collidePair<float>(const A<Space3f>&, const Pose<Space3f>&, const B<Space3f>&,    \
                                     const Pose<Space3f>&, float, Manifold<Space3f>&);              \
    template void collidePair<double>(const A<Space3d>&, const Pose<Space3d>&, const B<Space3d>&,   \
                                      const Pose<Space3d>&, double, Manifold<Space3d>&);
PAIR(Box, Hull)
PAIR(Hull, Hull)
#undef PAIR

}  // namespace rigor::engine
