// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box against box in 2D: what polygon_pairs.cpp does for any two polygons, with closed forms in place
// of its loops [Gottschalk1996, in two dimensions]. With C = axes of B in the frame of A, t = centre of B, a
// and b the half extents:
//
//   side i of A:   |t_i| - a_i - sum_j b_j |C_ij|
//   side j of B:   |t . C_j| - b_j - sum_i a_i |C_ij|
//
// and in the frame of the reference box height and place of a point over a side are its two coordinates. So
// rounding clips no deepest point away: 4e7 pairs of boxes of 1e-3 m to 10 m, with and without a memory, had
// theirs.
#include "engine/narrowphase/detail.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

/// Sides -y, +x, +y, -x: 0 to 3. Side i runs from corner i to corner i + 1, counter-clockwise.
int sideOf(int axis, bool positive) {
    return axis == 1 ? (positive ? 2 : 0) : (positive ? 1 : 3);
}
int axisOf(int side) {
    return side % 2 == 0 ? 1 : 0;
}
bool positive(int side) {
    return side == 1 || side == 2;
}
template <class R>
Vec2<R> corner(const Vec2<R>& half, int i) {
    return {i == 1 || i == 2 ? half.x() : -half.x(), i >= 2 ? half.y() : -half.y()};
}

/// One box in the frame of the other.
template <class R>
struct SeenBox {
    Vec2<R> own;     ///< half extents of the box whose frame it is
    Vec2<R> center;  ///< center of the other box
    Vec2<R> reach;   ///< half extents of the other box along the axes of this one

    R separation(int side) const {
        const int k = axisOf(side);
        return (positive(side) ? center[k] : -center[k]) - own[k] - reach[k];
    }
    /// The side that separates most: one must be better by more than rounding.
    int best(R rounding) const {
        const int across = sideOf(1, center.y() > 0), along = sideOf(0, center.x() > 0);
        return separation(along) > separation(across) + rounding ? along : across;
    }
};

/// Reference side and incident box, in the frame of the reference box.
template <class R>
struct SidePair {
    bool refIsA;
    int side;
    Vec2<R> refHalf, incHalf;
    Rot2<R> rotation;  ///< rotation of the incident box in the frame of the reference box
    Vec2<R> center;

    int axis() const { return axisOf(side); }
    R sign() const { return positive(side) ? R(1) : R(-1); }
    /// Height over the reference side.
    R height(const Vec2<R>& x) const { return sign() * x[axis()] - refHalf[axis()]; }
    /// The normal of the reference side in the frame of the incident box.
    Vec2<R> towards() const { return rotateInverse<R>(rotation, sign() * Vec2<R>::Unit(axis())); }
    /// A corner of the incident box.
    Vec2<R> incident(int i) const { return rotate(rotation, corner(incHalf, i)) + center; }
};

/// A point of the incident box and its foot on the reference side, into the world.
template <class R>
void emitPoint(const SidePair<R>& m, const Pose<Space<R, 2>>& ref, const Vec2<R>& x, R height, R speculative,
               std::uint32_t feature, Manifold<Space<R, 2>>& out) {
    if (height > speculative) return;
    const Vec2<R> onInc = toWorld<Space<R, 2>>(ref, x);
    const Vec2<R> onRef = onInc - (m.refIsA ? height : -height) * out.normal;
    addPoint<Space<R, 2>>(out, m.refIsA ? onRef : onInc, m.refIsA ? onInc : onRef, height, feature);
}

