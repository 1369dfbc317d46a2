// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convex polygons and capsules in 2D against each other: separating axes over edge normals, then the
// incident edge clipped to the reference edge [Ericson2005, ch. 5.2; Gregorius2013].
//
// A capsule is a polygon of two vertices (both edge normals of its segment) with a rounding radius, a segment
// one without. For
// overlapping cores the edge normals are all facet normals of the Minkowski difference, so the best of them
// is the exact penetration. For separated cores with a rounding radius the closest pair of features gives
// the exact distance and normal; it always has a vertex. Sharp polygons apart keep the best edge normal: a
// separating axis whose separation bounds the distance from below, without the jumps of corner normals.
// Cost O(n m) per pair.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

template <class R>
struct PolygonView {
    const Vec2<R>* vertices;
    const Vec2<R>* normals;
    int count;
    R radius;
    /// The vertex after vertex i.
    int next(int i) const { return i + 1 == count ? 0 : i + 1; }
};

template <class R>
struct Storage {
    std::array<Vec2<R>, 4> vertices, normals;
};

template <class R>
PolygonView<R> view(const Box<Space<R, 2>>& s, Storage<R>& store) {
    const R x = s.halfExtents.x(), y = s.halfExtents.y();
    store.vertices = {Vec2<R>(-x, -y), Vec2<R>(x, -y), Vec2<R>(x, y), Vec2<R>(-x, y)};
    store.normals = {Vec2<R>(0, -1), Vec2<R>(1, 0), Vec2<R>(0, 1), Vec2<R>(-1, 0)};
    return {store.vertices.data(), store.normals.data(), 4, R(0)};
}
template <class R>
PolygonView<R> view(const Capsule<Space<R, 2>>& s, Storage<R>& store) {
    store.vertices[0] = {0, -s.halfLength};
    store.vertices[1] = {0, s.halfLength};
    store.normals[0] = {1, 0};
    store.normals[1] = {-1, 0};
    return {store.vertices.data(), store.normals.data(), 2, s.radius};
}
template <class R>
PolygonView<R> view(const Hull<Space<R, 2>>& s, Storage<R>&) {
    const auto& d = *s.data;
    return {d.vertices.data(), d.normals.data(), static_cast<int>(d.vertices.size()), R(0)};
}

/// Both sides of a segment are edges of it.
template <class R>
PolygonView<R> view(const Segment<Space<R, 2>>& s, Storage<R>& store) {
    const Vec2<R> d = (s.b - s.a).normalized();
    store.vertices[0] = s.a;
    store.vertices[1] = s.b;
    store.normals[0] = {d.y(), -d.x()};
    store.normals[1] = {-d.y(), d.x()};
    return {store.vertices.data(), store.normals.data(), 2, R(0)};
}

template <class R>
R sizeOf(const PolygonView<R>& p) {
    R size = p.radius;
    for (int i = 0; i < p.count; ++i) size = std::max(size, p.vertices[i].cwiseAbs().maxCoeff());
    return size;
}

template <class R>
struct EdgeAxis {
    int edge = 0;
    R separation = -std::numeric_limits<R>::max();
};

/// The edge of `a` whose outward normal separates the cores most; `X` is the pose of b in the frame of a.
template <class R>
EdgeAxis<R> bestEdge(const PolygonView<R>& a, const PolygonView<R>& b, const Pose<Space<R, 2>>& X,
                     R tolerance) {
    EdgeAxis<R> best;
    for (int i = 0; i < a.count; ++i) {
        const R s = edgeSeparation(a, b, X, i);
        // An edge must be better by more than rounding, or opposite edges would take turns.
        if (i == 0 || s > best.separation + tolerance) best = {i, s};
    }
    return best;
}

/// The separation along edge i of `a`.
template <class R>
R edgeSeparation(const PolygonView<R>& a, const PolygonView<R>& b, const Pose<Space<R, 2>>& X, int i) {
    const Vec2<R> n = rotateInverse<R>(X.q, a.normals[i]);
    R s = std::numeric_limits<R>::max();
    for (int j = 0; j < b.count; ++j) s = std::min(s, n.dot(b.vertices[j]));
    return s + a.normals[i].dot(X.p - a.vertices[i]);
}

template <class R>
struct Closest {
    R squared = std::numeric_limits<R>::max();
    int vertex = 0, edge = 0;
    int corner = -1;  ///< the vertex of the edge that is nearest, -1: its interior
    bool vertexOnB = true;
};

