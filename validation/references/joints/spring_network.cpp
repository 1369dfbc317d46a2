// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies on springs, each spring between centres of mass or from a fixed point to one: the spring pendulum
// (elastic pendulum), two bodies on a spring in free space, nets.
//   m x'' = m g - sum (k (|d| - L) + c d'.n) n,  n = d/|d|, d from the other end,
// integrated in Cartesian coordinates to 1e-12 (ode.hpp), valid until a neighbour of a larger tolerance parts
// from it: in most fields two bodies on springs move chaotically. Scheme-exact: Euler's schemes stepped with the
// forces at the start of each step. Source: Landau and Lifshitz, Mechanics, 1976, sections 13-14 (central
// field); Cuerno, Ranada, Ruiz-Lorenzo, Am. J. Phys. 60 (1992) 73 (elastic pendulum).
// Assumes: springs anchored at centres of mass, so that nothing turns; no spin, contact, joint, other force;
// no spring shrinks to a point.
// Quantity: radial_period where one spring of rest length > 0 joins two free bodies without gravity or
// damping: 2 int dr/sqrt(2 (E - V(r))/mu), V = l^2/(2 mu r^2) + k (r - L)^2/2.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/roots.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;
using scenario::SpringForce;

struct Tie {
    int a = -1, b = 0;  ///< places in the list of bodies; -1: `fixed`
    Real3 fixed;
    Real stiffness = 0, damping = 0, rest = 0;
};

