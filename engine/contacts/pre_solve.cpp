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
bool callPreSolve(const PreSolve<S>& callback, const BodyArrays<S>& bodies, const ShapeRecord<S>& a,
                  const ShapeRecord<S>& b, std::uint32_t piece, const Manifold<S>& manifold,
                  const typename S::Vec& pA, const typename S::Vec& pB, PairCoefficients<S>& coefficients) {
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
    callback(contact);
    if (contact.veto) return false;
    if (!inRange<S>(contact.coefficients))
        throw EngineError("pre_solve", "a callback has set coefficients that are out of range");
    coefficients = contact.coefficients;
    return true;
}

#define RIGOR_INSTANTIATE(S)                                                                               \
    template bool callPreSolve<S>(const PreSolve<S>&, const BodyArrays<S>&, const ShapeRecord<S>&,         \
                                  const ShapeRecord<S>&, std::uint32_t, const Manifold<S>&, const S::Vec&, \
                                  const S::Vec&, PairCoefficients<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
