// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box against capsule: a segment x(s) = p + s d, s in [0, 1], with a rounding radius, in the frame of the
// box, half extents h.
//
//   cores apart: by e_i = x_i - clamp(x_i, -h_i, h_i) the point sticks out of the box. Its squared distance
//     |e(s)|^2 is convex in s, and half its slope, d . e(s), rises in straight pieces between the s at which
//     a coordinate of x passes -h_i or h_i. The piece in which it passes zero has the closest point: exact.
//   cores overlapping: the axis of largest separation over the facets of the Minkowski difference, the faces
//     of the box and e_k x d for its edges along k. Along n the box reaches |n| . h from its centre
//     [Ericson2005, ch. 4.4.1].
// A segment that lies along a face gets two points: its ends clipped to the prism of the face along the
// contact normal. rounded_polytope.cpp does the same for any convex hull, feature by feature.
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// The core of the capsule in the frame of the box.
template <class R>
struct Core {
    Vec3<R> h;     ///< half extents of the box [m]
    Vec3<R> p, d;  ///< start of the segment, and from there to its end [m]

    Vec3<R> at(R s) const { return p + s * d; }
    Vec3<R> excess(const Vec3<R>& x) const { return x - x.cwiseMax(-h).cwiseMin(h); }
    R slope(R s) const { return d.dot(excess(at(s))); }
};

/// The box's edge along axis k on the sides of n, by the vertex at its low end: bit i is set where n_i > 0.
template <class R>
int edgeVertex(int k, const Vec3<R>& n) {
    int vertex = 0;
    for (int i = 0; i < 3; ++i)
        if (i != k && n[i] > 0) vertex |= 1 << i;
    return vertex;
}
std::uint32_t edgeFeature(int k, int vertex) {
    return crossingFeature(edgeName(vertex, vertex | 1 << k), 0);
}

/// s of the point of the segment that is closest to the box.
template <class R>
R closestOnCore(const Core<R>& core) {
    R low = 0, high = 1, atLow = core.slope(low), atHigh = core.slope(high);
    if (atLow >= 0) return low;
    if (atHigh <= 0) return high;
    for (int i = 0; i < 3; ++i)
        for (const R side : {-core.h[i], core.h[i]}) {
            const R s = (side - core.p[i]) / core.d[i];
            if (!(s > low && s < high)) continue;
            const R slope = core.slope(s);
            if (slope > 0) {
                high = s;
                atHigh = slope;
            } else {
                low = s;
                atLow = slope;
            }
        }
    return low + (high - low) * (atLow / (atLow - atHigh));
}

/// Closest points of separate cores, or the least overlap of overlapping ones.
template <class R>
struct AxisContact {
    Vec3<R> normal;  ///< unit, out of the box
    R distance;      ///< distance of the cores [m]; negative: they overlap
    Vec3<R> point;   ///< point of the segment
    std::uint32_t feature;
};

/// Closest points of cores whose distance is more than `tolerance`.
template <class R>
AxisContact<R> closestPoints(const Core<R>& core, R tolerance) {
    const R s = closestOnCore(core);
    AxisContact<R> c;
    c.point = core.at(s);
    const Vec3<R> e = core.excess(c.point);
    c.distance = e.norm();
    c.normal = e / c.distance;
    c.feature = vertexFeature(false, s < R(0.5) ? 0 : 1);
    if (s <= 0 || s >= 1) return c;
    int out = 0, within = 0;
    for (int i = 0; i < 3; ++i)
        if (std::abs(e[i]) > tolerance)
            ++out;
        else
            within = i;
    if (out == 3) c.feature = vertexFeature(true, edgeVertex(-1, e));
    if (out != 2) return c;
    // Two edges that cross fix the normal better than the difference of two points close together.
    c.feature = edgeFeature(within, edgeVertex(within, e));
    const Vec3<R> across = Vec3<R>::Unit(within).cross(core.d);
    const R length = across.norm();
    if (length > R(1e-3) * core.d.norm()) c.normal = across * ((across.dot(e) < 0 ? R(-1) : R(1)) / length);
    return c;
}

