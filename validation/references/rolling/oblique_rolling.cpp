// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball that slides, turns and spins on a level floor in different directions, under sliding, rolling and torsional
// friction. With u = v - r w_t x n the velocity of its lowest point, w_t and w_n n the parts of its angular velocity
// along the floor and about the normal, and k = I/(m r^2):
//   slides (u != 0):  v' = -mu g u/|u|,   k r^2 w_t' = mu g r n x u/|u| - rho g w_t/|w_t|
//   rolls (u = 0):    v' = -(rho/r) g/(1 + k) v/|v| along a straight line, until it stops
//   always:           k r^2 w_n' = -rho_t g sgn w_n
// The directions of u and w_t pull on each other, so that the ball runs on a curve while it slides. Its equations are
// integrated to 1e-14 over s with ds = mu g/|u| dt: the direction of u, which turns faster and faster as u ends, is
// smooth in s, |u| falls exponentially, and what is left of it at the end is 1e-13 of the speeds of the start. It rolls
// afterwards as rho <= mu r (1 + k).
// Source: Ai, Chen, Rotter and Ooi, Powder Technology 206 (2011) 269, model A; Acary and Bourrier, Eur. J. Mech. A
// 85 (2021) 104046. Assumes: level floor, contact from the start, velocity along the floor, both slip and turning at the
// start; nothing but gravity and contact. Of one line: rolling_resistance. The orientation is not known.
// Quantities: slip_time and the way made across the first velocity ("sideways"); stop_time where it stops.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;

class ObliqueRolling : public Reference {
  public:
    ObliqueRolling(const Scenario& scenario, int index, int floor)
        : end_(runEnd(scenario)),
          duration_(scenario.duration),
          body_(scenario.bodies[index]),
          ball_(ballOf(scenario, index)),
          plane_(planeOf(scenario, floor, ball_.center)),
          pair_(pairCoefficients(scenario, ball_.material, plane_.material)),
          load_(-dot(gravityOn(scenario, index), plane_.normal)) {
        check(scenario, index, floor);
        spin0_ = dot(ball_.spin, plane_.normal);
        along_ = perpendicular(plane_.normal);
        across_ = cross(plane_.normal, along_);
        solve(scenario, index);
        for (int i = 0; i <= 64; ++i)
            require(plane_.holds(at(duration_ * i / 64.0).center),
                    bodyTitle(scenario, index) + " rolls off the floor");
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        const State s = at(t);
        PartialState state = stateOf(body_, s.center, s.velocity);
        state.angularVelocity = s.turning + spinAt(t) * plane_.normal;
        return state;
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (slipTime_ < 0.9 * duration_) {
            Quantity slip{"slip_time", "s", slipTime_, {}, 0.0, {}};
            slip.measure = [this](const Trajectory& run) {
                return extrapolatedStop(run, slipSpeed(run, 0),
                                        [&](std::size_t i) { return slipSpeed(run, i); });
            };
            result.push_back(std::move(slip));
        }
        const Vec3 side = cross(plane_.normal, unit(ball_.velocity));
        Quantity sideways{"sideways", "m", dot(at(duration_).center - ball_.center, side), {}, 0.0, {}};
        sideways.scale = std::max(norm(at(duration_).center - ball_.center), 1e-3 * ball_.radius);
        sideways.measure = [this, side](const Trajectory& run) -> std::optional<double> {
            return dot(centerOfMass(body_, run.state(run.frames() - 1, ball_.body)) - ball_.center, side);
        };
        if (norm(ball_.velocity) > 0.0) result.push_back(std::move(sideways));
        const double stop = slipTime_ + rollTime_;
        if (stop < 0.9 * duration_ && rollTime_ > slipTime_) {
            Quantity time{"stop_time", "s", stop, {}, 0.0, {}};
            time.measure = [this](const Trajectory& run) {
                return extrapolatedStop(run, norm(rolling_.velocity), [&](std::size_t i) {
                    return norm(run.state(i, ball_.body).velocity);
                });
            };
            result.push_back(std::move(time));
        }
        return result;
    }

  private:
    struct State {
        Vec3 center, velocity, turning;  ///< turning: angular velocity along the floor
    };
    /// Places of the unknowns: velocity, angular velocity, way, each along the two axes of the floor; time.
    enum { kV = 0, kW = 2, kX = 4, kT = 6, kUnknowns = 7 };

    void check(const Scenario& scenario, int index, int floor) const {
        const std::string subject = bodyTitle(scenario, index);
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        const Body& support = scenario.bodies[floor];
        const Vec3 n = plane_.normal, pull = gravityOn(scenario, index) + load_ * n;
        require(scenario.dimension == 3, "two dimensions have no oblique directions: rolling_resistance");
        require(support.velocity == Vec3{} && support.angularVelocity == Vec3{}, "the floor moves");
        require(load_ > 0.0, "gravity does not press " + subject + " onto the floor");
        require(negligible(norm(pull), load_), "the floor is not level");
        require(std::abs(plane_.height(ball_.center) - ball_.radius) <= 1e-4 * ball_.radius,
                subject + " does not start in contact");
        require(std::abs(dot(ball_.velocity, n)) <= 1e-9 * norm(ball_.velocity),
                subject + " moves across the floor");
        const Vec3 turning = ball_.spin - dot(ball_.spin, n) * n;
        const double fast = norm(ball_.velocity) + ball_.radius * norm(turning);
        require(norm(ball_.velocity - ball_.radius * cross(turning, n)) > 1e-6 * fast &&
                    ball_.radius * norm(turning) > 1e-6 * fast,
                subject + " does not both slip and turn at the start: rolling_resistance");
        require(pair_.friction > 0.0, "there is no friction");
        require(
            pair_.rollingFriction < 0.999 * pair_.friction * ball_.radius * (1 + ball_.k),
            "rolling friction is more than sliding friction may hold: " + subject + " does not come to roll");
    }