/// Vertices of q (posed by X in the frame of p) against edges of p.
template <class R>
void closestVertex(const PolygonView<R>& p, const PolygonView<R>& q, const Pose<Space<R, 2>>& X,
                   bool vertexOnB, Closest<R>& best) {
    for (int j = 0; j < q.count; ++j) {
        const Vec2<R> x = toWorld<Space<R, 2>>(X, q.vertices[j]);
        for (int i = 0; i < p.count; ++i) {
            const Vec2<R> v = p.vertices[i], e = p.vertices[p.next(i)] - v;
            const R t = e.dot(x - v) / e.squaredNorm();
            const R clamped = std::clamp(t, R(0), R(1));
            const R squared = (x - v - clamped * e).squaredNorm();
            // The normal of the back edge of a capsule's segment would point the wrong way.
            if (squared < best.squared && p.normals[i].dot(x - v) >= 0) {
                best.squared = squared;
                best.vertex = j;
                best.edge = i;
                best.vertexOnB = vertexOnB;
                best.corner = t <= 0 ? i : (t >= 1 ? p.next(i) : -1);
            }
        }
    }
}

/// False if the segments of two capsules cross: then their four side tests disagree strictly.
template <class R>
bool coresApart(const PolygonView<R>& a, const PolygonView<R>& b, const Pose<Space<R, 2>>& X) {
    const Vec2<R> p = a.vertices[0], d = a.vertices[1] - p;
    const Vec2<R> q0 = toWorld<Space<R, 2>>(X, b.vertices[0]), q1 = toWorld<Space<R, 2>>(X, b.vertices[1]);
    const Vec2<R> e = q1 - q0;
    const R s0 = cross(d, Vec2<R>(q0 - p)), s1 = cross(d, Vec2<R>(q1 - p));
    const R t0 = cross(e, Vec2<R>(p - q0)), t1 = cross(e, Vec2<R>(p + d - q0));
    return !(s0 * s1 < 0 && t0 * t1 < 0);
}

/// Everything a manifold is made from, in the frame of the reference polygon.
template <class R>
struct Reference {
    const PolygonView<R>& ref;
    const PolygonView<R>& inc;
    Pose<Space<R, 2>> X;  ///< pose of the incident polygon in the frame of the reference polygon
    bool refIsA;
    R speculative;
};

template <class R>
void emitPoint(const Reference<R>& c, const Vec2<R>& n, const Vec2<R>& onInc, R height, std::uint32_t feature,
               Manifold<Space<R, 2>>& out) {
    const R separation = height - c.ref.radius - c.inc.radius;
    if (separation > c.speculative || out.count == 2) return;
    const Vec2<R> pInc = onInc - c.inc.radius * n, pRef = onInc - (height - c.ref.radius) * n;
    addPoint<Space<R, 2>>(out, c.refIsA ? pRef : pInc, c.refIsA ? pInc : pRef, separation, feature);
}

/// Puts back the incident vertex that has the separation of the axis if no clipped point has it (thin
/// polygons that cross, with rounded normals).
template <class R>
void restoreDeepest(const Reference<R>& c, int edge, R separation, R tolerance, Manifold<Space<R, 2>>& out) {
    for (int i = 0; i < out.count; ++i) {
        const R s = out.points[i].separation;
        if (s + c.ref.radius + c.inc.radius <= separation + R(4) * tolerance) return;
    }
    const Vec2<R> n = c.ref.normals[edge], v0 = c.ref.vertices[edge];
    const auto height = [&](int i) { return R(n.dot(toWorld<Space<R, 2>>(c.X, c.inc.vertices[i]) - v0)); };
    int deepest = 0;
    for (int i = 1; i < c.inc.count; ++i)
        if (height(i) < height(deepest)) deepest = i;
    if (out.count == 2) --out.count;
    emitPoint<R>(c, n, toWorld<Space<R, 2>>(c.X, c.inc.vertices[deepest]), height(deepest),
                 vertexFeature(!c.refIsA, deepest), out);
}

