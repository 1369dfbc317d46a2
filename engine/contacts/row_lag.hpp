// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows of a step from midpoint to midpoint are those of its middle q_M, and hold for the velocity v_1 at its end q_1:
//     J(q_1) v_1 = J(q_M) v_1 + (h/2) (dJ/dt) v + O(h^2)
// Where J turns (round bodies on curves, corners about which bodies turn, contacts that move over a turntable) the second
// term, the lag, is of order h, and leaving it out makes the step one of order 1: an overlap that a curve leads to would be
// removed by position correction, and the velocity projected on a tangent half a step old, which takes energy. It is
// extrapolated from the midpoint before: ((J(q_M) - J(q_M-1)) v_0) / 2.
#pragma once

#include <array>

#include "engine/contacts/contact.hpp"

namespace rigor::engine {

/// The lag of the rows of a point, J(q_1) v - J(q_M) v.
template <class S>
struct RowLag {
    typename S::Real normal = 0;  ///< the normal row's [m/s]
    /// Its components along the tangents are those of their rows [m/s].
    typename S::Vec slip = S::Vec::Zero();
    typename S::Real landing =
        0;                 ///< fraction of the step at which the point lands within it; 0: it does not
    bool bounces = false;  ///< it lands with restitution
    /// Changes of its arms [m] and of its normal from the middle of the step to its end.
    typename S::Vec armA = S::Vec::Zero(), armB = S::Vec::Zero(), normalTurn = S::Vec::Zero();
};
template <class S>
using RowLags = std::array<RowLag<S>, S::maxManifoldPoints>;

/// Arms of a point and the normal, at one time.
template <class S>
struct PointFrame {
    typename S::Vec rA = S::Vec::Zero(), rB = S::Vec::Zero(), normal = S::Vec::Zero();
};

/// Velocity of B's point relative to that of A.
template <class S>
typename S::Vec relativeVelocity(const PointFrame<S>& at, const Velocity<S>& a, const Velocity<S>& b) {
    return b.v + cross(b.w, at.rB) - a.v - cross(a.w, at.rA);
}

/// The largest turn of a normal or an arm in a step that is extrapolated [rad].
template <class Real>
inline constexpr Real kMostTurn = Real(0.3);

/// The lag of a point from its frames at the last midpoint and at this one. None where the point is new, its arms zero, or
/// has moved further than an extrapolation reaches.
template <class S>
RowLag<S> rowLag(const PointFrame<S>& last, const PointFrame<S>& now, const BodyArrays<S>& bodies,
                 const Contact<S>& contact) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const auto jumps = [](const Vec& from, const Vec& to) {
        return !((to - from).squaredNorm() <= kMostTurn<Real> * kMostTurn<Real> * to.squaredNorm());
    };
    if (jumps(last.normal, now.normal)) return {};
    if (bodies.invMass[contact.bodyA] > 0 && jumps(last.rA, now.rA)) return {};
    if (bodies.invMass[contact.bodyB] > 0 && jumps(last.rB, now.rB)) return {};
    const Velocity<S>&a = bodies.velocity[contact.bodyA], &b = bodies.velocity[contact.bodyB];
    const Vec before = relativeVelocity<S>(last, a, b), after = relativeVelocity<S>(now, a, b);
    RowLag<S> lag;
    lag.normal = Real(0.5) * (now.normal.dot(after) - last.normal.dot(before));
    lag.slip = Real(0.5) * (after - before);
    lag.armA = Real(0.5) * (now.rA - last.rA);
    lag.armB = Real(0.5) * (now.rB - last.rB);
    lag.normalTurn = Real(0.5) * (now.normal - last.normal);
    if (contact.driven)
        lag.slip += Real(0.5) * (cross(contact.surfaceB.w, Vec(now.rB - last.rB)) -
                                 cross(contact.surfaceA.w, Vec(now.rA - last.rA)));
    return lag;
}

}  // namespace rigor::engine
