// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Any two convex shapes of space, in the frame of A:
//
//   1. normal n and separation by closestPoints (GJK, EPA), or the way out of the last step where that is as
//      short (keep_normal.cpp);
//   2. where a flat face of A or B looks along n within 2.5 degrees and the separation along the face's own
//      normal, s(m) = min over B of m . x - max over A of m . x, is no less than that of n within rounding,
//      the face's normal is taken: exact, and the same from step to step;
//   3. the supporting features of A and B along n are clipped against each other: face and face or segment
//      (Sutherland-Hodgman against the prism over the reference face), two nearly parallel segments (their
//      common stretch). Separations are measured along n. Where these have no points, the faces or segments that
//      look along n most nearly are clipped, if one of them does within 26 degrees: an overlap is a region between
//      two sides, which one point would let turn and sink further in. Else the closest points alone;
//   4. the deepest point is kept: if clipping lost it the closest points are added.
// Sources: [Bergen2003], [Ericson2005, ch. 5.3, 8.3].
//
// Limits: a disc is clipped as an inscribed polygon of 16 sides (in a sequence of steps its lowest
// point is good to kRimNoise);
// overlapping curved sides have a normal as good as EPA's. Cost: that of closestPoints and O(n m) of the
// features.
#include "engine/narrowphase/3d/clip.hpp"
#include "engine/narrowphase/3d/feature_segments.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/minkowski.hpp"
#include "engine/narrowphase/pairs.hpp"

