// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points of two polyhedra along a known axis n: the incident face clipped to the prism that the
// reference face sweeps along n (Sutherland-Hodgman), with separations measured along n, reduced to four
// points; or the closest points of two crossing edges.
//
// Deviation: an edge axis whose two best faces are nearly flat against each other clips faces as well, along
// the exact edge normal. A stack that rocks by microradians then keeps its four points, and the depth and
// normal stay exact. Every vertex of the clipped polygon remembers the two lines it lies on (edges of the
// incident face, sides of the reference prism); they name its feature, the same whichever face is reference.
#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {
namespace {

/// Faces with more vertices are thinned out evenly for clipping.
constexpr int kFaceVertices = 64;
constexpr int kRefSide = 1 << 16;  ///< line numbers from here on are sides of the reference prism
/// Cosine of the largest angle between two faces (via n) that count as flat against each other: 2.5 degrees.
template <class R>
inline constexpr R kFlat = R(0.999);

template <class R>
struct FaceLoop {
    std::array<Vec3<R>, kFaceVertices> at;  ///< frame of A
    std::array<int, kFaceVertices> index;   ///< vertex of the polytope
    int count = 0;
    std::uint32_t edge(int i) const {
        const auto k = static_cast<std::size_t>(i);
        return edgeName(index[k], index[(k + 1) % static_cast<std::size_t>(count)]);
    }
};

template <class R, class Place>
void loadFace(const Polytope<R>& p, int face, Place place, FaceLoop<R>& loop) {
    const HullFace<R>& f = p.faces[face];
    loop.count = std::min(f.count, kFaceVertices);
    for (int k = 0; k < loop.count; ++k) {
        const int i = f.count <= kFaceVertices ? k : k * f.count / kFaceVertices;
        loop.at[static_cast<std::size_t>(k)] = place(p.loopVertex(f, i));
        loop.index[static_cast<std::size_t>(k)] = p.loops[f.first + i];
    }
}

template <class R>
struct ClipVertex {
    Vec3<R> x;
    R side;       ///< signed distance to the plane being clipped by
    int in, out;  ///< line of the polygon before and after this vertex
};
template <class R>
struct ClipPolygon {
    std::array<ClipVertex<R>, 2 * kFaceVertices> v;
    int count = 0;
    void add(const ClipVertex<R>& c) {
        if (count < 2 * kFaceVertices) v[static_cast<std::size_t>(count++)] = c;
    }
};

/// Keeps what is below the plane m . (x - p) = 0; `line` numbers the plane.
template <class R>
void clip(const ClipPolygon<R>& from, const Vec3<R>& m, const Vec3<R>& p, int line, ClipPolygon<R>& to) {
    to.count = 0;
    for (int i = 0; i < from.count; ++i) {
        ClipVertex<R> a = from.v[static_cast<std::size_t>(i)];
        ClipVertex<R> b = from.v[static_cast<std::size_t>((i + 1) % from.count)];
        a.side = m.dot(a.x - p);
        b.side = m.dot(b.x - p);
        if (a.side <= 0) {
            if (b.side <= 0) {
                to.add(b);
                continue;
            }
            const Vec3<R> x = a.x + (a.side / (a.side - b.side)) * (b.x - a.x);
            to.add({x, R(0), a.out, line});
        } else if (b.side <= 0) {
            const Vec3<R> x = b.x + (b.side / (b.side - a.side)) * (a.x - b.x);
            to.add({x, R(0), line, a.out});
            to.add(b);
        }
    }
}

template <class R>
std::uint32_t featureOf(const ClipVertex<R>& c, const FaceLoop<R>& ref, const FaceLoop<R>& inc, bool refIsA) {
    const bool inRef = c.in >= kRefSide, outRef = c.out >= kRefSide;
    if (!inRef && !outRef) return vertexFeature(!refIsA, inc.index[static_cast<std::size_t>(c.out)]);
    if (inRef && outRef) {
        // Two sides of the prism meet at the vertex between them: the end of one, the start of the other.
        const int a = c.in - kRefSide, b = c.out - kRefSide;
        const int vertex = (a + 1) % ref.count == b ? b : a;
        return vertexFeature(refIsA, ref.index[static_cast<std::size_t>(vertex)]);
    }
    const std::uint32_t edgeRef = ref.edge((inRef ? c.in : c.out) - kRefSide);
    const std::uint32_t edgeInc = inc.edge(inRef ? c.out : c.in);
    return refIsA ? crossingFeature(edgeRef, edgeInc) : crossingFeature(edgeInc, edgeRef);
}

/// `outward`: the contact normal, out of the reference face. Fills `out` in the frame of A.
template <class R>
void clipFaces(const FaceLoop<R>& ref, const HullFace<R>& refPlane, const FaceLoop<R>& inc, bool refIsA,
               const PolytopeAxis<R>& axis, R speculative, Manifold<Space<R, 3>>& out) {
    using V = Vec3<R>;
    const V outward = refIsA ? axis.normal : V(-axis.normal);
    ClipPolygon<R> buffers[2];
    int now = 0;
    for (int i = 0; i < inc.count; ++i)
        buffers[0].add({inc.at[static_cast<std::size_t>(i)], R(0), (i + inc.count - 1) % inc.count, i});
    for (int i = 0; i < ref.count && buffers[now].count > 0; ++i) {
        const V& p = ref.at[static_cast<std::size_t>(i)];
        const V& q = ref.at[static_cast<std::size_t>((i + 1) % ref.count)];
        clip<R>(buffers[now], V((q - p).cross(outward)), p, kRefSide + i, buffers[1 - now]);
        now = 1 - now;
    }
    const ClipPolygon<R>& polygon = buffers[now];
    const R slope = R(1) / refPlane.normal.dot(outward);
    const auto height = [&](const V& x) { return R((refPlane.normal.dot(x) - refPlane.offset) * slope); };
    std::array<int, 2 * kFaceVertices> near;
    int found = 0;
    for (int i = 0; i < polygon.count; ++i)
        if (height(polygon.v[static_cast<std::size_t>(i)].x) <= speculative)
            near[static_cast<std::size_t>(found++)] = i;
    const auto vertex = [&](int k) -> const ClipVertex<R>& {
        return polygon.v[static_cast<std::size_t>(near[static_cast<std::size_t>(k)])];
    };
    const auto emit = [&](int k) {
        const ClipVertex<R>& c = vertex(k);
        const R h = height(c.x);
        const V onRef = c.x - h * outward;
        addPoint<Space<R, 3>>(out, refIsA ? onRef : c.x, refIsA ? c.x : onRef, h,
                              featureOf(c, ref, inc, refIsA));
    };
    reducePoints<Space<R, 3>>(
        found, outward, [&](int k) { return height(vertex(k).x); }, [&](int k) { return vertex(k).x; }, emit);
}

/// Closest points of two segments p + s d, q + t e that are not parallel; clamped to the segments.
template <class R>
void closestOnEdges(const Vec3<R>& p, const Vec3<R>& d, const Vec3<R>& q, const Vec3<R>& e, Vec3<R>& onP,
                    Vec3<R>& onQ) {
    const Vec3<R> r = p - q;
    const R dd = d.dot(d), ee = e.dot(e), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
    const R denominator = dd * ee - de * de;
    const R s = std::clamp((de * er - ee * dr) / denominator, R(0), R(1));
    const R t = std::clamp((de * s + er) / ee, R(0), R(1));
    onP = p + s * d;
    onQ = q + t * e;
}

template <class R>
int deepestIndex(const Polytope<R>& p, const Vec3<R>& direction) {
    int best = 0;
    for (int i = 1; i < p.vertexCount; ++i)
        if (p.vertices[i].dot(direction) > p.vertices[best].dot(direction)) best = i;
    return best;
}

/// Of the faces that meet at the vertex furthest along `direction`, the one that faces it most. (The best of
/// all faces need not hold that vertex: hulls can be sharp.)
template <class R>
int incidentFace(const Polytope<R>& p, const Vec3<R>& direction) {
    const Vec3<R>& v = p.vertices[deepestIndex(p, direction)];
    int best = 0;
    R facing = -2;
    for (int i = 0; i < p.faceCount; ++i) {
        const HullFace<R>& f = p.faces[i];
        if (f.offset - f.normal.dot(v) > kRounding<R> * p.size) continue;
        if (const R c = f.normal.dot(direction); c > facing) facing = c, best = i;
    }
    return best;
}

template <class R>
int betterFace(const Polytope<R>& p, const HullEdge& e, const Vec3<R>& direction) {
    return p.faces[e.left].normal.dot(direction) >= p.faces[e.right].normal.dot(direction) ? e.left : e.right;
}

template <class R>
void edgePoint(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, const PolytopeAxis<R>& axis,
               Manifold<Space<R, 3>>& out) {
    const HullEdge& ea = a.edges[axis.featureA];
    const HullEdge& eb = b.edges[axis.featureB];
    const Vec3<R> p = a.vertices[ea.v0], d = a.vertices[ea.v1] - p;
    const Vec3<R> q = X.point(b.vertices[eb.v0]), e = X.point(b.vertices[eb.v1]) - q;
    Vec3<R> onA, onB;
    closestOnEdges<R>(p, d, q, e, onA, onB);
    addPoint<Space<R, 3>>(out, onA, onB, axis.separation,
                          crossingFeature(edgeName(ea.v0, ea.v1), edgeName(eb.v0, eb.v1)));
}

/// The vertex of B (or A) deepest along the axis: where clipping lost everything to rounding.
template <class R>
void deepestVertex(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
                   const PolytopeAxis<R>& axis, Manifold<Space<R, 3>>& out) {
    const bool vertexOnB = axis.kind == PolytopeAxis<R>::FaceA;
    const Polytope<R>& p = vertexOnB ? b : a;
    const Vec3<R> n = vertexOnB ? Vec3<R>(X.rotation.transpose() * -axis.normal) : axis.normal;
    const int best = deepestIndex<R>(p, n);
    const Vec3<R> x = vertexOnB ? X.point(p.vertices[best]) : p.vertices[best];
    const Vec3<R> shift = axis.separation * axis.normal;
    addPoint<Space<R, 3>>(out, vertexOnB ? Vec3<R>(x - shift) : x, vertexOnB ? x : Vec3<R>(x + shift),
                          axis.separation, vertexFeature(!vertexOnB, best));
}

}  // namespace

