// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Nothing moves: stacks, chains hanging straight, blocks below the friction angle. The exact solution is the
// initial state for all time, by both schemes too. Source: Newton 1687, first law. Assumes: zero initial
// velocities, no impulses or forces, every body touches something or hangs on a joint; a body that stands on
// a single plane alone neither slides nor tips. Whether a whole pile stands is not checked.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/references/sliding/sliding.hpp"

namespace rigor::validation {
namespace {

using scenario::BodyType;

struct Extent {
    std::array<double, 3> low{}, high{};
};

class AtRest : public Reference {
  public:
    AtRest(const Scenario& scenario, std::vector<int> bodies)
        : scenario_(scenario), bodies_(std::move(bodies)) {
        for (const auto& body : scenario.bodies)
            require(
                body.type == BodyType::Dynamic || (body.velocity == Vec3{} && body.angularVelocity == Vec3{}),
                "body '" + body.name + "' moves");
        for (const int i : bodies_) check(i);
    }
    std::vector<int> bodies() const override { return bodies_; }
    PartialState exact(int index, double) const override {
        const Body& body = scenario_.bodies[index];
        return stateOf(body, centerOfMass(body), body.pose.orientation, {}, {});
    }
    std::optional<PartialState> schemeExact(int body, std::size_t, double, adapter::Scheme) const override {
        return exact(body, 0.0);
    }

  private:
    void check(int index) const {
        const Body& body = scenario_.bodies[index];
        const std::string subject = bodyTitle(scenario_, index);
        require(body.velocity == Vec3{} && body.angularVelocity == Vec3{},
                subject + " starts with a velocity");
        requireUndisturbed(scenario_, index,
                           {.joints = true, .springs = true, .drag = true, .damping = true});
        if (gravityOn(scenario_, index) == Vec3{}) return;
        std::vector<int> neighbours;
        for (int other = 0; other < static_cast<int>(scenario_.bodies.size()); ++other)
            if (other != index && scenario::mayCollide(scenario_, index, other) && near(index, other))
                neighbours.push_back(other);
        bool held = !neighbours.empty();
        for (const auto& joint : scenario_.joints)
            held = held || joint.bodyA == index || joint.bodyB == index;
        for (const auto& force : scenario_.forces)
            if (const auto* spring = std::get_if<scenario::SpringForce>(&force))
                held = held || spring->bodyA == index || spring->bodyB == index;
        require(held, subject + " touches nothing and would fall");
        if (neighbours.size() == 1 && scenario_.joints.empty()) checkAlone(index, neighbours.front());
    }

    void checkAlone(int index, int floor) const {
        const Body& ground = scenario_.bodies[floor];
        if (ground.type == BodyType::Dynamic || ground.shapes.size() != 1 ||
            std::holds_alternative<scenario::ConvexHull>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::Capsule>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::Cone>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::Sphere>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::Chain>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::TriangleMesh>(ground.shapes[0].geometry) ||
            std::holds_alternative<scenario::HeightField>(ground.shapes[0].geometry))
            return;
        const Body& body = scenario_.bodies[index];
        if (body.linearVelocityKept != 1.0 || body.angularVelocityKept != 1.0 || !scenario_.forces.empty())
            return;
        const SlidingBody sliding(scenario_, index, floor);
        require(sliding.slide().sticks(),
                bodyTitle(scenario_, index) + " slides: the slope is steeper than the friction angle");
    }

    Extent extent(int index) const {
        Extent box;
        Scenario shifted;
        shifted.dimension = scenario_.dimension;
        shifted.materials = scenario_.materials;
        shifted.pairs = scenario_.pairs;
        shifted.bodies.push_back(scenario_.bodies[index]);
        for (auto& shape : shifted.bodies[0].shapes) shape.material = 0;
        const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        for (std::size_t i = 0; i < 3; ++i) {
            Plane plane;
            plane.normal = axes[i];
            box.low[i] = supportOf(shifted, 0, plane).gap;
            plane.normal = -axes[i];
            box.high[i] = -supportOf(shifted, 0, plane).gap;
        }
        return box;
    }

    /// True if the bodies are close enough to touch: by bounding boxes, or exactly for half-spaces.
    bool near(int a, int b) const {
        const Body& other = scenario_.bodies[b];
        const double slack = 1e-2 * sizeOf(scenario_.bodies[a]);
        if (scenario_.bodies[a].shapes.empty() || other.shapes.empty()) return false;
        for (const auto& shape : other.shapes)
            if (std::holds_alternative<scenario::HalfSpace>(shape.geometry)) {
                if (other.shapes.size() > 1) return true;
                return supportOf(scenario_, a, planeOf(scenario_, b, {})).gap <= slack;
            }
        const Extent x = extent(a), y = extent(b);
        for (std::size_t i = 0; i < static_cast<std::size_t>(scenario_.dimension); ++i)
            if (x.low[i] > y.high[i] + slack || y.low[i] > x.high[i] + slack) return false;
        return true;
    }

    const Scenario& scenario_;
    std::vector<int> bodies_;
};

}  // namespace

std::unique_ptr<Reference> makeAtRest(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<AtRest>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