/// The incident edge clipped to the strip over the reference edge. Fills `out` in the frame of the reference.
template <class R>
void clipEdges(const Reference<R>& c, int edge, Manifold<Space<R, 2>>& out) {
    const Vec2<R> n = c.ref.normals[edge];
    const Vec2<R> nLocal = rotateInverse<R>(c.X.q, n);
    int incident = 0;
    for (int i = 1; i < c.inc.count; ++i)
        if (c.inc.normals[i].dot(nLocal) < c.inc.normals[incident].dot(nLocal)) incident = i;
    const int i0 = incident, i1 = c.inc.next(incident);
    const int r0 = edge, r1 = c.ref.next(edge);
    const Vec2<R> v0 = c.ref.vertices[r0], side = c.ref.vertices[r1] - v0;
    const R length = side.norm();
    const Vec2<R> along = side / length;
    Vec2<R> p = toWorld<Space<R, 2>>(c.X, c.inc.vertices[i0]);
    Vec2<R> q = toWorld<Space<R, 2>>(c.X, c.inc.vertices[i1]);
    std::uint32_t fp = vertexFeature(!c.refIsA, i0), fq = vertexFeature(!c.refIsA, i1);
    R tp = along.dot(p - v0), tq = along.dot(q - v0);  // tp > tq: counter-clockwise edges face each other
    const R hp = n.dot(p - v0), hq = n.dot(q - v0);
    out.normal = c.refIsA ? n : Vec2<R>(-n);
    if (tp < 0 || tq > length || !(tp - tq > kRounding<R> * length)) {
        // Nothing over the edge (a corner beside it), or the incident edge stands upright: the lower end.
        const bool first = hp <= hq;
        emitPoint<R>(c, n, first ? p : q, first ? hp : hq, first ? fp : fq, out);
        return;
    }
    const Vec2<R> p0 = p, d = q - p;
    const R t0 = tp, slope = R(1) / (tq - tp);
    if (tp > length) {
        p = p0 + (length - t0) * slope * d;
        fp = vertexFeature(c.refIsA, r1);
    }
    if (tq < 0) {
        q = p0 - t0 * slope * d;
        fq = vertexFeature(c.refIsA, r0);
    }
    emitPoint<R>(c, n, p, n.dot(p - v0), fp, out);
    emitPoint<R>(c, n, q, n.dot(q - v0), fq, out);
}

/// `a` and `b` in the frame of a; fills `out` in the world.
template <class R>
void collidePolygons(const PolygonView<R>& a, const Pose<Space<R, 2>>& Xa, const PolygonView<R>& b,
                     const Pose<Space<R, 2>>& Xb, R speculative, Manifold<Space<R, 2>>& out) {
    using S = Space<R, 2>;
    const Pose<S> XAB = relativePose<S>(Xa, Xb), XBA = relativePose<S>(Xb, Xa);
    const R radius = a.radius + b.radius;
    const R sizeA = sizeOf(a), sizeB = sizeOf(b);
    const R tolerance = kRounding<R> * std::max({sizeA, sizeB, XAB.p.cwiseAbs().maxCoeff()});
    const EdgeAxis<R> onA = bestEdge(a, b, XAB, tolerance);
    out.separationLowerBound = onA.separation - radius;
    if (out.separationLowerBound > speculative) return;
    const EdgeAxis<R> onB = bestEdge(b, a, XBA, tolerance);
    out.separationLowerBound = std::max(out.separationLowerBound, onB.separation - radius);
    if (out.separationLowerBound > speculative) return;
    bool refIsA = onB.separation <= onA.separation + tolerance;
    int edge = refIsA ? onA.edge : onB.edge;
    const R widest = refIsA ? onA.separation : onB.separation;
    R separation = widest;
    // The edge of the last step stays while it is as good within kKeep.
    using Memory = ManifoldMemory<S>;
    const bool lastIsA = out.memory.axis == Memory::kFaceA;
    const auto last = static_cast<int>(lastIsA ? out.memory.featureA : out.memory.featureB);
    if (out.memory.axis != Memory::kNoAxis && last < (lastIsA ? a : b).count) {
        const R s = lastIsA ? edgeSeparation(a, b, XAB, last) : edgeSeparation(b, a, XBA, last);
        if (s >= widest - kKeep<R> * std::min(sizeA, sizeB)) {
            refIsA = lastIsA;
            edge = last;
            separation = s;
        }
    }

    const bool segments = a.count == 2 && b.count == 2;
    const bool apart = segments ? coresApart(a, b, XAB) : widest > tolerance;
    if (radius > 0 && apart) {
        Closest<R> closest;
        closestVertex(a, b, XAB, true, closest);
        closestVertex(b, a, XBA, false, closest);
        const bool touching = closest.squared <= tolerance * tolerance;
        if (!touching && closest.corner >= 0) {
            const int va = closest.vertexOnB ? closest.corner : closest.vertex;
            const int vb = closest.vertexOnB ? closest.vertex : closest.corner;
            roundedPoint<S>(a.vertices[va], a.radius, toWorld<S>(XAB, b.vertices[vb]), b.radius,
                            a.normals[va], speculative, vertexFeature(false, vb), out);
            toWorldFrame<S>(out, Xa);
            out.memory.axis = Memory::kNoAxis;
            return;
        }
        if (!touching) {
            refIsA = closest.vertexOnB;
            edge = closest.edge;
        }
    }
    out.memory.axis = refIsA ? Memory::kFaceA : Memory::kFaceB;
    out.memory.featureA = out.memory.featureB = static_cast<std::uint32_t>(edge);
    const Reference<R> c =
        refIsA ? Reference<R>{a, b, XAB, true, speculative} : Reference<R>{b, a, XBA, false, speculative};
    clipEdges<R>(c, edge, out);
    // The deepest vertex can be beside an edge that is not the best axis.
    if (separation < -tolerance && !apart && (separation == widest || out.count == 0))
        restoreDeepest<R>(c, edge, separation, tolerance, out);
    toWorldFrame<S>(out, refIsA ? Xa : Xb);
}

}  // namespace

