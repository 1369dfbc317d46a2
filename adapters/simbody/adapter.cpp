// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Simbody as an engine: its identity, its features, and its option keys.
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/interface/presets.hpp"
#include "adapters/simbody/integrators.hpp"
#include "adapters/simbody/world.hpp"

namespace rigor::simbody {
namespace {

using adapter::choice;
using adapter::number;
using adapter::Option;

constexpr const char* kContacts =
    "simbody/internal/CompliantContactSubsystem.h: contacts are compliant; ConditionalConstraint.h, "
    "UnilateralContact: rigid ones are experimental and for SemiExplicitEulerTimeStepper alone";
constexpr const char* kStops =
    "simbody/internal/Force_MobilityLinearStop.h: a stop is a spring; ConditionalConstraint.h, "
    "HardStopUpper: "
    "rigid ones are experimental and for SemiExplicitEulerTimeStepper alone";

std::string version() {
    char text[64] = "";
    SimTK_about_simbody("version", sizeof(text), text);
    return text;
}

class SimbodyEngine final : public adapter::EngineWithPresets, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override { return {"simbody", version(), "f64", "Simbody", ""}; }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = true;
        c.dimensions = {3};
        c.planar = true;
        c.joints = {"ball.spring"};
        for (const char* joint :
             {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "wheel", "six_dof"}) {
            c.joints.push_back(joint);
            c.joints.push_back(joint + std::string(".break"));
        }
        for (const char* joint : {"hinge", "slider", "distance", "cone_twist", "wheel", "six_dof"})
            for (const char* what : {".motor", ".spring"}) c.joints.push_back(joint + std::string(what));
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        for (const char* shape :
             {"sphere", "box", "capsule", "cylinder", "cone", "ellipsoid", "hull", "half_space",
              "triangle_mesh", "height_field", "circle", "polygon", "half_plane", "segment", "chain"})
            c.libraryLacks[shape] = kContacts;
        for (const char* joint : {"ball", "hinge", "slider", "distance", "cone_twist", "wheel", "six_dof"})
            c.libraryLacks[std::string(joint) + ".limit"] = kStops;
        return c;
    }

    std::vector<Option> options() const override {
        return {
            choice("integrator", integratorNames(), "runge_kutta_merson", "runge_kutta_merson",
                   "how the equations of motion are integrated"),
            choice("step", {"error_controlled", "fixed"}, "error_controlled", "fixed",
                   "whether the integrator chooses its steps by their errors, or takes the case's"),
            number("accuracy", 1e-14, 1, "1e-3", "1e-3", "error that a step may have where it is controlled"),
            number("constraint_tolerance", 1e-15, 1, "1e-4", "1e-10",
                   "error of constraints above which they are projected [m] or [rad]"),
            choice("projection", {"tolerance", "every_step"}, "tolerance", "tolerance",
                   "whether constraints are projected above their tolerance or always"),
        };
    }

    std::vector<adapter::Preset> presets() const override {
        return {{"reference",
                 {{"step", "error_controlled"}, {"accuracy", "1e-10"}, {"constraint_tolerance", "1e-12"}}}};
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "simbody");
        return std::make_unique<SimbodyWorld>(scenario, dt, settings);
    }
};

std::unique_ptr<adapter::Engine> createEngine() {
    return std::make_unique<SimbodyEngine>();
}

}  // namespace
}  // namespace rigor::simbody

RIGOR_ADAPTER_MODULE(rigor::simbody::createEngine)
