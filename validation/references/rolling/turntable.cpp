// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball that rolls without slipping on a table turning at the rate Omega about its normal n:
//   v' = k/(1+k) Omega n x v: a circle at the rate k/(1+k) Omega (2/7 for a solid sphere), centre
//   x0 + n x v0/(k/(1+k) Omega); spin from rolling, w_t = n x (v - V_table)/r, its part along n constant.
// The table turns itself (kinematic), or its surface does over a body at rest.
// Source: Pars, A Treatise on Analytical Dynamics, 1965; Weckesser, Am. J. Phys. 65 (1997) 736.
// Assumes: level table turning about a fixed point, rolling from the start, enough friction, stays on the
// table. Quantities: turn_rate of the velocity's direction over the run, circle_drift: the change of the
// distance from the exact centre over the radius (exactly 0).
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using numerics::OdeState;
using numerics::Real;

class Turntable : public Reference {
  public:
    Turntable(const Scenario& scenario, int index, int table)
        : duration_(scenario.duration),
          body_(scenario.bodies[index]),
          ball_(ballOf(scenario, index)),
          plane_(planeOf(scenario, table, ball_.center)) {
        const std::string subject = bodyTitle(scenario, index);
        const Body& disc = scenario.bodies[table];
        require(scenario.dimension == 3, "a turntable needs three dimensions");
        requireUndisturbed(scenario, index);
        requireContact(scenario, index, table);
        const Vec3 n = plane_.normal, g = gravityOn(scenario, index), w = disc.angularVelocity;
        const double load = -dot(g, n);
        require(load > 0.0 && negligible(norm(g + load * n), norm(g)),
                "gravity is not along the normal of the table");
        tableRate_ = disc.type == scenario::BodyType::Kinematic ? dot(w, n) : 0.0;
        require(disc.velocity == Vec3{} && norm(w - dot(w, n) * n) <= 1e-9 * norm(w),
                "the table does not turn about its normal at a fixed place");
        pivot_ = centerOfMass(disc);
        if (disc.shapes.front().surfaceVelocity.moves()) takeSurface(disc);
        require(std::abs(plane_.height(ball_.center) - ball_.radius) <= 1e-4 * ball_.radius,
                subject + " does not start in contact");
        const Vec3 slip = ball_.velocity - ball_.radius * cross(ball_.spin, n) -
                          tableRate_ * cross(n, ball_.center - pivot_);
        const double fast = norm(ball_.velocity) + ball_.radius * norm(ball_.spin) +
                            std::abs(tableRate_) * norm(ball_.center - pivot_);
        require(norm(slip) <= 1e-6 * fast, subject + " slips at the start; it rolls at angular_velocity " +
                                               shown(ball_.spin - cross(slip, n) / ball_.radius, 3));
        rate_ = ball_.k / (1.0 + ball_.k) * tableRate_;
        const double mu = holdingFriction(pairCoefficients(scenario, ball_.material, plane_.material));
        require(std::abs(rate_) * norm(ball_.velocity) <= mu * load,
                subject + " needs more friction than there is to roll");
        const double end = runEnd(scenario);
        for (int k = 0; k <= 64; ++k)
            require(plane_.holds(centerAt(scenario.duration * k / 64.0)), subject + " rolls off the table");
        const auto rhs = [this](Real t, const OdeState& y, OdeState& d) {
            const Vec3 s = spinAt(static_cast<double>(t));
            d[0] = (-s.x * y[1] - s.y * y[2] - s.z * y[3]) / 2;
            d[1] = (s.x * y[0] + s.y * y[3] - s.z * y[2]) / 2;
            d[2] = (s.y * y[0] + s.z * y[1] - s.x * y[3]) / 2;
            d[3] = (s.z * y[0] + s.x * y[2] - s.y * y[1]) / 2;
        };
        const Quat q = scenario::normalized(body_.pose.orientation);
        orientation_ = numerics::DenseSolution(rhs, 0, {q.w, q.x, q.y, q.z}, end, 1e-12L);
    }
    std::vector<int> bodies() const override { return {ball_.body}; }

