// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact cache: the narrow phase is not called again while two shapes have hardly moved relative to each
// other (WorldDef::cacheTolerance). The idea is that of the contact caches of [Rouwe2022] and [Box2D2024];
// code and bounds are our own.
//
// Let T be the pose of the smaller shape (by its radius r about its origin) in the frame of the other, and T'
// the same at the last query. No point of the smaller shape has moved, relative to the other, by more than
//     m = |p - p'| + r |R - R'|,       |R - R'| = 2 sin(angle / 2) <= 2 |q - q'|   (2D: equal to |q - q'|)
// The cached result is valid while m <= s = min(cacheTolerance, kMaxTurn r). The narrow phase is queried with
// the distance speculativeDistance + s, so that
//     no contact    stays true: nothing can have come within speculativeDistance. With a lower bound of the
//                   separation (Manifold::separationLowerBound) it is valid until that has shrunk to the
//                   query distance
//     a manifold    keeps its points, each fixed to its body, and its normal, fixed to the body whose face it
//                   is: n . (pB - pA) is the separation of the same two points now
// Compared with a new query, the deepest separation is off by at most 2 s, and exact between a corner and the
// face that it rests on. Corners stay the same corners; points where two edges cross slide with one of them;
// the normal of two edges turns with A, by at most s / r <= kMaxTurn from the exact one. The solver's input
// moves with the bodies and jumps only at a query.
//
// Not cached: pairs with a sphere or circle, pairs of capsules and half-spaces, whose closed forms cost no
// more than this, and speculative contacts of continuous collision.
#include <algorithm>
#include <cmath>

#include "engine/contacts/contact_set.hpp"

namespace rigor::engine {
namespace {

/// Largest rotation of a cached manifold [rad], however small the shapes: beyond it the touching features may
/// change.
template <class R>
inline constexpr R kMaxTurn = R(0.02);

template <class S>
bool isWorthCaching(const Shape<S>& a, const Shape<S>& b) {
    const auto round = [](const Shape<S>& s) { return std::holds_alternative<Sphere<S>>(s); };
    const auto smooth = [](const Shape<S>& s) {
        return std::holds_alternative<Capsule<S>>(s) || std::holds_alternative<HalfSpace<S>>(s);
    };
    return !round(a) && !round(b) && !(smooth(a) && smooth(b));
}

/// Upper bound of |R - R'| of two rotations.
template <class R>
R rotationDistance(const Rot2<R>& q, const Rot2<R>& p) {
    const R c = q.c - p.c, s = q.s - p.s;
    return std::sqrt(c * c + s * s);
}
template <class R>
R rotationDistance(const Eigen::Quaternion<R>& q, const Eigen::Quaternion<R>& p) {
    return R(2) * (q.coeffs() - p.coeffs()).norm();
}

/// X in the frame of Y. The difference of the positions comes first: far from the origin it is exact.
template <class S>
Pose<S> inFrame(const Pose<S>& Y, const Pose<S>& X) {
    return {rotateInverse<typename S::Real>(Y.q, X.p - Y.p), compose(inverse(Y.q), X.q)};
}

}  // namespace

template <class S>
typename ContactSet<S>::Candidate ContactSet<S>::makeCandidate(std::uint32_t a, std::uint32_t b,
                                                               std::uint32_t piece) const {
    Candidate candidate;
    candidate.a = a;
    candidate.b = b;
    candidate.piece = piece;
    candidate.byA = shapes_[a].radius < shapes_[b].radius;
    if (isWorthCaching<S>(shapes_[a].shape, shapes_[b].shape))
        candidate.radius = std::min(shapes_[a].radius, shapes_[b].radius);
    return candidate;
}

template <class S>
typename S::Real ContactSet<S>::slack(const Candidate& candidate) const {
    return std::min(search_.cacheTolerance, kMaxTurn<Real> * candidate.radius);
}

template <class S>
Pose<S> ContactSet<S>::relative(const Candidate& candidate) const {
    const Pose<S>&A = shapePoses_[candidate.a], &B = shapePoses_[candidate.b];
    return candidate.byA ? inFrame<S>(B, A) : inFrame<S>(A, B);
}

template <class S>
bool ContactSet<S>::isCacheValid(const Candidate& candidate) const {
    if (!candidate.cached) return false;
    const Pose<S> now = relative(candidate);
    Real most = slack(candidate);
    if (candidate.contact == kNullIndex)
        most = std::max(most, candidate.separationBound - queryDistance(candidate));
    return (now.p - candidate.relative.p).norm() +
               candidate.radius * rotationDistance(now.q, candidate.relative.q) <=
           most;
}

/// Marks the result of the query just made as cached.
template <class S>
void ContactSet<S>::cacheResult(Candidate& candidate) const {
    candidate.cached = slack(candidate) > 0;
    if (candidate.cached) candidate.relative = relative(candidate);
}

/// Caches the manifold of a contact, in the frames of its bodies.
template <class S>
void ContactSet<S>::cacheManifold(Candidate& candidate, Contact<S>& contact) const {
    if (!candidate.cached) return;
    const Pose<S>&A = shapePoses_[candidate.a], &B = shapePoses_[candidate.b];
    const Manifold<S>& manifold = contact.manifold;
    candidate.onB = manifold.memory.axis == ManifoldMemory<S>::kFaceB;
    candidate.normal = rotateInverse<Real>(candidate.onB ? B.q : A.q, manifold.normal);
    contact.cache.count = manifold.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        const ManifoldPoint<S>& point = manifold.points[i];
        contact.cache.points[i] = {toLocal<S>(A, point.pointA), toLocal<S>(B, point.pointB), point.feature};
    }
}

