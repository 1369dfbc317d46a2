// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Separating axes of two convex polyhedra. The facets of the Minkowski difference B - A are faces of A, faces
// of B, and those pairs of edges whose arcs cross on the Gauss sphere [Gregorius2013]; the largest separation
// over them is the exact penetration (negative) of overlapping polyhedra, and a lower bound of the distance
// of separated ones.
//   arcs (a, b) of an edge of A and (-c, -d) of one of B cross iff
//     (c . ea)(d . ea) < 0,  (a . eb)(b . eb) < 0,  (c . ea)(b . eb) > 0   (signs with the normals negated)
// Most of them are passed over by a bound. With w any vertex of B, a face i of A (n_i . x = o_i) separates by
// no more than u_i(w) = n_i . w - o_i, and the arc between two faces i and j of A by no more than max(u_i,
// u_j) where that is not positive: n = (a n_i + b n_j) / |a n_i + b n_j| with a + b >= |a n_i + b n_j|. So
// faces are tried in the order of their bounds, each with its own deepest vertex as the next w, and of the
// edges only those count whose bound is above the best face. Cost O(F + V) per face tried, of which there are
// a few; the worst case (concentric) is O(F V + E E).
#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {
namespace {

template <class R>
struct FaceAxis {
    int face = -1;
    R separation = -std::numeric_limits<R>::max();
};

/// Faces of more than this are not bounded, but all tried.
constexpr int kBounded = 256;
/// Vertices of the other polytope that give the bounds of the edges.
constexpr int kWitnesses = 4;

/// Faces of p against vertices of q, posed by X in the frame of p.
template <class R>
struct FaceSearch {
    const Polytope<R>& p;
    const Polytope<R>& q;
    const Relative<R>& X;
    FaceAxis<R> best;
    int witnesses = 0;
    /// u_i of each witness.
    std::array<std::array<R, kBounded>, kWitnesses> height;

    FaceSearch(const Polytope<R>& own, const Polytope<R>& other, const Relative<R>& pose)
        : p(own), q(other), X(pose) {}

    /// The separation of face i; `deepest`: the vertex of q that has it.
    R separation(int i, int& deepest) const {
        const HullFace<R>& f = p.faces[i];
        const Vec3<R> n = X.rotation.transpose() * f.normal;
        R low = n.dot(q.vertices[0]);
        deepest = 0;
        for (int j = 1; j < q.vertexCount; ++j)
            if (const R at = n.dot(q.vertices[j]); at < low) {
                low = at;
                deepest = j;
            }
        return low + f.normal.dot(X.translation) - f.offset;
    }

    /// Every face.
    void tryAll(R stopAbove, R tolerance) {
        for (int i = 0; i < p.faceCount && !(best.separation > stopAbove); ++i) {
            int unused;
            const R s = separation(i, unused);
            if (best.face < 0 || s > best.separation + tolerance) best = {i, s};
        }
    }

    /// The best face, or any that separates by more than `stopAbove`.
    void run(R stopAbove, R tolerance) {
        if (p.faceCount > kBounded) return tryAll(stopAbove, tolerance);
        std::array<R, kBounded> bound, exact;
        const auto faces = static_cast<std::size_t>(p.faceCount);
        for (std::size_t i = 0; i < faces; ++i) {
            bound[i] = std::numeric_limits<R>::max();
            exact[i] = -std::numeric_limits<R>::max();
        }
        R most = -std::numeric_limits<R>::max();
        int next = deepestAlong<R>(q, Vec3<R>(X.rotation.transpose() * -X.translation));
        for (;;) {
            const int face = lower(X.point(q.vertices[next]), bound);
            const auto i = static_cast<std::size_t>(face);
            if (bound[i] < most - tolerance) break;
            exact[i] = separation(face, next);
            bound[i] = -std::numeric_limits<R>::max();
            most = std::max(most, exact[i]);
            if (most > stopAbove) break;
        }
        for (std::size_t i = 0; i < faces; ++i)
            if (exact[i] > best.separation + tolerance) best = {static_cast<int>(i), exact[i]};
    }

    /// Lowers the bounds by one witness; the face of the highest.
    int lower(const Vec3<R>& witness, std::array<R, kBounded>& bound) {
        std::array<R, kBounded>& own = height[std::min(witnesses, kWitnesses - 1)];
        witnesses = std::min(witnesses + 1, kWitnesses);
        int highest = 0;
        R most = -std::numeric_limits<R>::max();
        for (int i = 0; i < p.faceCount; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const HullFace<R>& f = p.faces[i];
            own[k] = f.normal.dot(witness) - f.offset;
            bound[k] = std::min(bound[k], own[k]);
            if (bound[k] > most) {
                most = bound[k];
                highest = i;
            }
        }
        return highest;
    }

