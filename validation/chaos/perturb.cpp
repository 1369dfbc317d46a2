// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/chaos/perturb.hpp"

#include <numeric>
#include <stdexcept>
#include <vector>

#include "validation/chaos/philox.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

bool isDynamicBody(const Scenario& s, int body) {
    return body != kNone && s.bodies[body].type == BodyType::Dynamic;
}

/// The lowest body that each body is joined to, over dynamic bodies.
std::vector<int> groupsOf(const Scenario& s) {
    std::vector<int> parent(s.bodies.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int body) {
        while (parent[body] != body) body = parent[body];
        return body;
    };
    for (const Joint& j : s.joints) {
        if (!isDynamicBody(s, j.bodyA) || !isDynamicBody(s, j.bodyB)) continue;
        const int a = root(j.bodyA), b = root(j.bodyB);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (int i = 0; i < static_cast<int>(parent.size()); ++i) parent[i] = root(i);
    return parent;
}

/// Motions of a group as a whole.
struct Freedom {
    bool shifts = true, turns = true;
    Vec3 pivot;
    Vec3 axis;  ///< axis of a hinge; zero: any
};

Vec3 centerOf(const Scenario& s, const std::vector<int>& group, int root) {
    Vec3 sum;
    double mass = 0.0;
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i] != root || !isDynamicBody(s, i)) continue;
        const Body& b = s.bodies[i];
        sum += b.massProperties.mass * (b.pose * b.massProperties.centerOfMass);
        mass += b.massProperties.mass;
    }
    return sum / mass;
}

Freedom freedomOf(const Scenario& s, const std::vector<int>& group, int root) {
    Freedom f;
    f.pivot = centerOf(s, group, root);
    int holds = 0;
    for (const Joint& j : s.joints) {
        const bool a = isDynamicBody(s, j.bodyA), b = isDynamicBody(s, j.bodyB);
        if (a == b || group[a ? j.bodyA : j.bodyB] != root) continue;
        ++holds;
        f.shifts = false;
        f.turns = holds == 1 && (j.type == JointType::Ball || j.type == JointType::Hinge);
        const Body& body = s.bodies[a ? j.bodyA : j.bodyB];
        f.pivot = body.pose * (a ? j.anchorA : j.anchorB);
        if (j.type == JointType::Hinge && s.dimension == 3)
            f.axis = rotate(body.pose.orientation, a ? j.axisA : j.axisB);
    }
    return f;
}

class Rng {
  public:
    Rng(std::uint64_t seed, std::uint32_t member, int group)
        : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
          counter_{member, static_cast<std::uint32_t>(group), 0, 0} {}
    /// Components within plus and minus `size`; a different `quantity` gives independent ones.
    Vec3 vector(std::uint32_t quantity, double size) const {
        PhiloxBlock counter = counter_;
        counter[2] = quantity;
        const PhiloxBlock words = philox(counter, key_);
        return size * Vec3{philoxUniform(words[0]), philoxUniform(words[1]), philoxUniform(words[2])};
    }

  private:
    std::array<std::uint32_t, 2> key_;
    PhiloxBlock counter_;
};

/// The part of a rotation vector that the group may turn by.
Vec3 allowedTurn(const Scenario& s, const Freedom& f, Vec3 turn) {
    if (s.dimension == 2) return {0, 0, turn.z};
    return norm(f.axis) > 0.0 ? turn.x * f.axis : turn;
}

void moveGroup(Scenario& s, const std::vector<int>& group, int root, const Freedom& f,
               const Perturbation& size, const Rng& rng) {
    enum : std::uint32_t { Shift, Turn, Velocity, Spin };
    const auto planar = [&](Vec3 v) { return s.dimension == 2 ? Vec3{v.x, v.y, 0.0} : v; };
    const Vec3 shift = f.shifts ? planar(rng.vector(Shift, size.position)) : Vec3{};
    const Vec3 push = f.shifts ? planar(rng.vector(Velocity, size.velocity)) : Vec3{};
    const Vec3 turn = allowedTurn(s, f, rng.vector(Turn, size.angle));
    const Vec3 spin = allowedTurn(s, f, rng.vector(Spin, size.spin));
    const double angle = norm(turn);
    const Quat Q = angle > 0.0 ? fromAxisAngle(turn / angle, angle) : Quat{};
    for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i] != root || !isDynamicBody(s, i)) continue;
        Body& b = s.bodies[i];
        b.pose = {f.pivot + rotate(Q, b.pose.position - f.pivot) + shift, Q * b.pose.orientation};
        b.angularVelocity = rotate(Q, b.angularVelocity) + spin;
        const Vec3 arm = b.pose * b.massProperties.centerOfMass - shift - f.pivot;
        b.velocity = rotate(Q, b.velocity) + push + cross(spin, arm);
    }
}

}  // namespace

Scenario perturbed(const Scenario& scenario, const Perturbation& size, std::uint64_t seed,
                   std::uint32_t member) {
    Scenario s = scenario;
    s.reference.reset();
    s.accept.clear();
    s.knownDeviations.clear();
    const std::vector<int> group = groupsOf(s);
    bool any = false;
    for (int i = 0; i < static_cast<int>(group.size()); ++i) {
        if (group[i] != i || !isDynamicBody(s, i)) continue;
        const Freedom f = freedomOf(scenario, group, i);
        const bool moves = (f.shifts && (size.position > 0.0 || size.velocity > 0.0)) ||
                           (f.turns && (size.angle > 0.0 || size.spin > 0.0));
        if (!moves) continue;
        any = true;
        Perturbation by = size;
        if (!f.turns) by.angle = by.spin = 0.0;
        moveGroup(s, group, i, f, by, Rng(seed, member, i));
    }
    if (!any)
        throw std::invalid_argument("scenario " + scenario.name +
                                    ": no body that this perturbation could move");
    return s;
}

}  // namespace rigor::validation
