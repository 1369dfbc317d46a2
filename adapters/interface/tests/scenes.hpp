// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenarios built by hand, and the adapter module under test (RIGOR_MODULE): for the tests of adapters.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::test {

using adapter::BodyState;
using adapter::ContactPoint;
using scenario::Body;
using scenario::BodyType;
using scenario::Box;
using scenario::Capsule;
using scenario::ConvexHull;
using scenario::Cylinder;
using scenario::Geometry;
using scenario::HalfSpace;
using scenario::Joint;
using scenario::JointType;
using scenario::Mat3;
using scenario::Quat;
using scenario::Scenario;
using scenario::Sphere;
using scenario::Vec3;

/// The module this test was built for, loaded once.
inline const adapter::Engine& engine() {
    static const adapter::LoadedEngine loaded{RIGOR_MODULE};
    return *loaded;
}
inline bool isDouble() {
    return engine().info().precision == "f64";
}
/// A tolerance for each precision of the engine.
inline double tol(double f64, double f32) {
    return isDouble() ? f64 : f32;
}

/// An empty scenario with one material.
inline Scenario scene(double friction = 0.0, double restitution = 0.0, int dimension = 3) {
    Scenario s;
    s.name = "test";
    s.dimension = dimension;
    s.materials.push_back({"stuff", friction, restitution, 1000.0});
    return s;
}

inline scenario::Shape shapeOf(Geometry geometry, int material = 0, scenario::Pose pose = {}) {
    return {std::move(geometry), pose, material};
}

/// Adds a dynamic body of one shape with the given principal moments; returns its index.
inline int addBody(Scenario& s, const Geometry& geometry, const Vec3& position, double mass = 1.0,
                   const Vec3& moments = {0.1, 0.1, 0.1}) {
    Body body;
    body.name = "body" + std::to_string(s.bodies.size());
    body.pose.position = position;
    body.shapes.push_back(shapeOf(geometry));
    body.massProperties = {mass, {}, Mat3::diagonal(moments.x, moments.y, moments.z)};
    s.bodies.push_back(body);
    return static_cast<int>(s.bodies.size()) - 1;
}

inline int addStatic(Scenario& s, const Geometry& geometry, const Vec3& position = {}) {
    Body body;
    body.name = "static" + std::to_string(s.bodies.size());
    body.type = BodyType::Static;
    body.pose.position = position;
    body.shapes.push_back(shapeOf(geometry));
    s.bodies.push_back(body);
    return static_cast<int>(s.bodies.size()) - 1;
}

/// Moments of a solid box of these half extents.
inline Vec3 boxMoments(double mass, const Vec3& h) {
    return {mass / 3.0 * (h.y * h.y + h.z * h.z), mass / 3.0 * (h.x * h.x + h.z * h.z),
            mass / 3.0 * (h.x * h.x + h.y * h.y)};
}
inline double sphereMoment(double mass, double r) {
    return 0.4 * mass * r * r;
}
inline Vec3 even(double v) {
    return {v, v, v};
}

/// The eight corners of a box as a hull.
inline ConvexHull boxHull(const Vec3& h) {
    ConvexHull hull;
    for (double x : {-h.x, h.x})
        for (double y : {-h.y, h.y})
            for (double z : {-h.z, h.z}) hull.vertices.push_back({x, y, z});
    return hull;
}

/// A world of the spec's settings ("preset=matched,iterations=50") at one time step.
class Simulation {
  public:
    Simulation(const Scenario& s, double dt, const std::string& options = "preset=matched")
        : dt_(dt), count_(s.bodies.size()) {
        const auto spec = adapter::parseSpec(engine().info().name + (options.empty() ? "" : ":" + options));
        world = engine().dynamics()->build(s, dt, adapter::resolveSettings(spec, engine()));
    }
    Simulation& steps(int n) {
        for (int i = 0; i < n; ++i) world->step();
        return *this;
    }
    Simulation& seconds(double t) { return steps(static_cast<int>(t / dt_ + 0.5)); }
    BodyState state(int body) const {
        std::vector<BodyState> states(count_);
        world->readStates(states);
        return states[body];
    }
    std::vector<ContactPoint> contacts() const {
        std::vector<ContactPoint> found;
        world->readContacts(found);
        return found;
    }
    const adapter::LedgerEntry* ledgerLine(const std::string& topic) {
        ledger_ = world->ledger();
        for (const auto& line : ledger_)
            if (line.topic == topic) return &line;
        return nullptr;
    }

    std::unique_ptr<adapter::World> world;

  private:
    double dt_;
    std::size_t count_;
    std::vector<adapter::LedgerEntry> ledger_;
};

}  // namespace rigor::test
