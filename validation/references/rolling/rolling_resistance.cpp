// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball (3D) or disc (2D) that rolls, slides and spins to rest under rolling and torsional friction:
//   along one line (line_roll.hpp); rolling on a level floor a = rho g r/(r^2 + i^2) with i^2 = I/m, so that it
//   stops after v0^2/(2 a); down a slope it starts where tan(slope) > rho/r;
//   about the normal w_n' = -rho_t N/I sgn w_n, whatever the rest does.
// Source: Ai, Chen, Rotter and Ooi, Powder Technology 206 (2011) 269, model A; Acary and Bourrier, Eur. J. Mech. A
// 85 (2021) 104046. Assumes: contact from the start; velocity, rolling spin and pull along one line in the plane;
// nothing but gravity and contact. The orientation is known where it turns about one axis.
// Quantities: stop_distance and stop_time where it stops, else displacement; spin_time where a spin ends.
#include <cmath>

#include "validation/references/parts.hpp"
#include "validation/references/rolling/line_roll.hpp"

namespace rigor::validation {
namespace {

class RollingResistance : public Reference {
  public:
    RollingResistance(const Scenario& scenario, int index, int floor)
        : duration_(scenario.duration),
          body_(scenario.bodies[index]),
          ball_(ballOf(scenario, index)),
          plane_(planeOf(scenario, floor, ball_.center)),
          pair_(pairCoefficients(scenario, ball_.material, plane_.material)),
          load_(-dot(gravityOn(scenario, index), plane_.normal)),
          pull_(gravityOn(scenario, index) + load_ * plane_.normal),
          motion_(motion(scenario, index, floor)) {
        for (int k = 0; k <= 64; ++k)
            require(plane_.holds(centerAt(duration_ * k / 64.0)),
                    bodyTitle(scenario, index) + " rolls off the floor");
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        const LineRoll::State s = motion_.at(t);
        const Vec3 n = plane_.normal, axis = cross(n, line_);
        const Vec3 w = (s.roll / ball_.radius) * axis + spinAt(t) * n;
        const Vec3 center = centerAt(t), velocity = s.velocity * line_;
        if (spin0_ == 0.0)
            return stateOf(body_, center, turned(body_.pose.orientation, axis, s.turned / ball_.radius),
                           velocity, w);
        if (s.turned == 0.0 && motion_.at(duration_).turned == 0.0)
            return stateOf(body_, center, turned(body_.pose.orientation, n, spunAt(t)), velocity, w);
        PartialState state = stateOf(body_, center, velocity);
        state.angularVelocity = w;
        return state;
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        addWay(result);
        addSpin(result);
        return result;
    }

  private:
    LineRoll motion(const Scenario& scenario, int index, int floor) {
        const std::string subject = bodyTitle(scenario, index);
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        const Body& support = scenario.bodies[floor];
        require(support.velocity == Vec3{} && support.angularVelocity == Vec3{}, "the floor moves");
        require(load_ > 0.0, "gravity does not press " + subject + " onto the floor");
        require(std::abs(plane_.height(ball_.center) - ball_.radius) <= 1e-4 * ball_.radius,
                subject + " does not start in contact");
        if (negligible(norm(pull_), load_)) pull_ = {};
        const Vec3 n = plane_.normal, v = ball_.velocity;
        spin0_ = dot(ball_.spin, n);
        if (negligible(spin0_, norm(ball_.spin))) spin0_ = 0.0;
        // The velocity that the rolling spin belongs to.
        const Vec3 rolls = ball_.radius * cross(ball_.spin - spin0_ * n, n);
        const double fast = norm(v) + norm(rolls);
        require(std::abs(dot(v, n)) <= 1e-9 * fast, subject + " moves across the floor");
        line_ = norm(v) >= 1e-9 * fast && norm(v) > 0.0 ? v : norm(rolls) > 0.0 ? rolls : pull_;
        line_ = norm(line_) > 0.0 ? unit(line_) : perpendicular(n);
        for (const Vec3& x : {v, rolls, pull_})
            require(norm(x - dot(x, line_) * line_) <= 1e-9 * norm(x),
                    subject +
                        " does not move along one line: its velocity, its rolling spin and the slope are "
                        "not parallel");
        return LineRoll({dot(pull_, line_), pair_.friction * load_, holdingFriction(pair_) * load_,
                         pair_.rollingFriction / ball_.radius * load_, ball_.k},
                        dot(v, line_), dot(rolls, line_));
    }
    Vec3 centerAt(double t) const { return ball_.center + motion_.at(t).way * line_; }
    /// Deceleration of the spin about the normal [rad/s^2].
    double braking() const {
        return pair_.torsionalFriction * load_ / (ball_.k * ball_.radius * ball_.radius);
    }
    double spinAt(double t) const {
        return std::copysign(std::max(0.0, std::abs(spin0_) - braking() * t), spin0_);
    }
    double spunAt(double t) const {
        const double end = braking() > 0.0 ? std::min(t, std::abs(spin0_) / braking()) : t;
        return std::copysign(std::abs(spin0_) * end - 0.5 * braking() * end * end, spin0_);
    }

    void addWay(std::vector<Quantity>& result) const {
        const auto rest = motion_.restTime();
        const bool stops = rest && *rest > 0.0 && *rest < duration_;
        const double moved = motion_.at(duration_).way;
        const double scale = std::max(std::abs(moved), std::abs(ball_.radius));
        Quantity way{stops ? "stop_distance" : "displacement", "m", moved, {}, scale, {}};
        way.measure = [this](const Trajectory& run) -> std::optional<double> {
            return dot(centerOfMass(body_, run.state(run.frames() - 1, ball_.body)) - ball_.center, line_);
        };
        result.push_back(std::move(way));
        const auto rolling = motion_.rollTime();
        if (!stops || !rolling || *rolling > 0.5 * *rest) return;
        Quantity time{"stop_time", "s", *rest, {}, 0.0, {}};
        time.measure = [this](const Trajectory& run) {
            const double start = norm(run.state(0, ball_.body).velocity);
            return extrapolatedStop(run, start,
                                    [&](std::size_t k) { return norm(run.state(k, ball_.body).velocity); });
        };
        result.push_back(std::move(time));
    }
    void addSpin(std::vector<Quantity>& result) const {
        if (spin0_ == 0.0 || !(braking() > 0.0) || std::abs(spin0_) >= braking() * duration_) return;
        Quantity time{"spin_time", "s", std::abs(spin0_) / braking(), {}, 0.0, {}};
        time.measure = [this](const Trajectory& run) {
            return extrapolatedStop(run, std::abs(spin0_), [&](std::size_t k) {
                return std::abs(dot(run.state(k, ball_.body).angularVelocity, plane_.normal));
            });
        };
        result.push_back(std::move(time));
    }

    double duration_;
    const Body& body_;
    Ball ball_;
    Plane plane_;
    scenario::PairCoefficients pair_;
    double load_;         ///< normal acceleration [m/s^2]
    Vec3 pull_, line_;    ///< gravity along the plane; direction of the motion
    double spin0_ = 0.0;  ///< about the normal [rad/s]
    LineRoll motion_;
};

}  // namespace

std::unique_ptr<Reference> makeRollingResistance(const Scenario& scenario,
                                                 const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "on"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<RollingResistance>(scenario, ball, parts.support("on", ball));
}

}  // namespace rigor::validation
