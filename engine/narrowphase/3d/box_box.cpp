// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box against box: the axis by box_axis.cpp, then what polytope_manifold.cpp does for any two polyhedra, in
// the two coordinates of the reference face. With n the contact normal out of the reference box, k the axis
// of its face, s the side, r its half extents:
//
//   height of x over the face, along n:   h = (s x_k - r_k) / (s n_k)
//   place of x on the face, along n:      u = x_u - h n_u,   v = x_v - h n_v
//
// (u, v, h) of the incident face is a parallelogram, clipped to |u| <= r_u, |v| <= r_v (Sutherland-Hodgman).
// A point then is o + u U + v V on the reference face and h N further on the incident one, with o, U, V, N in
// the world already: three multiplications and additions per coordinate. Axis, memory and
// the names of the points are those of polytope_manifold.cpp.
#include "engine/narrowphase/3d/box_axis.hpp"
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/3d/flat_clip.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// Lines 0 to 3: sides of the incident face, from here on those of the reference face.
constexpr int kRefLine = 4;

int loopVertex(int face, int i) {
    return kBoxLoops[4 * face + (i & 3)];
}
std::uint32_t loopEdge(int face, int i) {
    return edgeName(loopVertex(face, i), loopVertex(face, i + 1));
}
/// True if vertex i is on the positive side along the axis.
bool positive(int vertex, int axis) {
    return ((vertex >> axis) & 1) != 0;
}

/// Reference and incident face of two boxes, in the frame of the reference box.
template <class R>
struct FacePair {
    bool refIsA;
    int refFace, incFace;
    Vec3<R> refHalf, incHalf;
    Eigen::Matrix<R, 3, 3> rotation;  ///< incident box in the frame of the reference box
    Vec3<R> center;
    Vec3<R> outward;  ///< contact normal out of the reference box

    int axis() const { return refFace / 2; }
    int u() const { return axis() == 2 ? 0 : axis() + 1; }
    int v() const { return axis() == 0 ? 2 : axis() - 1; }
    R side() const { return refFace % 2 ? R(1) : R(-1); }
};

/// The incident face in the coordinates (u, v, h) of the reference face.
template <class R>
void layOut(const FacePair<R>& m, FlatPolygon<R>& out) {
    const int k = m.axis(), u = m.u(), v = m.v();
    const R slope = R(1) / m.outward[k];
    const auto flat = [&](const Vec3<R>& x, R height) {
        return Vec3<R>(x[u] - height * m.outward[u], x[v] - height * m.outward[v], height);
    };
    const int across = m.incFace / 2;
    Vec3<R> reach[3];
    for (int i = 0; i < 3; ++i) {
        const Vec3<R> x = m.incHalf[i] * m.rotation.col(i);
        reach[i] = flat(x, x[k] * slope);
    }
    const Vec3<R> center = flat(m.center, (m.side() * m.center[k] - m.refHalf[k]) * (m.side() * slope));
    const Vec3<R> middle = m.incFace % 2 ? Vec3<R>(center + reach[across]) : Vec3<R>(center - reach[across]);
    const int low = across == 0 ? 1 : 0, high = across == 2 ? 1 : 2;
    const Vec3<R> sum = reach[low] + reach[high], difference = reach[low] - reach[high];
    for (int i = 0; i < 4; ++i) {
        const int vertex = loopVertex(m.incFace, i);
        const bool plus = positive(vertex, low);
        const Vec3<R>& corner = plus == positive(vertex, high) ? sum : difference;
        const Vec3<R> x = plus ? Vec3<R>(middle + corner) : Vec3<R>(middle - corner);
        out.set(static_cast<std::size_t>(i), x[0], x[1], x[2], (i + 3) & 3, i);
    }
    out.count = 4;
}

/// The side of face `face` across `axis`: the number of the line in the face's loop.
int sideLine(int face, int axis, bool high) {
    // Side i runs between loop vertices i and i + 1, both on the same side.
    int line = 0;
    for (int i = 0; i < 4; ++i)
        if (positive(loopVertex(face, i), axis) == high && positive(loopVertex(face, i + 1), axis) == high)
            line = i;
    return kRefLine + line;
}

