// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball runs into a row of balls that touch each other: all contacts are hit in one instant. With u- and u+
// the rates at which neighbours part before and after, one law for all of them,
//   p >= 0, u+ + e u- >= 0, p (u+ + e u-) = 0 at every contact, u+ = u- + W p,
// a linear complementarity problem whose matrix W of the inverse masses is positive definite: one solution.
// Equal masses, one of N runs in at v: it gets (1 - (N-1) e)/N v, every other one (1 + e)/N v; at e = 1
// energy stays, yet steel balls do otherwise (newtons_cradle: one impact after another, the limit of small
// gaps). Source: Moreau 1988; Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008;
// Chatterjee and Ruina, J. Appl. Mech. 65 (1998) 939; Smith, Kaufman, Vouga, Tamstorf, Grinspun, ACM Trans.
// Graph. 31 (2012) 106. Assumes: balls on one line, velocities along it, no spin, no gravity; one gap that
// closes, the others at most 1e-4 of a radius. Quantities: velocity_<ball> after the impact.
#include <algorithm>
#include <cmath>

#include "validation/references/numerics/linear_system.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

class TouchingRow : public Reference {
  public:
    TouchingRow(const Scenario& scenario, const std::vector<int>& balls) : scenario_(scenario) {
        require(balls.size() >= 3, "a row needs three balls");
        for (const int body : balls) {
            requireUndisturbed(scenario, body);
            row_.push_back(ballOf(scenario, body));
            require(gravityOn(scenario, body) == Vec3{}, "gravity acts on " + bodyTitle(scenario, body));
            require(row_.back().spin == Vec3{}, bodyTitle(scenario, body) + " spins");
        }
        line_ = unit(row_[1].center - row_[0].center);
        std::sort(row_.begin(), row_.end(),
                  [&](const Ball& a, const Ball& b) { return dot(line_, a.center) < dot(line_, b.center); });
        for (const Ball& ball : row_) {
            const Vec3 off = ball.center - row_[0].center;
            require(norm(off - dot(off, line_) * line_) <= 1e-9 * norm(off) &&
                        norm(ball.velocity - dot(ball.velocity, line_) * line_) <= 1e-9 * norm(ball.velocity),
                    bodyTitle(scenario, ball.body) + " is not on the line, or leaves it");
            before_.push_back(dot(line_, ball.velocity));
            fastest_ = std::max(fastest_, std::abs(before_.back()));
        }
        for (std::size_t i = 0; i + 1 < row_.size(); ++i)
            requireContact(scenario, row_[i].body, row_[i + 1].body);
        findImpact();
        after_ = solved();
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const Ball& ball : row_) result.push_back(ball.body);
        return result;
    }

    PartialState exact(int body, double t) const override {
        const std::size_t i = slot(body);
        const double first = std::min(t, time_), then = std::max(0.0, t - time_);
        const double speed = t < time_ ? before_[i] : after_[i];
        const Body& b = scenario_.bodies[body];
        return stateOf(b, row_[i].center + (before_[i] * first + after_[i] * then) * line_,
                       b.pose.orientation, speed * line_, {});
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        if (time_ >= scenario_.duration) return result;
        for (std::size_t i = 0; i < row_.size(); ++i) {
            const int body = row_[i].body;
            Quantity q{"velocity_" + scenario_.bodies[body].name, "m/s", after_[i], after_[i], fastest_, {}};
            q.measure = [d = line_, body](const Trajectory& run) -> std::optional<double> {
                return dot(d, run.state(run.frames() - 1, body).velocity);
            };
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    std::size_t slot(int body) const {
        for (std::size_t i = 0; i < row_.size(); ++i)
            if (row_[i].body == body) return i;
        throw std::invalid_argument("touching_row: unknown body");
    }
    double gap(std::size_t i) const {
        return dot(line_, row_[i + 1].center - row_[i].center) - row_[i].radius - row_[i + 1].radius;
    }

    /// The only gap closes at time_; the others are closed already and stay so until then.
    void findImpact() {
        bool isHit = false;
        for (std::size_t i = 0; i + 1 < row_.size(); ++i) {
            const double small = 1e-4 * std::min(row_[i].radius, row_[i + 1].radius);
            const double closing = before_[i] - before_[i + 1];
            require(gap(i) >= -small, "neighbours in the row overlap");
            if (gap(i) <= small) {
                require(std::abs(closing) <= 1e-9 * fastest_, "touching neighbours move against each other");
                continue;
            }
            require(closing > 0.0, "a gap in the row does not close");
            require(!isHit, "more than one gap of the row closes");
            isHit = true;
            time_ = gap(i) / closing;
        }
        require(isHit, "nothing runs into the row");
    }

    /// The linear complementarity problem by trying which contacts push: few and positive definite.
    std::vector<double> solved() const {
        const std::size_t n = row_.size() - 1;
        require(n <= 12, "a row of more than 13 balls");
        const Real tiny = 1e-12L * fastest_;
        std::vector<Real> apart(n), bounce(n);
        for (std::size_t i = 0; i < n; ++i) {
            apart[i] = before_[i + 1] - before_[i];
            bounce[i] = pairCoefficients(scenario_, row_[i].material, row_[i + 1].material).restitution;
        }
        for (unsigned mask = 0; mask < (1U << n); ++mask) {
            std::vector<std::size_t> on;
            for (std::size_t i = 0; i < n; ++i)
                if (mask >> i & 1U) on.push_back(i);
            const auto size = static_cast<Eigen::Index>(on.size());
            numerics::Matrix m(size, size);
            numerics::Vector right(size);
            for (Eigen::Index a = 0; a < size; ++a) {
                const std::size_t i = on[a];
                for (Eigen::Index b = 0; b < size; ++b) m(a, b) = coupling(i, on[b]);
                right[a] = -(1 + bounce[i]) * apart[i];
            }
            std::vector<Real> push(n, 0);
            if (size > 0) {
                const auto p = numerics::solveDense(m, right);
                if (!p) continue;
                for (std::size_t a = 0; a < on.size(); ++a) push[on[a]] = (*p)[a];
            }
            bool fits = true;
            for (std::size_t i = 0; i < n; ++i) {
                Real after = apart[i];
                for (std::size_t j = 0; j < n; ++j) after += coupling(i, j) * push[j];
                // An impulse by the speed that it gives its own contact: zero up to rounding of the speeds.
                fits = fits && coupling(i, i) * push[i] >= -tiny && after + bounce[i] * apart[i] >= -tiny;
            }
            if (!fits) continue;
            std::vector<double> after = before_;
            for (std::size_t i = 0; i < n; ++i) {
                after[i] -= static_cast<double>(push[i]) / row_[i].mass;
                after[i + 1] += static_cast<double>(push[i]) / row_[i + 1].mass;
            }
            return after;
        }
        violated("the impact of the row has no solution");
    }
    /// Delassus matrix: the separation speed of contact i by a unit impulse at contact j.
    Real coupling(std::size_t i, std::size_t j) const {
        if (i == j) return 1 / static_cast<Real>(row_[i].mass) + 1 / static_cast<Real>(row_[i + 1].mass);
        if (i + 1 == j) return -1 / static_cast<Real>(row_[j].mass);
        if (j + 1 == i) return -1 / static_cast<Real>(row_[i].mass);
        return 0;
    }

    const Scenario& scenario_;
    std::vector<Ball> row_;
    Vec3 line_;
    std::vector<double> before_, after_;
    double time_ = 0.0, fastest_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeTouchingRow(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"balls"});
    return std::make_unique<TouchingRow>(scenario, parts.dynamicBodies("balls"));
}

}  // namespace rigor::validation
