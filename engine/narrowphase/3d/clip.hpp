// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sutherland-Hodgman clipping of one face to the prism that another sweeps along the contact normal, with the
// lines every vertex lies on. Private to this folder.
#pragma once

#include "engine/narrowphase/3d/polytope.hpp"

namespace rigor::engine {

/// Faces with more vertices are thinned out evenly for clipping.
inline constexpr int kFaceVertices = 64;
inline constexpr int kRefSide = 1 << 16;  ///< line numbers from here on are sides of the reference prism
/// Cosine of the largest angle at which a face and a cap or core axis count as flat against each other: 2.5 degrees.
template <class R>
inline constexpr R kFlat = R(0.999);
/// The same for the normal of two edges and the nearer of the two faces that meet along it: 26 degrees. Beyond it
/// crossing edges touch in a point; within it an overlap is a region between two faces, which one point would let turn
/// and sink further in.
template <class R>
inline constexpr R kFlatFaces = R(0.9);

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
        loop.at[k] = place(p.loopVertex(f, i));
        loop.index[k] = p.loops[f.first + i];
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
        if (count < 2 * kFaceVertices) v[count++] = c;
    }
};

/// Keeps what is below the plane m . (x - p) = 0; `line` numbers the plane.
template <class R>
void clip(const ClipPolygon<R>& from, const Vec3<R>& m, const Vec3<R>& p, int line, ClipPolygon<R>& to) {
    to.count = 0;
    for (int i = 0; i < from.count; ++i) {
        ClipVertex<R> a = from.v[i];
        ClipVertex<R> b = from.v[(i + 1) % from.count];
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
    if (!inRef && !outRef) return vertexFeature(!refIsA, inc.index[c.out]);
    if (inRef && outRef) {
        // Two sides of the prism meet at the vertex between them: the end of one, the start of the other.
        const int a = c.in - kRefSide, b = c.out - kRefSide;
        const int vertex = (a + 1) % ref.count == b ? b : a;
        return vertexFeature(refIsA, ref.index[vertex]);
    }
    const std::uint32_t edgeRef = ref.edge((inRef ? c.in : c.out) - kRefSide);
    const std::uint32_t edgeInc = inc.edge(inRef ? c.out : c.in);
    return refIsA ? crossingFeature(edgeRef, edgeInc) : crossingFeature(edgeInc, edgeRef);
}

/// The incident face (as a polygon) inside the prism of the reference face along `outward`, in one of the two
/// buffers.
template <class R>
const ClipPolygon<R>& clipToPrism(const FaceLoop<R>& ref, const FaceLoop<R>& inc, const Vec3<R>& outward,
                                  ClipPolygon<R> (&buffers)[2]) {
    int now = 0;
    for (int i = 0; i < inc.count; ++i) buffers[0].add({inc.at[i], R(0), (i + inc.count - 1) % inc.count, i});
    for (int i = 0; i < ref.count && buffers[now].count > 0; ++i) {
        const Vec3<R>& p = ref.at[i];
        const Vec3<R>& q = ref.at[(i + 1) % ref.count];
        clip<R>(buffers[now], Vec3<R>((q - p).cross(outward)), p, kRefSide + i, buffers[1 - now]);
        now = 1 - now;
    }
    return buffers[now];
}

/// Closest points of two segments p + s d, q + t e, clamped to the segments. For parallel ones, up to
/// rounding, the points face each other.
template <class R>
void closestOnEdges(const Vec3<R>& p, const Vec3<R>& d, const Vec3<R>& q, const Vec3<R>& e, Vec3<R>& onP,
                    Vec3<R>& onQ) {
    const Vec3<R> r = p - q;
    const R dd = d.dot(d), ee = e.dot(e), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
    const R denominator = dd * ee - de * de;
    const bool parallel = !(denominator > R(4) * std::numeric_limits<R>::epsilon() * dd * ee);
    R s = parallel ? R(0.5) : std::clamp((de * er - ee * dr) / denominator, R(0), R(1));
    const R t = std::clamp((de * s + er) / ee, R(0), R(1));
    if (parallel) s = std::clamp((de * t - dr) / dd, R(0), R(1));
    onP = p + s * d;
    onQ = q + t * e;
}

/// Incident face: of the faces that meet at the vertex furthest along `direction`, the one that faces it
/// most. (The best of all faces need not hold that vertex: hulls can be sharp.) `last`, the face of the last
/// step or -1, stays where it faces it as well as that, to a milliradian or so, and holds the vertex within
/// kKeep.
template <class R>
int incidentFace(const Polytope<R>& p, const Vec3<R>& direction, int last = -1) {
    const Vec3<R>& v = p.vertices[deepestAlong(p, direction)];
    int best = 0;
    R facing = -2;
    for (int i = 0; i < p.faceCount; ++i) {
        const HullFace<R>& f = p.faces[i];
        if (f.offset - f.normal.dot(v) > kRounding<R> * p.size) continue;
        if (const R c = f.normal.dot(direction); c > facing) {
            facing = c;
            best = i;
        }
    }
    if (last >= 0 && last < p.faceCount) {
        const HullFace<R>& f = p.faces[last];
        if (f.offset - f.normal.dot(v) <= kKeep<R> * p.size && f.normal.dot(direction) >= facing - R(1e-3))
            return last;
    }
    return best;
}

}  // namespace rigor::engine
