// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Flight with linear drag, by a drag force (F = -c v) or by damping (v = v0 kept^t, so rate -ln(kept)).
//   kappa = c/m - ln(kept), vinf = a/kappa, v = vinf + (v0 - vinf) e^(-kappa t),
//   x = x0 + vinf t + (v0 - vinf)(1 - e^(-kappa t))/kappa; likewise w = w0 e^(-kappa_w t) about a fixed axis.
// Scheme-exact for the drag force alone: v(n+1) - vinf = (v(n) - vinf) q, q = 1 - kappa h in Euler's schemes,
// with further terms of the exponential series in those of higher order. Damping has no scheme-exact value:
// engines differ in where they put the factor. Source: Stokes 1851; Goldstein, Poole, Safko 2002, chapter 1.
// Assumes: no contact, joint, other force; spin about a principal axis when the spin is damped.
#include <algorithm>
#include <cmath>

#include "validation/references/flight/rotation.hpp"

namespace rigor::validation {
namespace {

struct Damped {
    int index = 0;
    const Body* body = nullptr;
    Vec3 com, velocity, acceleration;
    double dragRate = 0.0;  ///< c/m [1/s]
    double rate = 0.0;      ///< kappa [1/s]
    double spinRate = 0.0;  ///< -ln(angularVelocityKept) [1/s]
    TorqueFreeMotion rotation;
};

/// (1 - e^(-k t))/k and (t - (1 - e^(-k t))/k)/k, also for k = 0.
double relaxation(double k, double t) {
    return k == 0.0 ? t : -std::expm1(-k * t) / k;
}
double relaxationMoment(double k, double t) {
    const double kt = k * t;
    if (std::abs(kt) < 1e-3)
        return t * t * (0.5 - kt / 6 + kt * kt / 24 - kt * kt * kt / 120 + kt * kt * kt * kt / 720);
    return (t - relaxation(k, t)) / k;
}

class LinearDrag : public Reference {
  public:
    LinearDrag(const Scenario& scenario, const std::vector<int>& bodies) {
        for (const int index : bodies) add(scenario, index);
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& one : damped_) result.push_back(one.index);
        return result;
    }
    double validUntil() const override {
        double end = 1e300;
        for (const auto& d : damped_) end = std::min(end, d.rotation.validUntil());
        return end;
    }

    PartialState exact(int body, double t) const override {
        const Damped& d = find(body);
        const Vec3 velocity = std::exp(-d.rate * t) * d.velocity + relaxation(d.rate, t) * d.acceleration;
        const Vec3 com =
            d.com + relaxation(d.rate, t) * d.velocity + relaxationMoment(d.rate, t) * d.acceleration;
        if (d.spinRate == 0.0) {
            const Attitude attitude = d.rotation.at(t);
            return stateOf(*d.body, com, attitude.orientation, velocity, attitude.angularVelocity);
        }
        const Vec3 w = d.body->angularVelocity;
        return stateOf(*d.body, com, turned(d.body->pose.orientation, w, relaxation(d.spinRate, t)), velocity,
                       std::exp(-d.spinRate * t) * w);
    }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        const Damped& d = find(body);
        if (scheme == adapter::Scheme::Unknown || d.rate != d.dragRate) return std::nullopt;
        const auto n = static_cast<double>(step);
        const double z = d.dragRate * dt;
        // Factor on v - vinf in one step: the exponential series up to the order of the scheme.
        double factor = 1.0 - z;
        const bool midpoint = scheme == adapter::Scheme::MoreauMidpoint;
        if (midpoint || scheme == adapter::Scheme::VelocityVerlet) factor += z * z / 2;
        if (scheme == adapter::Scheme::RungeKutta4) factor += z * z / 2 - z * z * z / 6 + z * z * z * z / 24;
        Vec3 velocity, com;
        if (d.dragRate * dt == 0.0) {
            const double t = n * dt, shift = scheme == adapter::Scheme::SymplecticEuler ? dt
                                             : adapter::isEuler(scheme)                 ? -dt
                                                                                        : 0.0;
            velocity = d.velocity + t * d.acceleration;
            com = d.com + t * d.velocity + (0.5 * t * (t + shift)) * d.acceleration;
        } else {
            // v(k) = vinf + (v0 - vinf) q^k: the sums of v(1..n) or v(0..n-1) are geometric. The others move
            // by h (1 - q)/z (v - vinf) beyond h vinf, whose sum is the same with another last factor; the
            // midpoint rule by h (1 + q)/2 (v - vinf).
            const Vec3 limit = d.acceleration / d.dragRate, excess = d.velocity - limit;
            const double power = std::pow(factor, n), sum = (1.0 - power) / (d.dragRate * dt);
            velocity = limit + power * excess;
            const double first = scheme == adapter::Scheme::SymplecticEuler ? factor
                                 : midpoint ? (1.0 - 0.5 * z + 0.25 * z * z) / (1.0 - 0.5 * z)
                                            : 1.0;
            com = d.com + (n * dt) * limit + (dt * first * sum) * excess;
        }
        PartialState state = stateOf(*d.body, com, velocity);
        if (d.body->angularVelocity == Vec3{})
            state = stateOf(*d.body, com, d.body->pose.orientation, velocity, {});
        return state;
    }

  private:
    void add(const Scenario& scenario, int index) {
        requireUndisturbed(scenario, index, {.drag = true, .damping = true});
        const Body& body = scenario.bodies[index];
        Damped d{index,
                 &body,
                 centerOfMass(body),
                 body.velocity,
                 gravityOn(scenario, index),
                 0.0,
                 0.0,
                 0.0,
                 TorqueFreeMotion(body, scenario.dimension, runEnd(scenario))};
        for (const auto& force : scenario.forces)
            if (const auto* drag = std::get_if<scenario::DragForce>(&force); drag && drag->body == index)
                d.dragRate += drag->coefficient / body.massProperties.mass;
        d.rate = d.dragRate;
        if (body.linearVelocityKept != 1.0) d.rate -= std::log(body.linearVelocityKept);
        if (body.angularVelocityKept != 1.0) {
            d.spinRate = -std::log(body.angularVelocityKept);
            require(
                d.rotation.kind() == TorqueFreeMotion::Kind::Constant,
                "the spin of " + bodyTitle(scenario, index) + " is damped and not about a principal axis");
        }
        damped_.push_back(std::move(d));
    }
    const Damped& find(int body) const {
        for (const auto& one : damped_)
            if (one.index == body) return one;
        throw std::invalid_argument("linear_drag: unknown body");
    }
    std::vector<Damped> damped_;
};

}  // namespace

std::unique_ptr<Reference> makeLinearDrag(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "body"});
    const char* key = spec.parameters.count("body") ? "body" : "bodies";
    return std::make_unique<LinearDrag>(scenario, parts.dynamicBodies(key));
}

}  // namespace rigor::validation
