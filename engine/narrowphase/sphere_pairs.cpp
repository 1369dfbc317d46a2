// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Closed forms of a sphere against sphere, box, capsule and half-space, the same in both dimensions.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {

/// separation = |b - a| - rA - rB. Concentric spheres are pushed apart along +y: every direction is equally
/// good.
template <class S>
void collidePair(const Sphere<S>& a, const Pose<S>& Xa, const Sphere<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    using V = typename S::Vec;
    roundedPoint<S>(V::Zero(), a.radius, Xb.p - Xa.p, b.radius, V::UnitY(), speculative, 0, out);
    for (int i = 0; i < out.count; ++i) {
        out.points[0].pointA += Xa.p;
        out.points[0].pointB += Xa.p;
    }
}

/// Computed in the frame of the box. The sphere's centre clamped to the box is the nearest point; a centre
/// inside is pushed out through the nearest face.
template <class S>
void collidePair(const Sphere<S>& a, const Pose<S>& Xa, const Box<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    using R = typename S::Real;
    using V = typename S::Vec;
    const V c = rotateInverse<R>(Xb.q, Xa.p - Xb.p);
    const V nearest = c.cwiseMax(-b.halfExtents).cwiseMin(b.halfExtents);
    const V outward = c - nearest;
    const R distance = outward.norm();
    V normal, onBox = nearest;  // normal out of the box
    R separation;
    if (distance > kRounding<R> * b.halfExtents.maxCoeff()) {
        normal = outward / distance;
        separation = distance - a.radius;
        out.memory.axis = ManifoldMemory<S>::kNoAxis;
    } else {
        const V depths = b.halfExtents - c.cwiseAbs();
        int axis = 0;
        R inside = depths.minCoeff(&axis);
        // The face of the last step stays while it is as near within kKeep.
        R sign = c[axis] < 0 ? R(-1) : R(1);
        const auto last = static_cast<int>(out.memory.featureB);
        if (out.memory.axis == ManifoldMemory<S>::kFaceB && last < 2 * S::dim) {
            const R lastSign = last % 2 == 0 ? R(-1) : R(1);
            const R depth = b.halfExtents[last / 2] - lastSign * c[last / 2];
            if (depth <= inside + kKeep<R> * std::min(a.radius, b.halfExtents.minCoeff())) {
                axis = last / 2;
                sign = lastSign;
                inside = depth;
            }
        }
        out.memory.axis = ManifoldMemory<S>::kFaceB;
        out.memory.featureB = static_cast<std::uint32_t>(2 * axis + (sign < 0 ? 0 : 1));
        normal = V::Unit(axis) * sign;
        onBox[axis] = normal[axis] * b.halfExtents[axis];
        separation = -inside - a.radius;
    }
    if (separation > speculative) return;
    const V n = rotate(Xb.q, normal);
    out.normal = -n;
    addPoint<S>(out, Xa.p - a.radius * n, toWorld<S>(Xb, onBox), separation, 0);
}

/// The sphere against the nearest point of the capsule's segment.
template <class S>
void collidePair(const Sphere<S>& a, const Pose<S>& Xa, const Capsule<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    using V = typename S::Vec;
    const V c = rotateInverse<typename S::Real>(Xb.q, Xa.p - Xb.p);
    const V core = onAxis<S>(c, b.halfLength) * V::UnitY();
    roundedPoint<S>(c, a.radius, core, b.radius, V::UnitX(), speculative, 0, out);
    toWorldFrame<S>(out, Xb);
}

template <class S>
void collidePair(const Sphere<S>& a, const Pose<S>& Xa, const HalfSpace<S>& b, const Pose<S>& Xb,
                 typename S::Real speculative, Manifold<S>& out) {
    using R = typename S::Real;
    const typename S::Vec n = rotate(Xb.q, b.normal);
    const R height = n.dot(Xa.p - Xb.p) - b.offset;
    if (height - a.radius > speculative) return;
    out.normal = -n;
    addPoint<S>(out, Xa.p - a.radius * n, Xa.p - height * n, height - a.radius, 0);
}

#define PAIR(A, B, S)                                                                               \
    template void collidePair<S>(const A<S>&, const Pose<S>&, const B<S>&, const Pose<S>&, S::Real, \
                                 Manifold<S>&);
#define INSTANTIATE(S)       \
    PAIR(Sphere, Sphere, S)  \
    PAIR(Sphere, Box, S)     \
    PAIR(Sphere, Capsule, S) \
    PAIR(Sphere, HalfSpace, S)
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE
#undef PAIR

}  // namespace rigor::engine
