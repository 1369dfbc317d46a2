// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bouncing ball: drop height H = height of the centre over the floor minus the radius, v0 up, e restitution.
//   v1 = sqrt(v0^2 + 2 g H), t1 = (v0 + v1)/g; after bounce n the speed is e^n v1, t(n+1) = t(n) + 2 e^n
//   v1/g; the bounces accumulate at t1 + 2 e v1/(g (1 - e)); from then on the ball lies still.
// Source: Newton 1687; Brogliato, Nonsmooth Mechanics, 3rd ed., 2016, chapter 1.
// Assumes: gravity presses towards the floor; motion, gravity and spin axis along the normal, or no friction
// (then the tangential motion is free flight).
// Quantities: bounce_time_n, rebound_speed_n, apex_height_n (of the centre over the floor, after bounce n).
// Measured from the two ballistic arcs next to a bounce: exact for ballistic arcs, whatever the step.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

constexpr int kMaxBounces = 5;

class BouncingBall : public Reference {
  public:
    BouncingBall(const Scenario& scenario, int index, int floor)
        : duration_(scenario.duration),
          body_(scenario.bodies[index]),
          ball_(ballOf(scenario, index)),
          plane_(planeOf(scenario, floor, ball_.center)) {
        const std::string subject = bodyTitle(scenario, index);
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        requireStill(scenario, floor);
        const Vec3 n = plane_.normal, g = gravityOn(scenario, index);
        g_ = -dot(g, n);
        require(g_ > 0.0, "gravity does not pull " + subject + " towards the floor");
        pull_ = g + g_ * n;
        if (negligible(norm(pull_), norm(g))) pull_ = {};
        speed_ = dot(ball_.velocity, n);
        drift_ = ball_.velocity - speed_ * n;
        const auto pair = pairCoefficients(scenario, ball_.material, plane_.material);
        e_ = pair.restitution;
        const Vec3 sideSpin = ball_.spin - dot(ball_.spin, n) * n;
        const bool straight = pull_ == Vec3{} && negligible(norm(drift_), norm(ball_.velocity)) &&
                              negligible(norm(sideSpin), norm(ball_.spin));
        require(straight || holdingFriction(pair) == 0.0,
                "the bounce of " + subject +
                    " is oblique or gravity is not along the normal, and there is friction");
        if (straight) drift_ = {};
        gap_ = plane_.height(ball_.center) - ball_.radius;
        require(gap_ >= -1e-9 * ball_.radius, subject + " starts inside the floor");
        gap_ = std::max(gap_, 0.0);
        impact_ = std::sqrt(speed_ * speed_ + 2.0 * g_ * gap_);
        first_ = (speed_ + impact_) / g_;
        for (const double t : {0.5, 1.0})
            require(plane_.holds(ball_.center + tangential(t * duration_)),
                    subject + " leaves the floor sideways");
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        double height = 0.0, velocity = 0.0;
        if (t < first_) {
            height = gap_ + speed_ * t - 0.5 * g_ * t * t;
            velocity = speed_ - g_ * t;
        } else {
            double time = first_, up = e_ * impact_;
            // The ball lies still beyond the accumulation point, and where flights are shorter than rounding.
            bool resting = e_ < 1.0 && t >= first_ + 2.0 * e_ * impact_ / (g_ * (1.0 - e_));
            while (!resting && time + 2.0 * up / g_ <= t) {
                resting = 2.0 * up / g_ < 1e-15 * t;
                time += 2.0 * up / g_;
                up *= e_;
            }
            if (!resting) {
                const double s = t - time;
                height = up * s - 0.5 * g_ * s * s;
                velocity = up - g_ * s;
            }
        }
        const Vec3 n = plane_.normal;
        const Vec3 center = ball_.center + tangential(t) + (height - gap_) * n;
        return stateOf(body_, center, turned(body_.pose.orientation, ball_.spin, t),
                       drift_ + t * pull_ + velocity * n, ball_.spin);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        double time = first_, up = e_ * impact_;
        for (int n = 1; n <= kMaxBounces && time <= duration_ && impact_ > 0.0; ++n) {
            const std::string suffix = "_" + std::to_string(n);
            // A rebound must show in at least the time it takes to fly up and down: otherwise it is not
            // required.
            if (time + 0.25 * up / g_ > duration_) break;
            result.push_back({"bounce_time" + suffix,
                              "s",
                              time,
                              {},
                              0.0,
                              [this, n](const Trajectory& run) -> std::optional<double> {
                                  const auto bounce = findBounce(run, n);
                                  return bounce ? std::optional<double>(bounce->time) : std::nullopt;
                              }});
            result.push_back({"rebound_speed" + suffix,
                              "m/s",
                              up,
                              {},
                              impact_,
                              [this, n](const Trajectory& run) -> std::optional<double> {
                                  const auto bounce = findBounce(run, n);
                                  return bounce ? std::optional<double>(bounce->speed) : std::nullopt;
                              }});
            if (time + up / g_ <= duration_ && up > 0.0)
                result.push_back({"apex_height" + suffix,
                                  "m",
                                  ball_.radius + up * up / (2.0 * g_),
                                  {},
                                  0.0,
                                  [this, n](const Trajectory& run) { return apexAfter(run, n); }});
            time += 2.0 * up / g_;
            up *= e_;
            if (up <= 0.0) break;
        }
        return result;
    }

