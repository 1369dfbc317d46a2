// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Sphere or capsule against hull: a point or segment core with a rounding radius.
//
//   cores apart: the exact closest pair over all features (core vertices and faces, segment and edges);
//   cores overlapping: the separating axis of largest separation over the facets of the Minkowski difference:
//   faces, and edges of the hull whose Gauss arc crosses the great circle of the segment's normals.
// A segment that lies along a face gets two points: its ends clipped to the prism of the face along the
// contact normal. Cost O(F + E), sums and products for most edges.
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/3d/polytope.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// Closest points of a core and a polytope, in the frame of the polytope.
template <class R>
struct Closest {
    R squared = std::numeric_limits<R>::max();
    Vec3<R> onCore, onHull;
    std::uint32_t feature = 0;
    /// Direction along the normal, of either sign, if the features themselves fix it (a face; two crossing
    /// edges): better than the difference of two points that are close together. Zero if they do not.
    Vec3<R> direction = Vec3<R>::Zero();
};

template <class R>
void consider(const Vec3<R>& onCore, const Vec3<R>& onHull, std::uint32_t feature, const Vec3<R>& direction,
              Closest<R>& best) {
    const R squared = (onCore - onHull).squaredNorm();
    if (squared < best.squared) best = {squared, onCore, onHull, feature, direction};
}

/// True if the foot of x on the plane of the face is inside the face.
template <class R>
bool overFace(const Polytope<R>& p, const HullFace<R>& f, const Vec3<R>& x) {
    for (int i = 0; i < f.count; ++i) {
        const Vec3<R>& v = p.loopVertex(f, i);
        const Vec3<R> e = p.loopVertex(f, (i + 1) % f.count) - v;
        if (e.cross(f.normal).dot(x - v) > 0) return false;
    }
    return true;
}

/// Closest points of segments p + s d and q + t e, s and t in [0, 1]; d may be zero. The crossing by cross
/// products: |d|^2 |e|^2 - (d . e)^2 is all rounding for angles below its root.
template <class R>
void segmentSegment(const Vec3<R>& p, const Vec3<R>& d, const Vec3<R>& q, const Vec3<R>& e,
                    std::uint32_t feature, Closest<R>& best) {
    const Vec3<R> r = p - q, across = d.cross(e);
    const R dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
    const R denominator = across.squaredNorm();
    R s = 0;
    if (denominator > kRounding<R> * kRounding<R> * dd * ee)
        s = std::clamp(R(e.cross(r).dot(across) / denominator), R(0), R(1));
    const R t = std::clamp((de * s + e.dot(r)) / ee, R(0), R(1));
    if (dd > 0) s = std::clamp((de * t - d.dot(r)) / dd, R(0), R(1));
    const bool inside = denominator > R(1e-6) * dd * ee && s > 0 && s < 1 && t > 0 && t < 1;
    consider<R>(p + s * d, q + t * e, feature, inside ? across : Vec3<R>(Vec3<R>::Zero()), best);
}

/// The same for the point p.
template <class R>
void pointSegment(const Vec3<R>& p, const Vec3<R>& q, const Vec3<R>& e, std::uint32_t feature,
                  Closest<R>& best) {
    const R t = std::clamp(R(e.dot(Vec3<R>(p - q)) / e.squaredNorm()), R(0), R(1));
    consider<R>(p, q + t * e, feature, Vec3<R>(Vec3<R>::Zero()), best);
}

/// Heights of the two ends of the core over the faces. The closest points, and an axis across the core that
/// is better than the faces, are at edges whose faces they are above:
///   closest: x - q = a n_left + b n_right with a, b >= 0, so that x is over one of the two;
///   axis: its separation is no more than the higher of what either end has over the two faces, where that is
///   not positive (polytope_axis.cpp).
template <class R>
struct CoreHeights {
    static constexpr int kMost = 256;  ///< edges of faces beyond are always tried
    std::array<R, kMost> first, second;

