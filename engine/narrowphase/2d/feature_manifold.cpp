// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points along a normal n that GJK, EPA or MPR found, in 2D: of each shape the edge that supports n
// (a sphere has none); the one most nearly perpendicular to n is the reference, the other is clipped to the
// strip that it sweeps along n, with separations measured along n. If neither is flat against n there is one
// point, the closest pair.
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

template <class R>
struct Feature {
    std::array<Vec2<R>, 2> at;  ///< core vertices, frame of A
    std::array<int, 2> index{0, 1};
    int count = 0;
    Vec2<R> normal = Vec2<R>::Zero();  ///< unit, out of the edge on the side of the contact
};

/// `local`: the direction in the frame of the shape; `place` takes points to the frame of A.
template <class R, class Place>
void loadFeature(const Shape<Space<R, 2>>& shape, const Vec2<R>& local, Place place, Feature<R>& f) {
    using S = Space<R, 2>;
    const auto edge = [&](int count, const auto& vertex) {
        // Edge at the support vertex that faces the direction more than the other one.
        int best = 0;
        for (int i = 1; i < count; ++i)
            if (vertex(i).dot(local) > vertex(best).dot(local)) best = i;
        const int before = (best + count - 1) % count, after = (best + 1) % count;
        const Vec2<R> in = vertex(best) - vertex(before), out = vertex(after) - vertex(best);
        const R facingIn = cross(local, in) / in.norm(), facingOut = cross(local, out) / out.norm();
        const int first = facingIn > facingOut ? before : best;
        f.index = {first, (first + 1) % count};
    };
    if (const auto* box = std::get_if<Box<S>>(&shape)) {
        const R x = box->halfExtents.x(), y = box->halfExtents.y();
        const std::array<Vec2<R>, 4> corners{Vec2<R>(-x, -y), Vec2<R>(x, -y), Vec2<R>(x, y), Vec2<R>(-x, y)};
        edge(4, [&](int i) -> const Vec2<R>& { return corners[i]; });
        for (std::size_t k = 0; k < 2; ++k) f.at[k] = place(corners[f.index[k]]);
        f.count = 2;
    } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
        const auto& v = hull->data->vertices;
        edge(static_cast<int>(v.size()), [&](int i) -> const Vec2<R>& { return v[i]; });
        for (std::size_t k = 0; k < 2; ++k) f.at[k] = place(v[f.index[k]]);
        f.count = 2;
    } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
        const Vec2<R> half = capsule->halfLength * Vec2<R>::UnitY();
        f.at = {place(Vec2<R>(-half)), place(half)};
        f.count = 2;
    } else if (const auto* segment = std::get_if<Segment<S>>(&shape)) {
        f.at = {place(segment->a), place(segment->b)};
        f.count = 2;
    }
}

}  // namespace

template <class R>
void featureManifold(const Shape<Space<R, 2>>& a, const Shape<Space<R, 2>>& b,
                     const Minkowski<Space<R, 2>>& D, const CoreContact<Space<R, 2>>& contact, R speculative,
                     Manifold<Space<R, 2>>& out) {
    using S = Space<R, 2>;
    using V = Vec2<R>;
    const R rA = roundingRadius<S>(a), rB = roundingRadius<S>(b);
    const V& n = contact.normal;
    out.normal = n;
    Feature<R> fA, fB;
    loadFeature<R>(
        a, n, [](const V& x) { return x; }, fA);
    loadFeature<R>(
        b, V(-(D.rotation().transpose() * n)),
        [&](const V& x) { return V(D.rotation() * x + D.translation()); }, fB);
    const auto face = [&](Feature<R>& f, const V& outward) {
        if (f.count < 2) return R(0);
        const V e = (f.at[1] - f.at[0]).normalized();
        f.normal = V(e.y(), -e.x());
        if (f.normal.dot(outward) < 0) f.normal = -f.normal;
        return R(f.normal.dot(outward));
    };
    const R flatA = face(fA, n), flatB = face(fB, V(-n));
    if (fA.count == 2 && fB.count == 2 && std::max(flatA, flatB) >= kFlatFeature<R>) {
        const bool refIsA = flatA >= flatB;
        const Feature<R>&ref = refIsA ? fA : fB, &inc = refIsA ? fB : fA;
        const V outward = refIsA ? n : V(-n), along(-outward.y(), outward.x());
        const R rRef = refIsA ? rA : rB, rInc = refIsA ? rB : rA;
        const V p = inc.at[0], d = inc.at[1] - p;
        // Parameters on the incident edge of the ends of the strip; -1, 2 where it stands upright.
        const R slope = along.dot(d);
        const R width = std::abs(along.dot(ref.at[1] - ref.at[0]));
        const bool upright = !(std::abs(slope) > kRounding<R> * std::max(width, d.norm()));
        const R t0 = upright ? R(-1) : along.dot(ref.at[0] - p) / slope;
        const R t1 = upright ? R(2) : along.dot(ref.at[1] - p) / slope;
        const R low = std::max(R(0), std::min(t0, t1)), high = std::min(R(1), std::max(t0, t1));
        const auto add = [&](R t) {
            const V x = t == R(1) ? inc.at[1] : V(p + t * d);
            const R height = ref.normal.dot(x - ref.at[0]) / ref.normal.dot(outward);
            const R separation = height - rRef - rInc;
            if (separation > speculative) return;
            const V pInc = x - rInc * outward, pRef = x - (height - rRef) * outward;
            const bool end = t == R(0) || t == R(1);
            const std::size_t k =
                end ? (t == R(0) ? 0u : 1u) : (std::abs(t - t0) <= std::abs(t - t1) ? 0u : 1u);
            addPoint<S>(out, refIsA ? pRef : pInc, refIsA ? pInc : pRef, separation,
                        vertexFeature(end != refIsA, end ? inc.index[k] : ref.index[k]));
        };
        if (!upright && high > low) {
            add(low);
            add(high);
        }
    }
    const R size = std::max(contact.onA.norm(), contact.onB.norm()) + rA + rB;
    addDeepest<S>(contact, rA, rB, R(4) * kRounding<R> * size, out);
}

template void featureManifold<float>(const Shape<Space2f>&, const Shape<Space2f>&, const Minkowski<Space2f>&,
                                     const CoreContact<Space2f>&, float, Manifold<Space2f>&);
template void featureManifold<double>(const Shape<Space2d>&, const Shape<Space2d>&, const Minkowski<Space2d>&,
                                      const CoreContact<Space2d>&, double, Manifold<Space2d>&);

}  // namespace rigor::engine
