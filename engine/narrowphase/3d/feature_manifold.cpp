// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact points along a normal n that GJK, EPA or MPR found. Of each shape the feature that supports n: a
// face of a box or hull, the segment of a capsule, a point of a sphere, the result of feature.hpp for others.
// The one most nearly perpendicular to n is the reference; the other is clipped to the prism that it sweeps
// along n (Sutherland-Hodgman), with separations measured along n. Two segments side by side have an interval
// in common. If nothing is flat against n there is one point, the closest pair.
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/3d/feature.hpp"
#include "engine/narrowphase/minkowski.hpp"

namespace rigor::engine {
namespace {

template <class R>
struct Feature {
    FaceLoop<R> loop;                  ///< core vertices, frame of A
    Vec3<R> normal = Vec3<R>::Zero();  ///< outward unit normal of a face
};

/// `direction` and the result in the frame of A; `place` takes points and `turn` vectors there.
template <class R, class Place, class Turn>
void loadFeature(const Shape<Space<R, 3>>& shape, const Vec3<R>& local, Place place, Turn turn,
                 Feature<R>& f) {
    using S = Space<R, 3>;
    BoxStorage<R> store;
    const auto face = [&](const Polytope<R>& p) {
        const int i = incidentFace<R>(p, local);
        loadFace(p, i, place, f.loop);
        f.normal = turn(p.faces[i].normal);
    };
    if (const auto* box = std::get_if<Box<S>>(&shape)) {
        face(polytopeOf<R>(*box, store));
    } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
        face(polytopeOf<R>(*hull, store));
    } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
        const Vec3<R> half = capsule->halfLength * Vec3<R>::UnitY();
        f.loop.at[0] = place(Vec3<R>(-half));
        f.loop.at[1] = place(half);
        f.loop.index[0] = 0;
        f.loop.index[1] = 1;
        f.loop.count = 2;
    } else if (!std::holds_alternative<Sphere<S>>(shape)) {
        SupportFeature<R> found;
        supportingFeature<R>(shape, local, found);
        for (f.loop.count = 0; f.loop.count < found.count; ++f.loop.count) {
            const auto k = static_cast<std::size_t>(f.loop.count);
            f.loop.at[k] = place(found.at[k]);
            f.loop.index[k] = found.index[k];
        }
        if (found.count > 2) f.normal = turn(found.normal);
    }
}

/// Alignment of a feature with n: cosine of the angle between the normals for a face, of the best face
/// through it for a segment.
template <class R>
R flatness(const Feature<R>& f, const Vec3<R>& n) {
    if (f.loop.count >= 3) return std::abs(f.normal.dot(n));
    if (f.loop.count < 2) return 0;
    const Vec3<R> e = (f.loop.at[1] - f.loop.at[0]).normalized();
    return std::sqrt(std::max(R(0), R(1) - e.dot(n) * e.dot(n)));
}

/// The first side of the smaller of two faces or segments: the length that kKeep is a fraction of.
template <class R>
R smallerSide(const FaceLoop<R>& a, const FaceLoop<R>& b) {
    return std::min((a.at[1] - a.at[0]).norm(), (b.at[1] - b.at[0]).norm());
}

template <class R>
struct Clip {
    const Feature<R>& ref;
    const Feature<R>& inc;
    bool refIsA;
    Vec3<R> outward;  ///< n out of the reference
    R rRef, rInc, speculative;
};

template <class R>
void addClipped(const Clip<R>& c, const Vec3<R>& onInc, R height, std::uint32_t feature,
                Manifold<Space<R, 3>>& out) {
    const R separation = height - c.rRef - c.rInc;
    const Vec3<R> pInc = onInc - c.rInc * c.outward, pRef = onInc - (height - c.rRef) * c.outward;
    addPoint<Space<R, 3>>(out, c.refIsA ? pRef : pInc, c.refIsA ? pInc : pRef, separation, feature);
}

template <class R>
void faceAgainstFeature(const Clip<R>& c, Manifold<Space<R, 3>>& out) {
    ClipPolygon<R> buffers[2];
    const ClipPolygon<R>& polygon = clipToPrism<R>(c.ref.loop, c.inc.loop, c.outward, buffers);
    const Vec3<R>& p = c.ref.loop.at[0];
    const R slope = R(1) / c.ref.normal.dot(c.outward);
    const auto height = [&](const Vec3<R>& x) { return R(c.ref.normal.dot(x - p) * slope); };
    std::array<int, 2 * kFaceVertices> near;
    std::array<std::uint32_t, 2 * kFaceVertices> names;
    int found = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const ClipVertex<R>& v = polygon.v[i];
        if (height(v.x) - c.rRef - c.rInc > c.speculative) continue;
        const std::uint32_t name = featureOf(v, c.ref.loop, c.inc.loop, c.refIsA);
        // A clipped segment runs there and back: each of its ends once.
        if (std::find(names.begin(), names.begin() + found, name) != names.begin() + found) continue;
        names[found] = name;
        near[found++] = i;
    }
    const auto at = [&](int k) -> const Vec3<R>& { return polygon.v[near[k]].x; };
    reducePoints<Space<R, 3>>(
        found, c.outward, smallerSide(c.ref.loop, c.inc.loop), out.memory,
        [&](int k) { return height(at(k)); }, at, [&](int k) { return names[k]; },
        [&](int k) { addClipped(c, at(k), height(at(k)), names[k], out); });
}