/// The side of the incident box that faces the reference side, clipped to what is over it.
template <class R>
void clipSides(const SidePair<R>& m, const Pose<Space<R, 2>>& ref, R speculative,
               Manifold<Space<R, 2>>& out) {
    const Vec2<R> d = m.towards();
    const int across = std::abs(d.x()) > std::abs(d.y()) ? 0 : 1, incSide = sideOf(across, d[across] < 0);
    const int i0 = incSide, i1 = (incSide + 1) & 3, r0 = m.side, r1 = (m.side + 1) & 3;
    Vec2<R> p = m.incident(i0), q = m.incident(i1);
    std::uint32_t fp = vertexFeature(!m.refIsA, i0), fq = vertexFeature(!m.refIsA, i1);
    // Coordinates are along the reference side, from r0 to r1. Counter-clockwise sides face each other: tp >
    // tq.
    const int o = 1 - m.axis();
    const R way = m.side < 2 ? R(1) : R(-1), end = m.refHalf[o];
    const R tp = way * p[o], tq = way * q[o], hp = m.height(p), hq = m.height(q);
    const Vec2<R> normal =
        m.sign() * Vec2<R>(m.axis() == 0 ? Vec2<R>(ref.q.c, ref.q.s) : Vec2<R>(-ref.q.s, ref.q.c));
    out.normal = m.refIsA ? normal : Vec2<R>(-normal);
    if (tp < -end || tq > end || !(tp - tq > kRounding<R> * end)) {
        // Nothing over the side (a corner beside it), or the incident side stands upright: the lower end.
        const bool first = hp <= hq;
        emitPoint<R>(m, ref, first ? p : q, first ? hp : hq, speculative, first ? fp : fq, out);
        return;
    }
    const Vec2<R> step = (q - p) / (tq - tp), p0 = p;
    if (tp > end) {
        p = p0 + (end - tp) * step;
        fp = vertexFeature(m.refIsA, r1);
    }
    if (tq < -end) {
        q = p0 - (end + tp) * step;
        fq = vertexFeature(m.refIsA, r0);
    }
    emitPoint<R>(m, ref, p, m.height(p), speculative, fp, out);
    emitPoint<R>(m, ref, q, m.height(q), speculative, fq, out);
}

}  // namespace

template <class R>
void collidePair(const Box<Space<R, 2>>& a, const Pose<Space<R, 2>>& Xa, const Box<Space<R, 2>>& b,
                 const Pose<Space<R, 2>>& Xb, typename Space<R, 2>::Real speculative,
                 Manifold<Space<R, 2>>& out) {
    using Memory = ManifoldMemory<Space<R, 2>>;
    const Pose<Space<R, 2>> X = relativePose<Space<R, 2>>(Xa, Xb);
    const R c = std::abs(X.q.c), s = std::abs(X.q.s);
    const auto reach = [&](const Vec2<R>& h) {
        return Vec2<R>(c * h.x() + s * h.y(), s * h.x() + c * h.y());
    };
    const SeenBox<R> byA{a.halfExtents, X.p, reach(b.halfExtents)};
    const R sizeA = a.halfExtents.maxCoeff(), sizeB = b.halfExtents.maxCoeff();
    const R tolerance = kRounding<R> * std::max({sizeA, sizeB, X.p.cwiseAbs().maxCoeff()});
    const int onA = byA.best(tolerance);
    out.separationLowerBound = byA.separation(onA);
    if (out.separationLowerBound > speculative) return;
    const SeenBox<R> byB{b.halfExtents, -rotateInverse<R>(X.q, X.p), reach(a.halfExtents)};
    const int onB = byB.best(tolerance);
    out.separationLowerBound = std::max(out.separationLowerBound, byB.separation(onB));
    if (out.separationLowerBound > speculative) return;

    bool refIsA = byB.separation(onB) <= byA.separation(onA) + tolerance;
    int side = refIsA ? onA : onB;
    const R most = refIsA ? byA.separation(onA) : byB.separation(onB);
    // The side of the last step stays while it is as good within kKeep.
    const bool lastIsA = out.memory.axis == Memory::kFaceA;
    const auto last = static_cast<int>(lastIsA ? out.memory.featureA : out.memory.featureB);
    if (out.memory.axis != Memory::kNoAxis && last < 4) {
        const R then = (lastIsA ? byA : byB).separation(last);
        if (then >= most - kKeep<R> * std::min(sizeA, sizeB)) {
            refIsA = lastIsA;
            side = last;
        }
    }
    out.memory.axis = refIsA ? Memory::kFaceA : Memory::kFaceB;
    out.memory.featureA = out.memory.featureB = static_cast<std::uint32_t>(side);

    const SidePair<R> m =
        refIsA ? SidePair<R>{true, side, a.halfExtents, b.halfExtents, X.q, byA.center}
               : SidePair<R>{false, side, b.halfExtents, a.halfExtents, inverse(X.q), byB.center};
    const Pose<Space<R, 2>>& ref = refIsA ? Xa : Xb;
    clipSides<R>(m, ref, speculative, out);
}

template void collidePair<float>(const Box<Space2f>&, const Pose<Space2f>&, const Box<Space2f>&,
                                 const Pose<Space2f>&, float, Manifold<Space2f>&);
template void collidePair<double>(const Box<Space2d>&, const Pose<Space2d>&, const Box<Space2d>&,
                                  const Pose<Space2d>&, double, Manifold<Space2d>&);

}  // namespace rigor::engine
