// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Separating axes of two convex polyhedra. The facets of the Minkowski difference B - A are faces of A, faces
// of B, and those pairs of edges whose arcs cross on the Gauss sphere [Gregorius2013]; the largest separation
// over them is the exact penetration (negative) of overlapping polyhedra, and a lower bound of the distance
// of separated ones.
//   arcs (a, b) of an edge of A and (-c, -d) of one of B cross iff
//     (c . ea)(d . ea) < 0,  (a . eb)(b . eb) < 0,  (c . ea)(b . eb) > 0   (signs with the normals negated)
// Cost O(F V + E E).
#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {
namespace {

template <class R>
struct FaceAxis {
    int face = -1;
    R separation = -std::numeric_limits<R>::max();
};

/// Faces of p against vertices of q, posed by X in the frame of p.
template <class R>
FaceAxis<R> bestFace(const Polytope<R>& p, const Polytope<R>& q, const Relative<R>& X, R stopAbove,
                     R tolerance) {
    FaceAxis<R> best;
    for (int i = 0; i < p.faceCount; ++i) {
        const HullFace<R>& f = p.faces[i];
        const Vec3<R> n = X.rotation.transpose() * f.normal;
        R low = std::numeric_limits<R>::max();
        for (int j = 0; j < q.vertexCount; ++j) low = std::min(low, n.dot(q.vertices[j]));
        const R s = low + f.normal.dot(X.translation) - f.offset;
        if (best.face < 0 || s > best.separation + tolerance) best = {i, s};
        if (s > stopAbove) return best;
    }
    return best;
}

/// The separation along `n` over all vertices: never more than there is, whatever rounding made of n.
template <class R>
R separationAlong(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, const Vec3<R>& n) {
    R high = -std::numeric_limits<R>::max(), low = std::numeric_limits<R>::max();
    for (int i = 0; i < a.vertexCount; ++i) high = std::max(high, n.dot(a.vertices[i]));
    const Vec3<R> local = X.rotation.transpose() * n;
    for (int i = 0; i < b.vertexCount; ++i) low = std::min(low, local.dot(b.vertices[i]));
    return low + n.dot(X.translation) - high;
}

template <class R>
PolytopeAxis<R> bestEdges(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X) {
    PolytopeAxis<R> best;
    best.kind = PolytopeAxis<R>::Edges;
    best.featureA = -1;
    const Eigen::Matrix<R, 3, 3> toB = X.rotation.transpose();
    for (int i = 0; i < a.edgeCount; ++i) {
        const HullEdge& ea = a.edges[i];
        // The edge of A in the frame of B.
        const Vec3<R> pa = toB * (a.vertices[ea.v0] - X.translation);
        const Vec3<R> da = toB * (a.vertices[ea.v1] - a.vertices[ea.v0]);
        const Vec3<R> left = toB * a.faces[ea.left].normal, right = toB * a.faces[ea.right].normal;
        const R squaredA = da.squaredNorm();
        for (int j = 0; j < b.edgeCount; ++j) {
            const HullEdge& eb = b.edges[j];
            const R c = -b.faces[eb.left].normal.dot(da), d = -b.faces[eb.right].normal.dot(da);
            if (c * d >= 0) continue;
            const Vec3<R> db = b.vertices[eb.v1] - b.vertices[eb.v0];
            const R l = left.dot(db), r = right.dot(db);
            if (l * r >= 0 || c * r <= 0) continue;
            Vec3<R> n = da.cross(db);
            const R squared = n.squaredNorm();
            const R whole = squaredA * db.squaredNorm();
            if (squared <= kRounding<R> * kRounding<R> * whole) continue;
            n *= (n.dot(left + right) < 0 ? R(-1) : R(1)) / std::sqrt(squared);
            R s = n.dot(b.vertices[eb.v0] - pa);
            if (s <= best.separation) continue;
            if (squared <= kParallel<R> * kParallel<R> * whole) {
                s = separationAlong(a, b, X, Vec3<R>(X.rotation * n));
                if (s <= best.separation) continue;
            }
            best.separation = s;
            best.normal = n;
            best.featureA = i;
            best.featureB = j;
        }
    }
    best.normal = X.rotation * best.normal;
    return best;
}

}  // namespace