/// The interval that two nearly parallel segments have in common, measured along the first.
template <class R>
void segmentAgainstSegment(const Clip<R>& c, Manifold<Space<R, 3>>& out) {
    const Vec3<R>&p = c.ref.loop.at[0], &q = c.inc.loop.at[0];
    const Vec3<R> d = c.ref.loop.at[1] - p, e = c.inc.loop.at[1] - q;
    const R dd = d.squaredNorm(), along = e.dot(d);
    if (!(along * along > kFlatFeature<R> * kFlatFeature<R> * dd * e.squaredNorm())) return;
    const R at0 = (p - q).dot(d) / along, at1 = (p + d - q).dot(d) / along;  // the ends of ref on inc
    const R low = std::max(R(0), std::min(at0, at1)), high = std::min(R(1), std::max(at0, at1));
    if (!(high - low > R(1e-3))) return;
    for (const R s : {low, high}) {
        const Vec3<R> x = q + s * e;
        const Vec3<R> foot = p + ((x - p).dot(d) / dd) * d;
        const R height = c.outward.dot(x - foot);
        const bool end = s == R(0) || s == R(1);
        const bool onA = end != c.refIsA;
        const int vertex = end ? (s == R(0) ? 0 : 1) : (std::abs(s - at0) <= std::abs(s - at1) ? 0 : 1);
        if (height - c.rRef - c.rInc <= c.speculative)
            addClipped(c, x, height, vertexFeature(onA, vertex), out);
    }
}

}  // namespace

template <class R>
void featureManifold(const Shape<Space<R, 3>>& a, const Shape<Space<R, 3>>& b,
                     const Minkowski<Space<R, 3>>& D, const CoreContact<Space<R, 3>>& contact, R speculative,
                     Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    using V = Vec3<R>;
    const R rA = roundingRadius<S>(a), rB = roundingRadius<S>(b);
    const V& n = contact.normal;
    out.normal = n;
    Feature<R> fA, fB;
    const Eigen::Matrix<R, 3, 3>& turn = D.rotation();
    loadFeature<R>(
        a, n, [](const V& x) { return x; }, [](const V& x) { return x; }, fA);
    loadFeature<R>(
        b, V(-(turn.transpose() * n)), [&](const V& x) { return V(turn * x + D.translation()); },
        [&](const V& x) { return V(turn * x); }, fB);
    const R flatA = flatness(fA, n), flatB = flatness(fB, n);
    const bool faceA = fA.loop.count >= 3 && flatA >= kFlatFeature<R>,
               faceB = fB.loop.count >= 3 && flatB >= kFlatFeature<R>;
    if (fA.loop.count >= 2 && fB.loop.count >= 2) {
        if (faceA && (!faceB || flatA >= flatB))
            faceAgainstFeature<R>({fA, fB, true, n, rA, rB, speculative}, out);
        else if (faceB)
            faceAgainstFeature<R>({fB, fA, false, -n, rB, rA, speculative}, out);
        else if (fA.loop.count == 2 && fB.loop.count == 2 && std::min(flatA, flatB) >= kFlatFeature<R>)
            segmentAgainstSegment<R>({fA, fB, true, n, rA, rB, speculative}, out);
    }
    const R size = std::max(contact.onA.norm(), contact.onB.norm()) + rA + rB;
    const R slack = fA.loop.count >= 2 && fB.loop.count >= 2
                        ? keepSlack(out.memory, smallerSide(fA.loop, fB.loop))
                        : R(0);
    addDeepest<S>(contact, rA, rB, R(4) * kRounding<R> * size + slack, out);
}

template void featureManifold<float>(const Shape<Space3f>&, const Shape<Space3f>&, const Minkowski<Space3f>&,
                                     const CoreContact<Space3f>&, float, Manifold<Space3f>&);
template void featureManifold<double>(const Shape<Space3d>&, const Shape<Space3d>&, const Minkowski<Space3d>&,
                                      const CoreContact<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
