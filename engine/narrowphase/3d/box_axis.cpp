// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Separating axes of two boxes [Gottschalk1996; Ericson2005, ch. 4.4]: three face normals each and nine cross
// products of edges. With C = axes of B in the frame of A, t = centre of B, a and b the half extents:
//
//   face i of A:   |t_i| - a_i - sum_j b_j |C_ij|
//   face j of B:   |t . C_j| - b_j - sum_i a_i |C_ij|
//   edges i, j:    (|t . n| - ra - rb) / |n|,   n = e_i x C_j,
//                  ra = a_i1 |C_i2 j| + a_i2 |C_i1 j|,   rb = b_j1 |C_i j2| + b_j2 |C_i j1|
//
// where i1, i2 are the two axes other than i. About 200 flops; the general search needs several thousand.
#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {
namespace {

/// Face of a box along +-axis, in the order of polytope.hpp.
int faceIndex(int axis, bool positive) {
    return 2 * axis + (positive ? 1 : 0);
}

/// The edge along `axis` that is furthest along n (box frame), in the order of polytope.hpp.
template <class R>
int edgeIndex(int axis, const Vec3<R>& n) {
    const int low = axis == 0 ? 1 : 0, high = axis == 2 ? 1 : 2;
    return 4 * axis + (n[low] > 0 ? 1 : 0) + (n[high] > 0 ? 2 : 0);
}

template <class R>
struct Faces {
    int axis = 0;
    R separation = -std::numeric_limits<R>::max();
};

/// Faces of the box of half extents `own`; `t` is the other's centre in its frame, `reach` the other's
/// extents along its axes.
template <class R>
Faces<R> bestFace(const Vec3<R>& own, const Vec3<R>& t, const Vec3<R>& reach, R rounding) {
    Faces<R> best;
    for (int i = 0; i < 3; ++i) {
        const R s = std::abs(t[i]) - own[i] - reach[i];
        if (i == 0 || s > best.separation + rounding) best = {i, s};
    }
    return best;
}

template <class R>
struct EdgePair {
    int i = -1, j = -1;
    R separation = -std::numeric_limits<R>::max();
};

template <class R>
Vec3<R> edgeNormal(const Eigen::Matrix<R, 3, 3>& C, int i, int j) {
    return Vec3<R>::Unit(i).cross(C.col(j));
}

/// The separation along the unit vector n over both boxes: never more than there is, whatever rounding made
/// of n.
template <class R>
R separationAlong(const Vec3<R>& a, const Vec3<R>& b, const Eigen::Matrix<R, 3, 3>& C, const Vec3<R>& t,
                  const Vec3<R>& n) {
    return std::abs(n.dot(t)) - a.dot(n.cwiseAbs()) - b.dot((C.transpose() * n).cwiseAbs());
}

/// False when an edge axis separates by more than `speculative`.
template <class R>
bool bestEdges(const Vec3<R>& a, const Vec3<R>& b, const Eigen::Matrix<R, 3, 3>& C,
               const Eigen::Matrix<R, 3, 3>& absC, const Vec3<R>& t, R speculative, EdgePair<R>& best) {
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            const R squared = C(i1, j) * C(i1, j) + C(i2, j) * C(i2, j);
            if (squared <= kRounding<R> * kRounding<R>) continue;
            const R ra = a[i1] * absC(i2, j) + a[i2] * absC(i1, j);
            const R rb = b[j1] * absC(i, j2) + b[j2] * absC(i, j1);
            const R along = t[i2] * C(i1, j) - t[i1] * C(i2, j);
            R s = (std::abs(along) - ra - rb) / std::sqrt(squared);
            if (squared <= kParallel<R> * kParallel<R> && s > best.separation)
                s = separationAlong<R>(a, b, C, t, edgeNormal(C, i, j).normalized());
            if (s > best.separation) best = {i, j, s};
        }
    }
    return best.separation <= speculative;
}

}  // namespace

template <class R>
bool boxAxis(const Vec3<R>& halfA, const Vec3<R>& halfB, const Relative<R>& X, R speculative,
             PolytopeAxis<R>& best) {
    const Eigen::Matrix<R, 3, 3>& C = X.rotation;
    const Eigen::Matrix<R, 3, 3> absC = C.cwiseAbs();
    const Vec3<R>& t = X.translation;
    const Vec3<R> tB = C.transpose() * t;
    const R size = std::max({halfA.maxCoeff(), halfB.maxCoeff(), t.cwiseAbs().maxCoeff()});
    const R rounding = kRounding<R> * size;

    const Faces<R> onA = bestFace<R>(halfA, t, absC * halfB, rounding);
    if (onA.separation > speculative) return false;
    const Faces<R> onB = bestFace<R>(halfB, tB, absC.transpose() * halfA, rounding);
    if (onB.separation > speculative) return false;
    EdgePair<R> edges;
    if (!bestEdges<R>(halfA, halfB, C, absC, t, speculative, edges)) return false;

    best.kind = PolytopeAxis<R>::FaceA;
    best.featureA = faceIndex(onA.axis, t[onA.axis] >= 0);
    best.normal = (t[onA.axis] >= 0 ? R(1) : R(-1)) * Vec3<R>::Unit(onA.axis);
    best.separation = onA.separation;
    if (onB.separation > onA.separation + axisTolerance(size, onA.separation)) {
        best.kind = PolytopeAxis<R>::FaceB;
        // B's face looks back at A.
        best.featureB = faceIndex(onB.axis, tB[onB.axis] < 0);
        best.normal = (tB[onB.axis] < 0 ? R(-1) : R(1)) * C.col(onB.axis);
        best.separation = onB.separation;
    }
    const R needed = best.separation + axisTolerance(size, best.separation);
    if (edges.i < 0 || edges.separation <= needed) return true;
    // Once more with the unit normal: dividing by a short cross product had magnified the rounding.
    Vec3<R> n = edgeNormal(C, edges.i, edges.j).normalized();
    if (n.dot(t) < 0) n = -n;
    const Vec3<R> nB = C.transpose() * n;
    const R separation = n.dot(t) - halfA.dot(n.cwiseAbs()) - halfB.dot(nB.cwiseAbs());
    if (separation <= needed) return true;
    best.kind = PolytopeAxis<R>::Edges;
    best.featureA = edgeIndex<R>(edges.i, n);
    best.featureB = edgeIndex<R>(edges.j, -nB);
    best.normal = n;
    best.separation = separation;
    return true;
}

template bool boxAxis<float>(const Vec3<float>&, const Vec3<float>&, const Relative<float>&, float,
                             PolytopeAxis<float>&);
template bool boxAxis<double>(const Vec3<double>&, const Vec3<double>&, const Relative<double>&, double,
                              PolytopeAxis<double>&);

}  // namespace rigor::engine
