// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Blocks at rest that constant forces push along a floor, in any direction: with N = -m g.n - f.n and the
// force f + m g along the floor of size F, a block stays while F <= mu_s N, else x = (F - mu N) t^2/(2 m)
// along it. A pyramid of friction holds a push along its diagonal up to sqrt(2) mu N.
// Source: Coulomb 1785; Goldstein, Poole, Safko, Classical Mechanics, 2002, ch. 1. Assumes: blocks on flat
// bases that do not tip, forces at their centres of mass from the start to the end; gravity and contact only.
#include <algorithm>
#include <cmath>

#include "validation/references/parts.hpp"

namespace rigor::validation {
namespace {

class PushedBlocks : public Reference {
  public:
    PushedBlocks(const Scenario& scenario, const std::vector<int>& bodies, int floor) : scenario_(scenario) {
        for (const int body : bodies) add(body, floor);
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const Pushed& p : pushed_) result.push_back(p.body);
        return result;
    }
    PartialState exact(int body, double t) const override {
        const Pushed& p = of(body);
        return moved(p, 0.5 * t * t, t);
    }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme scheme) const override {
        if (!adapter::isEuler(scheme)) return std::nullopt;
        const auto n = static_cast<double>(step);
        const double more = scheme == adapter::Scheme::SymplecticEuler ? n + 1 : n - 1;
        return moved(of(body), 0.5 * n * more * dt * dt, n * dt);
    }

  private:
    struct Pushed {
        int body = 0;
        Vec3 start, acceleration;
    };
    const Pushed& of(int body) const {
        for (const Pushed& p : pushed_)
            if (p.body == body) return p;
        throw std::invalid_argument("pushed_block: unknown body");
    }
    PartialState moved(const Pushed& p, double way, double time) const {
        const Body& b = scenario_.bodies[p.body];
        return stateOf(b, p.start + way * p.acceleration, b.pose.orientation, time * p.acceleration, {});
    }

    void add(int index, int floor) {
        const Body& body = scenario_.bodies[index];
        const std::string subject = bodyTitle(scenario_, index);
        requireUndisturbed(scenario_, index, {.constantForces = true});
        requireContact(scenario_, index, floor);
        requireStill(scenario_, index);
        requireStill(scenario_, floor);
        const Vec3 com = centerOfMass(body);
        const Plane plane = planeOf(scenario_, floor, com);
        const Support support = supportOf(scenario_, index, plane);
        require(std::abs(support.gap) <= 1e-4 * sizeOf(body), subject + " does not stand on the floor");
        const double mass = body.massProperties.mass;
        Vec3 force = mass * gravityOn(scenario_, index);
        for (const auto& f : scenario_.forces) {
            const auto* push = std::get_if<scenario::ConstantForce>(&f);
            if (!push || push->body != index) continue;
            require(push->start == 0.0 && push->end >= scenario_.duration && push->torque == Vec3{},
                    "the force on " + subject + " has a torque, or does not last from the start to the end");
            force += push->force;
        }
        const double load = -dot(force, plane.normal);
        require(load > 0.0, subject + " is lifted off the floor");
        const Vec3 along = force + load * plane.normal;
        const auto pair = pairCoefficients(scenario_, support.material, plane.material);
        const double holds = std::max(pair.staticFriction, pair.friction) * load;
        const bool stays = norm(along) <= holds;
        const double friction = stays ? norm(along) : pair.friction * load;
        // The pressure's centre: friction at the floor turns the body forward about its centre of mass.
        const Vec3 center =
            com - plane.height(com) * plane.normal + (plane.height(com) * friction / load) * unit(along);
        require(supportMargin(support.points, center, plane.normal, scenario_.dimension) >= 0.0,
                subject + " tips over");
        pushed_.push_back({index, com, stays ? Vec3{} : (1.0 / mass) * (along - friction * unit(along))});
    }

    const Scenario& scenario_;
    std::vector<Pushed> pushed_;
};

}  // namespace

std::unique_ptr<Reference> makePushedBlock(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies", "on"});
    const std::vector<int> bodies = parts.dynamicBodies("bodies");
    require(!bodies.empty(), "there is no body to push");
    return std::make_unique<PushedBlocks>(scenario, bodies, parts.support("on", bodies.front()));
}

}  // namespace rigor::validation