  private:
    struct Bounce {
        double time = 0.0, speed = 0.0;
        std::size_t after = 0;  ///< first frame of the arc that follows
    };
    Vec3 tangential(double t) const { return t * drift_ + (0.5 * t * t) * pull_; }
    double height(const Trajectory& run, std::size_t k) const {
        return plane_.height(centerOfMass(body_, run.state(k, ball_.body)));
    }
    double climb(const Trajectory& run, std::size_t k) const {
        return dot(plane_.normal, run.state(k, ball_.body).velocity);
    }

    /// Bounce number n: a falling frame followed by a jump upwards. The time is where the arc before and the
    /// arc after meet; their difference is linear in time.
    std::optional<Bounce> findBounce(const Trajectory& run, int n) const {
        const double least = 0.2 * std::pow(e_, n) * impact_;
        int seen = 0;
        for (std::size_t k = 1; k < run.frames(); ++k) {
            if (!(climb(run, k - 1) < 0.0)) continue;
            // Last falling frame a; the arc after starts at the first frame b that moves up, at most 3 later.
            const std::size_t a = k - 1;
            std::size_t b = k;
            while (b < run.frames() && b < a + 4 && !(climb(run, b) > least)) ++b;
            const double step = run.times[k] - run.times[a];
            const bool jumps = climb(run, k) - climb(run, a) > -0.5 * g_ * step;
            if (!jumps) continue;
            if (least == 0.0) b = k;
            if (b >= run.frames() || b >= a + 4) continue;
            if (++seen < n) {
                k = b;
                continue;
            }
            const double span = run.times[b] - run.times[a];
            const double va = climb(run, a), vb = climb(run, b), ha = height(run, a), hb = height(run, b);
            const double shared = va - vb - g_ * span;
            Bounce bounce;
            const double tau = std::clamp((hb - vb * span - 0.5 * g_ * span * span - ha) / shared, 0.0, span);
            bounce.time = run.times[a] + tau;
            bounce.speed = least == 0.0 ? vb : vb + g_ * (span - tau);
            bounce.after = b;
            return bounce;
        }
        return std::nullopt;
    }

    /// Vertex of the parabola through the frame next to the top.
    std::optional<double> apexAfter(const Trajectory& run, int n) const {
        const auto bounce = findBounce(run, n);
        if (!bounce) return std::nullopt;
        for (std::size_t k = bounce->after; k + 1 < run.frames(); ++k)
            if (climb(run, k) >= 0.0 && climb(run, k + 1) < 0.0)
                return height(run, k) + climb(run, k) * climb(run, k) / (2.0 * g_);
        return std::nullopt;
    }

    double duration_;
    const Body& body_;
    Ball ball_;
    Plane plane_;
    Vec3 pull_, drift_;
    double g_ = 0.0, speed_ = 0.0, e_ = 0.0, gap_ = 0.0;
    double impact_ = 0.0, first_ = 0.0;  ///< speed and time of the first impact
};

}  // namespace

std::unique_ptr<Reference> makeBouncingBall(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "floor"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<BouncingBall>(scenario, ball, parts.support("floor", ball));
}

}  // namespace rigor::validation