/// The centre against the edge of largest separation: inside or over the edge the edge's normal, beside it
/// the corner.
template <class R>
void collidePair(const Sphere<Space<R, 2>>& a, const Pose<Space<R, 2>>& Xa, const Hull<Space<R, 2>>& b,
                 const Pose<Space<R, 2>>& Xb, typename Space<R, 2>::Real speculative,
                 Manifold<Space<R, 2>>& out) {
    using S = Space<R, 2>;
    Storage<R> unused;
    const PolygonView<R> p = view<R>(b, unused);
    const Vec2<R> c = rotateInverse<R>(Xb.q, Xa.p - Xb.p);
    int edge = 0;
    R height = -std::numeric_limits<R>::max();
    for (int i = 0; i < p.count; ++i)
        if (const R h = p.normals[i].dot(c - p.vertices[i]); h > height) {
            height = h;
            edge = i;
        }
    if (height - a.radius > speculative) return;
    // A centre inside keeps the edge of the last step while it is as near within kKeep.
    const auto last = static_cast<int>(out.memory.featureB);
    if (height <= 0 && out.memory.axis == ManifoldMemory<S>::kFaceB && last < p.count) {
        const R h = p.normals[last].dot(c - p.vertices[last]);
        if (h >= height - kKeep<R> * std::min(a.radius, sizeOf(p))) {
            height = h;
            edge = last;
        }
    }
    out.memory.axis = ManifoldMemory<S>::kFaceB;
    out.memory.featureB = static_cast<std::uint32_t>(edge);
    const Vec2<R> v = p.vertices[edge], e = p.vertices[p.next(edge)] - v, n = p.normals[edge];
    const R t = e.dot(c - v) / e.squaredNorm();
    if (height > 0 && (t < 0 || t > 1)) {
        const int corner = t < 0 ? edge : p.next(edge);
        roundedPoint<S>(c, a.radius, p.vertices[corner], R(0), -n, speculative, vertexFeature(false, corner),
                        out);
    } else {
        out.normal = -n;
        addPoint<S>(out, c - a.radius * n, c - height * n, height - a.radius,
                    crossingFeature(0, static_cast<std::uint32_t>(edge)));
    }
    toWorldFrame<S>(out, Xb);
}

/// The normal over the segment is the segment's own, exact however near the centre is; it points upwards for
/// a centre on the segment. Beside the segment the nearest point is its end.
template <class R>
void collidePair(const Sphere<Space<R, 2>>& a, const Pose<Space<R, 2>>& Xa, const Segment<Space<R, 2>>& b,
                 const Pose<Space<R, 2>>& Xb, typename Space<R, 2>::Real speculative,
                 Manifold<Space<R, 2>>& out) {
    using S = Space<R, 2>;
    const Vec2<R> c = rotateInverse<R>(Xb.q, Xa.p - Xb.p), e = b.b - b.a;
    const R t = e.dot(c - b.a) / e.squaredNorm();
    if (t > 0 && t < 1) {
        const Vec2<R> across = anyPerpendicular<R>(e);
        const R height = across.dot(c - b.a);
        const Vec2<R> up = height < 0 ? Vec2<R>(-across) : across;
        if (std::abs(height) - a.radius > speculative) return;
        out.normal = -up;
        addPoint<S>(out, c - a.radius * up, c - height * across, std::abs(height) - a.radius, 0);
    } else {
        roundedPoint<S>(c, a.radius, b.a + std::clamp(t, R(0), R(1)) * e, R(0), anyPerpendicular<R>(e),
                        speculative, 0, out);
    }
    toWorldFrame<S>(out, Xb);
}

