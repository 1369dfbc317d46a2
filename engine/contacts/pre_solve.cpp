// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/pre_solve.hpp"

#include <cmath>

#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

template <class S>
bool inRange(const PairCoefficients<S>& c) {
    return c.friction >= 0 && std::isfinite(c.friction) && c.restitution >= 0 && c.restitution <= 1 &&
           c.rollingFriction >= 0 && std::isfinite(c.rollingFriction) && c.torsionalFriction >= 0 &&
           std::isfinite(c.torsionalFriction) &&
           (c.staticFriction == 0 || (c.staticFriction >= c.friction && std::isfinite(c.staticFriction)));
}

}  // namespace

template <class S>
std::optional<PreSolveAnswer<S>> PreSolveCall<S>::operator()(const BodyArrays<S>& bodies,
                                                             const ShapeRecord<S>& a, const ShapeRecord<S>& b,
                                                             std::uint32_t piece, const Manifold<S>& manifold,
                                                             const typename S::Vec& pA,
                                                             const typename S::Vec& pB,
                                                             const PairCoefficients<S>& coefficients) const {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    PreSolveContact<S> contact;
    contact.bodyA = bodies.id[a.body];
    contact.bodyB = bodies.id[b.body];
    contact.shapeA = a.id;
    contact.shapeB = b.id;
    contact.piece = piece;
    contact.normal = manifold.normal;
    contact.points = std::span(manifold.points.data(), static_cast<std::size_t>(manifold.count));
    contact.coefficients = coefficients;
    Vec middle = Vec::Zero();
    for (const ManifoldPoint<S>& point : contact.points) middle += Real(0.5) * (point.pointA + point.pointB);
    if (manifold.count > 0) middle /= static_cast<Real>(manifold.count);
    const Velocity<S>&A = bodies.velocity[a.body], &B = bodies.velocity[b.body];
    contact.velocity = B.v + cross(B.w, Vec(middle - pB)) - A.v - cross(A.w, Vec(middle - pA));
    callback_(contact);
    if (contact.veto) return std::nullopt;
    if (!inRange<S>(contact.coefficients))
        throw EngineError("pre_solve", "a callback has set coefficients that are out of range");
    if (!contact.surfaceVelocity.allFinite())
        throw EngineError("pre_solve", "a callback has set a surface velocity that is not finite");
    return PreSolveAnswer<S>{contact.coefficients, contact.surfaceVelocity};
}

RIGOR_INSTANTIATE_CLASS(PreSolveCall)

}  // namespace rigor::engine