template <class R>
bool polytopeAxis(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, R speculative,
                  PolytopeAxis<R>& best) {
    const R size = std::max({a.size, b.size, X.translation.cwiseAbs().maxCoeff()});
    const R rounding = kRounding<R> * size;
    const FaceAxis<R> onA = bestFace(a, b, X, speculative, rounding);
    if (onA.separation > speculative) return false;
    const FaceAxis<R> onB = bestFace(b, a, X.inverse(), speculative, rounding);
    if (onB.separation > speculative) return false;
    PolytopeAxis<R> edges = bestEdges(a, b, X);

    best.kind = PolytopeAxis<R>::FaceA;
    best.featureA = onA.face;
    best.normal = a.faces[onA.face].normal;
    best.separation = onA.separation;
    if (onB.separation > onA.separation + axisTolerance(size, onA.separation)) {
        best.kind = PolytopeAxis<R>::FaceB;
        best.featureB = onB.face;
        best.normal = -(X.rotation * b.faces[onB.face].normal);
        best.separation = onB.separation;
    }
    const R needed = best.separation + axisTolerance(size, best.separation);
    if (edges.featureA >= 0 && edges.separation > needed) {
        edges.separation = separationAlong(a, b, X, edges.normal);
        if (edges.separation > needed) best = edges;
    }
    return best.separation <= speculative;
}

template <class R>
void keepAxis(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
              const ManifoldMemory<Space<R, 3>>& memory, PolytopeAxis<R>& best) {
    using Memory = ManifoldMemory<Space<R, 3>>;
    PolytopeAxis<R> last;
    const auto i = static_cast<int>(memory.featureA), j = static_cast<int>(memory.featureB);
    if (memory.axis == Memory::kFaceA && i < a.faceCount) {
        last.kind = PolytopeAxis<R>::FaceA;
        last.normal = a.faces[i].normal;
    } else if (memory.axis == Memory::kFaceB && j < b.faceCount) {
        last.kind = PolytopeAxis<R>::FaceB;
        last.normal = -(X.rotation * b.faces[j].normal);
    } else if (memory.axis == Memory::kEdges && best.kind == PolytopeAxis<R>::Edges && i < a.edgeCount &&
               j < b.edgeCount) {
        const HullEdge &ea = a.edges[i], &eb = b.edges[j];
        const Vec3<R> da = a.vertices[ea.v1] - a.vertices[ea.v0];
        const Vec3<R> db = X.rotation * (b.vertices[eb.v1] - b.vertices[eb.v0]);
        const Vec3<R> n = da.cross(db);
        const R length = n.norm();
        if (!(length > kParallel<R> * da.norm() * db.norm())) return;
        last.kind = PolytopeAxis<R>::Edges;
        last.normal =
            n * ((n.dot(a.faces[ea.left].normal + a.faces[ea.right].normal) < 0 ? R(-1) : R(1)) / length);
    } else {
        return;
    }
    last.featureA = i, last.featureB = j;
    last.separation = separationAlong(a, b, X, last.normal);
    last.kept = last.separation < best.separation;
    if (last.separation >= best.separation - kKeep<R> * std::min(a.size, b.size)) best = last;
}

template void keepAxis<float>(const Polytope<float>&, const Polytope<float>&, const Relative<float>&,
                              const ManifoldMemory<Space3f>&, PolytopeAxis<float>&);
template void keepAxis<double>(const Polytope<double>&, const Polytope<double>&, const Relative<double>&,
                               const ManifoldMemory<Space3d>&, PolytopeAxis<double>&);
template bool polytopeAxis<float>(const Polytope<float>&, const Polytope<float>&, const Relative<float>&,
                                  float, PolytopeAxis<float>&);
template bool polytopeAxis<double>(const Polytope<double>&, const Polytope<double>&, const Relative<double>&,
                                   double, PolytopeAxis<double>&);

}  // namespace rigor::engine