    void set(int face, R atFirst, R atSecond) {
        if (face >= kMost) return;
        first[face] = atFirst;
        second[face] = atSecond;
    }
    /// True if one end is higher than `level` over one of the faces.
    bool over(const HullEdge& e, R level) const {
        if (e.left >= kMost || e.right >= kMost) return true;
        const auto l = static_cast<std::size_t>(e.left), r = static_cast<std::size_t>(e.right);
        return first[l] > level || first[r] > level || second[l] > level || second[r] > level;
    }
    /// True if each end is higher than `level` over one of the faces.
    bool bothOver(const HullEdge& e, R level) const {
        if (e.left >= kMost || e.right >= kMost) return true;
        const auto l = static_cast<std::size_t>(e.left), r = static_cast<std::size_t>(e.right);
        return (first[l] > level || first[r] > level) && (second[l] > level || second[r] > level);
    }
};

/// Core p to p + d (d = 0: a point) outside the polytope.
template <class R>
Closest<R> closestFeatures(const Polytope<R>& hull, const Vec3<R>& p, const Vec3<R>& d,
                           const CoreHeights<R>& heights, R tolerance) {
    Closest<R> best;
    const bool point = !(d.squaredNorm() > 0);
    const int ends = point ? 1 : 2;
    for (int i = 0; i < hull.faceCount; ++i) {
        const HullFace<R>& f = hull.faces[i];
        for (int k = 0; k < ends; ++k) {
            const Vec3<R> x = k == 0 ? p : Vec3<R>(p + d);
            const R height = f.normal.dot(x) - f.offset;
            if (height >= 0 && height * height < best.squared && overFace(hull, f, x))
                consider<R>(x, x - height * f.normal, vertexFeature(true, k), f.normal, best);
        }
    }
    for (int i = 0; i < hull.edgeCount; ++i) {
        const HullEdge& e = hull.edges[i];
        if (!heights.over(e, -tolerance)) continue;
        const Vec3<R>& q = hull.vertices[e.v0];
        const std::uint32_t feature = crossingFeature(0, edgeName(e.v0, e.v1));
        if (point)
            pointSegment<R>(p, q, hull.vertices[e.v1] - q, feature, best);
        else
            segmentSegment<R>(p, d, q, hull.vertices[e.v1] - q, feature, best);
    }
    return best;
}

template <class R>
struct CoreAxis {
    Vec3<R> normal = Vec3<R>::UnitY();  ///< direction out of the polytope
    R separation = -std::numeric_limits<R>::max();
    int face = -1, edge = -1;
};

/// The axis across the core and edge i; false where they make no facet of the difference.
template <class R>
bool edgeAxis(const Polytope<R>& hull, const Vec3<R>& p, const Vec3<R>& d, int i, CoreAxis<R>& axis) {
    const HullEdge& e = hull.edges[i];
    const Vec3<R>& left = hull.faces[e.left].normal;
    const Vec3<R>& right = hull.faces[e.right].normal;
    if (left.dot(d) * right.dot(d) >= 0) return false;
    const Vec3<R> along = hull.vertices[e.v1] - hull.vertices[e.v0];
    Vec3<R> n = along.cross(d);
    const R length = n.norm();
    if (!(length > kRounding<R> * along.norm() * d.norm())) return false;
    n *= (n.dot(left + right) < 0 ? R(-1) : R(1)) / length;
    axis = {n, n.dot(p - hull.vertices[e.v0]), -1, i};
    return true;
}

