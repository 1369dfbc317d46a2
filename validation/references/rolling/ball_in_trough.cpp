// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball (2D: a disc) rolls, or slides without friction, in a hollow whose axis is level: with r the ball's
// radius, R the hollow's and th the angle of the ball's centre from the lowest line,
//   th'' = -g sin(th)/((1 + k) (R - r)): a pendulum (swing.hpp); spin -(R - r) th'/r about the axis;
//   without friction k = 0 and no spin.
// It rolls where |F| = k/(1+k) m g |sin(th)| <= mu N, N = m (g cos(th) + (R - r) th'^2) at every angle.
// Source: Routh, Dynamics of a System of Rigid Bodies, 1905; Goldstein, Poole, Safko 2002, ch. 1.
// Assumes: contact from the start, motion across the axis, spin that fits; gravity alone. The hollow is made
// of facets (hollow.hpp); their finite angle is part of what a run is measured against.
// Quantities: period.
#include <cmath>

#include "validation/references/joints/swing.hpp"
#include "validation/references/rolling/hollow.hpp"

namespace rigor::validation {
namespace {

class BallInTrough : public Reference {
  public:
    BallInTrough(const Scenario& scenario, int ball, int trough)
        : scenario_(scenario),
          ball_(ballOf(scenario, ball)),
          body_(scenario.bodies[ball]),
          hollow_(hollowOf(scenario, trough, ball_.center)) {
        const std::string subject = bodyTitle(scenario, ball);
        requireUndisturbed(scenario, ball);
        requireContact(scenario, ball, trough);
        const Vec3 g = gravityOn(scenario, ball);
        require(norm(g) > 0.0 && std::abs(dot(g, hollow_.axis)) <= 1e-9 * norm(g),
                "the trough is not level along its axis");
        down_ = unit(g);
        side_ = cross(hollow_.axis, down_);
        const Vec3 out = hollow_.across(ball_.center);
        reach_ = hollow_.radius - ball_.radius;
        require(reach_ > 0.0 && std::abs(norm(out) - reach_) <= 1e-4 * hollow_.radius,
                subject + " does not touch the trough");
        const double angle = std::atan2(dot(out, side_), dot(out, down_));
        const Vec3 along = cross(hollow_.axis, unit(out));
        const double speed = dot(ball_.velocity, along), rate = speed / reach_;
        require(norm(ball_.velocity - speed * along) <= 1e-6 * norm(ball_.velocity),
                subject + " does not move along the trough's wall");
        const double mu = holdingFriction(pairCoefficients(scenario, ball_.material, hollow_.material));
        rolls_ = mu > 0.0;
        const double k = rolls_ ? ball_.k : 0.0;
        const Vec3 spin = rolls_ ? (-reach_ / ball_.radius * rate) * hollow_.axis : Vec3{};
        require(
            norm(ball_.spin - spin) <= 1e-6 * (norm(spin) + norm(ball_.spin)),
            subject + " does not roll at the start: its spin would be " + shown(spin, scenario.dimension));
        swing_ = Swing(std::sqrt(norm(g) / ((1 + k) * reach_)), angle, rate);
        require(swing_.parameter() < 0.5, subject + " rises above the trough's axis");
        for (int i = 0; rolls_ && i <= 2000; ++i) {
            const auto s = swing_.at(runEnd(scenario) * i / 2000);
            const auto th = static_cast<double>(s.angle), w = static_cast<double>(s.rate);
            const double load = norm(g) * std::cos(th) + reach_ * w * w;
            require(k / (1 + k) * norm(g) * std::abs(std::sin(th)) <= mu * load,
                    subject + " slips: friction is too small for the slope");
        }
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        const auto s = swing_.at(t);
        const auto th = static_cast<double>(s.angle), rate = static_cast<double>(s.rate);
        const Vec3 out = std::cos(th) * down_ + std::sin(th) * side_;
        const Vec3 place = ball_.center - hollow_.across(ball_.center) + reach_ * out;
        const double turn = rolls_ ? -reach_ / ball_.radius : 0.0;
        const auto first = static_cast<double>(swing_.at(0).angle);
        const Quat q = scenario::fromAxisAngle(hollow_.axis, turn * (th - first)) * body_.pose.orientation;
        return stateOf(body_, place, scenario::normalized(q), (reach_ * rate) * cross(hollow_.axis, out),
                       (turn * rate) * hollow_.axis);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const auto period = static_cast<double>(swing_.period());
        if (swing_.parameter() == 0 || swing_.firstPassage() + period > scenario_.duration) return result;
        Quantity q{"period", "s", period, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            const auto angle = [&](std::size_t k) { return angleIn(run, k); };
            const auto slope = [&](std::size_t k) {
                return dot(run.state(k, ball_.body).velocity,
                           cross(hollow_.axis, unit(hollow_.across(center(run, k))))) /
                       reach_;
            };
            return timeBetweenCrossings(run, angle, slope);
        };
        result.push_back(std::move(q));
        return result;
    }

  private:
    Vec3 center(const Trajectory& run, std::size_t k) const {
        return centerOfMass(body_, run.state(k, ball_.body));
    }
    double angleIn(const Trajectory& run, std::size_t k) const {
        const Vec3 out = hollow_.across(center(run, k));
        return std::atan2(dot(out, side_), dot(out, down_));
    }

    const Scenario& scenario_;
    Ball ball_;
    const Body& body_;
    Hollow hollow_;
    Vec3 down_, side_;
    double reach_ = 0.0;  ///< distance of the ball's centre from the axis [m]
    bool rolls_ = true;
    Swing swing_;
};

}  // namespace

std::unique_ptr<Reference> makeBallInTrough(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "trough"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<BallInTrough>(scenario, ball, parts.anyBody("trough", {ball}));
}

}  // namespace rigor::validation
