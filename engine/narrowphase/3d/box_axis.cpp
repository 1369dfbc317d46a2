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
// where i1, i2 are the two axes other than i. About 200 flops; root and division only for edges that can be
// better than the faces.
#include "engine/narrowphase/3d/box_axis.hpp"

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

/// The separation along face `face` of the box of half extents `own`; `t` is the other's centre in its frame,
/// `reach` the other's extents along its axes.
template <class R>
R faceSeparation(const Vec3<R>& own, const Vec3<R>& t, const Vec3<R>& reach, int face) {
    const int axis = face / 2;
    return (face % 2 ? t[axis] : -t[axis]) - own[axis] - reach[axis];
}

template <class R>
struct Faces {
    int axis = 0;
    R separation = -std::numeric_limits<R>::max();
};

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
    R separation;
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

/// Three numbers and a fourth that fills the register.
template <class R>
using Row = Eigen::Array<R, 4, 1>;

/// The best pair of edges, of those that separate by more than `best.separation`. Root and division only for
/// those: with q(x) = x |x|, which grows with x,
///   numerator / sqrt(squared) > best   where   q(numerator) > q(best) squared
template <class R>
void bestEdges(const Vec3<R>& a, const Vec3<R>& b, const Eigen::Matrix<R, 3, 3>& C,
               const Eigen::Matrix<R, 3, 3>& absC, const Vec3<R>& t, EdgePair<R>& best) {
    const auto row = [](const Eigen::Matrix<R, 3, 3>& m, int i) {
        return Row<R>(m(i, 0), m(i, 1), m(i, 2), R(0));
    };
    const Row<R> rows[3] = {row(C, 0), row(C, 1), row(C, 2)};
    const Row<R> absRows[3] = {row(absC, 0), row(absC, 1), row(absC, 2)};
    const Row<R> b1(b[1], b[2], b[0], R(1)), b2(b[2], b[0], b[1], R(0));
    Row<R> squared[3], numerator[3];
    // A little less than q(best): never a wrong no.
    const R bound =
        best.separation * std::abs(best.separation) * (R(1) - std::copysign(kRounding<R>, best.separation));
    for (int i = 0; i < 3; ++i) {
        const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
        const Row<R> abs1(absC(i, 1), absC(i, 2), absC(i, 0), R(0)),
            abs2(absC(i, 2), absC(i, 0), absC(i, 1), R(1));
        const Row<R> ra = a[i1] * absRows[i2] + a[i2] * absRows[i1], rb = b1 * abs2 + b2 * abs1;
        squared[i] = rows[i1] * rows[i1] + rows[i2] * rows[i2];
        numerator[i] = (t[i2] * rows[i1] - t[i1] * rows[i2]).abs() - ra - rb;
    }
    for (int i = 0; i < 3; ++i) {
        const Row<R> more = numerator[i] * numerator[i].abs() - bound * squared[i];
        if (!(more.maxCoeff() >= 0)) continue;
        for (int j = 0; j < 3; ++j) {
            if (!(more[j] >= 0) || squared[i][j] <= kRounding<R> * kRounding<R>) continue;
            R s = numerator[i][j] / std::sqrt(squared[i][j]);
            if (squared[i][j] <= kParallel<R> * kParallel<R> && s > best.separation)
                s = separationAlong<R>(a, b, C, t, edgeNormal(C, i, j).normalized());
            if (s > best.separation) best = {i, j, s};
        }
    }
}

/// n along the sum of the outward normals of the two faces that share the edge `edge` of a box.
template <class R>
R towardsFaces(int edge, const Vec3<R>& n) {
    const int axis = edge / 4, low = axis == 0 ? 1 : 0, high = axis == 2 ? 1 : 2;
    return (edge & 1 ? n[low] : -n[low]) + (edge & 2 ? n[high] : -n[high]);
}

}  // namespace

template <class R>
BoxAxes<R>::BoxAxes(const Vec3<R>& a, const Vec3<R>& b, const Relative<R>& relative)
    : halfA(a),
      halfB(b),
      X(relative),
      absC(X.rotation.cwiseAbs()),
      tB(X.rotation.transpose() * X.translation),
      size(std::max({a.maxCoeff(), b.maxCoeff(), X.translation.cwiseAbs().maxCoeff()})) {}

template <class R>
bool BoxAxes<R>::find(R speculative, PolytopeAxis<R>& best) {
    const Eigen::Matrix<R, 3, 3>& C = X.rotation;
    const Vec3<R>& t = X.translation;
    const R rounding = kRounding<R> * size;
    reachB = absC * halfB;
    const Faces<R> onA = bestFace<R>(halfA, t, reachB, rounding);
    best.separation = onA.separation;
    if (onA.separation > speculative) return false;
    reachA = absC.transpose() * halfA;
    const Faces<R> onB = bestFace<R>(halfB, tB, reachA, rounding);
    best.separation = std::max(onA.separation, onB.separation);
    if (onB.separation > speculative) return false;
    // Edges no better than the faces are of no use.
    EdgePair<R> edges{-1, -1, best.separation};
    bestEdges<R>(halfA, halfB, C, absC, t, edges);
    best.separation = edges.separation;
    if (edges.separation > speculative) return false;

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

template <class R>
void BoxAxes<R>::keep(const ManifoldMemory<Space<R, 3>>& memory, PolytopeAxis<R>& best) const {
    using Memory = ManifoldMemory<Space<R, 3>>;
    using Axis = PolytopeAxis<R>;
    const Eigen::Matrix<R, 3, 3>& C = X.rotation;
    const auto i = static_cast<int>(memory.featureA), j = static_cast<int>(memory.featureB);
    Axis last;
    if (memory.axis == Memory::kFaceA && i < 6) {
        if (best.kind == Axis::FaceA && best.featureA == i) return;
        last.kind = Axis::FaceA;
        last.normal = (i % 2 ? R(1) : R(-1)) * Vec3<R>::Unit(i / 2);
        last.separation = faceSeparation<R>(halfA, X.translation, reachB, i);
    } else if (memory.axis == Memory::kFaceB && j < 6) {
        if (best.kind == Axis::FaceB && best.featureB == j) return;
        last.kind = Axis::FaceB;
        last.normal = (j % 2 ? R(-1) : R(1)) * C.col(j / 2);
        last.separation = faceSeparation<R>(halfB, Vec3<R>(-tB), reachA, j);
    } else if (memory.axis == Memory::kEdges && best.kind == Axis::Edges && i < 12 && j < 12) {
        if (best.featureA == i && best.featureB == j) return;
        const Vec3<R> n = edgeNormal(C, i / 4, j / 4);
        const R length = n.norm();
        if (!(length > kParallel<R>)) return;
        last.kind = Axis::Edges;
        last.normal = n * ((towardsFaces<R>(i, n) < 0 ? R(-1) : R(1)) / length);
        last.separation = last.normal.dot(X.translation) - halfA.dot(last.normal.cwiseAbs()) -
                          halfB.dot((C.transpose() * last.normal).cwiseAbs());
    } else {
        return;
    }
    last.featureA = i;
    last.featureB = j;
    last.kept = last.separation < best.separation;
    if (last.separation >= best.separation - kKeep<R> * std::min(halfA.maxCoeff(), halfB.maxCoeff()))
        best = last;
}

template struct BoxAxes<float>;
template struct BoxAxes<double>;

}  // namespace rigor::engine
