// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chipmunk as an engine: its identity, its features, and its option keys.
#include "adapters/chipmunk/broadphase.hpp"
#include "adapters/chipmunk/collision.hpp"
#include "adapters/chipmunk/library.hpp"
#include "adapters/chipmunk/world.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/interface/replay.hpp"

namespace rigor::chipmunk {
namespace {

using adapter::choice;
using adapter::integer;
using adapter::number;
using adapter::Option;

class ChipmunkEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override {
        return {"chipmunk", cpVersionString, sizeof(cpFloat) == sizeof(double) ? "f64" : "f32", "Chipmunk2D",
                "asserts on"};
    }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = c.broadPhase = true;
        c.dimensions = {2};
        c.shapes = {"circle", "box", "capsule", "polygon", "half_plane", "segment", "chain"};
        c.joints = {"ball",           "ball.break",     "hinge",          "hinge.limit",
                    "hinge.motor",    "hinge.spring",   "hinge.break",    "slider",
                    "slider.limit",   "slider.spring",  "slider.break",   "fixed",
                    "fixed.break",    "distance",       "distance.limit", "distance.spring",
                    "distance.break", "wheel",          "wheel.limit",    "wheel.motor",
                    "wheel.spring",   "wheel.break",    "six_dof",        "six_dof.limit",
                    "six_dof.motor",  "six_dof.spring", "six_dof.break"};
        c.contactImpulses = c.surfaceVelocity = true;
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"3D", kTwoDimensions},
            {"slider.motor", "chipmunk/cpSimpleMotor.h: drives the relative angular velocity, the one motor"},
            {"distance.motor",
             "chipmunk/cpSimpleMotor.h: drives the relative angular velocity, the one motor"},
            {"rolling_friction", "chipmunk/cpShape.h: elasticity and friction, none of rolling"},
            {"static_friction", "chipmunk/cpShape.h, cpShapeSetFriction: the one coefficient of friction"}};
        return c;
    }

    std::vector<Option> options() const override {
        return {
            integer("iterations", 1, 100000, "10", "100", "iterations of the solver per step"),
            number("slop", 0, 10, "0.1", "0.0005", "overlap that is not corrected [m]"),
            number("bias", 0, 1, "0.0017970102999144", "0.0017970102999144",
                   "part of the overlap that is left after a second; Chipmunk's is 0.9^60"),
            choice(
                "positions", {"first", "last"}, "first", "last",
                "bodies move before contacts are found, as in cpSpaceStep, or after velocities are solved"),
            choice("space", {"bb_tree", "spatial_hash"}, "bb_tree", "bb_tree", "broad phase"),
            number("hash_cell", 1e-3, 1e6, "1", "1", "cell of the spatial hash [m]"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }
    const adapter::BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "chipmunk");
        return std::make_unique<adapter::ReplayWorld>(
            [=] { return std::make_unique<ChipmunkWorld>(scenario, dt, settings); });
    }

  private:
    ChipmunkCollisionEngine collision_;
    ChipmunkBroadPhaseEngine broadPhase_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    useLibrary();
    return std::make_unique<ChipmunkEngine>();
}

}  // namespace
}  // namespace rigor::chipmunk

RIGOR_ADAPTER_MODULE(rigor::chipmunk::createEngine)