/// A facet of the Minkowski difference.
template <class R>
struct CapsuleAxis {
    Vec3<R> normal;  ///< unit, out of the box
    R separation = -std::numeric_limits<R>::max();
    int face = -1;             ///< 0 to 5: -x, +x, -y, ...
    int edge = -1, along = 0;  ///< edgeVertex and axis of an edge
};

template <class R>
CapsuleAxis<R> faceAxis(const Core<R>& core, int axis, bool high) {
    const R side = high ? R(1) : R(-1);
    const R first = side * core.p[axis], last = first + side * core.d[axis];
    return {side * Vec3<R>::Unit(axis), std::min(first, last) - core.h[axis], 2 * axis + high};
}
/// e_k x d, out of the box on the side where `outward` points; false where edge and core are parallel.
template <class R>
bool edgeAxis(const Core<R>& core, int k, const Vec3<R>& outward, CapsuleAxis<R>& axis) {
    Vec3<R> n = Vec3<R>::Unit(k).cross(core.d);
    const R length = n.norm();
    if (!(length > kRounding<R> * core.d.norm())) return false;
    n *= (n.dot(outward) < 0 ? R(-1) : R(1)) / length;
    axis = {n, n.dot(core.p) - n.cwiseAbs().dot(core.h), -1, edgeVertex(k, n), k};
    return true;
}

/// The best face. The first of equal ones is taken.
template <class R>
CapsuleAxis<R> bestFace(const Core<R>& core, R tolerance) {
    CapsuleAxis<R> best;
    const Vec3<R> middle = core.at(R(0.5));
    for (int i = 0; i < 3; ++i)
        if (const CapsuleAxis<R> face = faceAxis(core, i, middle[i] >= 0);
            face.separation > best.separation + tolerance)
            best = face;
    return best;
}
/// Puts an edge in the place of `best` where that is better.
template <class R>
void tryEdges(const Core<R>& core, R tolerance, CapsuleAxis<R>& best) {
    const Vec3<R> middle = core.at(R(0.5));
    CapsuleAxis<R> axis;
    for (int k = 0; k < 3; ++k)
        if (edgeAxis(core, k, middle, axis) && axis.separation > best.separation + tolerance) best = axis;
}

/// The face or edge that `memory` names in the place of the best where it is as good within `slack`: an edge
/// gives way to a face, not the other way round.
template <class R>
void keepAxis(const Core<R>& core, const ManifoldMemory<Space<R, 3>>& memory, R slack, CapsuleAxis<R>& best) {
    using Memory = ManifoldMemory<Space<R, 3>>;
    CapsuleAxis<R> last;
    const auto i = static_cast<int>(memory.featureA);
    if (memory.axis == Memory::kFaceA && i < 6) {
        last = faceAxis(core, i / 2, i % 2 == 1);
    } else if (memory.axis == Memory::kEdges && best.edge >= 0 && i < 24) {
        Vec3<R> outward;
        for (int k = 0; k < 3; ++k) outward[k] = k == i / 8 ? R(0) : ((i >> k) & 1) != 0 ? R(1) : R(-1);
        if (!edgeAxis(core, i / 8, outward, last)) return;
    }
    if (last.separation >= best.separation - slack) best = last;
}

/// The point of the core that is deepest along the axis.
template <class R>
AxisContact<R> deepestPoint(const Core<R>& core, const CapsuleAxis<R>& axis) {
    if (axis.edge < 0) {
        const bool end = axis.normal.dot(core.d) < 0;
        return {axis.normal, axis.separation, core.at(end ? R(1) : R(0)), vertexFeature(false, end ? 1 : 0)};
    }
    // Point at which the core passes the line of the edge, seen along the edge.
    Vec3<R> way, across = core.d;
    for (int i = 0; i < 3; ++i)
        way[i] =
            ((axis.edge >> i) & 1 ? core.h[i] : -core.h[i]) + axis.separation * axis.normal[i] - core.p[i];
    across[axis.along] = 0;
    const R s = std::clamp(across.dot(way) / across.squaredNorm(), R(0), R(1));
    return {axis.normal, axis.separation, core.at(s), edgeFeature(axis.along, axis.edge)};
}