/// The axis of largest separation; where a face separates, that of the faces alone. Fills `heights`.
template <class R>
CoreAxis<R> bestAxis(const Polytope<R>& hull, const Vec3<R>& p, const Vec3<R>& d, R tolerance,
                     CoreHeights<R>& heights) {
    CoreAxis<R> best;
    for (int i = 0; i < hull.faceCount; ++i) {
        const HullFace<R>& f = hull.faces[i];
        const R height = f.normal.dot(p) - f.offset, slope = f.normal.dot(d);
        heights.set(i, height, height + slope);
        const R s = height + std::min(R(0), slope);
        if (s > best.separation + tolerance) best = {f.normal, s, i, -1};
    }
    if (d.squaredNorm() == 0 || best.separation > tolerance) return best;
    const R level = std::min(R(0), best.separation);
    CoreAxis<R> axis;
    for (int i = 0; i < hull.edgeCount; ++i)
        if (heights.bothOver(hull.edges[i], level) && edgeAxis(hull, p, d, i, axis) &&
            axis.separation > best.separation + tolerance)
            best = axis;
    return best;
}

/// The face or edge that `memory` names in the place of the best where it is as good within `slack`.
template <class R>
void keepAxis(const Polytope<R>& hull, const Vec3<R>& p, const Vec3<R>& d,
              const ManifoldMemory<Space<R, 3>>& memory, R slack, CoreAxis<R>& best) {
    using Memory = ManifoldMemory<Space<R, 3>>;
    const auto i = static_cast<int>(memory.featureB);
    CoreAxis<R> last;
    if (memory.axis == Memory::kFaceB && i < hull.faceCount) {
        const HullFace<R>& f = hull.faces[i];
        last = {f.normal, f.normal.dot(p) - f.offset + std::min(R(0), f.normal.dot(d)), i, -1};
    } else if (memory.axis == Memory::kEdges && best.edge >= 0 && i < hull.edgeCount) {
        if (!edgeAxis(hull, p, d, i, last)) return;
    }
    if (last.separation >= best.separation - slack) best = last;
}

/// The part of the core over the face, along n: parameters of p + s d. False where nothing is left.
template <class R>
bool clipToFace(const Polytope<R>& hull, const HullFace<R>& f, const Vec3<R>& n, const Vec3<R>& p,
                const Vec3<R>& d, R& low, R& high) {
    low = 0;
    high = 1;
    for (int i = 0; i < f.count; ++i) {
        const Vec3<R>& v = hull.loopVertex(f, i);
        const Vec3<R> m = (hull.loopVertex(f, (i + 1) % f.count) - v).cross(n);
        const R a = m.dot(p - v), slope = m.dot(d);
        if (slope > 0)
            high = std::min(high, -a / slope);
        else if (slope < 0)
            low = std::max(low, -a / slope);
        else if (a > 0)
            return false;
    }
    return low < high;
}

