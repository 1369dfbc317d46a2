// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The classical Runge-Kutta method of order 4 [HairerNorsettWanner1993, section II.1]:
//     k_1 = f(t, y), k_2 = f(t + h/2, y + h/2 k_1), k_3 = f(t + h/2, y + h/2 k_2), k_4 = f(t + h, y + h k_3),
//     y_1 = y + h/6 (k_1 + 2 k_2 + 2 k_3 + k_4)
// for y = (p, v, theta, L): position, velocity, the rotation vector theta with q = exp(theta) q_0, and the
// angular momentum L in the world. So orientations never leave the group [MuntheKaas1999],
// [HairerLubichWanner2006, section IV.8]:
//     theta' = dexp^-1_theta(w) = w - theta x w / 2 + theta x (theta x w) / 12,   w = I(q)^-1 L,   L' = torque
// (the next term of dexp^-1 is of order 4 in theta = O(h), hence of order 5 in y). Momentum is kept exactly
// where there is no torque; energy is not: its error falls with h^4 and grows with time.
//
// The gyroscopic term is part of w = I^-1 L, so every choice of `rotation` gives the same, but for `none`,
// whose law has no such term: then w itself is integrated, w' = I(q)^-1 torque. Damping is a force like
// others. Smooth forces only: a step that a jump of the force falls into is of order 1 (forces with a
// beginning and an end excepted: FreeFlow splits the step there), and h must resolve the fastest rate (h
// |rate| < 2.78).
//
// Four evaluations of the forces per step.
#include "engine/integrators/free_flow.hpp"
#include "engine/integrators/traits.hpp"
#include "engine/math/portable.hpp"

namespace rigor::engine {
namespace {

template <class S>
typename S::Ang inverseDexp(const typename S::Ang& theta, const typename S::Ang& w) {
    if constexpr (S::dim == 2) {
        (void)theta;
        return w;
    } else {
        using Real = typename S::Real;
        const typename S::Vec once = theta.cross(w), twice = theta.cross(once);
        return w - Real(0.5) * once + (Real(1) / Real(12)) * twice;
    }
}

/// ln(kept per second) [1/s].
template <class R>
R dampingRate(R kept) {
    return kept == R(1) ? R(0) : static_cast<R>(portable::log(static_cast<double>(kept)));
}

/// The spin variable of body i: angular momentum, or angular velocity where there is no gyroscopic term.
template <class S>
typename S::Ang spinOf(const FreeFlow<S>& flow, std::size_t i, const typename S::Rot& q,
                       const typename S::Ang& w) {
    return flow.rotation().gyroscopic ? flow.inertiaTimes(i, q, w) : w;
}
template <class S>
typename S::Ang velocityOf(const FreeFlow<S>& flow, std::size_t i, const typename S::Rot& q,
                           const typename S::Ang& spin) {
    return flow.rotation().gyroscopic ? flow.inverseInertiaTimes(i, q, spin) : spin;
}

/// y_0 + c (p, v, theta, L) of `slope`: pose and velocity of the flow.
template <class S>
void place(FreeFlow<S>& flow, std::size_t i, const typename FreeFlow<S>::Rate& slope, typename S::Real c) {
    using Ang = typename S::Ang;
    const Pose<S>& X0 = flow.startPose[i];
    const Velocity<S>& v0 = flow.startVelocity[i];
    flow.pose[i].p = X0.p + c * slope.p;
    flow.pose[i].q = flow.turned(X0.q, Ang(c * slope.turn));
    if (!flow.isDynamic(i)) return;
    const Ang spin = spinOf(flow, i, X0.q, v0.w) + c * slope.spin;
    flow.velocity[i].v = v0.v + c * slope.v;
    flow.velocity[i].w = velocityOf(flow, i, flow.pose[i].q, spin);
}

/// f at the flow's pose and velocity, whose rotation vector from the start is theta.
template <class S>
typename FreeFlow<S>::Rate slopeAt(const FreeFlow<S>& flow, std::size_t i, const typename S::Ang& theta) {
    const Velocity<S>& velocity = flow.velocity[i];
    typename FreeFlow<S>::Rate k;
    k.p = velocity.v;
    k.turn = inverseDexp<S>(theta, velocity.w);
    if (!flow.isDynamic(i)) {
        k.v = S::Vec::Zero();
        k.spin = zeroAng<S>();
        return k;
    }
    const BodyConstants<S>& body = flow.constants(i);
    const typename S::Rot& q = flow.pose[i].q;
    const auto spin = spinOf(flow, i, q, velocity.w);
    const typename S::Ang& torque = flow.wrench[i].torque;
    k.v = flow.acceleration(i) + dampingRate(body.linearVelocityKept) * velocity.v;
    k.spin = (flow.rotation().gyroscopic ? torque : flow.inverseInertiaTimes(i, q, torque)) +
             dampingRate(body.angularVelocityKept) * spin;
    return k;
}

template <class S>
void advanceRk4(FreeFlow<S>& flow, double begin, typename S::Real h) {
    using Real = typename S::Real;
    const Real reach[4] = {Real(0), Real(0.5) * h, Real(0.5) * h, h};
    const Real weight[4] = {h / Real(6), h / Real(3), h / Real(3), h / Real(6)};
    const double end = begin + static_cast<double>(h);
    const std::size_t n = flow.size();
    flow.startPose.assign(flow.pose.begin(), flow.pose.end());
    flow.startVelocity.assign(flow.velocity.begin(), flow.velocity.end());
    flow.rate.resize(n);
    flow.sum.resize(n);
    const auto moves = [&](std::size_t i) { return flow.isDynamic(i) || flow.isKinematic(i); };
    for (int stage = 0; stage < 4; ++stage) {
        for (std::size_t i = 0; stage > 0 && i < n; ++i)
            if (moves(i)) place(flow, i, flow.rate[i], reach[stage]);
        flow.evaluate(begin, end);
        for (std::size_t i = 0; i < n; ++i) {
            if (!moves(i)) continue;
            typename FreeFlow<S>::Rate& sum = flow.sum[i];
            typename S::Ang theta = zeroAng<S>();
            if (stage > 0) theta = reach[stage] * flow.rate[i].turn;
            const typename FreeFlow<S>::Rate k = slopeAt(flow, i, theta);
            if (stage == 0) sum = {S::Vec::Zero(), S::Vec::Zero(), zeroAng<S>(), zeroAng<S>()};
            sum.p += weight[stage] * k.p;
            sum.v += weight[stage] * k.v;
            sum.turn += weight[stage] * k.turn;
            sum.spin += weight[stage] * k.spin;
            flow.rate[i] = k;
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!moves(i)) continue;
        place(flow, i, flow.sum[i], Real(1));
        flow.turn[i] += flow.sum[i].turn;
    }
}

}  // namespace

IntegratorTraits integratorRk4Traits() {
    return {
        .scheme = FlightScheme::RungeKutta4, .order = 4, .forces = ForceTimes::Stages, .ownsRotation = true};
}

template <class S>
Integrator<S> integratorRk4() {
    return {nullptr, false, &advanceRk4<S>};
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorRk4<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
