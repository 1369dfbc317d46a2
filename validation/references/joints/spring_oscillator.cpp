// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body on springs and dampers along one line, with drag, constant force and gravity along it:
//   m x'' + c x' + k (x - xe) = 0, gamma = c/(2 m), w0^2 = k/m, s^2 = w0^2 - gamma^2:
//   x - xe = e^(-gamma t) [A cos(s t) + B sin(s t)/s], cosh and sinh when overdamped, 1 and t when critical.
// Scheme-exact: the step is a linear map, raised to the power n.
// Source: Landau and Lifshitz, Mechanics, 1976, section 25; Hairer, Lubich, Wanner 2006, I.1.
// Assumes: springs from the world or a static body to the centre of mass, everything along one line, no spin;
// the springs keep their side of their anchors. A spring of rest length zero and no damper acts the same in
// every direction: then any line of motion will do.
// Quantities: period (mean between passages of the equilibrium in one direction), log_decrement.
#include <cmath>

#include "validation/references/numerics/real.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

struct Affine {
    // (x, v) -> matrix (x, v), x from the equilibrium.
    double a = 1, b = 0, c = 0, d = 1;
};
Affine operator*(const Affine& p, const Affine& q) {
    return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
}
Affine power(Affine base, std::size_t n) {
    Affine result;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) result = result * base;
        base = base * base;
    }
    return result;
}

class SpringOscillator : public Reference {
  public:
    SpringOscillator(const Scenario& scenario, int index)
        : scenario_(scenario), index_(index), body_(scenario.bodies[index]), com_(centerOfMass(body_)) {
        requireUndisturbed(scenario, index, {.springs = true, .constantForces = true, .drag = true});
        require(body_.angularVelocity == Vec3{}, bodyTitle(scenario, index) + " spins");
        mass_ = body_.massProperties.mass;
        bool lineNeeded = false;
        Vec3 load = mass_ * gravityOn(scenario, index);
        double drag = 0.0, dampers = 0.0;
        for (const auto& force : scenario.forces) {
            if (const auto* f = std::get_if<scenario::DragForce>(&force); f && f->body == index)
                drag += f->coefficient;
            if (const auto* f = std::get_if<scenario::ConstantForce>(&force); f && f->body == index) {
                require(
                    f->start <= 0.0 && f->end >= scenario.duration && f->torque == Vec3{},
                    "the constant force on " + bodyTitle(scenario, index) + " does not last, or turns it");
                load += f->force;
            }
            const auto* spring = std::get_if<scenario::SpringForce>(&force);
            if (spring && (spring->bodyA == index || spring->bodyB == index))
                addSpring(*spring, load, dampers, lineNeeded);
        }
        require(stiffness_ > 0.0, "no spring acts on " + bodyTitle(scenario, index));
        damping_ = drag + dampers;
        offset_ = load / stiffness_;  // equilibrium relative to the start
        if (lineNeeded) requireLine();
    }
    std::vector<int> bodies() const override { return {index_}; }