/// Interval of the core's parameter s over the face that n points out of, with the heights along n at its
/// ends.
template <class R>
struct Interval {
    R low = 0, high = 1, atLow = 0, atHigh = 0;
};
template <class R>
bool overFace(const Core<R>& core, const Vec3<R>& n, Interval<R>& part) {
    int k;
    const R cosine = n.cwiseAbs().maxCoeff(&k);
    if (!(cosine >= kFlatFaces<R>)) return false;
    const R start = (core.p[k] - std::copysign(core.h[k], n[k])) / n[k], rise = core.d[k] / n[k];
    for (const int i : {(k + 1) % 3, (k + 2) % 3}) {
        const R from = core.p[i] - start * n[i], step = core.d[i] - rise * n[i];
        if (step == 0 && std::abs(from) > core.h[i]) return false;
        if (step == 0) continue;
        const R in = (-std::copysign(core.h[i], step) - from) / step;
        const R out = (std::copysign(core.h[i], step) - from) / step;
        part.low = std::max(part.low, in);
        part.high = std::min(part.high, out);
    }
    part.atLow = start + part.low * rise;
    part.atHigh = start + part.high * rise;
    return part.high - part.low > R(1e-3);
}

/// Fills `out` in the frame of the box.
template <class R>
void collideCore(const Core<R>& core, R radius, R speculative, Manifold<Space<R, 3>>& out) {
    using Memory = ManifoldMemory<Space<R, 3>>;
    const R size =
        std::max({core.h.maxCoeff(), core.p.cwiseAbs().maxCoeff(), core.at(R(1)).cwiseAbs().maxCoeff()});
    const R tolerance = kRounding<R> * size;
    CapsuleAxis<R> axis = bestFace(core, tolerance);
    out.separationLowerBound = axis.separation - radius;
    if (out.separationLowerBound > speculative) return;
    if (axis.separation <= tolerance) tryEdges(core, tolerance, axis);

    AxisContact<R> contact;
    if (axis.separation > tolerance) {
        out.memory.axis = Memory::kNoAxis;
        contact = closestPoints(core, tolerance);
        if (contact.distance - radius > speculative) return;
    } else {
        keepAxis(core, out.memory, kKeep<R> * std::min(core.h.maxCoeff(), radius + core.d.norm() / R(2)),
                 axis);
        out.memory.axis = axis.face >= 0 ? Memory::kFaceA : Memory::kEdges;
        out.memory.featureA =
            static_cast<std::uint32_t>(axis.face >= 0 ? axis.face : 8 * axis.along + axis.edge);
        contact = deepestPoint(core, axis);
    }
    const Vec3<R>& n = contact.normal;
    out.normal = n;
    const auto add = [&](const Vec3<R>& x, R height, std::uint32_t feature) {
        if (height - radius > speculative) return;
        addPoint<Space<R, 3>>(out, x - height * n, x - radius * n, height - radius, feature);
    };
    Interval<R> part;
    if (overFace(core, n, part) && std::min(part.atLow, part.atHigh) <= contact.distance + tolerance) {
        add(core.at(part.low), part.atLow, vertexFeature(false, 0));
        add(core.at(part.high), part.atHigh, vertexFeature(false, 1));
    } else {
        add(contact.point, contact.distance, contact.feature);
    }
}

}  // namespace

template <class R>
void collidePair(const Box<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Capsule<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    const Vec3<R> center = rotateInverse<R>(Xa.q, Xb.p - Xa.p);
    const Vec3<R> half = rotateInverse<R>(Xa.q, rotate(Xb.q, Vec3<R>(b.halfLength * Vec3<R>::UnitY())));
    collideCore<R>({a.halfExtents, center - half, R(2) * half}, b.radius, speculative, out);
    toWorldFrame<Space<R, 3>>(out, Xa);
}

template void collidePair<float>(const Box<Space3f>&, const Pose<Space3f>&, const Capsule<Space3f>&,
                                 const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collidePair<double>(const Box<Space3d>&, const Pose<Space3d>&, const Capsule<Space3d>&,
                                  const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
