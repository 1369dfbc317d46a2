// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points of two polyhedra along a known axis n: the incident face clipped to the prism that the
// reference face sweeps along n (Sutherland-Hodgman), with separations measured along n, reduced to four
// points; or the closest points of two crossing edges.
//
// Deviation: an edge axis along which two faces meet at less than 26 degrees clips the faces as well, along the
// exact edge normal. A stack that rocks then keeps its four points, boxes that fell into each other are parted
// over the whole of their overlap, and the depth and normal stay exact. Every vertex of the clipped polygon remembers the two lines it lies on (edges of the
// incident face, sides of the reference prism); they name its feature, the same whichever face is reference.
#include "engine/narrowphase/3d/clip.hpp"

namespace rigor::engine {
namespace {

/// `outward`: the contact normal, out of the reference face. Fills `out` in the frame of A.
template <class R>
void clipFaces(const FaceLoop<R>& ref, const HullFace<R>& refPlane, const FaceLoop<R>& inc, bool refIsA,
               const PolytopeAxis<R>& axis, R size, R speculative, Manifold<Space<R, 3>>& out) {
    using V = Vec3<R>;
    const V outward = refIsA ? axis.normal : V(-axis.normal);
    ClipPolygon<R> buffers[2];
    const ClipPolygon<R>& polygon = clipToPrism<R>(ref, inc, outward, buffers);
    const R slope = R(1) / refPlane.normal.dot(outward);
    const auto height = [&](const V& x) { return R((refPlane.normal.dot(x) - refPlane.offset) * slope); };
    std::array<int, 2 * kFaceVertices> near;
    int found = 0;
    for (int i = 0; i < polygon.count; ++i)
        if (height(polygon.v[i].x) <= speculative) near[found++] = i;
    const auto vertex = [&](int k) -> const ClipVertex<R>& { return polygon.v[near[k]]; };
    const auto emit = [&](int k) {
        const ClipVertex<R>& c = vertex(k);
        const R h = height(c.x);
        const V onRef = c.x - h * outward;
        addPoint<Space<R, 3>>(out, refIsA ? onRef : c.x, refIsA ? c.x : onRef, h,
                              featureOf(c, ref, inc, refIsA));
    };
    reducePoints<Space<R, 3>>(
        found, outward, size, out.memory, [&](int k) { return height(vertex(k).x); },
        [&](int k) { return vertex(k).x; }, [&](int k) { return featureOf(vertex(k), ref, inc, refIsA); },
        emit);
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
    const int best = deepestAlong<R>(p, n);
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
    using Memory = ManifoldMemory<Space<R, 3>>;
    const auto feature = [](int i) { return static_cast<std::uint32_t>(i); };
    const Memory last = out.memory;
    out.memory.axis = edges                                 ? Memory::kEdges
                      : axis.kind == PolytopeAxis<R>::FaceA ? Memory::kFaceA
                                                            : Memory::kFaceB;
    out.memory.featureA = feature(axis.featureA);
    out.memory.featureB = feature(axis.featureB);
    const bool keepsAxis = last.axis == out.memory.axis &&
                           (axis.kind == PolytopeAxis<R>::FaceA ? last.featureA == feature(axis.featureA)
                                                                : last.featureB == feature(axis.featureB));
    bool refIsA = axis.kind != PolytopeAxis<R>::FaceB;
    if (edges) {
        faceA = betterFace<R>(a, a.edges[axis.featureA], axis.normal);
        faceB = betterFace<R>(b, b.edges[axis.featureB], -towardsB);
        // An edge that lies along a face touches it in an interval, as two faces do in a polygon.
        const R facingA = a.faces[faceA].normal.dot(axis.normal),
                facingB = -b.faces[faceB].normal.dot(towardsB);
        if (std::max(facingA, facingB) < kFlatFaces<R>) {
            edgePoint(a, b, X, axis, out);
            return;
        }
        refIsA = facingA >= facingB;
    } else if (axis.kind == PolytopeAxis<R>::FaceA) {
        faceB = incidentFace<R>(b, -towardsB, keepsAxis ? static_cast<int>(last.featureB) : -1);
    } else {
        faceA = incidentFace<R>(a, axis.normal, keepsAxis ? static_cast<int>(last.featureA) : -1);
    }
    if (!edges) {
        out.memory.featureA = feature(faceA);
        out.memory.featureB = feature(faceB);
    }
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
    clipFaces<R>(refIsA ? loopA : loopB, plane, refIsA ? loopB : loopA, refIsA, axis,
                 std::min(a.size, b.size), speculative, out);
    // The deepest point of overlapping polytopes is on both faces; if rounding clipped it away it is put
    // back. Along an axis that is not the best it can be beside them.
    R least = std::numeric_limits<R>::max();
    for (int i = 0; i < out.count; ++i) least = std::min(least, out.points[i].separation);
    const R size = std::max(a.size, b.size);
    if (axis.separation > 0 || (axis.kept && out.count > 0) ||
        least <= axis.separation + R(4) * axisTolerance(size, axis.separation) +
                     keepSlack(out.memory, std::min(a.size, b.size)))
        return;
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
