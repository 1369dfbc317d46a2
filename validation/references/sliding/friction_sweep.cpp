// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many blocks launched in different directions on one floor: isotropic friction stops each after v^2/(2 mu g)
// on a straight line. A friction pyramid stops the diagonal ones after 1/sqrt(2) of it, and bends the others.
// Source: Coulomb 1785. Assumes for each body what sliding_stop assumes, and that the blocks never collide.
// Quantities: stop_distance_<body>, and deflection_<body>: final distance from the line of launch over the
// stopping distance, exactly 0.
#include <cmath>
#include <memory>

#include "validation/references/sliding/sliding.hpp"

namespace rigor::validation {
namespace {

class FrictionSweep : public Reference {
  public:
    FrictionSweep(const Scenario& scenario, const std::vector<int>& bodies, int floor) : scenario_(scenario) {
        for (const int body : bodies) {
            sliding_.push_back(std::make_unique<SlidingBody>(scenario, body, floor));
            require(sliding_.back()->pull() == 0.0, "gravity is not along the normal of the floor");
        }
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& one : sliding_) result.push_back(one->index());
        return result;
    }
    PartialState exact(int body, double t) const override { return find(body).exact(t); }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        return find(body).schemeExact(step, dt, scheme);
    }
    std::vector<Quantity> quantities(double dt, adapter::Scheme scheme) const override {
        std::vector<Quantity> result;
        for (const auto& one : sliding_) {
            const std::string suffix = "_" + scenario_.bodies[one->index()].name;
            one->addStopQuantities(result, suffix, dt, scheme);
            if (one->slide().stopTime() && one->speed() > 0.0) result.push_back(deflection(*one, suffix));
        }
        return result;
    }

  private:
    Quantity deflection(const SlidingBody& one, const std::string& suffix) const {
        const Body& body = scenario_.bodies[one.index()];
        const double reach = norm(one.slide().at(*one.slide().stopTime()).displacement);
        Quantity q{"deflection" + suffix, "1", 0.0, {}, 1.0, {}};
        q.measure = [&body, reach, index = one.index(),
                     n = one.normal()](const Trajectory& run) -> std::optional<double> {
            const Vec3 moved = centerOfMass(body, run.state(run.frames() - 1, index)) -
                               centerOfMass(body, run.state(0, index));
            return std::abs(dot(moved, cross(n, unit(body.velocity)))) / reach;
        };
        return q;
    }
    const SlidingBody& find(int body) const {
        for (const auto& one : sliding_)
            if (one->index() == body) return *one;
        throw std::invalid_argument("friction_sweep: unknown body");
    }
    const Scenario& scenario_;
    std::vector<std::unique_ptr<SlidingBody>> sliding_;
};

}  // namespace

std::unique_ptr<Reference> makeFrictionSweep(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "on"});
    const auto bodies = parts.dynamicBodies("bodies");
    return std::make_unique<FrictionSweep>(scenario, bodies, parts.support("on", bodies.front()));
}

}  // namespace rigor::validation