    Vec3 onFloor(const OdeState& y, int first) const {
        return static_cast<double>(y[first]) * along_ + static_cast<double>(y[first + 1]) * across_;
    }

    /// y' over s; y[kT] is the time.
    void derivative(const OdeState& y, OdeState& dyds) const {
        const Real r = ball_.radius, mu = Real(pair_.friction) * load_, k = ball_.k;
        const Real rho = Real(pair_.rollingFriction) * load_;
        // Along the axes (a, b) of the floor, with n = a x b: w x n = (w_b, -w_a), n x u = (-u_b, u_a).
        const Real ua = y[kV] - r * y[kW + 1], ub = y[kV + 1] + r * y[kW];
        const Real slip = std::hypot(ua, ub), turning = std::hypot(y[kW], y[kW + 1]), dt = slip / mu;
        const Real ea = slip > 0 ? ua / slip : 0, eb = slip > 0 ? ub / slip : 0;
        const Real ta = turning > 0 ? y[kW] / turning : 0, tb = turning > 0 ? y[kW + 1] / turning : 0;
        dyds[kV] = -mu * ea * dt;
        dyds[kV + 1] = -mu * eb * dt;
        dyds[kW] = (-mu * r * eb - rho * ta) / (k * r * r) * dt;
        dyds[kW + 1] = (mu * r * ea - rho * tb) / (k * r * r) * dt;
        dyds[kX] = y[kV] * dt;
        dyds[kX + 1] = y[kV + 1] * dt;
        dyds[kT] = dt;
    }

    void solve(const Scenario& scenario, int index) {
        const double r = ball_.radius, mu = pair_.friction * load_, rho = pair_.rollingFriction * load_;
        const Vec3 v = ball_.velocity, w = ball_.spin - spin0_ * plane_.normal;
        OdeState y(kUnknowns, 0);
        y[kV] = dot(v, along_);
        y[kV + 1] = dot(v, across_);
        y[kW] = dot(w, along_);
        y[kW + 1] = dot(w, across_);
        const double fast = norm(v) + r * norm(w);
        // |u| falls at least as exp(-fall s).
        const double fall = 1 + 1 / ball_.k - rho / (mu * ball_.k * r);
        longest_ = std::log(1e13) / fall;
        const Real way = Real(fast) * fast / mu;
        const OdeState scale{fast, fast, fast / r, fast / r, way, way, fast / mu};
        try {
            slide_ = numerics::DenseSolution(
                [this](Real, const OdeState& x, OdeState& dxds) { derivative(x, dxds); }, 0, y, longest_,
                1e-14L, {}, scale);
        } catch (const std::runtime_error& error) {
            violated("no reference to the required accuracy: " + bodyTitle(scenario, index) +
                     " nearly ceases to turn while it slides (" + error.what() + ")");
        }
        const OdeState last = slide_.at(longest_);
        slipTime_ = static_cast<double>(last[kT]);
        rolling_ = {ball_.center + onFloor(last, kX), onFloor(last, kV), onFloor(last, kW)};
        braking_ = rho / r / (1 + ball_.k);
        rollTime_ = braking_ > 0.0 ? norm(rolling_.velocity) / braking_ : end_;
    }

    State at(double t) const {
        if (t < slipTime_) {
            Real low = 0, high = longest_;
            for (int i = 0; i < 80; ++i) {
                const Real middle = (low + high) / 2;
                (slide_.at(middle)[kT] < t ? low : high) = middle;
            }
            const OdeState y = slide_.at(low);
            return {ball_.center + onFloor(y, kX), onFloor(y, kV), onFloor(y, kW)};
        }
        const double rolled = std::min(t - slipTime_, rollTime_), speed = norm(rolling_.velocity);
        const Vec3 line = unit(rolling_.velocity);
        const double left = speed - braking_ * rolled;
        const Vec3 velocity = rolled < rollTime_ ? left * line : Vec3{};
        return {rolling_.center + (speed - 0.5 * braking_ * rolled) * rolled * line, velocity,
                (1 / ball_.radius) * cross(plane_.normal, velocity)};
    }

    double spinAt(double t) const {
        const double braking = pair_.torsionalFriction * load_ / (ball_.k * ball_.radius * ball_.radius);
        return std::copysign(std::max(0.0, std::abs(spin0_) - braking * t), spin0_);
    }
    double slipSpeed(const Trajectory& run, std::size_t frame) const {
        const auto& state = run.state(frame, ball_.body);
        const Vec3 n = plane_.normal, u = state.velocity - ball_.radius * cross(state.angularVelocity, n);
        return norm(u - dot(u, n) * n);
    }

    double end_, duration_;
    const Body& body_;
    Ball ball_;
    Plane plane_;
    scenario::PairCoefficients pair_;
    double load_;          ///< normal acceleration [m/s^2]
    Vec3 along_, across_;  ///< axes of the floor
    double spin0_ = 0.0;   ///< about the normal [rad/s]
    numerics::DenseSolution slide_;
    double longest_ = 0.0;                    ///< end of slide_, in s
    double slipTime_ = 0.0, rollTime_ = 0.0;  ///< [s]
    double braking_ = 0.0;                    ///< deceleration of a rolling ball [m/s^2]
    State rolling_;                           ///< state in which it begins to roll
};

}  // namespace

std::unique_ptr<Reference> makeObliqueRolling(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "on"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<ObliqueRolling>(scenario, ball, parts.support("on", ball));
}

}  // namespace rigor::validation
