// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball or disc on an incline: from rest it rolls iff tan(alpha) <= mu (1 + 1/k), with a = g sin(alpha)/(1 +
// k); else it slips with a = g (sin(alpha) - mu cos(alpha)) and k r w' = mu g cos(alpha). Any initial
// velocity and spin (rolling_ball.hpp). Source: Goldstein, Poole, Safko 2002, chapter 1; Routh 1905. Assumes:
// contact from the start, velocity along the plane; no rolling resistance. Quantities: displacement,
// final_speed, final_spin in the last frame; slip_ratio: slip speed over speed there.
#include <cmath>

#include "validation/references/rolling/rolling_ball.hpp"

namespace rigor::validation {
namespace {

class RollingIncline : public Reference {
  public:
    RollingIncline(const Scenario& scenario, int ball, int floor)
        : duration_(scenario.duration), rolling_(scenario, ball, floor) {}
    std::vector<int> bodies() const override { return {rolling_.ball().body}; }
    PartialState exact(int, double t) const override { return rolling_.exact(t); }
    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        return rolling_.schemeExact(step, dt, scheme);
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const int index = rolling_.ball().body;
        const auto end = rolling_.at(duration_);
        const double fast = norm(rolling_.pull()) * duration_ + norm(rolling_.ball().velocity) +
                            rolling_.ball().radius * norm(rolling_.ball().spin);
        if (fast == 0.0) return result;
        Quantity moved{"displacement", "m", norm(end.center - rolling_.ball().center), {}, 0.0, {}};
        if (moved.exact == 0.0) moved.scale = fast * duration_;
        moved.measure = [index](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).position - run.state(0, index).position);
        };
        // The ball's frame may turn about its centre: positions compare only when the two coincide.
        if (rolling_.exact(0.0).position == rolling_.ball().center) result.push_back(std::move(moved));
        Quantity speed{"final_speed", "m/s", norm(end.velocity), norm(end.velocity), fast, {}};
        speed.measure = [index](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).velocity);
        };
        Quantity spin{
            "final_spin", "rad/s", norm(end.spin), norm(end.spin), fast / rolling_.ball().radius, {}};
        spin.measure = [index](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index).angularVelocity);
        };
        // If the direction of slip is constant the velocities of the scheme are those of the exact motion.
        if (rolling_.initialSlip() > 0.0) {
            speed.schemeExact.reset();
            spin.schemeExact.reset();
        }
        result.push_back(std::move(speed));
        result.push_back(std::move(spin));
        if (norm(end.velocity) > 1e-9 * fast) {
            const double slip = norm(rolling_.slip().at(duration_).velocity) / norm(end.velocity);
            Quantity ratio{"slip_ratio", "1", slip, {}, 1.0, {}};
            ratio.measure = [this, index](const Trajectory& run) -> std::optional<double> {
                const double v = norm(run.state(run.frames() - 1, index).velocity);
                if (!(v > 0.0)) return std::nullopt;
                return rolling_.slipSpeed(run, run.frames() - 1) / v;
            };
            result.push_back(std::move(ratio));
        }
        return result;
    }

  private:
    double duration_;
    RollingBall rolling_;
};

}  // namespace

std::unique_ptr<Reference> makeRollingIncline(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "on"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<RollingIncline>(scenario, ball, parts.support("on", ball));
}

}  // namespace rigor::validation