namespace rigor::engine {
namespace {

template <class R>
using S3 = Space<R, 3>;

/// Two shapes with their contact normal and witness points, in the frame of A.
template <class R>
struct FeaturePair {
    const Shape<S3<R>>& a;
    const Shape<S3<R>>& b;
    Pose<S3<R>> X;  ///< pose of B in the frame of A
    Vec3<R> normal;
    R separation;
    Vec3<R> pointA, pointB;
    R tolerance;
    R speculative;
};

/// s(m) of the file's head.
template <class R>
R separationAlong(const FeaturePair<R>& m, const Vec3<R>& n) {
    const Vec3<R> onB = support<S3<R>>(m.b, rotateInverse<R>(m.X.q, Vec3<R>(-n)));
    return n.dot(m.X.p) + n.dot(rotate(m.X.q, onB)) - n.dot(support<S3<R>>(m.a, n));
}

/// `find`: supportingFeature or facingFeature.
template <class R, class Find>
void featuresAlong(const FeaturePair<R>& m, const Find& find, SupportFeature<R>& fa, SupportFeature<R>& fb) {
    find(m.a, m.normal, fa);
    find(m.b, rotateInverse<R>(m.X.q, Vec3<R>(-m.normal)), fb);
    for (int i = 0; i < fb.count; ++i) {
        Vec3<R>& x = fb.at[i];
        x = toWorld<S3<R>>(m.X, x);
    }
    fb.normal = rotate(m.X.q, fb.normal);
}

template <class R>
void featuresAlong(const FeaturePair<R>& m, SupportFeature<R>& fa, SupportFeature<R>& fb) {
    featuresAlong(m, &supportingFeature<R>, fa, fb);
}

/// Step 2. True when the normal changed.
template <class R>
bool preferFaceNormal(FeaturePair<R>& m, const SupportFeature<R>& fa, const SupportFeature<R>& fb) {
    Vec3<R> best = m.normal;
    R most = m.separation - m.tolerance;
    const auto consider = [&](const Vec3<R>& n) {
        // B's face must be better than A's by more than rounding, or they would take turns.
        if (const R s = separationAlong(m, n); s >= most) {
            best = n;
            most = s + m.tolerance;
        }
    };
    if (fa.count > 2) consider(fa.normal);
    if (fb.count > 2) consider(-fb.normal);
    if (most == m.separation - m.tolerance) return false;
    m.normal = best;
    m.separation = most - m.tolerance;
    return true;
}

constexpr int kRefSide = 1 << 16;  ///< line numbers from here on are sides of the reference prism

template <class R>
struct FeatureVertex {
    Vec3<R> x;
    int in, out;  ///< lines before and after: edge i of the incident feature, or kRefSide + side
};
template <class R>
struct FeaturePolygon {
    std::array<FeatureVertex<R>, 2 * SupportFeature<R>::kMost> v;
    int count = 0;
    void add(const FeatureVertex<R>& c) {
        if (count < 2 * SupportFeature<R>::kMost) v[count++] = c;
    }
    const FeatureVertex<R>& operator[](int i) const { return v[i]; }
};

/// Keeps what is below the plane m . (x - p) = 0. An open polygon (a segment) is not closed again.
template <class R>
void clip(const FeaturePolygon<R>& from, bool closed, const Vec3<R>& m, const Vec3<R>& p, int line,
          FeaturePolygon<R>& to) {
    to.count = 0;
    if (!closed && from.count > 0 && m.dot(from[0].x - p) <= 0) to.add(from[0]);
    for (int i = 0; i + (closed ? 0 : 1) < from.count; ++i) {
        const FeatureVertex<R>&a = from[i], &b = from[(i + 1) % from.count];
        const R sa = m.dot(a.x - p), sb = m.dot(b.x - p);
        if (sa <= 0 && sb <= 0) {
            to.add(b);
        } else if (sa <= 0) {
            to.add({a.x + (sa / (sa - sb)) * (b.x - a.x), a.out, line});
        } else if (sb <= 0) {
            to.add({b.x + (sb / (sb - sa)) * (a.x - b.x), line, a.out});
            to.add(b);
        }
    }
}

template <class R>
std::uint32_t clipFeature(const FeatureVertex<R>& c, const SupportFeature<R>& ref,
                          const SupportFeature<R>& inc, bool refIsA) {
    const auto edge = [](const SupportFeature<R>& f, int i) {
        const auto k = static_cast<std::size_t>(i);
        return edgeName(f.index[k], f.index[(k + 1) % static_cast<std::size_t>(f.count)]);
    };
    const bool inRef = c.in >= kRefSide, outRef = c.out >= kRefSide;
    if (!inRef && !outRef) return vertexFeature(!refIsA, inc.index[c.out]);
    if (inRef && outRef) {
        const int a = c.in - kRefSide, b = c.out - kRefSide;
        return vertexFeature(refIsA, ref.index[(a + 1) % ref.count == b ? b : a]);
    }
    const std::uint32_t onRef = edge(ref, (inRef ? c.in : c.out) - kRefSide);
    const std::uint32_t onInc = edge(inc, inRef ? c.out : c.in);
    return refIsA ? crossingFeature(onRef, onInc) : crossingFeature(onInc, onRef);
}

/// The lowest first; of those within rounding of it the first, so that a flat contact keeps its choice.
template <class R, class Height>
R steadyHeight(Height height, R lowest, R noise, int i) {
    const R h = height(i);
    return h <= lowest + noise ? lowest : h;
}

/// The first side of the smaller of two faces or segments.
template <class R>
R smallerSide(const SupportFeature<R>& a, const SupportFeature<R>& b) {
    return std::min((a.at[1] - a.at[0]).norm(), (b.at[1] - b.at[0]).norm());
}

/// A disc's points all are as deep where it lies flat. The choice of the deepest ones must not depend on the
/// rocking of a resting body: another choice in every step has no impulses for the warm start.
template <class R>
R selectionNoise(const FeaturePair<R>& m, const SupportFeature<R>& ref, const SupportFeature<R>& inc) {
    const bool discs = ref.count == kRimPoints || inc.count == kRimPoints;
    return discs ? std::max(R(2) * kRimNoise<R> * smallerSide(ref, inc), m.tolerance) : m.tolerance;
}

/// Distance that a vertex may be beyond an inner side and still count as over the face: rounding must not lose
/// it between two faces.
template <class R>
R innerSlack(const SupportFeature<R>& ref) {
    R size = 0;
    for (int i = 0; i < ref.count; ++i) size = std::max(size, ref.at[i].cwiseAbs().maxCoeff());
    return R(4) * kRounding<R> * size;
}

/// True where a vertex of the clipped polygon is on inner sides of the reference face alone (bit i: side i):
/// it is no vertex of what the incident feature has in common with the facet.
template <class R>
bool isInner(const FeatureVertex<R>& c, unsigned inner) {
    const bool inRef = c.in >= kRefSide, outRef = c.out >= kRefSide;
    if (!inRef && !outRef) return false;
    return (!inRef || inner >> (c.in - kRefSide) & 1u) && (!outRef || inner >> (c.out - kRefSide) & 1u);
}

/// A face against a face or a segment. `inner`: sides of the reference face beyond which its plane goes on.
template <class R>
void clipFeatures(const FeaturePair<R>& m, const SupportFeature<R>& ref, const SupportFeature<R>& inc,
                  bool refIsA, Manifold<S3<R>>& out, unsigned inner = 0) {
    const Vec3<R> outward = refIsA ? m.normal : Vec3<R>(-m.normal);
    FeaturePolygon<R> buffers[2];
    int now = 0;
    const bool closed = inc.count > 2;
    for (int i = 0; i < inc.count; ++i)
        buffers[0].add({inc.at[i], closed ? (i + inc.count - 1) % inc.count : 0, closed || i == 0 ? i : 1});
    for (int i = 0; i < ref.count && buffers[now].count > 0; ++i) {
        const Vec3<R>& p = ref.at[i];
        const Vec3<R>& q = ref.at[(i + 1) % ref.count];
        const Vec3<R> side = (q - p).cross(outward);
        const Vec3<R> on = inner >> i & 1u ? Vec3<R>(p + innerSlack<R>(ref) * side.normalized()) : p;
        clip<R>(buffers[now], closed, side, on, kRefSide + i, buffers[1 - now]);
        now = 1 - now;
    }
    const FeaturePolygon<R>& polygon = buffers[now];
    const R slope = R(1) / ref.normal.dot(outward);
    const auto height = [&](const Vec3<R>& x) { return R(ref.normal.dot(x - ref.at[0]) * slope); };
    std::array<int, 2 * SupportFeature<R>::kMost> near;
    int found = 0;
    R lowest = std::numeric_limits<R>::max();
    for (int i = 0; i < polygon.count; ++i)
        if (const R h = height(polygon[i].x); h <= m.speculative && !isInner(polygon[i], inner)) {
            near[found++] = i;
            lowest = std::min(lowest, h);
        }
    const auto at = [&](int k) -> const FeatureVertex<R>& { return polygon[near[k]]; };
    const R noise = selectionNoise(m, ref, inc);
    reducePoints<S3<R>>(
        found, outward, smallerSide(ref, inc), out.memory,
        [&](int k) { return steadyHeight<R>([&](int i) { return height(at(i).x); }, lowest, noise, k); },
        [&](int k) { return at(k).x; }, [&](int k) { return clipFeature(at(k), ref, inc, refIsA); },
        [&](int k) {
            const FeatureVertex<R>& c = at(k);
            const R h = height(c.x);
            const Vec3<R> onRef = c.x - h * outward;
            addPoint<S3<R>>(out, refIsA ? onRef : c.x, refIsA ? c.x : onRef, h,
                            clipFeature(c, ref, inc, refIsA));
        });
}

/// Step 3 for features at larger angles. `fa`, `fb` are replaced where there are points.
template <class R>
void clipFacing(const FeaturePair<R>& m, SupportFeature<R>& fa, SupportFeature<R>& fb, Manifold<S3<R>>& out) {
    SupportFeature<R> a, b;
    featuresAlong(m, &facingFeature<R>, a, b);
    if (a.count < 2 || b.count < 2) return;
    const R flatA = flatness(a, m.normal), flatB = flatness(b, m.normal);
    const bool isRefA = a.count > 2 && flatA >= kFlatFaces<R>, isRefB = b.count > 2 && flatB >= kFlatFaces<R>;
    if (isRefA && (!isRefB || flatA >= flatB))
        clipFeatures(m, a, b, true, out);
    else if (isRefB)
        clipFeatures(m, b, a, false, out);
    else if (isRound(a, m.normal) && b.count == 2 && flatB >= kFlatFaces<R>)
        alongSegments(m.normal, m.speculative, a, b, true, true, out);
    else if (isRound(b, m.normal) && a.count == 2 && flatA >= kFlatFaces<R>)
        alongSegments(m.normal, m.speculative, b, a, false, true, out);
    if (out.count == 0) return;
    fa = a;
    fb = b;
}

/// Step 1b: the penetration vector of the last step, if it is as short. `last` in the frame of A.
template <class R>
void keepWayOut(const Shape<S3<R>>& a, const Shape<S3<R>>& b, const Pose<S3<R>>& X, const Vec3<R>& last,
                ClosestPoints<S3<R>>& closest) {
    const R rA = roundingRadius<S3<R>>(a), rB = roundingRadius<S3<R>>(b);
    CoreContact<S3<R>> contact;
    contact.normal = closest.normal;
    contact.distance = closest.distance + rA + rB;
    contact.onA = closest.pointA - rA * closest.normal;
    contact.onB = closest.pointB + rB * closest.normal;
    keepNormal<S3<R>>(a, b, Minkowski<S3<R>>(a, Pose<S3<R>>{}, b, X), last, contact);
    closest.normal = contact.normal;
    closest.distance = contact.distance - rA - rB;
    closest.pointA = contact.onA + rA * contact.normal;
    closest.pointB = contact.onB - rB * contact.normal;
}

/// Sets the exact depth for pairs that are not in a sequence of steps: the deepest corner of a disc's polygon
/// is shallower than the rim between two by up to the noise.
template <class R>
void deepen(const FeaturePair<R>& m, R least, Manifold<S3<R>>& out) {
    for (int i = 0; i < out.count; ++i) {
        auto& p = out.points[i];
        if (p.separation != least || !(m.separation < least)) continue;
        const Vec3<R> half = R(0.5) * (least - m.separation) * m.normal;
        p.pointA += half;
        p.pointB -= half;
        p.separation = m.separation;
    }
}

/// Step 4.
template <class R>
void keepDeepest(const FeaturePair<R>& m, const SupportFeature<R>& fa, const SupportFeature<R>& fb,
                 Manifold<S3<R>>& out) {
    R least = std::numeric_limits<R>::max();
    for (int i = 0; i < out.count; ++i) least = std::min(least, out.points[i].separation);
    const R noise = fa.count > 2 && fb.count > 1   ? selectionNoise(m, fa, fb)
                    : fb.count > 2 && fa.count > 1 ? selectionNoise(m, fb, fa)
                                                   : m.tolerance;
    const R slack = fa.count > 1 && fb.count > 1 ? keepSlack(out.memory, smallerSide(fa, fb)) : R(0);
    if (out.count > 0 && least <= m.separation + R(4) * noise + slack) {
        if (out.memory.count == 0) deepen(m, least, out);
        return;
    }
    if (out.count == S3<R>::maxManifoldPoints) --out.count;
    const bool vertexOnA = fa.count == 1, vertexOnB = fb.count == 1;
    // Inside both features, whatever of them is near: a name that no crossing of two edges has.
    const std::uint32_t feature = vertexOnB   ? vertexFeature(false, fb.index[0])
                                  : vertexOnA ? vertexFeature(true, fa.index[0])
                                              : crossingFeature(0, 1);
    // Both points are on one line along the normal.
    const Vec3<R> middle = R(0.5) * (m.pointA + m.pointB), half = R(0.5) * m.separation * m.normal;
    addPoint<S3<R>>(out, middle - half, middle + half, m.separation, feature);
}

}  // namespace

template <class R>
void collideFeatures(const Shape<Space<R, 3>>& a, const Pose<Space<R, 3>>& Xa, const Shape<Space<R, 3>>& b,
                     const Pose<Space<R, 3>>& Xb, R speculative, Manifold<Space<R, 3>>& out) {
    using S = Space<R, 3>;
    const Pose<S> X = relativePose<S>(Xa, Xb);
    ClosestPoints<S> closest = closestPoints<S>(a, Pose<S>{}, b, X);
    if (out.memory.count > 0 && closest.distance < 0)
        keepWayOut(a, b, X, rotateInverse<R>(Xa.q, out.memory.normal), closest);
    if (!(closest.distance <= speculative)) return;
    const R size = std::max({closest.pointA.cwiseAbs().maxCoeff(), closest.pointB.cwiseAbs().maxCoeff(),
                             X.p.cwiseAbs().maxCoeff()});
    FeaturePair<R> m{a,
                     b,
                     X,
                     closest.normal,
                     closest.distance,
                     closest.pointA,
                     closest.pointB,
                     axisTolerance(size, closest.distance),
                     speculative};
    SupportFeature<R> fa, fb;
    featuresAlong(m, fa, fb);
    if (preferFaceNormal(m, fa, fb)) featuresAlong(m, fa, fb);
    out.normal = m.normal;
    if (fa.count > 2 && fb.count >= 2 &&
        (fb.count == 2 || fa.normal.dot(m.normal) >= -fb.normal.dot(m.normal) - kRounding<R>))
        clipFeatures(m, fa, fb, true, out);
    else if (fb.count > 2 && fa.count >= 2)
        clipFeatures(m, fb, fa, false, out);
    else if (fa.count == 2 && fb.count == 2)
        alongSegments(m.normal, m.speculative, fa, fb, true, false, out);
    if (out.count == 0) clipFacing(m, fa, fb, out);
    keepDeepest(m, fa, fb, out);
    toWorldFrame<S>(out, Xa);
}

template <class R>
void collideAlong(const Triangle<Space<R, 3>>& piece, bool front, const Shape<Space<R, 3>>& convex,
                  const Pose<Space<R, 3>>& X, typename Space<R, 3>::Real speculative,
                  Manifold<Space<R, 3>>& out, unsigned innerSides) {
    using S = Space<R, 3>;
    const Vec3<R> up = (piece.v[1] - piece.v[0]).cross(piece.v[2] - piece.v[0]).normalized();
    const Vec3<R> n = front ? up : Vec3<R>(-up);
    const Shape<S> triangle = piece;
    const FeaturePair<R> m{triangle, convex, X, n, R(0), Vec3<R>::Zero(), Vec3<R>::Zero(), R(0), speculative};
    SupportFeature<R> fa, fb;
    featuresAlong(m, fa, fb);
    out.count = 0;
    out.normal = n;
    // Sides of the feature, which goes round the other way seen from behind.
    unsigned inner = 0;
    for (std::size_t i = 0; i < 3 && innerSides != 0; ++i) {
        const int from = fa.index[i], to = fa.index[(i + 1) % 3], side = (from + 1) % 3 == to ? from : to;
        inner |= (innerSides >> side & 1u) << i;
    }
    if (fb.count >= 2) {
        clipFeatures(m, fa, fb, true, out, inner);
    } else if (fb.count == 1) {
        const Vec3<R>& x = fb.at[0];
        const R slack = inner == 0 ? R(0) : innerSlack(fa);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3<R> side = (fa.at[(i + 1) % 3] - fa.at[i]).cross(n);
            if (side.dot(x - fa.at[i]) > (inner >> i & 1u ? slack * side.norm() : R(0))) return;
        }
        const R s = n.dot(x - fa.at[0]);
        if (s <= speculative) addPoint<S>(out, x - s * n, x, s, vertexFeature(false, fb.index[0]));
    }
}

#define ALONG(S)                                                                                            \
    template void collideAlong<S::Real>(const Triangle<S>&, bool, const Shape<S>&, const Pose<S>&, S::Real, \
                                        Manifold<S>&, unsigned);
ALONG(Space3f)
ALONG(Space3d)
#undef ALONG
template void collideFeatures<float>(const Shape<Space3f>&, const Pose<Space3f>&, const Shape<Space3f>&,
                                     const Pose<Space3f>&, float, Manifold<Space3f>&);
template void collideFeatures<double>(const Shape<Space3d>&, const Pose<Space3d>&, const Shape<Space3d>&,
                                      const Pose<Space3d>&, double, Manifold<Space3d>&);

}  // namespace rigor::engine