/// True if the part of the incident face lower than `near` over the reference face is all within the prism of
/// the reference face. It is if its corners are, and the points where its sides rise above `near`.
template <class R>
bool withinPrism(const FacePair<R>& m, const FlatPolygon<R>& p, R near) {
    const R u = m.refHalf[m.u()], v = m.refHalf[m.v()];
    for (std::size_t i = 0; i < 4; ++i)
        if (p.h[i] <= near && (std::abs(p.u[i]) > u || std::abs(p.v[i]) > v)) return false;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (i + 1) & 3;
        if ((p.h[i] <= near) == (p.h[k] <= near)) continue;
        const R s = (near - p.h[i]) / (p.h[k] - p.h[i]);
        if (std::abs(p.u[i] + s * (p.u[k] - p.u[i])) > u || std::abs(p.v[i] + s * (p.v[k] - p.v[i])) > v)
            return false;
    }
    return true;
}

/// The incident face inside the prism of the reference face; what is higher than `near` may be outside.
template <class R>
void clipToFace(const FacePair<R>& m, R near, FlatPolygon<R>& polygon) {
    using Polygon = FlatPolygon<R>;
    Polygon between;
    layOut(m, polygon);
    if (withinPrism(m, polygon, near)) return;
    const auto line = [&](int axis, bool high) { return sideLine(m.refFace, axis, high); };
    const int u = m.u(), v = m.v();
    clipFlat<R, &Polygon::u, &Polygon::v>(polygon, m.refHalf[u], line(u, false), line(u, true), between);
    clipFlat<R, &Polygon::v, &Polygon::u>(between, m.refHalf[v], line(v, false), line(v, true), polygon);
}

template <class R>
std::uint32_t featureOf(const FlatVertex<R>& x, const FacePair<R>& m) {
    const bool inRef = x.in >= kRefLine, outRef = x.out >= kRefLine;
    if (!inRef && !outRef) return vertexFeature(!m.refIsA, loopVertex(m.incFace, x.out));
    if (inRef && outRef) {
        // Two sides of the prism meet at the vertex between them: the end of one, the start of the other.
        const int a = x.in - kRefLine, b = x.out - kRefLine;
        return vertexFeature(m.refIsA, loopVertex(m.refFace, (a + 1) % 4 == b ? b : a));
    }
    const std::uint32_t edgeRef = loopEdge(m.refFace, (inRef ? x.in : x.out) - kRefLine);
    const std::uint32_t edgeInc = loopEdge(m.incFace, inRef ? x.out : x.in);
    return m.refIsA ? crossingFeature(edgeRef, edgeInc) : crossingFeature(edgeInc, edgeRef);
}

/// Fills `out` in the world; `ref` is the pose of the reference box. Returns the least separation.
template <class R>
R clipFaces(const FacePair<R>& m, const Pose<Space<R, 3>>& ref, R speculative, Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    FlatPolygon<R> polygon;
    clipToFace<R>(m, speculative, polygon);
    const Eigen::Matrix<R, 3, 3> frame = toMatrix(ref.q);
    const V U = frame.col(m.u()), W = frame.col(m.v()), N = frame * m.outward;
    const V origin = ref.p + (m.side() * m.refHalf[m.axis()]) * frame.col(m.axis());
    out.normal = m.refIsA ? N : V(-N);

    std::array<int, kFlatMost> near;
    int found = 0;
    for (int i = 0; i < polygon.count; ++i) {
        near[found] = i;
        found += polygon.h[i] <= speculative;
    }
    R least = std::numeric_limits<R>::max();
    const auto emit = [&](const FlatVertex<R>& x) {
        const V onRef = origin + (x.u * U + x.v * W), onInc = onRef + x.h * N;
        addPoint<S>(out, m.refIsA ? onRef : onInc, m.refIsA ? onInc : onRef, x.h, featureOf(x, m));
        least = std::min(least, x.h);
    };
    reduceFlat<R>(
        polygon, near, found, m.side(), std::min(m.refHalf.maxCoeff(), m.incHalf.maxCoeff()),
        std::max(m.refHalf[m.u()], m.refHalf[m.v()]), out.memory,
        [&](const FlatVertex<R>& x) { return featureOf(x, m); }, emit);
    return least;
}