class SpringNetwork : public Reference {
  public:
    SpringNetwork(const Scenario& scenario, std::vector<int> bodies)
        : scenario_(scenario), bodies_(std::move(bodies)) {
        OdeState start(6 * bodies_.size());
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const Body& body = at(i);
            requireUndisturbed(scenario, bodies_[i], {.springs = true});
            require(body.angularVelocity == Vec3{}, bodyTitle(scenario, bodies_[i]) + " spins");
            masses_.push_back(body.massProperties.mass);
            gravity_.push_back(real3(gravityOn(scenario, bodies_[i])));
            put(start, 2 * i, real3(centerOfMass(body)));
            put(start, 2 * i + 1, real3(body.velocity));
        }
        for (const auto& force : scenario.forces)
            if (const auto* spring = std::get_if<SpringForce>(&force)) addTie(*spring);
        require(!ties_.empty(), "no spring holds the bodies");
        start_ = start;
        const Real end = runEnd(scenario);
        Real size = 0, fast = 0, stiff = 1 / end;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            size = std::max(size, Real{sizeOf(at(i))});
            fast = std::max(fast, Real{norm(at(i).velocity)});
        }
        for (const Tie& tie : ties_) stiff = std::max(stiff, std::sqrt(tie.stiffness / masses_[tie.b]));
        fast += size * stiff;
        OdeState beside;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            beside.insert(beside.end(), 3, size);
            beside.insert(beside.end(), 3, fast);
        }
        solution_ =
            DenseSolution([this](Real, const OdeState& y, OdeState& d) { derivative(y, d); }, 0, start, end,
                          1e-14L, {}, beside, OdeLimits::neighbourOf(1e-13L, 1e-8L, beside));
        if (!solution_.isWhole()) validUntil_ = static_cast<double>(solution_.end());
    }
    std::vector<int> bodies() const override { return bodies_; }
    double validUntil() const override { return validUntil_; }

    PartialState exact(int body, double t) const override { return stateIn(solution_.at(t), body); }

    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        if (!adapter::isEuler(scheme)) return std::nullopt;
        if (steps_.empty() || dt != dt_ || scheme != scheme_) steps_ = {start_};
        dt_ = dt;
        scheme_ = scheme;
        while (steps_.size() <= step) {
            OdeState y = steps_.back(), d(y.size());
            derivative(y, d);
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                const Real3 v = get(y, 2 * i + 1), after = v + static_cast<Real>(dt) * get(d, 2 * i + 1);
                const Real3 moves = scheme == adapter::Scheme::SymplecticEuler ? after : v;
                put(y, 2 * i, get(y, 2 * i) + static_cast<Real>(dt) * moves);
                put(y, 2 * i + 1, after);
            }
            steps_.push_back(std::move(y));
        }
        return stateIn(steps_[step], body);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        const auto period = radialPeriod();
        if (!period) return result;
        // Twice the time from one turning point of the distance to the next, read off d.v.
        Quantity q{"radial_period", "s", *period, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            const auto rate = [&](double sign) {
                return [this, &run, sign](std::size_t k) {
                    const Vec3 d = run.state(k, bodies_[1]).position - run.state(k, bodies_[0]).position;
                    return sign *
                           dot(d, run.state(k, bodies_[1]).velocity - run.state(k, bodies_[0]).velocity);
                };
            };
            const auto turning = [&](double sign) {
                const auto f = rate(sign);
                const auto slope = [&](std::size_t k) {
                    const std::size_t low = k > 0 ? k - 1 : k, high = std::min(k + 1, run.frames() - 1);
                    return (f(high) - f(low)) / (run.times[high] - run.times[low]);
                };
                return upwardCrossing(run, 0, f, slope);
            };
            const auto inner = turning(1.0), outer = turning(-1.0);
            if (!inner || !outer) return std::nullopt;
            return 2.0 * std::abs(*outer - *inner);
        };
        result.push_back(std::move(q));
        return result;
    }

  private:
    const Body& at(std::size_t i) const { return scenario_.bodies[bodies_[i]]; }
    static Real3 get(const OdeState& y, std::size_t i) { return {y[3 * i], y[3 * i + 1], y[3 * i + 2]}; }
    static void put(OdeState& y, std::size_t i, Real3 v) {
        y[3 * i] = v.x;
        y[3 * i + 1] = v.y;
        y[3 * i + 2] = v.z;
    }

    PartialState stateIn(const OdeState& y, int body) const {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (bodies_[i] == body)
                return stateOf(at(i), toVec3(get(y, 2 * i)), at(i).pose.orientation,
                               toVec3(get(y, 2 * i + 1)), {});
        throw std::invalid_argument("spring_network: unknown body");
    }

    void addTie(const SpringForce& spring) {
        Tie tie{-1, -1, {}, spring.stiffness, spring.damping, spring.restLength};
        const auto end = [&](int body, Vec3 anchor, int& place) {
            for (std::size_t i = 0; i < bodies_.size(); ++i)
                if (bodies_[i] == body) {
                    place = i;
                    require(norm(anchor - at(i).massProperties.centerOfMass) <= 1e-9 * sizeOf(at(i)),
                            "a spring does not pull at the centre of mass of " + bodyTitle(scenario_, body));
                }
            if (place >= 0) return;
            if (body == scenario::kNone) {
                tie.fixed = real3(anchor);
                return;
            }
            const Body& other = scenario_.bodies[body];
            require(other.type == scenario::BodyType::Static,
                    "a spring leads to " + bodyTitle(scenario_, body) + ", which is neither fixed nor known");
            tie.fixed = real3(other.pose * anchor);
        };
        end(spring.bodyA, spring.anchorA, tie.a);
        end(spring.bodyB, spring.anchorB, tie.b);
        if (tie.b < 0) std::swap(tie.a, tie.b);
        if (tie.b >= 0) ties_.push_back(tie);
    }

    void derivative(const OdeState& y, OdeState& d) const {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            put(d, 2 * i, get(y, 2 * i + 1));
            put(d, 2 * i + 1, gravity_[i]);
        }
        for (const Tie& tie : ties_) {
            const auto b = static_cast<std::size_t>(tie.b), a = static_cast<std::size_t>(tie.a);
            const bool free = tie.a >= 0;
            const Real3 span = get(y, 2 * b) - (free ? get(y, 2 * a) : tie.fixed);
            const Real3 rate = get(y, 2 * b + 1) - (free ? get(y, 2 * a + 1) : Real3{});
            const Real length = norm(span);
            if (!(length > 0)) throw std::runtime_error("a spring shrinks to a point");
            const Real3 n = (1 / length) * span;
            const Real3 pull = (tie.stiffness * (length - tie.rest) + tie.damping * dot(rate, n)) * n;
            put(d, 2 * b + 1, get(d, 2 * b + 1) - (1 / masses_[b]) * pull);
            if (free) put(d, 2 * a + 1, get(d, 2 * a + 1) + (1 / masses_[a]) * pull);
        }
    }

    std::optional<double> radialPeriod() const {
        if (bodies_.size() != 2 || ties_.size() != 1 || ties_[0].a < 0 || ties_[0].damping != 0 ||
            norm(gravity_[0] - gravity_[1]) != 0)
            return std::nullopt;
        const Real mu = masses_[0] * masses_[1] / (masses_[0] + masses_[1]), k = ties_[0].stiffness;
        const Real3 d = get(start_, 2) - get(start_, 0), v = get(start_, 3) - get(start_, 1);
        const Real r0 = norm(d), l = mu * norm(cross(d, v)), radial = dot(d, v) / r0;
        const auto potential = [&](Real r) {
            return l * l / (2 * mu * r * r) + k * (r - ties_[0].rest) * (r - ties_[0].rest) / 2;
        };
        const Real energy = mu * radial * radial / 2 + potential(r0);
        const auto excess = [&](Real r) { return energy - potential(r); };
        if (!(l > 0)) return std::nullopt;
        // The bottom of the potential, then the turning points on both sides.
        const Real slopeZero =
            findRoot([&](Real r) { return k * (r - ties_[0].rest) - l * l / (mu * r * r * r); }, 1e-6L * r0,
                     1e3L * r0);
        if (!(excess(slopeZero) > 1e-9L * energy)) return std::nullopt;
        Real low = slopeZero, high = slopeZero;
        while (excess(low) > 0) low /= 2;
        while (excess(high) > 0) high *= 2;
        low = findRoot(excess, low, slopeZero);
        high = findRoot(excess, slopeZero, high);
        // r = middle - half cos(s) takes the root singularities out of both ends.
        const Real middle = (low + high) / 2, half = (high - low) / 2;
        const Real time = boost::math::quadrature::gauss_kronrod<Real, 31>::integrate(
            [&](Real s) {
                const Real r = middle - half * std::cos(s);
                return half * std::sin(s) / std::sqrt(2 * std::max(excess(r), Real{1e-30L}) / mu);
            },
            Real(0), kPi, 12, 1e-13L);
        return static_cast<double>(2 * time);
    }

    const Scenario& scenario_;
    std::vector<int> bodies_;
    std::vector<Real> masses_;
    std::vector<Real3> gravity_;
    std::vector<Tie> ties_;
    OdeState start_;
    DenseSolution solution_;
    double validUntil_ = 1e300;
    mutable double dt_ = 0.0;
    mutable adapter::Scheme scheme_ = adapter::Scheme::Unknown;
    mutable std::vector<OdeState> steps_;
};

}  // namespace

std::unique_ptr<Reference> makeSpringNetwork(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<SpringNetwork>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
