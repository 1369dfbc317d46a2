// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Flight with quadratic drag, any direction: m v' = m g - (c + q |v|) v, integrated to 1e-12 (ode.hpp). Along
// the vertical with c = 0 and vt = sqrt(m g/q), T = vt/g it is: falling from rest v = -vt tanh(t/T), rising
// v = vt tan(atan(v0/vt) - t/T), apex vt T ln(1 + v0^2/vt^2)/2. Scheme-exact: Euler's schemes stepped.
// Source: Newton, Principia, book II, 1687; Parker, Am. J. Phys. 45 (1977) 606; Timmerman and van der Weele,
// Am. J. Phys. 67 (1999) 538. Assumes: drag and gravity only, no spin.
// Quantity: terminal_speed, where the run reaches it to 1e-3: the speed at the end.
#include <cmath>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/numerics/vector.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;

class QuadraticDragFlight : public Reference {
  public:
    QuadraticDragFlight(const Scenario& scenario, int index)
        : scenario_(scenario), index_(index), body_(scenario.bodies[index]) {
        requireUndisturbed(scenario, index, {.drag = true, .quadraticDrag = true});
        require(body_.angularVelocity == Vec3{}, bodyTitle(scenario, index) + " spins");
        for (const auto& force : scenario.forces)
            if (const auto* drag = std::get_if<scenario::DragForce>(&force); drag && drag->body == index) {
                linear_ += drag->coefficient / body_.massProperties.mass;
                quadratic_ += drag->quadratic / body_.massProperties.mass;
            }
        require(quadratic_ > 0, bodyTitle(scenario, index) + " has no quadratic drag");
        gravity_ = real3(gravityOn(scenario, index));
        const Real3 x = real3(centerOfMass(body_)), v = real3(body_.velocity);
        start_ = {x.x, x.y, x.z, v.x, v.y, v.z};
        const Real end = runEnd(scenario), fast = norm(v) + norm(gravity_) * end, far = fast * end;
        solution_ = DenseSolution([this](Real, const OdeState& y, OdeState& d) { derivative(y, d); }, 0,
                                  start_, end, 1e-14L, {}, {far, far, far, fast, fast, fast});
    }
    std::vector<int> bodies() const override { return {index_}; }
    PartialState exact(int, double t) const override { return stateIn(solution_.at(t)); }

    std::optional<PartialState> schemeExact(int, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        if (!adapter::isEuler(scheme)) return std::nullopt;
        if (steps_.empty() || dt != dt_ || scheme != scheme_) steps_ = {start_};
        dt_ = dt;
        scheme_ = scheme;
        while (steps_.size() <= step) {
            OdeState y = steps_.back(), d(6);
            derivative(y, d);
            for (std::size_t i = 0; i < 3; ++i) {
                const Real before = y[3 + i];
                y[3 + i] += dt * d[3 + i];
                y[i] += dt * (scheme == adapter::Scheme::SymplecticEuler ? y[3 + i] : before);
            }
            steps_.push_back(std::move(y));
        }
        return stateIn(steps_[step]);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        const Real g = norm(gravity_);
        if (linear_ != 0 || g == 0) return {};
        const auto terminal = static_cast<double>(std::sqrt(g / quadratic_));
        if (std::abs(norm(*exact(index_, scenario_.duration).velocity) - terminal) > 1e-3 * terminal)
            return {};
        const double end = norm(*exact(index_, scenario_.duration).velocity);
        Quantity q{"terminal_speed", "m/s", end, {}, 0.0, {}};
        q.measure = [this](const Trajectory& run) -> std::optional<double> {
            return norm(run.state(run.frames() - 1, index_).velocity);
        };
        return {q};
    }

  private:
    void derivative(const OdeState& y, OdeState& d) const {
        const Real3 v{y[3], y[4], y[5]}, a = gravity_ - (linear_ + quadratic_ * norm(v)) * v;
        d = {v.x, v.y, v.z, a.x, a.y, a.z};
    }
    PartialState stateIn(const OdeState& y) const {
        return stateOf(body_, toVec3({y[0], y[1], y[2]}), body_.pose.orientation, toVec3({y[3], y[4], y[5]}),
                       {});
    }

    const Scenario& scenario_;
    int index_;
    const Body& body_;
    Real linear_ = 0, quadratic_ = 0;  ///< coefficients over the mass
    Real3 gravity_;
    OdeState start_;
    DenseSolution solution_;
    mutable double dt_ = 0.0;
    mutable adapter::Scheme scheme_ = adapter::Scheme::Unknown;
    mutable std::vector<OdeState> steps_;
};

}  // namespace

std::unique_ptr<Reference> makeQuadraticDrag(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"body"});
    return std::make_unique<QuadraticDragFlight>(scenario, parts.dynamicBody("body"));
}

}  // namespace rigor::validation
