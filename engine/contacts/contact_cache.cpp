// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_cache.hpp"

#include <algorithm>
#include <cmath>

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
Candidate<S> makeCandidate(const ShapeSet<S>& shapes, std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
    Candidate<S> candidate;
    candidate.a = a;
    candidate.b = b;
    candidate.piece = piece;
    candidate.byA = shapes[a].radius < shapes[b].radius;
    if (isWorthCaching<S>(shapes[a].shape, shapes[b].shape))
        candidate.radius = std::min(shapes[a].radius, shapes[b].radius);
    return candidate;
}

template <class S>
typename S::Real ContactCache<S>::slack(const Candidate<S>& candidate) const {
    const Real tolerance = std::max(shapes_.tolerance(candidate.a), shapes_.tolerance(candidate.b));
    return std::min(tolerance, kMaxTurn<Real> * candidate.radius);
}

template <class S>
Pose<S> ContactCache<S>::relative(const Candidate<S>& candidate) const {
    const Pose<S>&A = shapes_.pose(candidate.a), &B = shapes_.pose(candidate.b);
    return candidate.byA ? inFrame<S>(B, A) : inFrame<S>(A, B);
}

template <class S>
bool ContactCache<S>::hasHardlyMoved(const Candidate<S>& candidate) const {
    const Real allowed = slack(candidate);
    if (allowed == 0) return false;
    const Real ahead = motion(candidate);
    if (ahead > 0 && candidate.contact != kNullIndex) return false;
    const Pose<S> now = relative(candidate);
    Real most = ahead > 0 ? Real(-1) : allowed;
    if (candidate.contact == kNullIndex)
        most = std::max(most, candidate.separationBound - queryDistance(candidate) - ahead);
    return (now.p - candidate.relative.p).norm() +
               candidate.radius * rotationDistance(now.q, candidate.relative.q) <=
           most;
}

template <class S>
void ContactCache<S>::storeResult(Candidate<S>& candidate) const {
    candidate.cached = slack(candidate) > 0;
    // The normal of an ended contact would be part of the hash, and not of a snapshot of candidates without a result.
    candidate.onB = false;
    candidate.normal.setZero();
    if (candidate.cached) candidate.relative = relative(candidate);
}

template <class S>
void ContactCache<S>::storeManifold(Candidate<S>& candidate, Contact<S>& contact) const {
    if (!candidate.cached) return;
    const Pose<S>&A = shapes_.pose(candidate.a), &B = shapes_.pose(candidate.b);
    const Manifold<S>& manifold = contact.manifold;
    candidate.onB = manifold.memory.axis == ManifoldMemory<S>::kFaceB;
    candidate.normal = rotateInverse<Real>(candidate.onB ? B.q : A.q, manifold.normal);
    contact.cache.count = manifold.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        const ManifoldPoint<S>& point = manifold.points[i];
        contact.cache.points[i] = {toLocal<S>(A, point.pointA), toLocal<S>(B, point.pointB), point.feature};
    }
}

template <class S>
void ContactCache<S>::moveManifold(const Candidate<S>& candidate, Contact<S>& contact) const {
    const Pose<S>&A = shapes_.pose(candidate.a), &B = shapes_.pose(candidate.b);
    const typename S::Mat Ra = toMatrix(A.q), Rb = toMatrix(B.q);
    const typename S::Vec between = B.p - A.p, n = (candidate.onB ? Rb : Ra) * candidate.normal;
    contact.manifold.normal = n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const typename ManifoldCache<S>::Point& cached = contact.cache.points[i];
        ManifoldPoint<S>& point = contact.manifold.points[i];
        // Relative to A's origin, so that the separation is accurate far from the world's origin.
        const typename S::Vec a = Ra * cached.onA, b = between + Rb * cached.onB;
        point.pointA = A.p + a;
        point.pointB = A.p + b;
        point.separation = n.dot(b - a);
    }
}

#define RIGOR_INSTANTIATE(S) \
    template Candidate<S> makeCandidate<S>(const ShapeSet<S>&, std::uint32_t, std::uint32_t, std::uint32_t);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE
RIGOR_INSTANTIATE_CLASS(ContactCache)

}  // namespace rigor::engine
