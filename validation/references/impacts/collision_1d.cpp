// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Central collision of two bodies on one line: after it va' = V - e mb u/M, vb' = V + e ma u/M, u = va - vb,
// V = (ma va + mb vb)/M, M = ma + mb; lost energy (1 - e^2) ma mb u^2/(2 M). One of them may be fixed.
// Source: Newton 1687; Goldstein, Poole, Safko 2002, chapter 3.
// Assumes: see line_collisions.hpp; they approach.
// Quantities: impact_time, velocity_<body> after the impact along the line from a to b, energy_loss.
#include <cmath>

#include "validation/references/impacts/line_collisions.hpp"

namespace rigor::validation {
namespace {

class Collision1d : public Reference {
  public:
    Collision1d(const Scenario& scenario, int a, int b)
        : scenario_(scenario), a_(a), b_(b), line_(scenario, {a, b}, false) {
        require(!line_.impacts().empty() && line_.impacts().front().time <= scenario.duration,
                "the bodies do not meet within the duration");
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const int i : {a_, b_})
            if (isDynamic(i)) result.push_back(i);
        return result;
    }
    PartialState exact(int body, double t) const override { return line_.exact(body, t); }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const double start = line_.impacts().front().time;
        if (start >= scenario_.duration) return result;
        const Vec3 d = line_.bodies().front() == a_ ? line_.direction() : -line_.direction(),
                   g = line_.gravity();
        const double sign = dot(d, line_.direction()),
                     closing = std::abs(line_.velocityBefore(a_) - line_.velocityBefore(b_));
        // Time at which the straight lines before and after meet: exact for uniform motion and any step. It
        // also holds for e = 1 and equal bodies, because the relative coordinate is the one that reverses.
        Quantity time{"impact_time", "s", start, {}, start > 0.0 ? 0.0 : scenario_.duration, {}};
        time.measure = [this, d](const Trajectory& run) -> std::optional<double> {
            const std::size_t end = run.frames() - 1;
            const auto apart = [&](std::size_t k) {
                return dot(d, run.state(k, b_).position - run.state(k, a_).position);
            };
            const auto rate = [&](std::size_t k) {
                return dot(d, run.state(k, b_).velocity - run.state(k, a_).velocity);
            };
            const double change = rate(end) - rate(0);
            if (!(change > 0.0)) return std::nullopt;
            return (apart(0) - apart(end) + rate(end) * run.times[end]) / change;
        };
        result.push_back(std::move(time));
        for (const int i : bodies()) {
            const double after = sign * line_.velocityAfter(i);
            Quantity q{"velocity_" + scenario_.bodies[i].name, "m/s", after, after, closing, {}};
            q.measure = [=](const Trajectory& run) -> std::optional<double> {
                const std::size_t end = run.frames() - 1;
                return dot(d, run.state(end, i).velocity - run.times[end] * g);
            };
            result.push_back(std::move(q));
        }
        Quantity loss{"energy_loss", "J", line_.energyLoss(), line_.energyLoss(), kineticScale(closing), {}};
        loss.measure = [this, d, g](const Trajectory& run) -> std::optional<double> {
            const std::size_t end = run.frames() - 1;
            double sum = 0.0;
            for (const int i : bodies()) {
                const double m = scenario_.bodies[i].massProperties.mass;
                const double before = dot(d, run.state(0, i).velocity);
                const double after = dot(d, run.state(end, i).velocity - run.times[end] * g);
                sum += 0.5 * m * (before * before - after * after);
            }
            return sum;
        };
        result.push_back(std::move(loss));
        return result;
    }

  private:
    bool isDynamic(int i) const { return scenario_.bodies[i].type == scenario::BodyType::Dynamic; }
    /// Kinetic energy of the relative motion: all that an impact can take.
    double kineticScale(double closing) const {
        const double ma = scenario_.bodies[a_].massProperties.mass;
        const double mb = scenario_.bodies[b_].massProperties.mass;
        const double reduced = !isDynamic(a_) ? mb : (!isDynamic(b_) ? ma : ma * mb / (ma + mb));
        return 0.5 * reduced * closing * closing;
    }
    const Scenario& scenario_;
    int a_, b_;
    LineCollisions line_;
};

}  // namespace

std::unique_ptr<Reference> makeCollision1d(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"a", "b"});
    // If both are left out they are the two bodies of the scenario, in their order.
    const bool both =
        !spec.parameters.count("a") && !spec.parameters.count("b") && scenario.bodies.size() == 2;
    const int a = both ? 0 : parts.anyBody("a");
    const int b = both ? 1 : parts.anyBody("b", {a});
    if (a == b) throw std::invalid_argument("reference 'collision_1d': a and b are the same body");
    return std::make_unique<Collision1d>(scenario, a, b);
}

}  // namespace rigor::validation
