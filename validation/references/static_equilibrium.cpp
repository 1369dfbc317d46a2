// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Do bodies that lean on each other stand? Stacks, overhangs, pyramids, ladders, arches: a force f_c at every
// touching point, inside the friction cone, must balance gravity and torque on every body:
//   sum f_c + m g + F = 0,  sum (p_c - x) x f_c + T = 0,  f_c = sum of rays of the cone, weights >= 0:
// a linear program (linear_program.hpp), exact in two dimensions. In three the cone lies between two pyramids
// of 16 sides; the answer stands where both agree. Feasible: everything rests, the exact solution is the
// start (the law of maximal dissipation allows other answers only to bodies already moving). Infeasible: no
// forces hold the bodies, something must move. The total force between two bodies is determinate where the
// least and the greatest value over all solutions agree. Source: Heyman, The Stone Skeleton, 1966; Livesley,
// Int. J. Numer. Meth. Eng. 12 (1978) 1853; Gilbert and Melbourne, Struct. Eng. 72 (1994) 356; Milankovitch
// 1907 (arch); Paterson and Zwick, Am. Math. Mon. 116 (2009) 19 (overhang). Assumes: rest at the start;
// shapes of touching.hpp; gravity, constant forces and contact only. Quantities: moves (0 or 1; a run shows 1
// where a body moved by 5 % of its size or turned by 0.1 rad); where they rest and it is determinate,
// force_<a>_<b>: the normal force between two bodies [N], from the impulses of the last quarter of the run.
#include <algorithm>
#include <cmath>
#include <map>

#include "validation/references/numerics/linear_program.hpp"
#include "validation/references/touching.hpp"

namespace rigor::validation {
namespace {

using numerics::LinearProgram;
using numerics::Real;
using scenario::BodyType;

constexpr int kSides = 16;  // of the pyramids that stand for a cone in space
constexpr double kMoved = 0.02,
                 kTurned = 0.05;  // beside the size; [rad]: far above what any engine at rest shows

class StaticEquilibrium : public Reference {
  public:
    StaticEquilibrium(const Scenario& scenario, std::vector<int> bodies)
        : scenario_(scenario), dynamic_(std::move(bodies)), points_(touchingPoints(scenario)) {
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
        LinearProgram inner = build(false);
        stands_ = inner.feasible(1e-9L);
        if (scenario.dimension == 3 && !stands_)
            require(!build(true).feasible(1e-9L), "too near the limit of equilibrium to decide");
        require(stands_ || inner.infeasibility() > 1e-6L, "too near the limit of equilibrium to decide");
        if (stands_) findForces(inner);
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
            result.push_back(std::move(q));
        }
        return result;
    }

  private:
    const Body& at(int i) const { return scenario_.bodies[static_cast<std::size_t>(i)]; }

    /// Rays of the friction cone of a point; force on b.
    std::vector<Vec3> raysOf(const TouchingPoint& p, bool outer) const {
        const Vec3 t = perpendicular(p.normal), s = cross(p.normal, t);
        if (p.friction == 0.0) return {p.normal};
        if (scenario_.dimension == 2) return {p.normal + p.friction * t, p.normal - p.friction * t};
        std::vector<Vec3> rays;
        const double pi = 3.14159265358979323846,
                     reach = outer ? p.friction / std::cos(pi / kSides) : p.friction;
        for (int i = 0; i < kSides; ++i) {
            const double a = 2 * pi * i / kSides;
            rays.push_back(p.normal + (reach * std::cos(a)) * t + (reach * std::sin(a)) * s);
        }
        return rays;
    }

    /// Forces over the weight, torques over the weight times the size of each body: entries of order 1.
    LinearProgram build(bool outer) {
        const std::size_t torques = scenario_.dimension == 2 ? 1 : 3,
                          forces = scenario_.dimension == 2 ? 2 : 3, each = torques + forces;
        std::vector<std::vector<Real>> rows(each * dynamic_.size());
        std::vector<Real> right(rows.size(), 0);
        const auto write = [&](std::size_t slot, Vec3 force, Vec3 torque, double size, auto put) {
            const double f[3] = {force.x, force.y, force.z};
            const double t[3] = {scenario_.dimension == 2 ? torque.z : torque.x, torque.y, torque.z};
            for (std::size_t i = 0; i < forces; ++i) put(each * slot + i, static_cast<Real>(f[i]));
            for (std::size_t i = 0; i < torques; ++i)
                put(each * slot + forces + i, static_cast<Real>(t[i]) / static_cast<Real>(size));
        };
        columnPoint_.clear();
        for (std::size_t c = 0; c < points_.size(); ++c)
            for (const Vec3 ray : raysOf(points_[c], outer)) {
                columnPoint_.push_back(c);
                for (auto& row : rows) row.push_back(0);
                for (std::size_t slot = 0; slot < dynamic_.size(); ++slot) {
                    const bool onB = dynamic_[slot] == points_[c].b;
                    if (!onB && dynamic_[slot] != points_[c].a) continue;
                    const Vec3 force = onB ? ray : -ray,
                               arm = points_[c].point - centerOfMass(at(dynamic_[slot]));
                    write(slot, force, cross(arm, force), sizeOf(at(dynamic_[slot])),
                          [&](std::size_t row, Real v) { rows[row].back() = v; });
                }
            }
        for (std::size_t slot = 0; slot < dynamic_.size(); ++slot) {
            const int index = dynamic_[slot];
            Vec3 load = at(index).massProperties.mass * gravityOn(scenario_, index), torque;
            for (const auto& force : scenario_.forces)
                if (const auto* f = std::get_if<scenario::ConstantForce>(&force); f && f->body == index) {
                    require(f->start <= 0.0 && f->end >= scenario_.duration,
                            "a force does not act all the time");
                    load += f->force;
                    torque += f->torque;
                }
            write(slot, -load / weight_, -torque / weight_, sizeOf(at(index)),
                  [&](std::size_t row, Real v) { right[row] = v; });
        }
        return {rows, right};
    }

    /// Total normal force between each two touching bodies, where all solutions agree.
    void findForces(LinearProgram& program) {
        std::map<std::pair<int, int>, bool> pairs;
        for (const auto& p : points_) pairs[{p.a, p.b}] = true;
        for (const auto& [pair, unused] : pairs) {
            std::vector<Real> cost(columnPoint_.size(), 0);
            for (std::size_t j = 0; j < cost.size(); ++j) {
                const TouchingPoint& p = points_[columnPoint_[j]];
                if (p.a == pair.first && p.b == pair.second) cost[j] = 1;  // every ray has a unit normal part
            }
            const auto least = program.minimise(cost);
            for (Real& c : cost) c = -c;
            const auto most = program.minimise(cost);
            if (least.status != LinearProgram::Status::Optimal ||
                most.status != LinearProgram::Status::Optimal)
                continue;
            if (std::abs(-most.value - least.value) > 1e-9L) continue;
            forces_[pair] = weight_ * static_cast<double>(least.value);
        }
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
        bool told = false;
        for (std::size_t k = run.frames() - run.frames() / 4; k < run.frames(); ++k, ++count)
            for (const auto& c : run.contacts[k]) {
                if (!((c.bodyA == a && c.bodyB == b) || (c.bodyA == b && c.bodyB == a))) continue;
                told = told || c.hasImpulse;
                sum += c.normalImpulse;
            }
        if (count == 0 || !told) return std::nullopt;
        return sum / (static_cast<double>(count) * run.dt);
    }

    const Scenario& scenario_;
    std::vector<int> dynamic_;
    std::vector<TouchingPoint> points_;
    std::vector<std::size_t> columnPoint_;
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
