// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball rolls round the inside of an upright cylinder and does not fall out of it (the golfer's dilemma).
// With W its rate about the axis, constant, r and R the radii, w_r its spin about the direction outwards:
//   z = ze + (z0 - ze) cos(nu t) + z0'/nu sin(nu t), nu = W sqrt(k/(1+k)), ze = z0 - r w_r0/W - g/(k W^2),
//   w_r = w_r0 + W (z - z0)/r, w_phi = z'/r, w_z = -(R - r) W/r.
// It sticks where |F| = m |g + z''| <= mu N, N = m (R - r) W^2.
// Source: Pars, A Treatise on Analytical Dynamics, 1965; Gualtieri, Tokieda, Advis-Gaete, Carry, Reffet,
// Guthmann, Am. J. Phys. 74 (2006) 497. Assumes: contact and rolling from the start, gravity along the axis,
// nothing else. The cylinder is made of facets (hollow.hpp). Quantities: height_min.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/rolling/hollow.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class BallInCylinder : public Reference {
  public:
    BallInCylinder(const Scenario& scenario, int ball, int wall)
        : scenario_(scenario),
          ball_(ballOf(scenario, ball)),
          body_(scenario.bodies[ball]),
          hollow_(hollowOf(scenario, wall, ball_.center)) {
        const std::string subject = bodyTitle(scenario, ball);
        require(scenario.dimension == 3, "a ball in a cylinder needs three dimensions");
        requireUndisturbed(scenario, ball);
        requireContact(scenario, ball, wall);
        const Vec3 g = gravityOn(scenario, ball);
        require(norm(g) > 0.0 && norm(cross(g, hollow_.axis)) <= 1e-9 * norm(g),
                "the cylinder is not upright");
        up_ = -1.0 * unit(g);
        gravity_ = norm(g);
        reach_ = hollow_.radius - ball_.radius;
        out_ = unit(hollow_.across(ball_.center));
        along_ = cross(up_, out_);
        require(std::abs(norm(hollow_.across(ball_.center)) - reach_) <= 1e-4 * hollow_.radius,
                subject + " does not touch the cylinder");
        rate_ = dot(ball_.velocity, along_) / reach_;
        rise_ = dot(ball_.velocity, up_);
        require(rate_ != 0.0, subject + " does not run round the cylinder");
        spin_ = dot(ball_.spin, out_);
        const Vec3 spin =
            spin_ * out_ + (rise_ / ball_.radius) * along_ - (reach_ * rate_ / ball_.radius) * up_;
        require(std::abs(dot(ball_.velocity, out_)) <= 1e-6 * norm(ball_.velocity) &&
                    norm(ball_.spin - spin) <= 1e-6 * norm(spin),
                subject + " does not roll at the start: its spin would be " + shown(spin, 3));
        nu_ = std::abs(rate_) * std::sqrt(ball_.k / (1 + ball_.k));
        middle_ = -ball_.radius * spin_ / rate_ - gravity_ / (ball_.k * rate_ * rate_);
        const double swing = std::hypot(middle_, rise_ / nu_);
        const double mu = holdingFriction(pairCoefficients(scenario, ball_.material, hollow_.material));
        require(gravity_ + nu_ * nu_ * swing <= mu * reach_ * rate_ * rate_,
                subject + " slips: friction is too small for its speed");
        requireWall(wall, swing, subject);
        const OdeRhs turn = [this](Real t, const OdeState& y, OdeState& d) {
            const Real33 m = rotationOf(y[0], y[1], y[2], y[3]);
            quaternionRate(y, 0, transposed(m, real3(spinAt(static_cast<double>(t)))), d);
        };
        const Quat q = scenario::normalized(body_.pose.orientation);
        attitude_ = DenseSolution(turn, 0, {q.w, q.x, q.y, q.z}, runEnd(scenario));
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        const Vec3 out = outAt(t);
        const Vec3 place = ball_.center - reach_ * out_ + reach_ * out + heightAt(t) * up_;
        const OdeState q = attitude_.at(t);
        const auto d = [&](std::size_t i) { return static_cast<double>(q[i]); };
        return stateOf(body_, place, scenario::normalized(Quat{d(0), d(1), d(2), d(3)}),
                       (reach_ * rate_) * cross(up_, out) + climbAt(t) * up_, spinAt(t));
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        const double swing = std::hypot(middle_, rise_ / nu_);
        const double lowest = std::atan2(rise_ / nu_, -middle_);  // phase of the top
        std::vector<Quantity> result;
        const double pi = static_cast<double>(kPi);
        const double reached = std::fmod(lowest + pi + 2 * pi, 2 * pi) / nu_;
        if (reached >= scenario_.duration) return result;
        Quantity q{"height_min", "m", middle_ - swing, {}, swing, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            double least = 1e300;
            for (std::size_t k = 0; k < run.frames(); ++k)
                least =
                    std::min(least, dot(centerOfMass(body_, run.state(k, ball_.body)) - ball_.center, up_));
            return least;
        };
        result.push_back(std::move(q));
        return result;
    }

  private:
    /// Height above the start [m].
    double heightAt(double t) const {
        return middle_ - middle_ * std::cos(nu_ * t) + rise_ / nu_ * std::sin(nu_ * t);
    }
    double climbAt(double t) const { return nu_ * middle_ * std::sin(nu_ * t) + rise_ * std::cos(nu_ * t); }
    Vec3 outAt(double t) const { return std::cos(rate_ * t) * out_ + std::sin(rate_ * t) * along_; }
    Vec3 spinAt(double t) const {
        const Vec3 out = outAt(t);
        return (spin_ + rate_ * heightAt(t) / ball_.radius) * out +
               (climbAt(t) / ball_.radius) * cross(up_, out) - (reach_ * rate_ / ball_.radius) * up_;
    }
    /// The wall reaches from the lowest to the highest point of the way.
    void requireWall(int index, double swing, const std::string& subject) const {
        const Body& wall = scenario_.bodies[index];
        const auto& mesh = std::get<scenario::TriangleMesh>(wall.shapes[0].geometry);
        double low = 1e300, high = -1e300;
        for (const Vec3 v : mesh.vertices) {
            const double h = dot(wall.pose * (wall.shapes[0].pose * v) - ball_.center, up_);
            low = std::min(low, h);
            high = std::max(high, h);
        }
        require(low <= middle_ - swing && high >= middle_ + swing, subject + " leaves the cylinder");
    }

    const Scenario& scenario_;
    Ball ball_;
    const Body& body_;
    Hollow hollow_;
    Vec3 up_, out_, along_;
    double gravity_ = 0.0, reach_ = 0.0, rate_ = 0.0, rise_ = 0.0, spin_ = 0.0, nu_ = 0.0;
    double middle_ = 0.0;  ///< middle of the vertical swing, above the start [m]
    DenseSolution attitude_;
};

}  // namespace

std::unique_ptr<Reference> makeBallInCylinder(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "cylinder"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<BallInCylinder>(scenario, ball, parts.anyBody("cylinder", {ball}));
}

}  // namespace rigor::validation
