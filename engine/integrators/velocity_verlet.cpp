// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Velocity Verlet [SwopeAndersen1982], kick - drift - kick:
//     v_1/2 = v_0 + h/2 a(x_0, v_0),   x_1 = x_0 + h v_1/2,   v_1 = v_1/2 + h/2 a(x_1, v*_1).
// Forces that depend on the velocity see v*_1 = v_1/2 + h/2 a(x_0, v_0), which is of order 1 and enters v_1
// times h: the scheme stays of order 2. Without such forces it is symplectic [HairerLubichWanner2006, section
// I.1.4], and exact for a constant force.
//
// Rotation is split alike [HairerLubichWanner2006, section VII.5.3]: half the torque, the free rotation of
// the `rotation` choice over h, half the torque at the end. So the order is that of the rotation choice: 2
// for lie_midpoint and moser_veselov. Damping is exact over each half of the step.
//
// Two evaluations of the forces per step.
#include "engine/integrators/free_flow.hpp"
#include "engine/integrators/traits.hpp"

namespace rigor::engine {
namespace {

/// Half a step of forces and damping; `wrench` is of the pose.
template <class S>
Velocity<S> kicked(const FreeFlow<S>& flow, std::size_t i, const Velocity<S>& from, typename S::Real h) {
    const BodyConstants<S>& body = flow.constants(i);
    const auto linear = dampedStep(body.linearVelocityKept, h);
    const auto angular = dampedStep(body.angularVelocityKept, h);
    Velocity<S> to;
    to.v = linear.kept * from.v + linear.kick * flow.acceleration(i);
    to.w = angular.kept * from.w +
           angular.kick * flow.inverseInertiaTimes(i, flow.pose[i].q, flow.wrench[i].torque);
    return to;
}

template <class S>
void drift(FreeFlow<S>& flow, std::size_t i, typename S::Real h) {
    using Ang = typename S::Ang;
    Pose<S>& X = flow.pose[i];
    Velocity<S>& velocity = flow.velocity[i];
    X.p += h * velocity.v;
    const typename S::Rot q0 = X.q;
    const RotationScheme<S>& scheme = flow.rotation();
    const Ang w = velocity.w;
    const Ang W = flow.isDynamic(i) ? scheme.predict(flow.constants(i), q0, w, h) : w;
    X.q = flow.turned(q0, Ang(h * W));
    flow.turn[i] += h * W;
    if (!flow.isDynamic(i)) return;
    velocity.w = scheme.finish ? scheme.finish(flow.constants(i), q0, X.q, w, W, W) : W;
}

template <class S>
void advanceVerlet(FreeFlow<S>& flow, double begin, typename S::Real h) {
    const double end = begin + static_cast<double>(h);
    const typename S::Real half = typename S::Real(0.5) * h;
    const std::size_t n = flow.size();
    flow.evaluate(begin, end);
    flow.startVelocity.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (flow.isDynamic(i)) flow.velocity[i] = kicked(flow, i, flow.velocity[i], half);
        if (flow.isDynamic(i) || flow.isKinematic(i)) drift(flow, i, h);
        flow.startVelocity[i] = flow.velocity[i];  // v_1/2, and the velocity after the free rotation
        // The torque of the start in the frame of the final orientation: an error of order 1, times h.
        if (flow.isDynamic(i)) flow.velocity[i] = kicked(flow, i, flow.velocity[i], half);
    }
    flow.evaluate(begin, end);
    for (std::size_t i = 0; i < n; ++i)
        if (flow.isDynamic(i)) flow.velocity[i] = kicked(flow, i, flow.startVelocity[i], half);
}

}  // namespace

IntegratorTraits integratorVelocityVerletTraits() {
    return {.scheme = FlightScheme::VelocityVerlet, .order = 2, .forces = ForceTimes::StartAndEnd};
}

template <class S>
Integrator<S> integratorVelocityVerlet() {
    return {nullptr, false, &advanceVerlet<S>};
}
#define RIGOR_INSTANTIATE(S) template Integrator<S> integratorVelocityVerlet<S>();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