/// Moves the cached manifold to the current poses of its bodies.
template <class S>
void ContactSet<S>::moveCachedManifold(const Candidate& candidate, Contact<S>& contact) const {
    const Pose<S>&A = shapePoses_[candidate.a], &B = shapePoses_[candidate.b];
    const typename S::Mat Ra = toMatrix(A.q), Rb = toMatrix(B.q);
    const Vec between = B.p - A.p, n = (candidate.onB ? Rb : Ra) * candidate.normal;
    contact.manifold.normal = n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const typename ManifoldCache<S>::Point& cached = contact.cache.points[i];
        ManifoldPoint<S>& point = contact.manifold.points[i];
        // Relative to A's origin, so that the separation is accurate far from the world's origin.
        const Vec a = Ra * cached.onA, b = between + Rb * cached.onB;
        point.pointA = A.p + a;
        point.pointB = A.p + b;
        point.separation = n.dot(b - a);
    }
}

/// Invalidates manifolds cached with other distances: a snapshot may come from a world with other settings.
template <class S>
void ContactSet<S>::invalidateCacheOfOtherSearch() {
    if (cachedSearch_.speculativeDistance != search_.speculativeDistance ||
        cachedSearch_.cacheTolerance != search_.cacheTolerance)
        for (Candidate& candidate : candidates_) candidate.cached = false;
    cachedSearch_ = search_;
}

template <class S>
bool ContactSet<S>::completeRestored() {
    coefficientsValid_ = mayCollideHolds_ = candidatesHavePieces_ = false;
    std::size_t count = 0;
    keys_.clear();
    for (Contact<S>& contact : contacts_) {
        const auto n = static_cast<std::size_t>(contact.manifold.count);
        for (std::size_t i = 0; i < n; ++i) contact.impacts = contact.impacts || contact.points[i].impact;
        // A world that solves patches does not write the points.
        contact.placed = n > 0 && !contact.points[0].rB.isZero(0);
    }
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
        Candidate& c = candidates_[k];
        if (c.a >= shapes_.size() || c.b >= shapes_.size() || c.a == c.b) return false;
        const auto key = [](const Candidate& x) { return std::pair(pairKey(x.a, x.b), x.piece); };
        if (k > 0 && key(candidates_[k - 1]) >= key(c)) return false;
        keys_.push_back(pairKey(c.a, c.b));
        candidatesHavePieces_ = candidatesHavePieces_ || c.piece != kNullIndex;
        const Candidate made = makeCandidate(c.a, c.b, c.piece);
        c.byA = made.byA;
        c.radius = made.radius;
        if (c.contact == kNullIndex) continue;
        if (count >= contacts_.size()) return false;
        const Contact<S>& contact = contacts_[count++];
        if (contact.shapeA != c.a || contact.shapeB != c.b || contact.piece != c.piece) return false;
        if (c.cached && contact.cache.count != contact.manifold.count) return false;
    }
    return count == contacts_.size();
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