    /// Bit w of a face: witness w shows it to separate by no more than `level` <= 0. Two faces with a bit in
    /// common have no edge between them that separates by more.
    void mark(R level, std::array<std::uint8_t, kBounded>& bits) const {
        const auto faces = static_cast<std::size_t>(std::min(p.faceCount, kBounded));
        for (std::size_t i = 0; i < faces; ++i) bits[i] = 0;
        for (int w = 0; w < witnesses; ++w)
            for (std::size_t i = 0; i < faces; ++i)
                bits[i] =
                    static_cast<std::uint8_t>(bits[i] | static_cast<unsigned>(height[w][i] <= level) << w);
    }
};

/// Edges that may separate by more than the best face.
template <class R>
struct EdgeFilter {
    std::array<std::uint8_t, kBounded> bits;
    bool operator()(const HullEdge& e) const {
        return e.left >= kBounded || e.right >= kBounded || (bits[e.left] & bits[e.right]) == 0;
    }
};

/// The separation along `n` over all vertices: never more than there is, whatever rounding made of n.
template <class R>
R separationAlong(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, const Vec3<R>& n) {
    R high = -std::numeric_limits<R>::max(), low = std::numeric_limits<R>::max();
    for (int i = 0; i < a.vertexCount; ++i) high = std::max(high, n.dot(a.vertices[i]));
    const Vec3<R> local = X.rotation.transpose() * n;
    for (int i = 0; i < b.vertexCount; ++i) low = std::min(low, local.dot(b.vertices[i]));
    return low + n.dot(X.translation) - high;
}

/// Edges of A and B in the frame of B.
template <class R>
struct EdgeOfA {
    Vec3<R> p, d, left, right;  ///< start, direction, normals of its faces
    R squared;
};

/// One pair: into `best` where it is a facet of the difference and separates more.
template <class R>
void tryEdges(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, const EdgeOfA<R>& ea, int i,
              int j, PolytopeAxis<R>& best) {
    const HullEdge& eb = b.edges[j];
    const R c = -b.faces[eb.left].normal.dot(ea.d), d = -b.faces[eb.right].normal.dot(ea.d);
    if (c * d >= 0) return;
    const Vec3<R> db = b.vertices[eb.v1] - b.vertices[eb.v0];
    const R l = ea.left.dot(db), r = ea.right.dot(db);
    if (l * r >= 0 || c * r <= 0) return;
    Vec3<R> n = ea.d.cross(db);
    const R squared = n.squaredNorm();
    const R whole = ea.squared * db.squaredNorm();
    if (squared <= kRounding<R> * kRounding<R> * whole) return;
    n *= (n.dot(ea.left + ea.right) < 0 ? R(-1) : R(1)) / std::sqrt(squared);
    R s = n.dot(b.vertices[eb.v0] - ea.p);
    if (s <= best.separation) return;
    if (squared <= kParallel<R> * kParallel<R> * whole) {
        s = separationAlong(a, b, X, Vec3<R>(X.rotation * n));
        if (s <= best.separation) return;
    }
    best.separation = s;
    best.normal = n;
    best.featureA = i;
    best.featureB = j;
}

template <class R>
PolytopeAxis<R> bestEdges(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
                          const EdgeFilter<R>& onA, const EdgeFilter<R>& onB) {
    PolytopeAxis<R> best;
    best.kind = PolytopeAxis<R>::Edges;
    best.featureA = -1;
    const Eigen::Matrix<R, 3, 3> toB = X.rotation.transpose();
    std::array<int, kBounded> ofB;
    for (int j = 0; j < b.edgeCount;) {
        int count = 0;
        for (; j < b.edgeCount && count < kBounded; ++j)
            if (onB(b.edges[j])) ofB[count++] = j;
        if (count == 0) continue;
        for (int i = 0; i < a.edgeCount; ++i) {
            const HullEdge& e = a.edges[i];
            if (!onA(e)) continue;
            const Vec3<R> d = toB * (a.vertices[e.v1] - a.vertices[e.v0]);
            const EdgeOfA<R> ea{toB * (a.vertices[e.v0] - X.translation), d, toB * a.faces[e.left].normal,
                                toB * a.faces[e.right].normal, d.squaredNorm()};
            for (int k = 0; k < count; ++k) tryEdges(a, b, X, ea, i, ofB[k], best);
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
    const Relative<R> inverse = X.inverse();
    FaceSearch<R> searchA(a, b, X), searchB(b, a, inverse);
    searchA.run(speculative, rounding);
    const FaceAxis<R> onA = searchA.best;
    best.separation = onA.separation;
    if (onA.separation > speculative) return false;
    searchB.run(speculative, rounding);
    const FaceAxis<R> onB = searchB.best;
    best.separation = onB.separation;
    if (onB.separation > speculative) return false;
    EdgeFilter<R> edgesOfA, edgesOfB;
    const R level = std::min(R(0), std::max(onA.separation, onB.separation));
    searchA.mark(level, edgesOfA.bits);
    searchB.mark(level, edgesOfB.bits);
    PolytopeAxis<R> edges = bestEdges(a, b, X, edgesOfA, edgesOfB);

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
    last.featureA = i;
    last.featureB = j;
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
