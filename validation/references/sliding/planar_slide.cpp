// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See planar_slide.hpp for the equations.
#include "validation/references/sliding/planar_slide.hpp"

#include <cmath>

#include "validation/references/numerics/roots.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

/// Integral of x^(p-1) over [s, 1]; ln(1/s) for p = 0, without cancellation near it.
Real powerIntegral(Real p, Real s) {
    if (s == 0) return 1 / p;
    const Real logS = std::log(s);
    return std::abs(p * logS) < 1e-18L ? -logS : -std::expm1(p * logS) / p;
}

}  // namespace

PlanarSlide::PlanarSlide(Vec3 pull, double friction, Vec3 velocity, double holding)
    : pull_(pull), velocity_(velocity), friction_(friction) {
    const double g = norm(pull), v = norm(velocity);
    // A pull of rounding size is none: the scenario's numbers have 16 digits.
    const bool level = g == 0.0;
    down_ = level ? Vec3{} : pull / g;
    const double along = dot(velocity, down_);
    const Vec3 sideways = velocity - along * down_;
    if (!level && norm(sideways) > 1e-12 * v && friction > 0.0) {
        curved_ = true;
        across_ = sideways / norm(sideways);
        g_ = g;
        kappa_ = static_cast<Real>(friction) / g;
        p_ = norm(sideways);
        // tan(psi/2) = sin/(1 + cos), from the side without cancellation.
        const Real s = norm(sideways), c = along, speed = std::sqrt(s * s + c * c);
        w0_ = c >= 0 ? s / (speed + c) : (speed - c) / s;
        if (kappa_ > 1) stop_ = static_cast<double>(timeAt(0));
        return;
    }
    turn_ = 1e300;
    if (!level && norm(sideways) > 1e-12 * v) return;  // no friction: a parabola, never at rest
    along_ = v > 0.0 ? velocity / v : down_;
    speed_ = v;
    slope_ = dot(pull, along_) - (v > 0.0 ? friction : 0.0);
    if (v == 0.0 || slope_ < 0.0) turn_ = v == 0.0 ? 0.0 : -v / slope_;
    if (turn_ < 1e300 && g <= holding) stop_ = turn_;
}

PlanarSlide::State PlanarSlide::at(double t) const {
    return curved_ ? curved(t) : straight(t);
}

PlanarSlide::State PlanarSlide::straight(double t) const {
    if (friction_ == 0.0 && !stop_) return {t * velocity_ + (0.5 * t * t) * pull_, velocity_ + t * pull_};
    if (t < turn_) return {(speed_ * t + 0.5 * slope_ * t * t) * along_, (speed_ + slope_ * t) * along_};
    const Vec3 turned = (0.5 * speed_ * turn_) * along_;
    if (stop_) return {turned, {}};
    const double rest = t - turn_, rate = norm(pull_) - friction_;
    return {turned + (0.5 * rate * rest * rest) * down_, (rate * rest) * down_};
}

/// Time at which w = s w0.
Real PlanarSlide::timeAt(Real s) const {
    return p_ / (2 * g_) * (powerIntegral(kappa_ - 1, s) / w0_ + w0_ * powerIntegral(kappa_ + 1, s));
}

PlanarSlide::State PlanarSlide::curved(double t) const {
    Real s = 1;
    if (stop_ && t >= *stop_) {
        s = 0;
    } else if (t > 0.0) {
        // z = ln(s) <= 0; t grows as z falls.
        Real low = -1;
        while (timeAt(std::exp(low)) < t && low > -11000) low *= 2;
        s = std::exp(numerics::findRoot([&](Real z) { return timeAt(std::exp(z)) - t; }, low, 0));
    }
    const Real scale = p_ * p_ / (2 * g_);
    const Real across =
        scale * (powerIntegral(2 * kappa_ - 1, s) / w0_ + w0_ * powerIntegral(2 * kappa_ + 1, s));
    const Real down =
        scale / 2 *
        (powerIntegral(2 * kappa_ - 2, s) / (w0_ * w0_) - w0_ * w0_ * powerIntegral(2 * kappa_ + 2, s));
    State state;
    state.displacement = static_cast<double>(across) * across_ + static_cast<double>(down) * down_;
    if (s > 0) {
        const Real w = s * w0_, lateral = p_ * std::pow(s, kappa_);
        state.velocity = static_cast<double>(lateral) * across_ +
                         static_cast<double>(lateral * (1 - w * w) / (2 * w)) * down_;
    }
    return state;
}

std::vector<double> PlanarSlide::kinks() const {
    std::vector<double> times;
    if (stop_) times.push_back(*stop_);
    if (!curved_ && turn_ < 1e300) times.push_back(turn_);
    return times;
}

Vec3 PlanarSlide::step(Vec3 velocity, Vec3 pull, double friction, double dt) {
    const Vec3 free = velocity + dt * pull;
    const double speed = norm(free), loss = friction * dt;
    return speed > loss ? (1.0 - loss / speed) * free : Vec3{};
}

SlideSteps::State SlideSteps::at(Vec3 pull, double friction, Vec3 velocity, std::size_t step, double dt,
                                 adapter::Scheme scheme) const {
    if (dt != dt_ || scheme != scheme_ || states_.empty() || states_.front().velocity != velocity) {
        dt_ = dt;
        scheme_ = scheme;
        states_.assign(1, {{}, velocity});
    }
    while (states_.size() <= step) {
        const State& last = states_.back();
        const Vec3 next = PlanarSlide::step(last.velocity, pull, friction, dt);
        const Vec3 used = scheme == adapter::Scheme::SymplecticEuler ? next : last.velocity;
        states_.push_back({last.displacement + dt * used, next});
    }
    return states_[step];
}

}  // namespace rigor::validation
