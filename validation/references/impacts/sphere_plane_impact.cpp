// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Oblique impact of a ball (disc in 2D) on a plane, with spin. s = tangential part of v - r w x n at the
// impact:
//   stick iff k/(1+k) |s| <= mu (1+e) |vn|: v_t' = v_t - k/(1+k) s; else v_t' = v_t - mu (1+e)|vn| s/|s|;
//   v_n' = -e v_n; k r^2 w' changes by (-r n) x impulse/m. Free flight before and after, in any gravity.
// Source: Brach, Mechanical Impact Dynamics, 1991; Walton 1993; Foerster et al. 1994.
// Assumes: one impact within the time for which it is valid; valid until the second.
// Quantities: impact_time, normal_velocity, tangential_velocity, spin after the impact, taken from the last
// frame before the second impact, back along the free flight.
#include <algorithm>
#include <cmath>

#include "validation/references/impacts/impact_law.hpp"
#include "validation/references/numerics/roots.hpp"

namespace rigor::validation {
namespace {

class SpherePlaneImpact : public Reference {
  public:
    SpherePlaneImpact(const Scenario& scenario, int index, int floor)
        : duration_(scenario.duration),
          body_(scenario.bodies[index]),
          ball_(ballOf(scenario, index)),
          plane_(planeOf(scenario, floor, ball_.center)),
          gravity_(gravityOn(scenario, index)) {
        const std::string subject = bodyTitle(scenario, index);
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, floor);
        requireStill(scenario, floor);
        const Vec3 n = plane_.normal;
        const double gap = plane_.height(ball_.center) - ball_.radius;
        require(gap >= -1e-9 * ball_.radius, subject + " starts inside the floor");
        const auto hit =
            numerics::firstDescent(0.5L * dot(gravity_, n), dot(ball_.velocity, n), std::max(gap, 0.0));
        require(hit.has_value() && *hit <= scenario.duration,
                subject + " does not reach the floor within the duration");
        time_ = static_cast<double>(*hit);
        contact_ = ball_.center + time_ * ball_.velocity + (0.5 * time_ * time_) * gravity_;
        require(plane_.holds(contact_), subject + " misses the floor");
        before_ = ball_.velocity + time_ * gravity_;
        const auto pair = pairCoefficients(scenario, ball_.material, plane_.material);
        const Vec3 slip = before_ - ball_.radius * cross(ball_.spin, n);
        const auto impact =
            frictionalImpact(slip, n, pair, ball_.mass, ball_.mass * ball_.k / (1.0 + ball_.k));
        after_ = before_ + impact.impulse / ball_.mass;
        if (pair.restitution == 0.0) after_ = after_ - dot(after_, n) * n;
        spin_ = ball_.spin - (1.0 / (ball_.k * ball_.mass * ball_.radius)) * cross(n, impact.impulse);
        const double fall = 0.5 * dot(gravity_, n), up = dot(after_, n);
        if (fall < 0.0) validUntil_ = time_ + (up > 0.0 ? -up / fall : 0.0);
    }
    std::vector<int> bodies() const override { return {ball_.body}; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int, double t) const override {
        const Quat start = body_.pose.orientation;
        if (t < time_)
            return stateOf(body_, ball_.center + t * ball_.velocity + (0.5 * t * t) * gravity_,
                           turned(start, ball_.spin, t), ball_.velocity + t * gravity_, ball_.spin);
        const double s = t - time_;
        return stateOf(body_, contact_ + s * after_ + (0.5 * s * s) * gravity_,
                       turned(turned(start, ball_.spin, time_), spin_, s), after_ + s * gravity_, spin_);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const Vec3 n = plane_.normal, slipDirection = tangentDirection();
        const double scale = norm(before_) + ball_.radius * norm(ball_.spin);
        const auto add = [&](const char* name, const char* unitName, double exact, double against,
                             auto read) {
            Quantity q{name, unitName, exact, {}, against, {}};
            q.measure = [this, read](const Trajectory& run) -> std::optional<double> {
                const auto frame =
                    lastFrameBefore(run, time_ + 0.9 * (std::min(validUntil_, duration_) - time_));
                if (!frame || run.times[*frame] <= time_) return std::nullopt;
                const auto& state = run.state(*frame, ball_.body);
                const Vec3 v = state.velocity - (run.times[*frame] - time_) * gravity_;
                return read(v, state.angularVelocity);
            };
            result.push_back(std::move(q));
        };
        if (time_ < duration_ && validUntil_ > time_) {
            add("normal_velocity", "m/s", dot(after_, n), scale, [n](Vec3 v, Vec3) { return dot(v, n); });
            add("tangential_velocity", "m/s", dot(after_, slipDirection), scale,
                [slipDirection](Vec3 v, Vec3) { return dot(v, slipDirection); });
            const Vec3 axis = cross(n, slipDirection);
            add("spin", "rad/s", dot(spin_, axis), scale / ball_.radius,
                [axis](Vec3, Vec3 w) { return dot(w, axis); });
            result.push_back(impactTime());
        }
        return result;
    }

  private:
    Vec3 tangentDirection() const {
        const Vec3 n = plane_.normal, s = before_ - ball_.radius * cross(ball_.spin, n),
                   t = s - dot(s, n) * n;
        return norm(t) > 0.0 ? unit(t) : perpendicular(n);
    }
    /// Time at which the flights before (from frame 0) and after (from the last usable frame) meet along the
    /// normal.
    Quantity impactTime() const {
        Quantity q{"impact_time", "s", time_, {}, time_ > 0.0 ? 0.0 : duration_, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            const auto frame = lastFrameBefore(run, time_ + 0.9 * (std::min(validUntil_, duration_) - time_));
            if (!frame || run.times[*frame] <= time_) return std::nullopt;
            const Vec3 n = plane_.normal;
            const auto &a = run.state(0, ball_.body), &b = run.state(*frame, ball_.body);
            const double g = dot(gravity_, n), T = run.times[*frame], va = dot(a.velocity, n),
                         vb = dot(b.velocity, n);
            // ha + va t + g t^2/2 = hb + vb (t - T) + g (t - T)^2/2 is linear in t.
            const double slope = va - vb + g * T;
            if (!(slope < 0.0)) return std::nullopt;
            const double ha = dot(n, centerOfMass(body_, a)), hb = dot(n, centerOfMass(body_, b));
            return (hb - ha - vb * T + 0.5 * g * T * T) / slope;
        };
        return q;
    }

    double duration_;
    const Body& body_;
    Ball ball_;
    Plane plane_;
    Vec3 gravity_, contact_, before_, after_, spin_;
    double time_ = 0.0, validUntil_ = 1e300;
};

}  // namespace

std::unique_ptr<Reference> makeSpherePlaneImpact(const Scenario& scenario,
                                                 const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "floor"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<SpherePlaneImpact>(scenario, ball, parts.support("floor", ball));
}

}  // namespace rigor::validation
