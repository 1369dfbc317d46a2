// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A driven rod swings about one end and strikes a ball at rest: the time of impact of a turning body. With D
// the ball's distance from the pivot, R the sum of the radii of rod and ball, L the rod's length, the rod
// touches when it is still
//   delta = asin(R/D) before the ball's direction if sqrt(D^2 - R^2) <= L (its side hits), else
//   delta = acos((D^2 + L^2 - R^2)/(2 D L)) (its round end hits),
// and the ball leaves along the normal with (1 + e) times the normal speed of the rod there (no friction).
// Source: Ericson, Real-Time Collision Detection, 2005, ch. 5; Brach, Mechanical Impact Dynamics, 1991.
// Assumes: a kinematic capsule whose axis ends at its body's origin, turning about a fixed axis across it; a
// free ball in the plane of its turn; no gravity, no friction. Valid until the rod comes round again.
// Quantities: impact_time (from the way the ball has gone at the end), speed_after.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

constexpr double kFullTurn = 6.283185307179586476925;

class RodStrikesBall : public Reference {
  public:
    RodStrikesBall(const Scenario& scenario, int rod, int ball)
        : scenario_(scenario), ball_(ballOf(scenario, ball)) {
        const Body& swung = scenario.bodies[rod];
        const std::string subject = bodyTitle(scenario, rod);
        requireUndisturbed(scenario, ball);
        requireContact(scenario, rod, ball);
        requireStill(scenario, ball);
        require(gravityOn(scenario, ball) == Vec3{}, "gravity acts on the ball");
        require(swung.type == scenario::BodyType::Kinematic && swung.velocity == Vec3{},
                subject + " is not driven about a fixed point");
        const auto* capsule =
            swung.shapes.size() == 1 ? std::get_if<scenario::Capsule>(&swung.shapes[0].geometry) : nullptr;
        require(capsule != nullptr, subject + " is not a capsule");
        const Pose pose = swung.pose * swung.shapes[0].pose;
        const Vec3 half = rotate(pose.orientation, {0, capsule->halfLength, 0});
        pivot_ = swung.pose.position;
        const bool up = norm(pose.position - half - pivot_) < norm(pose.position + half - pivot_);
        const Vec3 near = up ? pose.position - half : pose.position + half;
        require(norm(near - pivot_) <= 1e-9 * norm(half),
                "the axis of " + subject + " does not end at its pivot");
        arm_ = 2.0 * (up ? half : -1.0 * half);
        turn_ = swung.angularVelocity;
        const Vec3 to = ball_.center - pivot_, axis = unit(turn_);
        require(turn_ != Vec3{} && std::abs(dot(axis, arm_)) <= 1e-9 * norm(arm_) &&
                    std::abs(dot(axis, to)) <= 1e-9 * norm(to),
                "the ball is not in the plane in which " + subject + " turns");
        const auto pair = pairCoefficients(scenario, swung.shapes[0].material, ball_.material);
        require(holdingFriction(pair) == 0.0, "there is friction between rod and ball");
        const double D = norm(to), R = capsule->radius + ball_.radius, L = norm(arm_);
        require(D > R && D < L + R, "the rod does not reach the ball");
        const double side = std::sqrt(D * D - R * R);
        const double delta = side <= L ? std::asin(R / D) : std::acos((D * D + L * L - R * R) / (2 * D * L));
        double ahead = std::atan2(dot(axis, cross(arm_, to)), dot(arm_, to));
        require(std::abs(ahead) > delta, "rod and ball overlap at the start");
        if (ahead < 0.0) ahead += kFullTurn;
        const double rate = norm(turn_);
        time_ = (ahead - delta) / rate;
        // The point on the rod and the normal of the impact.
        const Vec3 tip = rotate(scenario::fromAxisAngle(axis, rate * time_), arm_);
        const double along = std::clamp(dot(to, tip) / (L * L), 0.0, 1.0);
        const Vec3 normal = unit(to - along * tip);
        const Vec3 touch = along * tip + capsule->radius * normal;
        velocity_ = ((1.0 + pair.restitution) * dot(cross(turn_, touch), normal)) * normal;
        findEnd(R);
    }
    std::vector<int> bodies() const override { return {ball_.body}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override {
        const Body& b = scenario_.bodies[body];
        const bool hit = t >= time_;
        return stateOf(b, ball_.center + std::max(0.0, t - time_) * velocity_, b.pose.orientation,
                       hit ? velocity_ : Vec3{}, {});
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        if (time_ >= scenario_.duration || validUntil_ < scenario_.duration) return {};
        const auto last = [this](const Trajectory& run) { return run.state(run.frames() - 1, ball_.body); };
        const Body& b = scenario_.bodies[ball_.body];
        Quantity time{"impact_time", "s", time_, {}, 0.0, {}};
        time.measure = [this, last, &b](const Trajectory& run) -> std::optional<double> {
            const auto end = last(run);
            const double speed = norm(end.velocity);
            if (speed < 1e-3 * norm(velocity_)) return std::nullopt;
            return run.times.back() - norm(centerOfMass(b, end) - ball_.center) / speed;
        };
        Quantity speed{"speed_after", "m/s", norm(velocity_), {}, 0.0, {}};
        speed.measure = [last](const Trajectory& run) -> std::optional<double> {
            return norm(last(run).velocity);
        };
        return {time, speed};
    }

  private:
    /// Finds the end: the time when the rod, going round, comes as near to the ball again.
    void findEnd(double reach) {
        const Vec3 axis = unit(turn_);
        constexpr int kSamples = 20000;
        constexpr double kMostSamples = 1e6;
        const double end = runEnd(scenario_);
        // A hundred looks a turn at least; of a rod too fast for that, only as far as the looks go.
        const double samples = std::max(double{kSamples}, std::ceil(16 * norm(turn_) * (end - time_)));
        if (samples > kMostSamples) validUntil_ = time_ + (end - time_) * kMostSamples / samples;
        for (int k = 1; k <= std::min(samples, kMostSamples); ++k) {
            const double t = time_ + (end - time_) * k / samples;
            const Vec3 tip = rotate(scenario::fromAxisAngle(axis, norm(turn_) * t), arm_);
            const Vec3 to = ball_.center + (t - time_) * velocity_ - pivot_;
            const double along = std::clamp(dot(to, tip) / dot(tip, tip), 0.0, 1.0);
            if (norm(to - along * tip) >= reach * (1 - 1e-9)) continue;
            validUntil_ = time_ + (end - time_) * (k - 1) / samples;
            return;
        }
    }

    const Scenario& scenario_;
    Ball ball_;
    Vec3 pivot_, arm_, turn_, velocity_;  ///< arm_: to the far end at the start
    double time_ = 0.0, validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeRodStrikesBall(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"rod", "ball"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<RodStrikesBall>(scenario, parts.anyBody("rod", {ball}), ball);
}

}  // namespace rigor::validation
