// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Static equilibrium of bodies that rest on each other: stacks, overhangs, pyramids, ladders, arches: a force
// f_c at every touching point, inside the friction cone, must balance gravity and torque on every body:
//   sum f_c + m g + F = 0,  sum (p_c - x) x f_c + T = 0,  f_c in the cone of Coulomb.
// If such forces exist everything rests, and the exact solution is the start (the law of maximal dissipation
// allows other solutions only for bodies already moving). If none do, something must move. A linear program
// looks for the forces or for a virtual motion in which the loads gain energy (contact_forces.hpp); each
// result is checked separately in exact rational arithmetic (force_balance.hpp), and where neither check
// holds the scene is refused as undecided. The total force between two bodies is determinate where certified
// bounds from below and above agree. Source: Heyman, The Stone Skeleton, 1966; Livesley, Int. J. Numer. Meth.
// Eng. 12 (1978) 1853; Gilbert and Melbourne, Struct. Eng. 72 (1994) 356; Milankovitch 1907 (arch); Paterson
// and Zwick, Am. Math. Mon. 116 (2009) 19 (overhang). Assumes: rest at the start; shapes of touching.hpp;
// gravity, constant forces and contact only. Quantities: moves (0 or 1; a run shows 1 where a body moved by 2
// % of its size or turned by 0.05 rad); where they rest and it is determinate, force_<a>_<b>: the normal
// force between two bodies [N], from the impulses of the last quarter of the run.
#include <algorithm>
#include <cmath>
#include <map>

#include "validation/references/statics/contact_forces.hpp"
#include "validation/references/statics/touching.hpp"

namespace rigor::validation {
namespace {

using scenario::BodyType;

/// Motion relative to the size of a body, and turn [rad], of a moved body: far above what any engine shows
/// at rest.
constexpr double kMoved = 0.02, kTurned = 0.05;

class StaticEquilibrium : public Reference {
  public:
    StaticEquilibrium(const Scenario& scenario, std::vector<int> bodies)
        : scenario_(scenario), dynamic_(std::move(bodies)) {
        require(scenario.joints.empty(), "joints hold bodies, which this reference does not know");
        for (int i = 0; i < static_cast<int>(scenario.bodies.size()); ++i) {
            const Body& body = at(i);
            requireStill(scenario, i);
            if (body.type != BodyType::Dynamic) continue;
            requireUndisturbed(scenario, i, {.constantForces = true});
            require(std::find(dynamic_.begin(), dynamic_.end(), i) != dynamic_.end(),
                    bodyTitle(scenario, i) + " is left out: all that leans on each other counts");
            weight_ += body.massProperties.mass * norm(gravityOn(scenario, i));
        }
        require(weight_ > 0.0, "nothing has a weight");
        const LoadedBodies problem = loadedBodies();
        ContactForces found(problem);
        require(
            found.verdict() != ContactForces::Verdict::Undecided,
            "undecided: neither contact forces that balance the loads nor a motion that gains energy could "
            "be certified");
        stands_ = found.verdict() == ContactForces::Verdict::Balance;
        if (!stands_) return;
        for (const auto& [pair, force] : found.determinate()) forces_[pairs_[pair]] = force;
    }
    std::vector<int> bodies() const override { return stands_ ? dynamic_ : std::vector<int>{}; }
    PartialState exact(int index, double) const override {
        return stateOf(at(index), centerOfMass(at(index)), at(index).pose.orientation, {}, {});
    }
    std::optional<PartialState> schemeExact(int body, std::size_t, double, adapter::Scheme) const override {
        return exact(body, 0.0);
    }

    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        Quantity moves{"moves", "1", stands_ ? 0.0 : 1.0, stands_ ? 0.0 : 1.0, 1.0, {}};
        moves.measure = [this](const Trajectory& run) -> std::optional<double> {
            return moved(run) ? 1.0 : 0.0;
        };
        result.push_back(std::move(moves));
        for (const auto& [pair, force] : forces_) {
            Quantity q{
                "force_" + at(pair.first).name + "_" + at(pair.second).name, "N", force, force, weight_, {}};
            q.measure = [pair = pair](const Trajectory& run) {
                return meanForce(run, pair.first, pair.second);
            };
            q.needsImpulses = true;
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    const Body& at(int i) const { return scenario_.bodies[i]; }

    LoadedBodies loadedBodies() {
        LoadedBodies problem;
        problem.dimension = scenario_.dimension;
        for (const int index : dynamic_) {
            LoadedBodies::LoadedBody body;
            body.center = centerOfMass(at(index));
            body.size = sizeOf(at(index));
            body.force = at(index).massProperties.mass * gravityOn(scenario_, index);
            for (const auto& force : scenario_.forces)
                if (const auto* f = std::get_if<scenario::ConstantForce>(&force); f && f->body == index) {
                    require(f->start <= 0.0 && f->end >= scenario_.duration,
                            "a force does not act all the time");
                    body.force += f->force;
                    body.torque += f->torque;
                }
            // A body of next to no load is measured against all of them.
            body.load = std::max(norm(body.force) + norm(body.torque) / body.size, 1e-9 * weight_);
            problem.bodies.push_back(body);
        }
        const auto slotOf = [&](int index) {
            const auto place = std::find(dynamic_.begin(), dynamic_.end(), index);
            return place == dynamic_.end() ? -1 : static_cast<int>(place - dynamic_.begin());
        };
        for (const auto& p : touchingPoints(scenario_)) {
            const int a = slotOf(p.a), b = slotOf(p.b);
            if (a < 0 && b < 0) continue;
            const std::pair<int, int> pair{p.a, p.b};
            if (pairs_.empty() || pairs_.back() != pair) pairs_.push_back(pair);
            problem.contacts.push_back(
                {a, b, static_cast<int>(pairs_.size()) - 1, p.point, p.normal, p.friction});
        }
        return problem;
    }

    bool moved(const Trajectory& run) const {
        for (std::size_t k = 0; k < run.frames(); ++k)
            for (const int i : dynamic_) {
                const auto& state = run.state(k, i);
                const Quat turn = state.orientation * scenario::conjugate(at(i).pose.orientation);
                const double angle = 2.0 * std::atan2(norm(Vec3{turn.x, turn.y, turn.z}), std::abs(turn.w));
                const double way = norm(centerOfMass(at(i), state) - centerOfMass(at(i)));
                if (!(way <= kMoved * sizeOf(at(i)) && angle <= kTurned)) return true;
            }
        return false;
    }

    static std::optional<double> meanForce(const Trajectory& run, int a, int b) {
        double sum = 0.0;
        std::size_t count = 0;
        bool impulsesKnown = false;
        // No step begins at the last frame.
        for (std::size_t k = run.frames() - run.frames() / 4; k + 1 < run.frames(); ++k, ++count)
            for (const auto& c : run.contacts[k]) {
                if (!((c.bodyA == a && c.bodyB == b) || (c.bodyA == b && c.bodyB == a))) continue;
                impulsesKnown = impulsesKnown || c.hasImpulse;
                sum += c.normalImpulse;
            }
        if (count == 0 || !impulsesKnown) return std::nullopt;
        return sum / (static_cast<double>(count) * run.dt);
    }

    const Scenario& scenario_;
    std::vector<int> dynamic_;
    std::vector<std::pair<int, int>> pairs_;  ///< bodies that touch
    std::map<std::pair<int, int>, double> forces_;
    double weight_ = 0.0;
    bool stands_ = false;
};

}  // namespace

std::unique_ptr<Reference> makeStaticEquilibrium(const Scenario& scenario,
                                                 const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<StaticEquilibrium>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
