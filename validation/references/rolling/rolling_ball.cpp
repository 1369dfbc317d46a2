// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See rolling_ball.hpp for the equations.
#include "validation/references/rolling/rolling_ball.hpp"

#include <cmath>

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;

}  // namespace

RollingBall::RollingBall(const Scenario& scenario, int index, int floor)
    : body_(&scenario.bodies[index]),
      ball_(ballOf(scenario, index)),
      plane_(planeOf(scenario, floor, ball_.center)),
      slip_({}, 0.0, {}, 0.0) {
    const std::string subject = bodyTitle(scenario, index);
    requireUndisturbed(scenario, index);
    requireContact(scenario, index, floor);
    requireStill(scenario, floor);
    require(std::abs(plane_.height(ball_.center) - ball_.radius) <= 1e-4 * ball_.radius,
            subject + " does not start in contact");
    const Vec3 n = plane_.normal, g = gravityOn(scenario, index);
    const double load = -dot(g, n);
    require(load > 0.0, "gravity does not press " + subject + " against the floor");
    const double fast = norm(ball_.velocity) + ball_.radius * norm(ball_.spin);
    require(negligible(dot(ball_.velocity, n), fast),
            "the velocity of " + subject + " is not along the floor");
    pull_ = g + load * n;
    if (negligible(norm(pull_), norm(g))) pull_ = {};
    const auto pair = pairCoefficients(scenario, ball_.material, plane_.material);
    friction_ = (1.0 + 1.0 / ball_.k) * pair.friction * load;
    holding_ = (1.0 + 1.0 / ball_.k) * holdingFriction(pair) * load;
    slip0_ = ball_.velocity - ball_.radius * cross(ball_.spin, n);
    slip0_ = slip0_ - dot(slip0_, n) * n;
    // Rolling up to rounding of the scenario's numbers is rolling.
    if (norm(slip0_) <= 1e-12 * fast) slip0_ = {};
    slip_ = PlanarSlide(pull_, friction_, slip0_, holding_);
    const double end = runEnd(scenario);
    for (int k = 1; k <= 8; ++k)
        require(plane_.holds(at(scenario.duration * k / 8.0).center),
                subject + " rolls over the edge of the floor");
    // Spin direction at a few times; spin = w0 + n x (...)/(k r).
    const Vec3 reference = ball_.spin;
    for (int k = 0; k <= 16; ++k) {
        const Vec3 w = at(end * k / 16.0).spin,
                   other = norm(reference) > 0.0 ? reference : at(end / 16.0).spin;
        if (norm(cross(w, other)) > 1e-13 * norm(w) * norm(other)) fixedAxis_ = false;
    }
    if (!fixedAxis_) {
        const auto rhs = [this](Real t, const OdeState& y, OdeState& d) {
            const Vec3 w = at(static_cast<double>(t)).spin;
            d[0] = (-w.x * y[1] - w.y * y[2] - w.z * y[3]) / 2;
            d[1] = (w.x * y[0] + w.y * y[3] - w.z * y[2]) / 2;
            d[2] = (w.y * y[0] + w.z * y[1] - w.x * y[3]) / 2;
            d[3] = (w.z * y[0] + w.x * y[2] - w.y * y[1]) / 2;
        };
        const Quat q = scenario::normalized(body_->pose.orientation);
        // The spin is known in double: 1e-12 is what that allows.
        std::vector<Real> breaks;
        for (const double time : slip_.kinks()) breaks.push_back(time);
        orientation_ = numerics::DenseSolution(rhs, 0, {q.w, q.x, q.y, q.z}, end, 1e-12L, breaks);
    }
}

RollingBall::State RollingBall::fromSlip(const PlanarSlide::State& slip, double t) const {
    const double k = ball_.k, share = k / (1.0 + k);
    const Vec3 n = plane_.normal;
    State state;
    state.velocity = ball_.velocity + (t / (1.0 + k)) * pull_ + share * (slip.velocity - slip0_);
    state.center = ball_.center + t * ball_.velocity + (0.5 * t * t / (1.0 + k)) * pull_ +
                   share * (slip.displacement - t * slip0_);
    // Impulse of friction per mass: g_t t - (v - v0).
    const Vec3 friction = t * pull_ - (state.velocity - ball_.velocity);
    state.spin = ball_.spin + (1.0 / (k * ball_.radius)) * cross(n, friction);
    return state;
}

RollingBall::State RollingBall::at(double t) const {
    return fromSlip(slip_.at(t), t);
}

PartialState RollingBall::exact(double t) const {
    const State s = at(t);
    if (!fixedAxis_) {
        const OdeState y = orientation_.at(t);
        const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
        return stateOf(*body_, s.center, scenario::normalized(Quat{d(0), d(1), d(2), d(3)}), s.velocity,
                       s.spin);
    }
    // Angle turned: integral of the spin, from the same integrals as the path.
    const double k = ball_.k;
    const Vec3 friction = (0.5 * t * t) * pull_ - (s.center - ball_.center - t * ball_.velocity);
    const Vec3 angle = t * ball_.spin + (1.0 / (k * ball_.radius)) * cross(plane_.normal, friction);
    return stateOf(*body_, s.center, turned(body_->pose.orientation, angle, 1.0), s.velocity, s.spin);
}

std::optional<PartialState> RollingBall::schemeExact(std::size_t step, double dt,
                                                     adapter::Scheme scheme) const {
    // Two coefficients: no one knows which of them a scheme takes in the step that ends the slip.
    if (!adapter::isEuler(scheme) || holding_ != friction_) return std::nullopt;
    const auto slip = steps_.at(pull_, friction_, slip0_, step, dt, scheme);
    const double t = step * dt;
    State s = fromSlip({slip.displacement, slip.velocity}, t);
    const double shift = scheme == adapter::Scheme::SymplecticEuler ? dt : -dt;
    s.center += (0.5 * t * shift / (1.0 + ball_.k)) * pull_;
    // The slip sums start at u0 for old velocities, at u1 for new ones: both are in `slip`.
    PartialState state = stateOf(*body_, s.center, s.velocity);
    state.angularVelocity = s.spin;
    return state;
}

double RollingBall::slipSpeed(const Trajectory& run, std::size_t k) const {
    const auto& state = run.state(k, ball_.body);
    const Vec3 n = plane_.normal;
    const Vec3 u = state.velocity - ball_.radius * cross(state.angularVelocity, n);
    return norm(u - dot(u, n) * n);
}

}  // namespace rigor::validation