template <class R>
void collideAlong(const Segment<Space<R, 2>>& segment, bool front, const Shape<Space<R, 2>>& convex,
                  const Pose<Space<R, 2>>& X, typename Space<R, 2>::Real speculative,
                  Manifold<Space<R, 2>>& out, unsigned innerSides) {
    using S = Space<R, 2>;
    out.count = 0;
    Storage<R> store, storeConvex;
    // Rounding must not lose a corner between two segments: inner ends reach a little further.
    Segment<S> piece = segment;
    const R size = std::max(segment.a.cwiseAbs().maxCoeff(), segment.b.cwiseAbs().maxCoeff());
    const Vec2<R> further = R(4) * kRounding<R> * size * (segment.b - segment.a).normalized();
    if (innerSides & 1u) piece.a -= further;
    if (innerSides & 2u) piece.b += further;
    const PolygonView<R> ref = view<R>(piece, store);
    const int edge = front ? 1 : 0;
    out.normal = ref.normals[edge];
    const Vec2<R> along = (piece.b - piece.a).normalized();
    const R length = (piece.b - piece.a).norm();
    const auto inside = [&](const Vec2<R>& x) {
        const R t = along.dot(x - piece.a);
        return t >= 0 && t <= length;
    };
    if (const auto* ball = std::get_if<Sphere<S>>(&convex)) {
        const R s = out.normal.dot(X.p - piece.a) - ball->radius;
        const Vec2<R> x = X.p - ball->radius * out.normal;
        if (s <= speculative && inside(x)) addPoint<S>(out, x - s * out.normal, x, s, 0);
        return;
    }
    std::visit(
        [&]<class Kind>(const Kind& s) {
            if constexpr (!std::is_same_v<Kind, Sphere<S>> && !kStaticOnly<Kind>)
                clipEdges<R>({ref, view<R>(s, storeConvex), X, true, speculative}, edge, out);
        },
        convex);
    // A corner beside the segment is not over it.
    int kept = 0;
    for (int i = 0; i < out.count; ++i) {
        const ManifoldPoint<S>& p = out.points[i];
        const R slack = kRounding<R> * length, t = along.dot(p.pointB - piece.a);
        const bool inner = (p.feature == vertexFeature(true, 0) && innerSides & 1u) ||
                           (p.feature == vertexFeature(true, 1) && innerSides & 2u);
        if (t >= -slack && t <= length + slack && !inner) out.points[kept++] = p;
    }
    out.count = kept;
}

#define PAIR(A, B)                                                                                  \
    template <class R>                                                                              \
    void collidePair(const A<Space<R, 2>>& a, const Pose<Space<R, 2>>& Xa, const B<Space<R, 2>>& b, \
                     const Pose<Space<R, 2>>& Xb, typename Space<R, 2>::Real speculative,           \
                     Manifold<Space<R, 2>>& out) {                                                  \
        Storage<R> storeA, storeB;                                                                  \
        collidePolygons<R>(view<R>(a, storeA), Xa, view<R>(b, storeB), Xb, speculative, out);       \
    }                                                                                               \
    template void collidePair<float>(const A<Space2f>&, const Pose<Space2f>&, const B<Space2f>&,    \
                                     const Pose<Space2f>&, float, Manifold<Space2f>&);              \
    template void collidePair<double>(const A<Space2d>&, const Pose<Space2d>&, const B<Space2d>&,   \
                                      const Pose<Space2d>&, double, Manifold<Space2d>&);
PAIR(Capsule, Capsule)
PAIR(Box, Capsule)
PAIR(Capsule, Hull)
PAIR(Box, Hull)
PAIR(Hull, Hull)
PAIR(Box, Segment)
PAIR(Capsule, Segment)
PAIR(Hull, Segment)
#undef PAIR
#define INSTANTIATE(S)                                                                                      \
    template void collidePair<S::Real>(const Sphere<S>&, const Pose<S>&, const Segment<S>&, const Pose<S>&, \
                                       S::Real, Manifold<S>&);                                              \
    template void collideAlong<S::Real>(const Segment<S>&, bool, const Shape<S>&, const Pose<S>&, S::Real,  \
                                        Manifold<S>&, unsigned);
INSTANTIATE(Space2f)
INSTANTIATE(Space2d)
#undef INSTANTIATE
template void collidePair<float>(const Sphere<Space2f>&, const Pose<Space2f>&, const Hull<Space2f>&,
                                 const Pose<Space2f>&, float, Manifold<Space2f>&);
template void collidePair<double>(const Sphere<Space2d>&, const Pose<Space2d>&, const Hull<Space2d>&,
                                  const Pose<Space2d>&, double, Manifold<Space2d>&);

}  // namespace rigor::engine