/// Incident face: of the faces that meet at the vertex furthest along d, the one that faces d most. `last` is
/// that of the last step or -1, as for incidentFace (clip.hpp).
template <class R>
int incidentBoxFace(const Vec3<R>& half, const Vec3<R>& d, int last) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
    if (last >= 0 && last < 6) {
        const R facing = last % 2 ? d[last / 2] : -d[last / 2];
        const bool holdsVertex = facing >= 0 || R(2) * half[last / 2] <= kKeep<R> * half.maxCoeff();
        if (holdsVertex && facing >= std::abs(d[axis]) - R(1e-3)) return last;
    }
    return 2 * axis + (d[axis] > 0 ? 1 : 0);
}

/// A vertex by its number.
template <class R>
Vec3<R> boxVertex(const Vec3<R>& half, int i) {
    return {positive(i, 0) ? half.x() : -half.x(), positive(i, 1) ? half.y() : -half.y(),
            positive(i, 2) ? half.z() : -half.z()};
}

template <class R>
int betterBoxFace(int edge, const Vec3<R>& d, R& facing) {
    const HullEdge& e = kBoxEdges[edge];
    const auto dot = [&](int face) { return face % 2 ? d[face / 2] : -d[face / 2]; };
    const int face = dot(e.left) >= dot(e.right) ? e.left : e.right;
    facing = dot(face);
    return face;
}

template <class R>
struct Boxes {
    const BoxAxes<R>& axes;
    const Pose<Space<R, 3>>& Xa;
    const PolytopeAxis<R>& axis;
    Manifold<Space<R, 3>>& out;

    void add(const Vec3<R>& onA, const Vec3<R>& onB, std::uint32_t feature) const {
        using S = Space<R, 3>;
        out.normal = rotate(Xa.q, axis.normal);
        addPoint<S>(out, toWorld<S>(Xa, onA), toWorld<S>(Xa, onB), axis.separation, feature);
    }
    /// The closest points of the two edges of the axis.
    void edgePoint() const {
        const HullEdge& ea = kBoxEdges[axis.featureA];
        const HullEdge& eb = kBoxEdges[axis.featureB];
        const Vec3<R> p = boxVertex(axes.halfA, ea.v0), d = boxVertex(axes.halfA, ea.v1) - p;
        const Vec3<R> q = axes.X.point(boxVertex(axes.halfB, eb.v0)),
                      e = axes.X.point(boxVertex(axes.halfB, eb.v1)) - q;
        Vec3<R> onA, onB;
        closestOnEdges<R>(p, d, q, e, onA, onB);
        add(onA, onB, crossingFeature(edgeName(ea.v0, ea.v1), edgeName(eb.v0, eb.v1)));
    }
    /// The vertex of the incident box deepest along the axis: where clipping lost everything to rounding.
    void deepestVertex() const {
        const bool onB = axis.kind == PolytopeAxis<R>::FaceA;
        const Vec3<R> d = onB ? Vec3<R>(axes.X.rotation.transpose() * -axis.normal) : axis.normal;
        const int i = (d.x() > 0 ? 1 : 0) + (d.y() > 0 ? 2 : 0) + (d.z() > 0 ? 4 : 0);
        const Vec3<R> x = onB ? axes.X.point(boxVertex(axes.halfB, i)) : boxVertex(axes.halfA, i);
        const Vec3<R> shift = axis.separation * axis.normal;
        add(onB ? Vec3<R>(x - shift) : x, onB ? x : Vec3<R>(x + shift), vertexFeature(!onB, i));
    }
};

