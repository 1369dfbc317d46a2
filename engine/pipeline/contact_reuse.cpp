// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Answers of the narrow phase that are kept while two shapes hardly move against each other
// (WorldDef::reuseDistance). The idea is that of the contact caches of [Rouwe2022] and of
// [Box2D2024], which recycles contacts likewise; code and bounds are our own.
//
// With T the pose of the smaller shape (by its radius r about its origin) in the frame of the other, T' the
// same when the narrow phase was asked, no point of the smaller has moved by more than
//     m = |p - p'| + r |R - R'|,       |R - R'| = 2 sin(angle / 2) <= 2 |q - q'|   (2D: equal to |q - q'|)
// against the other. The answer stays while m <= s = min(reuseDistance, kMostTurn r). Narrow phases are asked
// for what is within speculativeDistance + s, so that
//     nothing found    stays true: nothing can have come within speculativeDistance; where the narrow phase
//     knows
//                      how far apart they are (Manifold::apart), until they could be as near as it was asked
//     a manifold       keeps its points, each where it was on its body, and its normal, fixed to the body
//                      whose face it is: n . (pB - pA) is the separation of the same two points now
// Against asking again, the deepest separation is off by at most 2 s, and exact between a corner and the face
// that it rests on; corners are the same corners, points where two edges cross slide with one of them; the
// normal of two edges turns with A, by at most s / r <= kMostTurn from the right one. What the solver sees
// moves with the bodies and jumps only at the moment of asking.
//
// Not kept: pairs with a ball, and of capsules and half-spaces, whose closed forms cost no more than this;
// and contacts found ahead (continuous_collision = speculative).
#include <algorithm>
#include <cmath>

#include "engine/pipeline/contact_set.hpp"

namespace rigor::engine {
namespace {

/// However small the shapes, more than this changes what they touch with [rad].
template <class R>
inline constexpr R kMostTurn = R(0.02);

template <class S>
bool worthKeeping(const Shape<S>& a, const Shape<S>& b) {
    const auto ball = [](const Shape<S>& s) { return std::holds_alternative<Sphere<S>>(s); };
    const auto smooth = [](const Shape<S>& s) {
        return std::holds_alternative<Capsule<S>>(s) || std::holds_alternative<HalfSpace<S>>(s);
    };
    return !ball(a) && !ball(b) && !(smooth(a) && smooth(b));
}

/// At least |R - R'| of two rotations.
template <class R>
R turned(const Rot2<R>& q, const Rot2<R>& p) {
    const R c = q.c - p.c, s = q.s - p.s;
    return std::sqrt(c * c + s * s);
}
template <class R>
R turned(const Eigen::Quaternion<R>& q, const Eigen::Quaternion<R>& p) {
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
    if (worthKeeping<S>(shapes_[a].shape, shapes_[b].shape))
        candidate.radius = std::min(shapes_[a].radius, shapes_[b].radius);
    return candidate;
}

template <class S>
typename S::Real ContactSet<S>::slack(const Candidate& candidate) const {
    return std::min(search_.reuseDistance, kMostTurn<Real> * candidate.radius);
}

template <class S>
Pose<S> ContactSet<S>::relative(const Candidate& candidate) const {
    const Pose<S>&A = shapePoses_[candidate.a], &B = shapePoses_[candidate.b];
    return candidate.byA ? inFrame<S>(B, A) : inFrame<S>(A, B);
}

template <class S>
bool ContactSet<S>::stillValid(const Candidate& candidate) const {
    if (!candidate.kept) return false;
    const Pose<S> now = relative(candidate);
    Real most = slack(candidate);
    if (candidate.contact == kNullIndex) most = std::max(most, candidate.apart - askedDistance(candidate));
    return (now.p - candidate.relative.p).norm() + candidate.radius * turned(now.q, candidate.relative.q) <=
           most;
}

/// Keeps what the narrow phase has just answered.
template <class S>
void ContactSet<S>::keep(Candidate& candidate) const {
    candidate.kept = slack(candidate) > 0;
    if (candidate.kept) candidate.relative = relative(candidate);
}

/// And the manifold of its contact.
template <class S>
void ContactSet<S>::keepPoints(Candidate& candidate, Contact<S>& contact) const {
    if (!candidate.kept) return;
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

/// The manifold that is kept, where its bodies are now.
template <class S>
void ContactSet<S>::carry(const Candidate& candidate, Contact<S>& contact) const {
    const Pose<S>&A = shapePoses_[candidate.a], &B = shapePoses_[candidate.b];
    const typename S::Mat Ra = toMatrix(A.q), Rb = toMatrix(B.q);
    const Vec between = B.p - A.p, n = (candidate.onB ? Rb : Ra) * candidate.normal;
    contact.manifold.normal = n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const typename ManifoldCache<S>::Point& kept = contact.cache.points[i];
        ManifoldPoint<S>& point = contact.manifold.points[i];
        // From A's origin: far from the world's, where coordinates are coarse, the separation is not.
        const Vec a = Ra * kept.onA, b = between + Rb * kept.onB;
        point.pointA = A.p + a;
        point.pointB = A.p + b;
        point.separation = n.dot(b - a);
    }
}

/// Answers of another search, in a world that a snapshot of other settings was restored into, hold no more.
template <class S>
void ContactSet<S>::forgetOtherAnswers() {
    if (keptFor_.speculativeDistance != search_.speculativeDistance ||
        keptFor_.reuseDistance != search_.reuseDistance)
        for (Candidate& candidate : candidates_) candidate.kept = false;
    keptFor_ = search_;
}

template <class S>
bool ContactSet<S>::completeRestored() {
    coefficientsHold_ = mayHolds_ = candidatesHavePieces_ = false;
    std::size_t count = 0;
    keys_.clear();
    for (Contact<S>& contact : contacts_) {
        const auto n = static_cast<std::size_t>(contact.manifold.count);
        for (std::size_t i = 0; i < n; ++i) contact.impacts = contact.impacts || contact.points[i].impact;
        // A world that solves patches leaves the points alone.
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
        if (c.kept && contact.cache.count != contact.manifold.count) return false;
    }
    return count == contacts_.size();
}

RIGOR_INSTANTIATE_CLASS(ContactSet)

}  // namespace rigor::engine