    PartialState exact(int, double t) const override {
        double p = 0, q = 0, dp = 0, dq = 0;
        fundamental(t, p, q, dp, dq);
        return stateAt(p, q, dp, dq);
    }

    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        if (scheme == adapter::Scheme::Unknown) return std::nullopt;
        const Affine all = power(oneStep(dt, scheme), step);
        return stateAt(all.a, all.b, all.c, all.d);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const double gamma = damping_ / (2.0 * mass_), s2 = stiffness_ / mass_ - gamma * gamma;
        if (!(s2 > 0.0) || amplitude() == 0.0) return result;
        const double period = 2.0 * static_cast<double>(numerics::kPi) / std::sqrt(s2);
        if (2.0 * period > scenario_.duration) return result;
        Quantity q{"period", "s", period, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) { return passages(run).first; };
        result.push_back(std::move(q));
        Quantity decrement{"log_decrement", "1", gamma * period, {}, 1.0, {}};
        decrement.measure = [this](const Trajectory& run) { return passages(run).second; };
        result.push_back(std::move(decrement));
        return result;
    }

  private:
    void addSpring(const scenario::SpringForce& spring, Vec3& load, double& dampers, bool& lineNeeded) {
        const bool isB = spring.bodyB == index_;
        const int other = isB ? spring.bodyA : spring.bodyB;
        require(other == scenario::kNone || scenario_.bodies[other].type == scenario::BodyType::Static,
                "a spring joins " + bodyTitle(scenario_, index_) + " to a moving body");
        const Vec3 local = isB ? spring.anchorA : spring.anchorB, own = isB ? spring.anchorB : spring.anchorA;
        const Vec3 anchor = other == scenario::kNone ? local : scenario_.bodies[other].pose * local;
        const Vec3 arm = com_ - anchor;
        require(norm(own - body_.massProperties.centerOfMass) <= 1e-9 * (norm(arm) + sizeOf(body_)),
                "a spring pulls " + bodyTitle(scenario_, index_) + " beside its centre of mass");
        // Force at x = com + displacement: -k (arm + displacement - L0 d).
        stiffness_ += spring.stiffness;
        dampers += spring.damping;
        load += -spring.stiffness * arm;
        if (spring.restLength == 0.0 && spring.damping == 0.0) return;
        require(norm(arm) > 0.0, "a spring has no direction at the start");
        const Vec3 d = unit(arm);
        load += (spring.stiffness * spring.restLength) * d;
        require(line_ == Vec3{} || norm(cross(line_, d)) < 1e-9, "the springs are not on one line");
        if (line_ == Vec3{}) line_ = d;
        lineNeeded = true;
        if (spring.restLength > 0.0) anchors_.push_back(anchor);
    }

    void requireLine() const {
        const auto onLine = [&](Vec3 v, double scale, const char* what) {
            require(norm(cross(v, line_)) <= 1e-9 * scale,
                    std::string(what) + " of " + bodyTitle(scenario_, index_) + " is not along its spring");
        };
        onLine(body_.velocity, norm(body_.velocity), "the velocity");
        onLine(offset_, norm(offset_), "gravity or a force");
        for (int i = 0; i <= 4000; ++i) {
            const Vec3 x =
                centerOfMass(body_, BodyState{*exact(index_, scenario_.duration * i / 4000.0).position,
                                              body_.pose.orientation,
                                              {},
                                              {}});
            for (const Vec3 anchor : anchors_)
                require(dot(x - anchor, com_ - anchor) > 0.0,
                        bodyTitle(scenario_, index_) + " passes through the anchor of its spring");
        }
    }

    /// The step of a scheme as a linear map of (x - xe, v).
    Affine oneStep(double dt, adapter::Scheme scheme) const {
        const double k = dt * stiffness_ / mass_, c = dt * damping_ / mass_;
        if (scheme == adapter::Scheme::ExplicitEuler) return {1.0, dt, -k, 1.0 - c};
        if (scheme == adapter::Scheme::SymplecticEuler) return {1.0 - dt * k, dt * (1.0 - c), -k, 1.0 - c};
        if (scheme == adapter::Scheme::MoreauMidpoint) {
            // y = x + h/2 v, v1 = v + h a(y, v + h/2 a(y, v)), x1 = y + h/2 v1
            const double va = -k * (1.0 - 0.5 * c), vb = 1.0 + 0.5 * dt * va - c * (1.0 - 0.5 * c);
            return {1.0 + 0.5 * dt * va, 0.5 * dt * (1.0 + vb), va, vb};
        }
        if (scheme == adapter::Scheme::VelocityVerlet) {
            // x1 = x + h v + h^2/2 a(x, v), v1 = v + h/2 (a(x, v) + a(x1, v + h a(x, v)))
            const double x1 = 1.0 - 0.5 * dt * k, x1v = dt * (1.0 - 0.5 * c);
            return {x1, x1v, -0.5 * (k + k * x1 - c * k), 1.0 - 0.5 * (c + k * x1v + c * (1.0 - c))};
        }
        // Runge-Kutta of order 4 on a linear equation: the exponential series up to the fourth power.
        const Affine z{0.0, dt, -k, -c};
        Affine sum{}, term{};
        for (const double n : {1.0, 2.0, 3.0, 4.0}) {
            term = term * z;
            term = {term.a / n, term.b / n, term.c / n, term.d / n};
            sum = {sum.a + term.a, sum.b + term.b, sum.c + term.c, sum.d + term.d};
        }
        return sum;
    }

    /// x - xe = p (x0 - xe) + q v0, v = dp (x0 - xe) + dq v0.
    void fundamental(double t, double& p, double& q, double& dp, double& dq) const {
        const double gamma = damping_ / (2.0 * mass_), w2 = stiffness_ / mass_, s2 = w2 - gamma * gamma;
        double c = 1.0, s = t;  // cos(s t) and sin(s t)/s, or their hyperbolic and critical limits
        if (s2 > 0.0) {
            const double w = std::sqrt(s2);
            c = std::cos(w * t);
            s = std::sin(w * t) / w;
        } else if (s2 < 0.0) {
            const double w = std::sqrt(-s2);
            // e^(-gamma t) cosh and sinh without overflow.
            const double up = std::exp((w - gamma) * t), down = std::exp(-(w + gamma) * t);
            p = 0.5 * (up + down) + gamma * 0.5 * (up - down) / w;
            q = 0.5 * (up - down) / w;
            dp = -w2 * q;
            dq = 0.5 * (up + down) - gamma * q;
            return;
        }
        const double decay = std::exp(-gamma * t);
        p = decay * (c + gamma * s);
        q = decay * s;
        dp = -w2 * q;
        dq = decay * (c - gamma * s);
    }

    PartialState stateAt(double p, double q, double dp, double dq) const {
        const Vec3 com = com_ + offset_ - p * offset_ + q * body_.velocity;
        return stateOf(body_, com, body_.pose.orientation, dq * body_.velocity - dp * offset_, {});
    }

    double amplitude() const { return norm(offset_) + norm(body_.velocity) * std::sqrt(mass_ / stiffness_); }
    /// Direction in which the passages are counted: of the first velocity through the equilibrium.
    Vec3 direction() const { return norm(offset_) > 0.0 ? unit(offset_) : unit(body_.velocity); }

    /// Mean period and logarithmic decrement from upward passages of the equilibrium.
    std::pair<std::optional<double>, std::optional<double>> passages(const Trajectory& run) const {
        const Vec3 d = direction(), center = com_ + offset_;
        const auto x = [&](std::size_t k) {
            return dot(d, centerOfMass(body_, run.state(k, index_)) - center);
        };
        const auto v = [&](std::size_t k) { return dot(d, run.state(k, index_).velocity); };
        std::optional<double> first, last;
        double firstSpeed = 0.0, lastSpeed = 0.0;
        int count = 0;
        for (std::size_t k = 0; k + 1 < run.frames(); ++k) {
            if (!(x(k) < 0.0 && x(k + 1) >= 0.0)) continue;
            const auto time = upwardCrossing(run, k, x, v);
            if (!time) return {};
            // Speed at the passage: linear between the frames plus the second order of a sine is beyond need;
            // the slope of v at the equilibrium is -2 gamma v, nearly constant.
            const double part = (*time - run.times[k]) / (run.times[k + 1] - run.times[k]);
            const double speed =
                v(k) + part * (v(k + 1) - v(k)) + curvature(part, run.times[k + 1] - run.times[k]) * v(k);
            if (!first) {
                first = time;
                firstSpeed = speed;
            }
            last = time;
            lastSpeed = speed;
            ++count;
        }
        if (count < 2) return {};
        return {(*last - *first) / (count - 1), std::log(firstSpeed / lastSpeed) / (count - 1)};
    }
    /// Error of linear interpolation of a cosine of rate w0 next to its top, relative to it.
    double curvature(double part, double step) const {
        return 0.5 * stiffness_ / mass_ * part * (1.0 - part) * step * step;
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Vec3 com_, offset_, line_;
    std::vector<Vec3> anchors_;
    double mass_ = 0.0, stiffness_ = 0.0, damping_ = 0.0;
};

}  // namespace

std::unique_ptr<Reference> makeSpringOscillator(const Scenario& scenario,
                                                const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body"});
    return std::make_unique<SpringOscillator>(scenario, parts.dynamicBody("body"));
}

}  // namespace rigor::validation