template <class R>
void polytopeManifold(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
                      const PolytopeAxis<R>& axis, R speculative, Manifold<Space<R, 3>>& out) {
    using V = Vec3<R>;
    out.normal = axis.normal;
    const V towardsB = X.rotation.transpose() * axis.normal;
    const bool edges = axis.kind == PolytopeAxis<R>::Edges;
    int faceA = axis.featureA, faceB = axis.featureB;
    if (edges) {
        faceA = betterFace<R>(a, a.edges[axis.featureA], axis.normal);
        faceB = betterFace<R>(b, b.edges[axis.featureB], -towardsB);
        if (a.faces[faceA].normal.dot(axis.normal) < kFlat<R> ||
            -b.faces[faceB].normal.dot(towardsB) < kFlat<R>) {
            edgePoint(a, b, X, axis, out);
            return;
        }
    } else if (axis.kind == PolytopeAxis<R>::FaceA) {
        faceB = incidentFace<R>(b, -towardsB);
    } else {
        faceA = incidentFace<R>(a, axis.normal);
    }
    const bool refIsA = axis.kind != PolytopeAxis<R>::FaceB;
    FaceLoop<R> loopA, loopB;
    loadFace(
        a, faceA, [](const V& v) { return v; }, loopA);
    loadFace(
        b, faceB, [&](const V& v) { return X.point(v); }, loopB);
    HullFace<R> plane = refIsA ? a.faces[faceA] : b.faces[faceB];
    if (!refIsA) {
        plane.normal = X.direction(plane.normal);
        plane.offset += plane.normal.dot(X.translation);
    }
    clipFaces<R>(refIsA ? loopA : loopB, plane, refIsA ? loopB : loopA, refIsA, axis, speculative, out);
    // Of overlapping polytopes the deepest point is on both faces; where rounding clipped it away it is put
    // back.
    R least = std::numeric_limits<R>::max();
    for (int i = 0; i < out.count; ++i)
        least = std::min(least, out.points[static_cast<std::size_t>(i)].separation);
    const R size = std::max(a.size, b.size);
    if (axis.separation > 0 || least <= axis.separation + R(4) * axisTolerance(size, axis.separation)) return;
    if (out.count == Space<R, 3>::maxManifoldPoints) --out.count;
    if (edges)
        edgePoint(a, b, X, axis, out);
    else
        deepestVertex(a, b, X, axis, out);
}

template void polytopeManifold<float>(const Polytope<float>&, const Polytope<float>&, const Relative<float>&,
                                      const PolytopeAxis<float>&, float, Manifold<Space3f>&);
template void polytopeManifold<double>(const Polytope<double>&, const Polytope<double>&,
                                       const Relative<double>&, const PolytopeAxis<double>&, double,
                                       Manifold<Space3d>&);

}  // namespace rigor::engine
