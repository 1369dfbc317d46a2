// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/symmetry/symmetry.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "validation/metrics/metric_parts.hpp"
#include "validation/symmetry/transforms.hpp"
#include "validation/table.hpp"

namespace rigor::validation {
namespace {

/// Minus zero is another zero, not another state.
bool sameBits(double a, double b) {
    return a == b || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool sameBits(const scenario::Vec3& a, const scenario::Vec3& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool sameBits(const BodyState& a, const BodyState& b) {
    const auto &p = a.orientation, &q = b.orientation;
    return sameBits(a.position, b.position) && sameBits(a.velocity, b.velocity) &&
           sameBits(a.angularVelocity, b.angularVelocity) && sameBits(p.w, q.w) && sameBits(p.x, q.x) &&
           sameBits(p.y, q.y) && sameBits(p.z, q.z);
}

void compareFrames(const scenario::Scenario& s, const Trajectory& a, std::size_t frameA, const Trajectory& b,
                   std::size_t frameB, Difference& d) {
    bool same = true;
    for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
        if (s.bodies[i].type == scenario::BodyType::Static) continue;
        const BodyState &x = a.state(frameA, i), &y = b.state(frameB, i);
        same = same && sameBits(x, y);
        const double distance = norm(x.position - y.position);
        if (!(distance <= d.position)) {
            d.position = distance;
            d.positionAt = a.times[frameA];
            d.body = i;
        }
        const double angle = rotationAngle(x.orientation, y.orientation);
        if (!(angle <= d.angle)) d.angle = angle;
    }
    ++d.frames;
    if (same) return;
    ++d.differing;
    if (!d.firstDiffering) d.firstDiffering = a.times[frameA];
}

}  // namespace

const std::vector<SymmetryEntry>& symmetryTable() {
    static const std::vector<SymmetryEntry> table{
#define SYMMETRY(name, title, rerun, formula, obstacle, apply) \
    {#name, title, Rerun::rerun, formula, &obstacle, &apply},
#include "validation/symmetry/symmetries.def"
#undef SYMMETRY
    };
    return table;
}

const SymmetryEntry* findSymmetry(const std::string& name) {
    return findEntry(symmetryTable(), name);
}

std::string symmetryNames() {
    return namesOf(symmetryTable());
}

Difference differenceOf(const scenario::Scenario& scenario, const Trajectory& a, const Trajectory& b) {
    if (a.bodyCount != scenario.bodies.size() || b.bodyCount != a.bodyCount)
        throw std::invalid_argument("trajectories of other bodies than the scenario's");
    Difference d;
    std::size_t k = 0;
    for (std::size_t f = 0; f < a.frames(); ++f) {
        const double slack = 1e-6 * a.dt;
        while (k < b.frames() && b.times[k] < a.times[f] - slack) ++k;
        if (k < b.frames() && b.times[k] <= a.times[f] + slack) compareFrames(scenario, a, f, b, k, d);
    }
    if (d.frames < 2) throw std::invalid_argument("trajectories without a common frame after the first");
    return d;
}

scenario::Scenario bare(const scenario::Scenario& scenario) {
    scenario::Scenario s = scenario;
    s.reference.reset();
    s.accept.clear();
    s.knownDeviations.clear();
    s.metrics = {"energy_drift"};
    return s;
}

Trajectory mapped(const Trajectory& trajectory,
                  const std::function<BodyState(const BodyState&, double time)>& state,
                  const std::function<ContactPoint(const ContactPoint&, double time)>& contact) {
    Trajectory t = trajectory;
    for (std::size_t f = 0; f < t.frames(); ++f) {
        for (std::size_t i = 0; i < t.bodyCount; ++i) {
            BodyState& s = t.states[f * t.bodyCount + i];
            s = state(s, t.times[f]);
        }
        if (f < t.contacts.size())
            for (ContactPoint& c : t.contacts[f]) c = contact(c, t.times[f]);
    }
    return t;
}

Trajectory reordered(const Trajectory& trajectory, const std::vector<int>& place) {
    Trajectory t = trajectory;
    t.bodyCount = place.size();
    t.states.clear();
    std::vector<int> before(trajectory.bodyCount, scenario::kNone);
    for (std::size_t i = 0; i < place.size(); ++i) before[place[i]] = i;
    for (std::size_t f = 0; f < trajectory.frames(); ++f) {
        for (const int p : place) t.states.push_back(trajectory.state(f, p));
        if (f >= t.contacts.size()) continue;
        auto& contacts = t.contacts[f];
        for (ContactPoint& c : contacts) {
            c.bodyA = before[c.bodyA];
            c.bodyB = before[c.bodyB];
            if (c.bodyA <= c.bodyB) continue;
            std::swap(c.bodyA, c.bodyB);
            std::swap(c.shapeA, c.shapeB);
            std::swap(c.pointA, c.pointB);
            c.normal = -c.normal;
            c.frictionImpulse = -c.frictionImpulse;
        }
        std::erase_if(contacts, [](const ContactPoint& c) { return c.bodyA == scenario::kNone; });
    }
    return t;
}

void require(const std::string& obstacle) {
    if (!obstacle.empty()) throw std::invalid_argument(obstacle);
}

std::string noObstacle(const scenario::Scenario&) {
    return "";
}

Transformed sameAgain(const scenario::Scenario& scenario, const Trajectory*) {
    return {bare(scenario), 1.0, [](const Trajectory& t) { return t; }};
}

}  // namespace rigor::validation
