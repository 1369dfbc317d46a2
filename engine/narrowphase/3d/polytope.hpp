// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes and hulls as one: a view of vertices, faces and edges in the frame of the shape. A box is laid out on
// the stack over a constant topology.
#pragma once

#include <array>

#include "engine/narrowphase/detail.hpp"

namespace rigor::engine {

/// A view that owns nothing and is valid as long as the shape and the BoxStorage it was made from.
template <class R>
struct Polytope {
    const Vec3<R>* vertices;
    const HullFace<R>* faces;
    const int* loops;
    const HullEdge* edges;
    int vertexCount, faceCount, edgeCount;
    R size;  ///< largest coordinate [m], for tolerances

    const Vec3<R>& loopVertex(const HullFace<R>& f, int i) const { return vertices[loops[f.first + i]]; }
};

template <class R>
struct BoxStorage {
    std::array<Vec3<R>, 8> vertices;
    std::array<HullFace<R>, 6> faces;
};

/// Vertex i of a box has the sign of bit 0, 1, 2 of i on x, y, z. Faces: -x, +x, -y, +y, -z, +z. Edges: four
/// along x, four along y, four along z.
inline constexpr std::array<int, 24> kBoxLoops{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                               2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
inline constexpr std::array<HullEdge, 12> kBoxEdges{{{0, 1, 2, 4},
                                                     {2, 3, 4, 3},
                                                     {4, 5, 5, 2},
                                                     {6, 7, 3, 5},
                                                     {0, 2, 4, 0},
                                                     {1, 3, 1, 4},
                                                     {4, 6, 0, 5},
                                                     {5, 7, 5, 1},
                                                     {0, 4, 0, 2},
                                                     {1, 5, 2, 1},
                                                     {2, 6, 3, 0},
                                                     {3, 7, 1, 3}}};

template <class R>
Polytope<R> polytopeOf(const Box<Space<R, 3>>& box, BoxStorage<R>& store) {
    const Vec3<R>& h = box.halfExtents;
    for (unsigned i = 0; i < 8; ++i)
        store.vertices[i] = {i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z()};
    for (int i = 0; i < 6; ++i) {
        HullFace<R>& f = store.faces[i];
        f.normal = (i % 2 ? R(1) : R(-1)) * Vec3<R>::Unit(i / 2);
        f.offset = h[i / 2];
        f.first = 4 * i;
        f.count = 4;
    }
    return {store.vertices.data(), store.faces.data(), kBoxLoops.data(), kBoxEdges.data(), 8, 6, 12,
            h.maxCoeff()};
}

template <class R>
Polytope<R> polytopeOf(const Hull<Space<R, 3>>& hull, BoxStorage<R>&) {
    const HullData<Space<R, 3>>& d = *hull.data;
    R size = 0;
    for (const Vec3<R>& v : d.vertices) size = std::max(size, v.cwiseAbs().maxCoeff());
    return {d.vertices.data(),
            d.faces.data(),
            d.loops.data(),
            d.edges.data(),
            static_cast<int>(d.vertices.size()),
            static_cast<int>(d.faces.size()),
            static_cast<int>(d.edges.size()),
            size};
}

/// The vertex furthest along `direction`, of equal ones the first.
template <class R>
int deepestAlong(const Polytope<R>& p, const Vec3<R>& direction) {
    int best = 0;
    R most = p.vertices[0].dot(direction);
    for (int i = 1; i < p.vertexCount; ++i)
        if (const R at = p.vertices[i].dot(direction); at > most) {
            most = at;
            best = i;
        }
    return best;
}

/// The best separating axis of two polytopes A and B, in the frame of A.
template <class R>
struct PolytopeAxis {
    enum Kind { FaceA, FaceB, Edges } kind = FaceA;
    int featureA = 0, featureB = 0;  ///< face or edge indices (FaceA: only featureA; FaceB: only featureB)
    Vec3<R> normal;                  ///< unit, A to B
    R separation = -std::numeric_limits<R>::max();
    bool kept = false;  ///< the last step's, though another is better by less than kKeep
};

/// Rotation and translation of B in the frame of A.
template <class R>
struct Relative {
    Eigen::Matrix<R, 3, 3> rotation;
    Vec3<R> translation;
    Vec3<R> point(const Vec3<R>& v) const { return rotation * v + translation; }
    Vec3<R> direction(const Vec3<R>& v) const { return rotation * v; }
    Relative inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

/// Penetration deeper than this is not resolved: an edge pair must be better than the best face by more.
template <class R>
R axisTolerance(R size, R separation) {
    return kRounding<R> * size + R(1e-7) * std::abs(separation);
}

/// False when separated by more than `speculative`; then best.separation is a bound of the distance from
/// below. Else the axis of largest separation, faces of A
/// preferred to faces of B preferred to edges within a tolerance of rounding size.
template <class R>
bool polytopeAxis(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X, R speculative,
                  PolytopeAxis<R>& best);

/// Puts the axis that `memory` names in the place of `best` where that one is no better than by kKeep of the
/// smaller polytope: two penetration vectors that are equally deep do not alternate. A face does not give way
/// to edges then, but edges to a face: it holds more points.
template <class R>
void keepAxis(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
              const ManifoldMemory<Space<R, 3>>& memory, PolytopeAxis<R>& best);

/// The facet of near-parallel edges is thin and its normal may be lost to rounding: their separation is
/// measured over all vertices. Sine of the angle.
template <class R>
inline constexpr R kParallel = R(1e-7);
template <>
inline constexpr float kParallel<float> = 5e-3f;

/// Contact points for an axis, in the frame of A.
template <class R>
void polytopeManifold(const Polytope<R>& a, const Polytope<R>& b, const Relative<R>& X,
                      const PolytopeAxis<R>& axis, R speculative, Manifold<Space<R, 3>>& out);

}  // namespace rigor::engine
