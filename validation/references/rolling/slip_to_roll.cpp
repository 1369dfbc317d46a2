// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball launched slipping on a level floor (bowling, backspin, masse): parabola until
//   t* = |u0|/(mu g (1 + 1/k)), then rolling straight with v = v0 - k/(1+k) u0, u0 = v0 - r w0 x n.
// k = 2/5 solid sphere, 2/3 shell, 1/2 disc; the final velocity does not depend on mu, nor on the time step.
// Source: Coriolis 1835; Routh, Dynamics of a System of Rigid Bodies, 1905.
// Assumes: level floor, contact from the start; see rolling_ball.hpp.
// Quantities: roll_time (extrapolated from the last slipping frames), rolling_speed, direction_error
// (angle of the final velocity from the exact one, so exactly 0), final_spin.
#include <cmath>

#include "validation/references/rolling/rolling_ball.hpp"

namespace rigor::validation {
namespace {

class SlipToRoll : public Reference {
  public:
    SlipToRoll(const Scenario& scenario, int ball, int floor)
        : duration_(scenario.duration), rolling_(scenario, ball, floor) {
        require(norm(rolling_.pull()) == 0.0,
                "gravity is not along the normal of the floor: use rolling_incline");
    }
    std::vector<int> bodies() const override { return {rolling_.ball().body}; }
    PartialState exact(int, double t) const override { return rolling_.exact(t); }
    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        return rolling_.schemeExact(step, dt, scheme);
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const auto stop = rolling_.slip().stopTime();
        if (!stop || *stop >= duration_) return result;
        const int index = rolling_.ball().body;
        const auto end = rolling_.at(duration_);
        const double fast =
            norm(rolling_.ball().velocity) + rolling_.ball().radius * norm(rolling_.ball().spin);
        if (fast == 0.0) return result;
        if (rolling_.initialSlip() > 0.0) {
            Quantity time{"roll_time", "s", *stop, {}, 0.0, {}};
            time.measure = [this](const Trajectory& run) {
                return extrapolatedStop(run, rolling_.initialSlip(),
                                        [&](std::size_t k) { return rolling_.slipSpeed(run, k); });
            };
            result.push_back(std::move(time));
        }
        // Independent of the step: the angular momentum about the line of contact is conserved.
        Quantity speed{"rolling_speed", "m/s", norm(end.velocity), norm(end.velocity), fast, {}};
        speed.measure = [index](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).velocity);
        };
        result.push_back(std::move(speed));
        const Vec3 axis = unit(end.velocity), side = cross(rolling_.normal(), axis);
        if (norm(end.velocity) > 1e-9 * fast) {
            Quantity direction{"direction_error", "rad", 0.0, 0.0, 1.0, {}};
            direction.measure = [=](const Trajectory& run) -> std::optional<double> {
                const Vec3 v = run.state(run.frames() - 1, index).velocity;
                return std::atan2(dot(v, side), dot(v, axis));
            };
            result.push_back(std::move(direction));
        }
        Quantity spin{
            "final_spin", "rad/s", norm(end.spin), norm(end.spin), fast / rolling_.ball().radius, {}};
        spin.measure = [index](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).angularVelocity);
        };
        result.push_back(std::move(spin));
        return result;
    }

  private:
    double duration_;
    RollingBall rolling_;
};

}  // namespace

std::unique_ptr<Reference> makeSlipToRoll(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "floor"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<SlipToRoll>(scenario, ball, parts.support("floor", ball));
}

}  // namespace rigor::validation
