// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Oblique impact of two balls (discs in 2D) with friction, restitution and spin. n from a to b at the impact,
// relative velocity of the contact points u, slip s = u - (u.n) n:
//   1/mn = 1/ma + 1/mb, 1/mt = (1+1/ka)/ma + (1+1/kb)/mb; jn = (1+e) mn |un|; jt = min(mt |s|, mu jn) against
//   s.
// Source: Brach, Mechanical Impact Dynamics, 1991; Walton 1993; Foerster et al. 1994.
// Assumes: free flight in the same gravity before and after; they collide within the duration.
// Quantities, for each body: velocity_x_<body>, velocity_y_<body> (velocity_z_<body>) right after the impact,
// taken from the end of the run less what gravity has added since, and spin_<body>, in 3D spin_x_<body> and
// so on.
#include <cmath>

#include "validation/references/impacts/impact_law.hpp"
#include "validation/references/numerics/roots.hpp"

namespace rigor::validation {
namespace {

struct Partner {
    Ball ball;
    const Body* body = nullptr;
    Vec3 contact, velocity, spin;  ///< contact at the impact and velocities after it
};

class TwoSphereImpact : public Reference {
  public:
    TwoSphereImpact(const Scenario& scenario, int a, int b) : scenario_(scenario) {
        partners_[0].ball = ballOf(scenario, a);
        partners_[1].ball = ballOf(scenario, b);
        requireContact(scenario, a, b);
        for (auto& p : partners_) {
            requireUndisturbed(scenario, p.ball.body);
            p.body = &scenario.bodies[p.ball.body];
        }
        gravity_ = gravityOn(scenario, a);
        require(negligible(norm(gravityOn(scenario, b) - gravity_), norm(gravity_)),
                "gravity acts differently on the two bodies");
        findImpact();
        solveImpact();
    }
    std::vector<int> bodies() const override { return {partners_[0].ball.body, partners_[1].ball.body}; }

    PartialState exact(int body, double t) const override {
        const Partner& p = find(body);
        const Quat start = p.body->pose.orientation;
        if (t < time_)
            return stateOf(*p.body, p.ball.center + t * p.ball.velocity + (0.5 * t * t) * gravity_,
                           turned(start, p.ball.spin, t), p.ball.velocity + t * gravity_, p.ball.spin);
        const double s = t - time_;
        return stateOf(*p.body, p.contact + s * p.velocity + (0.5 * s * s) * gravity_,
                       turned(turned(start, p.ball.spin, time_), p.spin, s), p.velocity + s * gravity_,
                       p.spin);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (time_ >= scenario_.duration) return result;
        const double scale = norm(partners_[0].ball.velocity - partners_[1].ball.velocity) +
                             partners_[0].ball.radius * norm(partners_[0].ball.spin) +
                             partners_[1].ball.radius * norm(partners_[1].ball.spin);
        const bool space = scenario_.dimension == 3;
        for (const auto& p : partners_) {
            const int index = p.ball.body;
            const auto add = [&](const std::string& name, const char* unitName, double exact, double against,
                                 auto read) {
                Quantity q{name + "_" + p.body->name, unitName, exact, {}, against, {}};
                q.measure = [this, index, read](const Trajectory& run) -> std::optional<double> {
                    const double since = run.times.back() - time_;
                    if (since <= 0.0) return std::nullopt;
                    const auto& state = run.state(run.frames() - 1, index);
                    return read(state.velocity - since * gravity_, state.angularVelocity);
                };
                result.push_back(std::move(q));
            };
            add("velocity_x", "m/s", p.velocity.x, scale, [](Vec3 v, Vec3) { return v.x; });
            add("velocity_y", "m/s", p.velocity.y, scale, [](Vec3 v, Vec3) { return v.y; });
            if (space) add("velocity_z", "m/s", p.velocity.z, scale, [](Vec3 v, Vec3) { return v.z; });
            const double turning = scale / p.ball.radius;
            if (space) add("spin_x", "rad/s", p.spin.x, turning, [](Vec3, Vec3 w) { return w.x; });
            if (space) add("spin_y", "rad/s", p.spin.y, turning, [](Vec3, Vec3 w) { return w.y; });
            add(space ? "spin_z" : "spin", "rad/s", p.spin.z, turning, [](Vec3, Vec3 w) { return w.z; });
        }
        return result;
    }

  private:
    void findImpact() {
        const Ball &a = partners_[0].ball, &b = partners_[1].ball;
        const Vec3 d = b.center - a.center, u = b.velocity - a.velocity;
        const double reach = a.radius + b.radius;
        const double gap2 = dot(d, d) - reach * reach;
        require(gap2 >= -1e-9 * reach * reach, "the spheres start overlapping");
        // |d + u t|^2 = reach^2.
        const auto hit = numerics::firstDescent(dot(u, u), 2.0L * dot(d, u), std::max(gap2, 0.0));
        require(hit.has_value() && *hit <= scenario_.duration, "the spheres do not meet within the duration");
        time_ = static_cast<double>(*hit);
        for (auto& p : partners_)
            p.contact = p.ball.center + time_ * p.ball.velocity + (0.5 * time_ * time_) * gravity_;
    }
    void solveImpact() {
        Partner &a = partners_[0], &b = partners_[1];
        const Vec3 n = unit(b.contact - a.contact);
        const auto pair = pairCoefficients(scenario_, a.ball.material, b.ball.material);
        // Velocity of b's contact point relative to a's.
        const Vec3 va = a.ball.velocity + cross(a.ball.spin, a.ball.radius * n);
        const Vec3 vb = b.ball.velocity - cross(b.ball.spin, b.ball.radius * n);
        const double normalMass = 1.0 / (1.0 / a.ball.mass + 1.0 / b.ball.mass);
        const double tangentMass =
            1.0 / ((1.0 + 1.0 / a.ball.k) / a.ball.mass + (1.0 + 1.0 / b.ball.k) / b.ball.mass);
        const auto impact = frictionalImpact(vb - va, n, pair, normalMass, tangentMass);
        const Vec3 fall = time_ * gravity_;
        a.velocity = a.ball.velocity + fall - impact.impulse / a.ball.mass;
        b.velocity = b.ball.velocity + fall + impact.impulse / b.ball.mass;
        const auto turn = [&](const Ball& ball) {
            return (1.0 / (ball.k * ball.mass * ball.radius)) * cross(n, impact.impulse);
        };
        // Lever arms r n on a and -r n on b, impulses of opposite sign: both spins change the same way.
        a.spin = a.ball.spin - turn(a.ball);
        b.spin = b.ball.spin - turn(b.ball);
    }
    const Partner& find(int body) const {
        return partners_[0].ball.body == body ? partners_[0] : partners_[1];
    }

    const Scenario& scenario_;
    Partner partners_[2];
    Vec3 gravity_;
    double time_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeTwoSphereImpact(const Scenario& scenario,
                                               const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"a", "b"});
    const bool both =
        !spec.parameters.count("a") && !spec.parameters.count("b") && scenario.bodies.size() == 2;
    const int a = both ? 0 : parts.dynamicBody("a");
    const int b = both ? 1 : parts.dynamicBody("b", {a});
    if (a == b) throw std::invalid_argument("reference 'two_sphere_impact': a and b are the same body");
    return std::make_unique<TwoSphereImpact>(scenario, a, b);
}

}  // namespace rigor::validation
