// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box, capsule and hull against a half-space: every vertex of the core within reach of the plane is a contact
// point, its separation the height over the plane less the rounding radius. The same in both dimensions.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// The deepest vertex and those spanning the largest area, straight from the vertex list, so that no buffer
/// bounds the size of a hull. `vertex(i)` is in the frame of the shape.
template <class S, class Vertex>
void verticesAgainstPlane(int count, Vertex vertex, typename S::Real radius, const Pose<S>& Xa,
                          const HalfSpace<S>& b, const Pose<S>& Xb, typename S::Real speculative,
                          Manifold<S>& out) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V n = rotate(Xb.q, b.normal);              // normal out of the half-space
    const V local = rotateInverse<R>(Xa.q, n);       // the same in the shape's frame
    const R height = n.dot(Xa.p - Xb.p) - b.offset;  // height of the shape's origin
    const auto separation = [&](int i) { return R(height + local.dot(vertex(i)) - radius); };
    // The first pass counts and numbers the vertices within reach.
    constexpr int kMost = 64;
    std::array<int, kMost> near;
    int found = 0;
    R lowest = std::numeric_limits<R>::max(), size = 0;
    int deepest = 0;
    for (int i = 0; i < count; ++i) {
        const R s = separation(i);
        size = std::max(size, vertex(i).cwiseAbs().maxCoeff());
        if (s < lowest) {
            lowest = s;
            deepest = i;
        }
        if (s <= speculative && found < kMost) near[found++] = i;
    }
    if (found == 0) return;
    // Points found far ahead: the upper corners are not among the next to touch, and would take the places of
    // the lower ones.
    const R limit = std::max(lowest, R(0)) + R(0.5) * size;
    if (limit < speculative && found < kMost) {
        int kept = 0;
        for (int k = 0; k < found; ++k)
            if (separation(near[k]) <= limit) near[kept++] = near[k];
        found = kept;
    }
    if (found == kMost)
        near[0] = deepest;  // a face of many vertices: 64 of them are enough, with the deepest
    out.normal = -n;
    const auto index = [&](int k) { return near[k]; };
    const auto emit = [&](int k) {
        const R s = separation(index(k));
        const V onShape = toWorld<S>(Xa, vertex(index(k))) - radius * n;
        addPoint<S>(out, onShape, onShape - s * n, s, vertexFeature(true, index(k)));
    };
    reducePoints<S>(
        found, local, size, out.memory, [&](int k) { return separation(index(k)); },
        [&](int k) { return V(vertex(index(k))); }, [&](int k) { return vertexFeature(true, index(k)); },
        emit);
}

}  // namespace

template <class S>
void collidePair(const Box<S>& a, const Pose<S>& Xa, const HalfSpace<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    const auto vertex = [&](int i) {
        typename S::Vec v = a.halfExtents;
        for (int k = 0; k < S::dim; ++k)
            if (((i >> k) & 1) == 0) v[k] = -v[k];
        return v;
    };
    verticesAgainstPlane<S>(1 << S::dim, vertex, 0, Xa, b, Xb, speculative, out);
}

template <class S>
void collidePair(const Capsule<S>& a, const Pose<S>& Xa, const HalfSpace<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    using V = typename S::Vec;
    const auto vertex = [&](int i) { return V((i == 0 ? -a.halfLength : a.halfLength) * V::UnitY()); };
    verticesAgainstPlane<S>(2, vertex, a.radius, Xa, b, Xb, speculative, out);
}

template <class S>
void collidePair(const Hull<S>& a, const Pose<S>& Xa, const HalfSpace<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    const auto& vertices = a.data->vertices;
    const auto vertex = [&](int i) -> const typename S::Vec& { return vertices[i]; };
    verticesAgainstPlane<S>(static_cast<int>(vertices.size()), vertex, 0, Xa, b, Xb, speculative, out);
}

#define PAIR(A, S)                                                                                          \
    template void collidePair<S>(const A<S>&, const Pose<S>&, const HalfSpace<S>&, const Pose<S>&, S::Real, \
                                 Manifold<S>&);
#define INSTANTIATE(S) \
    PAIR(Box, S)       \
    PAIR(Capsule, S)   \
    PAIR(Hull, S)
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE
#undef PAIR

}  // namespace rigor::engine