/// Fills `out` in the frame of the polytope: A is the core of the given radius, B the polytope.
template <class R>
void collideCore(const Polytope<R>& hull, const Vec3<R>& p, const Vec3<R>& d, R radius, R speculative,
                 Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const R size = std::max({hull.size, p.cwiseAbs().maxCoeff(), (p + d).cwiseAbs().maxCoeff()});
    const R tolerance = kRounding<R> * size;
    CoreHeights<R> heights;
    CoreAxis<R> axis = bestAxis(hull, p, d, tolerance, heights);
    out.separationLowerBound = axis.separation - radius;
    if (out.separationLowerBound > speculative) return;
    using Memory = ManifoldMemory<S>;
    if (axis.separation <= tolerance) {
        keepAxis(hull, p, d, out.memory, kKeep<R> * std::min(hull.size, radius + d.norm() / R(2)), axis);
        out.memory.axis = axis.face >= 0 ? Memory::kFaceB : Memory::kEdges;
        out.memory.featureB = static_cast<std::uint32_t>(std::max(axis.face, axis.edge));
    } else {
        out.memory.axis = Memory::kNoAxis;
    }

    V n = axis.normal;
    R distance = axis.separation;
    Closest<R> closest;
    if (axis.separation > tolerance) {
        closest = closestFeatures(hull, p, d, heights, tolerance);
        distance = std::sqrt(closest.squared);
        n = (closest.onCore - closest.onHull) / distance;
        if (const R length = closest.direction.norm(); length > 0)
            n = closest.direction * ((closest.direction.dot(n) < 0 ? R(-1) : R(1)) / length);
        if (distance - radius > speculative) return;
    } else {
        // Deepest core point: the lower end along the axis, or the crossing with the edge.
        const bool second = n.dot(d) < 0;
        closest.onCore = second ? V(p + d) : p;
        closest.feature = vertexFeature(true, second ? 1 : 0);
        if (axis.edge >= 0) {
            const HullEdge& e = hull.edges[axis.edge];
            const V q = hull.vertices[e.v0] + distance * n;
            Closest<R> crossing;
            segmentSegment<R>(p, d, q, hull.vertices[e.v1] - hull.vertices[e.v0],
                              crossingFeature(0, edgeName(e.v0, e.v1)), crossing);
            closest.onCore = crossing.onCore;
            closest.feature = crossing.feature;
        }
    }
    const auto add = [&](const V& core, R height, std::uint32_t feature) {
        if (height - radius > speculative) return;
        addPoint<S>(out, core - radius * n, core - height * n, height - radius, feature);
    };
    out.normal = -n;

    if (d.squaredNorm() > 0) {
        int face = 0;
        for (int i = 1; i < hull.faceCount; ++i)
            if (hull.faces[i].normal.dot(n) > hull.faces[face].normal.dot(n)) face = i;
        const HullFace<R>& f = hull.faces[face];
        R low = 0, high = 0;
        if (f.normal.dot(n) >= kFlatFaces<R> && clipToFace(hull, f, n, p, d, low, high)) {
            const auto height = [&](R s) {
                return R((f.normal.dot(p + s * d) - f.offset) / f.normal.dot(n));
            };
            const R least = std::min(height(low), height(high));
            if (least <= distance + tolerance && high - low > R(1e-3)) {
                add(p + low * d, height(low), vertexFeature(true, 0));
                add(p + high * d, height(high), vertexFeature(true, 1));
                return;
            }
        }
    }
    add(closest.onCore, distance, closest.feature);
}

}  // namespace

template <class R>
void collidePair(const Sphere<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Hull<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    BoxStorage<R> unused;
    const Vec3<R> c = rotateInverse<R>(Xb.q, Xa.p - Xb.p);
    collideCore<R>(polytopeOf<R>(b, unused), c, Vec3<R>::Zero(), a.radius, speculative, out);
    toWorldFrame<Space<R, 3>>(out, Xb);
}

template <class R>
void collidePair(const Capsule<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Hull<Space<R, 3>>& b,
                 const Pose<Space<R, 3>>& Xb, typename Space<R, 3>::Real speculative,
                 Manifold<Space<R, 3>>& out) {
    BoxStorage<R> unused;
    const Pose<Space<R, 3>> X = relativePose<Space<R, 3>>(Xb, Xa);
    const Vec3<R> half = rotate(X.q, Vec3<R>(a.halfLength * Vec3<R>::UnitY()));
    collideCore<R>(polytopeOf<R>(b, unused), X.p - half, R(2) * half, a.radius, speculative, out);
    toWorldFrame<Space<R, 3>>(out, Xb);
}

#define INSTANTIATE(A, B)                                                                         \
    template void collidePair<float>(const A<Space3f>&, const Pose<Space3f>&, const B<Space3f>&,  \
                                     const Pose<Space3f>&, float, Manifold<Space3f>&);            \
    template void collidePair<double>(const A<Space3d>&, const Pose<Space3d>&, const B<Space3d>&, \
                                      const Pose<Space3d>&, double, Manifold<Space3d>&);
INSTANTIATE(Sphere, Hull)
INSTANTIATE(Capsule, Hull)
#undef INSTANTIATE

}  // namespace rigor::engine
