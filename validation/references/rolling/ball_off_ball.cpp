// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball (disc in 2D) on a fixed ball slides or rolls down from near the top and leaves it. With theta from
// the top, d = R + r, k = I/(m r^2), s = d theta' - r w the slip:
//   rolls:  theta'' = g sin(theta)/((1 + k) d), friction k/(1 + k) m g sin(theta) up to mu N (static mu);
//   slips:  theta'' = (g sin(theta) - mu N/m sign(s))/d, k r w' = mu N/m sign(s);
//   N = m (g cos(theta) - d theta'^2); leaves where N = 0: cos(theta) = 2 cos(theta0)/(3 + k') from rest, k'
//   = 0
// without friction, k where it rolls to the end. Then free flight. Integrated to 1e-12; the separation
// without friction is the closed form. Source: Goldstein, Poole, Safko 2002, ch. 1, exercises; Routh 1905.
// Assumes: touching at the start, velocity along the surface, in the plane of gravity and the centres; spin
// across it. Quantities: clear_time and clear_angle, where the gap is a twentieth of the radius.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/roots.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using numerics::DenseSolution;
using numerics::OdeState;
using numerics::Real;

constexpr std::size_t kMostPieces = 5000;  // pieces of a natural time at most

class BallOffBall : public Reference {
  public:
    BallOffBall(const Scenario& scenario, int index, int base)
        : scenario_(scenario), ball_(ballOf(scenario, index)), body_(scenario.bodies[index]) {
        const std::string subject = bodyTitle(scenario, index);
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, base);
        const Body& fixed = scenario.bodies[base];
        require(fixed.type == scenario::BodyType::Static && fixed.shapes.size() == 1 &&
                    std::holds_alternative<scenario::Sphere>(fixed.shapes[0].geometry),
                bodyTitle(scenario, base) + " is not a fixed ball");
        middle_ = fixed.pose * fixed.shapes[0].pose.position;
        const Vec3 g = gravityOn(scenario, index), from = ball_.center - middle_;
        pull_ = norm(g);
        require(pull_ > 0.0, "nothing pulls " + subject);
        up_ = -unit(g);
        distance_ = norm(from);
        require(std::abs(distance_ - std::get<scenario::Sphere>(fixed.shapes[0].geometry).radius -
                         ball_.radius) <= 1e-6 * ball_.radius,
                subject + " does not touch the fixed ball");
        const auto pair = pairCoefficients(scenario, ball_.material, fixed.shapes[0].material);
        mu_ = pair.friction;
        holds_ = holdingFriction(pair);
        side_ = unit(from - dot(from, up_) * up_);
        require(side_ != Vec3{}, subject + " stands on the top: nothing says which way it goes");
        axis_ = cross(up_, side_);  // positive spin rolls down along side_
        const double angle = std::atan2(dot(from, side_), dot(from, up_));
        const Vec3 along = std::cos(angle) * side_ - std::sin(angle) * up_, v = ball_.velocity,
                   w = ball_.spin;
        require(norm(v - dot(v, along) * along) <= 1e-9 * norm(v) &&
                    norm(w - dot(w, axis_) * axis_) <= 1e-9 * norm(w),
                subject + " does not move along the surface in the plane of gravity");
        follow({angle, dot(v, along) / distance_, 0, dot(w, axis_)});
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        if (t > leaves_) {
            const double s = t - leaves_;
            const Vec3 g = -pull_ * up_;
            return stateOf(body_, left_.com + s * left_.velocity + (0.5 * s * s) * g,
                           turnedBy(left_.turn + s * left_.spin), left_.velocity + s * g, left_.spin * axis_);
        }
        const Moment m = momentAt(t);
        return stateOf(body_, m.com, turnedBy(m.turn), m.velocity, m.spin * axis_);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (!(leaves_ < scenario_.duration)) return result;
        // The gap grows from nothing with the square of time: taken where it can be seen in any run.
        const double apart = distance_ + 0.05 * ball_.radius;
        double low = leaves_, high = scenario_.duration;
        const auto away = [&](double t) { return norm(*exact(ball_.body, t).position - middle_) - apart; };
        if (body_.massProperties.centerOfMass != Vec3{} || away(high) <= 0.0) return result;
        const auto when = static_cast<double>(
            numerics::findRoot([&](Real t) { return Real{away(static_cast<double>(t))}; }, low, high));
        result.push_back({"clear_time", "s", when, {}, 0.0, [this, apart](const Trajectory& run) {
                              return clearTime(run, apart);
                          }});
        const auto angleAt = [this](Vec3 x) {
            return std::atan2(dot(x - middle_, side_), dot(x - middle_, up_));
        };
        result.push_back({"clear_angle",
                          "rad",
                          angleAt(*exact(ball_.body, when).position),
                          {},
                          0.0,
                          [this, apart, angleAt](const Trajectory& run) -> std::optional<double> {
                              const auto t = clearTime(run, apart);
                              if (!t) return std::nullopt;
                              const auto k = lastFrameBefore(run, *t);
                              if (!k || *k + 1 >= run.frames()) return std::nullopt;
                              const double f = (*t - run.times[*k]) / (run.times[*k + 1] - run.times[*k]);
                              return angleAt((1 - f) * run.state(*k, ball_.body).position +
                                             f * run.state(*k + 1, ball_.body).position);
                          }});
        return result;
    }

  private:
    struct Moment {
        Vec3 com, velocity;
        double turn = 0.0, spin = 0.0;
    };
    struct Phase {
        double begin = 0.0, end = 0.0;
        DenseSolution solution;
    };

    Real loadOf(const OdeState& y) const { return pull_ * std::cos(y[0]) - distance_ * y[1] * y[1]; }
    Real slipOf(const OdeState& y) const { return distance_ * y[1] - ball_.radius * y[3]; }

    /// Friction per mass that rolling needs, signed like `sign` in follow().
    Real needOf(const OdeState& y) const { return ball_.k / (1 + ball_.k) * pull_ * std::sin(y[0]); }
    /// Margin of friction of a contact that rolls.
    Real spareOf(const OdeState& y) const { return holds_ * loadOf(y) - std::abs(needOf(y)); }

    /// y = theta, theta', angle turned, spin. It covers the time from the start to the separation, rolling or
    /// slipping.
    void follow(OdeState y) {
        double t = 0.0;
        const double end = runEnd(scenario_);
        require(loadOf(y) > 0, "the ball is already too fast to stay on");
        const Real natural = std::sqrt(pull_ / distance_) + std::abs(y[1]),
                   spin = distance_ / ball_.radius * natural + std::abs(y[3]);
        const bool slips = std::abs(slipOf(y)) > 1e-9L * ball_.radius * spin;
        bool rolls = !slips && spareOf(y) >= 0;
        // If the ball does not slip yet and does not stick, gravity gives the direction of its slip.
        Real sign = slips ? (slipOf(y) > 0 ? 1 : -1) : (y[0] >= 0 ? 1 : -1);
        int stops = 0;
        while (t < end) {
            const Real sliding = mu_ * sign;
            const auto rhs = [=, this](Real, const OdeState& s, OdeState& d) {
                const Real friction = rolls ? needOf(s) : sliding * loadOf(s);
                d = {s[1], (pull_ * std::sin(s[0]) - friction) / distance_, s[3],
                     friction / (ball_.k * ball_.radius)};
            };
            // The integration goes in pieces: soon beyond the separation the equations of the contact have no
            // meaning.
            const double until = std::min({end, t + end / 48, t + static_cast<double>(1 / natural)});
            Phase phase{t, until, DenseSolution(rhs, t, y, until, 1e-14L, {}, {1, natural, 1, spin})};
            // Rolls while friction holds; slips until the slip is gone; either until the load is.
            const auto keeps = [&](Real at) {
                const OdeState s = phase.solution.at(at);
                if (rolls) return spareOf(s);
                return mu_ > 0.0 ? sign * slipOf(s) : Real{1};
            };
            const auto loaded = [&](Real at) { return loadOf(phase.solution.at(at)); };
            const auto lost = firstLoss(loaded, t, until), changed = firstLoss(keeps, t, until);
            phase.end = std::min(lost.value_or(until), changed.value_or(until));
            phases_.push_back(phase);
            y = phase.solution.at(phase.end);
            stops = phase.end > t ? 0 : stops + 1;
            require(phases_.size() < kMostPieces, "the ball stays on for too long beside its natural time");
            require(stops < 4, "rolling and slipping alternate at one instant: the laws leave it open");
            t = phase.end;
            if (lost && *lost <= phase.end) {
                leaves_ = t;
                left_ = momentAt(t);
                return;
            }
            if (!changed) continue;
            rolls = !rolls && spareOf(y) >= 0;
            sign = std::sin(y[0]) >= 0 ? 1 : -1;
        }
    }

    static std::optional<double> firstLoss(const std::function<Real(Real)>& f, double from, double to) {
        const int looks = 100;
        for (int i = 1; i <= looks; ++i) {
            const double a = from + (to - from) * (i - 1) / looks, b = from + (to - from) * i / looks;
            if (f(b) >= 0) continue;
            if (!(f(a) > 0)) return a;
            return static_cast<double>(numerics::findRoot(f, a, b));
        }
        return std::nullopt;
    }

    Moment momentAt(double t) const {
        const Phase* phase = &phases_.front();
        for (const Phase& p : phases_)
            if (p.begin <= t) phase = &p;
        const OdeState y = phase->solution.at(t);
        const double a = static_cast<double>(y[0]), c = std::cos(a), s = std::sin(a);
        return {middle_ + distance_ * (s * side_ + c * up_),
                (distance_ * static_cast<double>(y[1])) * (c * side_ - s * up_), static_cast<double>(y[2]),
                static_cast<double>(y[3])};
    }

    Quat turnedBy(double angle) const {
        return scenario::normalized(scenario::fromAxisAngle(axis_, angle) * body_.pose.orientation);
    }

    std::optional<double> clearTime(const Trajectory& run, double apart) const {
        return upwardCrossing(
            run, 0, [&](std::size_t k) { return norm(run.state(k, ball_.body).position - middle_) - apart; },
            [&](std::size_t k) {
                return dot(unit(run.state(k, ball_.body).position - middle_),
                           run.state(k, ball_.body).velocity);
            });
    }

    const Scenario& scenario_;
    Ball ball_;
    const Body& body_;
    Vec3 middle_, up_, side_, axis_;
    double distance_ = 0.0, pull_ = 0.0, leaves_ = 1e300;
    double mu_ = 0.0, holds_ = 0.0;  ///< coefficients of slipping and of rolling
    std::vector<Phase> phases_;
    Moment left_;
};

}  // namespace

std::unique_ptr<Reference> makeBallOffBall(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "base"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<BallOffBall>(scenario, ball, parts.support("base", ball));
}

}  // namespace rigor::validation
