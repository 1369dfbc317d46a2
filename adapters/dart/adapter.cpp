// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// DART as an engine: its identity, its features, and its option keys.
#include <dart/config.hpp>

#include "adapters/dart/collision.hpp"
#include "adapters/dart/world.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::dart_adapter {
namespace {

using adapter::choice;
using adapter::integer;
using adapter::number;
using adapter::Option;

constexpr const char* kConstraints = "dart/constraint: BallJointConstraint and WeldJointConstraint";
constexpr const char* kLimits = "dart/dynamics/Joint.hpp, setPositionLowerLimit: of single coordinates";

constexpr const char* kCones =
    "message of OdeCollisionDetector: unsupported shape type 'ConeShape'; with FCL cones are not found";

class DartEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override { return {"dart", DART_VERSION, "f64", "DART", ""}; }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = true;
        c.dimensions = {3};
        c.planar = true;
        c.shapes = {"sphere",  "box",        "capsule",       "cylinder",     "ellipsoid",
                    "hull",    "half_space", "triangle_mesh", "height_field", "circle",
                    "polygon", "half_plane", "segment",       "chain"};
        c.joints = {"ball",          "ball.spring",   "ball.break",   "hinge",       "hinge.limit",
                    "hinge.motor",   "hinge.spring",  "hinge.break",  "slider",      "slider.limit",
                    "slider.motor",  "slider.spring", "fixed",        "fixed.break", "wheel",
                    "wheel.limit",   "wheel.motor",   "wheel.spring", "six_dof",     "six_dof.limit",
                    "six_dof.motor", "six_dof.spring"};
        c.contactImpulses = true;
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"distance", kConstraints},
            {"distance.limit", kConstraints},
            {"distance.motor", kConstraints},
            {"distance.spring", kConstraints},
            {"distance.break", kConstraints},
            {"ball.limit", kLimits},
            {"cone_twist", kLimits},
            {"slider.break", kConstraints},
            {"wheel.break", kConstraints},
            {"six_dof.break", kConstraints},
            {"cone", kCones},
            {"static_friction", "dart/dynamics/ShapeFrame.hpp, DynamicsAspectProperties: one coefficient"},
            {"rolling_friction", "dart/dynamics/ShapeFrame.hpp, DynamicsAspectProperties: none of rolling"},
            {"torsional_friction", "dart/dynamics/ShapeFrame.hpp, DynamicsAspectProperties: none of rolling"},
            {"surface_velocity",
             "dart/dynamics/ShapeFrame.hpp, DynamicsAspectProperties: none of a surface"}};
        return c;
    }

    std::vector<Option> options() const override {
        return {
            choice("solver", {"dantzig", "pgs"}, "dantzig", "dantzig", "solver of the boxed problem"),
            integer("pgs_iterations", 1, 100000, "30", "200", "sweeps of projected Gauss-Seidel"),
            choice("narrow_phase", {"fcl_mesh", "fcl_primitive", "dart", "ode"}, "fcl_mesh", "ode",
                   "how contacts are found"),
            integer("max_contacts", 1, 1e6, "1000", "100000", "most contacts of a step"),
            number("contact_erp", 0, 1, "0.01", "0.2", "part of an overlap that a step takes away"),
            number("contact_max_speed", 0, 1e6, "0.001", "1", "most speed of that [m/s]"),
            number("contact_cfm", 1e-9, 1, "1e-5", "1e-5", "part of the diagonal that is added to it"),
            number("joint_erp", 0, 1, "0.01", "0.2", "the same of joints' stops and loops"),
            number("joint_max_speed", 0, 1e6, "10", "100", "most speed of that [m/s] or [rad/s]"),
            number("joint_cfm", 1e-9, 1, "1e-9", "1e-9", "part of the diagonal that is added to it"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "dart");
        return std::make_unique<DartWorld>(scenario, dt, settings);
    }

  private:
    DartCollisionEngine collision_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    return std::make_unique<DartEngine>();
}

}  // namespace
}  // namespace rigor::dart_adapter

RIGOR_ADAPTER_MODULE(rigor::dart_adapter::createEngine)