    PartialState exact(int, double t) const override {
        const OdeState y = orientation_.at(t);
        const auto d = [&](std::size_t i) { return static_cast<double>(y[i]); };
        return stateOf(body_, centerAt(t), scenario::normalized(Quat{d(0), d(1), d(2), d(3)}), velocityAt(t),
                       spinAt(t));
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const double speed = norm(ball_.velocity);
        if (rate_ == 0.0 || speed == 0.0) return result;
        const Vec3 n = plane_.normal, center = ball_.center + (1.0 / rate_) * cross(n, ball_.velocity);
        Quantity turn{"turn_rate", "rad/s", rate_, {}, 0.0, {}};
        turn.measure = [=, index = ball_.body](const Trajectory& run) -> std::optional<double> {
            if (run.frames() < 2) return std::nullopt;
            double angle = 0.0;
            for (std::size_t k = 1; k < run.frames(); ++k) {
                const Vec3 a = run.state(k - 1, index).velocity, b = run.state(k, index).velocity;
                angle += std::atan2(dot(n, cross(a, b)), dot(a, b));
            }
            return angle / (run.times.back() - run.times.front());
        };
        result.push_back(std::move(turn));
        Quantity drift{"circle_drift", "1", 0.0, {}, 1.0, {}};
        drift.measure = [this, center,
                         radius = speed / std::abs(rate_)](const Trajectory& run) -> std::optional<double> {
            const Vec3 away = centerOfMass(body_, run.state(run.frames() - 1, ball_.body)) - center;
            return (norm(away - dot(away, plane_.normal) * plane_.normal) - radius) / radius;
        };
        result.push_back(std::move(drift));
        return result;
    }

  private:
    /// The surface turns about a point at the rate of the table.
    void takeSurface(const Body& disc) {
        require(disc.shapes.size() == 1, "the table has more than one shape");
        require(tableRate_ == 0.0, "the table turns, and its surface over it");
        const Vec3 n = plane_.normal;
        const scenario::SurfaceVelocity& surface = disc.shapes.front().surfaceVelocity;
        const Vec3 turning = rotate(disc.pose.orientation, surface.angular);
        const Vec3 moving = rotate(disc.pose.orientation, surface.linear);
        tableRate_ = dot(turning, n);
        require(tableRate_ != 0.0, "the surface does not turn: use conveyor");
        require(norm(turning - tableRate_ * n) <= 1e-9 * norm(turning) &&
                    std::abs(dot(moving, n)) <= 1e-9 * norm(moving),
                "the surface does not turn about the normal of the table");
        // moving + rate n x (pivot - origin) = 0
        pivot_ = disc.pose.position + (1.0 / tableRate_) * cross(n, moving);
    }
    Vec3 velocityAt(double t) const {
        const double c = std::cos(rate_ * t), s = std::sin(rate_ * t);
        return c * ball_.velocity + s * cross(plane_.normal, ball_.velocity);
    }
    Vec3 centerAt(double t) const {
        if (rate_ == 0.0) return ball_.center + t * ball_.velocity;
        const double half = std::sin(0.5 * rate_ * t);
        return ball_.center + (std::sin(rate_ * t) / rate_) * ball_.velocity +
               (2.0 * half * half / rate_) * cross(plane_.normal, ball_.velocity);
    }
    Vec3 spinAt(double t) const {
        const Vec3 n = plane_.normal;
        const Vec3 table = tableRate_ * cross(n, centerAt(t) - pivot_);
        return dot(ball_.spin, n) * n + (1.0 / ball_.radius) * cross(n, velocityAt(t) - table);
    }

    double duration_;
    const Body& body_;
    Ball ball_;
    Plane plane_;
    Vec3 pivot_;
    double tableRate_ = 0.0, rate_ = 0.0;
    numerics::DenseSolution orientation_;
};

}  // namespace

std::unique_ptr<Reference> makeTurntable(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"ball", "table"});
    const int ball = parts.dynamicBody("ball");
    return std::make_unique<Turntable>(scenario, ball, parts.support("table", ball));
}

}  // namespace rigor::validation