/// The faces that meet along the axis, and their names into the memory. False: two edges cross.
template <class R>
bool findFacePair(const BoxAxes<R>& boxes, const PolytopeAxis<R>& axis, ManifoldMemory<Space<R, 3>>& memory,
                  FacePair<R>& m) {
    using Memory = ManifoldMemory<Space<R, 3>>;
    using Axis = PolytopeAxis<R>;
    const auto number = [](std::uint32_t i) { return static_cast<int>(i); };
    const std::uint8_t kind = axis.kind == Axis::Edges   ? Memory::kEdges
                              : axis.kind == Axis::FaceA ? Memory::kFaceA
                                                         : Memory::kFaceB;
    const Vec3<R> towardsB = boxes.X.rotation.transpose() * axis.normal;
    int faceA = axis.featureA, faceB = axis.featureB;
    m.refIsA = axis.kind != Axis::FaceB;
    if (axis.kind == Axis::Edges) {
        R facingA, facingB;
        faceA = betterBoxFace<R>(axis.featureA, axis.normal, facingA);
        faceB = betterBoxFace<R>(axis.featureB, Vec3<R>(-towardsB), facingB);
        memory.axis = kind;
        memory.featureA = static_cast<std::uint32_t>(axis.featureA);
        memory.featureB = static_cast<std::uint32_t>(axis.featureB);
        // An edge that lies along a face touches it in an interval, as two faces do in a polygon.
        if (std::max(facingA, facingB) < kFlatFaces<R>) return false;
        m.refIsA = facingA >= facingB;
    } else {
        const bool same = memory.axis == kind &&
                          (m.refIsA ? number(memory.featureA) == faceA : number(memory.featureB) == faceB);
        if (m.refIsA)
            faceB = incidentBoxFace<R>(boxes.halfB, Vec3<R>(-towardsB), same ? number(memory.featureB) : -1);
        else
            faceA = incidentBoxFace<R>(boxes.halfA, axis.normal, same ? number(memory.featureA) : -1);
        memory.axis = kind;
        memory.featureA = static_cast<std::uint32_t>(faceA);
        memory.featureB = static_cast<std::uint32_t>(faceB);
    }
    m.refFace = m.refIsA ? faceA : faceB;
    m.incFace = m.refIsA ? faceB : faceA;
    m.refHalf = m.refIsA ? boxes.halfA : boxes.halfB;
    m.incHalf = m.refIsA ? boxes.halfB : boxes.halfA;
    if (m.refIsA) {
        m.rotation = boxes.X.rotation;
        m.center = boxes.X.translation;
    } else {
        m.rotation = boxes.X.rotation.transpose();
        m.center = -boxes.tB;
    }
    if (axis.kind != Axis::Edges)
        m.outward = m.side() * Vec3<R>::Unit(m.axis());
    else
        m.outward = m.refIsA ? axis.normal : Vec3<R>(-towardsB);
    return true;
}

}  // namespace

template <class R>
void collidePair(const Box<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Box<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    const Pose<Space<R, 3>> X = relativePose<Space<R, 3>>(Xa, Xb);
    BoxAxes<R> axes(a.halfExtents, b.halfExtents, {toMatrix(X.q), X.p});
    PolytopeAxis<R> axis;
    if (!axes.find(speculative, axis)) {
        out.separationLowerBound = axis.separation;
        return;
    }
    axes.keep(out.memory, axis);
    const Boxes<R> boxes{axes, Xa, axis, out};
    FacePair<R> faces;
    if (!findFacePair<R>(axes, axis, out.memory, faces)) {
        boxes.edgePoint();
        return;
    }
    const R least = clipFaces<R>(faces, faces.refIsA ? Xa : Xb, speculative, out);
    // The deepest point of overlapping boxes is on both faces; if rounding clipped it away it is put back.
    // Along an axis that is not the best it can be beside them.
    const R size = std::max(a.halfExtents.maxCoeff(), b.halfExtents.maxCoeff());
    if (axis.separation > 0 || (axis.kept && out.count > 0) ||
        least <= axis.separation + R(4) * axisTolerance(size, axis.separation) +
                     keepSlack(out.memory, std::min(a.halfExtents.maxCoeff(), b.halfExtents.maxCoeff())))
        return;
    if (out.count == Space<R, 3>::maxManifoldPoints) --out.count;
    if (axis.kind == PolytopeAxis<R>::Edges)
        boxes.edgePoint();
    else
        boxes.deepestVertex();
}

template void collidePair<float>(const Box<Space3f>&, const Pose<Space3f>&, const Box<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Box<Space3d>&, const Pose<Space3d>&, const Box<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
