// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box2D as an engine: its identity, its features, and its option keys.
#include "adapters/box2d/broadphase.hpp"
#include "adapters/box2d/collision.hpp"
#include "adapters/box2d/world.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/interface/replay.hpp"

namespace rigor::box2d {
namespace {

using adapter::choice;
using adapter::integer;
using adapter::number;
using adapter::Option;

class Box2dEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override {
        const std::string version = std::to_string(b2_version.major) + "." +
                                    std::to_string(b2_version.minor) + "." +
                                    std::to_string(b2_version.revision);
        const std::string package = RIGOR_BOX2D_PACKAGE;
        return {"box2d", version,      sizeof(b2Vec2) == 2 * sizeof(float) ? "f32" : "f64",
                "Box2D", "asserts on", package == version ? "" : package};
    }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = c.broadPhase = true;
        c.dimensions = {2};
        c.shapes = {"circle", "box", "capsule", "polygon", "half_plane", "segment", "chain"};
        c.joints = {"ball",           "ball.break",     "hinge",           "hinge.limit",  "hinge.motor",
                    "hinge.spring",   "hinge.break",    "slider",          "slider.limit", "slider.motor",
                    "slider.spring",  "slider.break",   "fixed",           "fixed.break",  "distance",
                    "distance.limit", "distance.break", "distance.spring", "wheel",        "wheel.limit",
                    "wheel.motor",    "wheel.spring",   "wheel.break",     "six_dof",      "six_dof.limit",
                    "six_dof.motor",  "six_dof.spring", "six_dof.break"};
        c.contactImpulses = c.signedDistance = c.surfaceVelocity = true;
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"3D", kTwoDimensions},
            {"distance.motor", "b2_distance_joint.h, b2DistanceJointDef: length, bounds and spring"},
            {"rolling_friction", "b2_fixture.h, b2FixtureDef: friction and restitution, none of rolling"},
            {"static_friction", "b2_fixture.h, b2FixtureDef::friction: the one coefficient of friction"}};
        return c;
    }

    std::vector<Option> options() const override {
        return {
            integer("velocity_iterations", 1, 100000, "8", "50", "velocity iterations per step"),
            integer("position_iterations", 0, 100000, "3", "10", "position iterations per step"),
            number("scale", 0.01, 1000, "1", "4",
                   "Box2D lengths per metre: its tolerances shrink and its speed limit falls with it"),
            choice("skin", {"library", "least"}, "library", "least",
                   "rounding around shapes; least: true surfaces touch at rest"),
            choice("restitution", {"library", "corrected"}, "library", "corrected",
                   "corrected: bounces exactly e times the approach speed"),
            number("restitution_threshold", 0, 1e9, "1", "0", "no bounce below this speed [m/s]"),
            choice("warm_starting", {"on", "off"}, "on", "on", "start from the last impulses"),
            choice("continuous", {"on", "off"}, "on", "off", "time-of-impact handling of fast bodies"),
            choice("sleeping", {"on", "off"}, "on", "off", "bodies at rest are stopped and skipped"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }
    const adapter::BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "box2d");
        return std::make_unique<adapter::ReplayWorld>(
            [=] { return std::make_unique<Box2dWorld>(scenario, dt, settings); });
    }

  private:
    Box2dCollisionEngine collision_;
    Box2dBroadPhaseEngine broadPhase_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    return std::make_unique<Box2dEngine>();
}

}  // namespace
}  // namespace rigor::box2d

RIGOR_ADAPTER_MODULE(rigor::box2d::createEngine)
