// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MuJoCo as an engine: its identity, its features, and its option keys.
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/mujoco/collision.hpp"
#include "adapters/mujoco/geoms.hpp"
#include "adapters/mujoco/library.hpp"
#include "adapters/mujoco/mjcf.hpp"
#include "adapters/mujoco/world.hpp"

namespace rigor::mujoco {
namespace {

using adapter::choice;
using adapter::integer;
using adapter::number;
using adapter::Option;

class MujocoEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override {
        return {"mujoco", mj_versionString(), sizeof(mjtNum) == sizeof(double) ? "f64" : "f32", "MuJoCo", ""};
    }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = true;
        c.dimensions = {3};
        c.planar = true;
        c.shapes = {"sphere",       "box",       "capsule", "cylinder", "hull",      "half_space",
                    "height_field", "ellipsoid", "circle",  "polygon",  "half_plane"};
        c.joints = {"ball",
                    "hinge",
                    "hinge.limit",
                    "hinge.motor",
                    "hinge.spring",
                    "slider",
                    "slider.limit",
                    "slider.motor",
                    "slider.spring",
                    "fixed",
                    "distance",
                    "distance.limit",
                    "distance.spring",
                    "wheel",
                    "wheel.limit",
                    "wheel.motor",
                    "wheel.spring",
                    "six_dof",
                    "six_dof.limit",
                    "six_dof.motor",
                    "six_dof.spring",
                    "ball.limit",
                    "cone_twist",
                    "cone_twist.limit",
                    "cone_twist.motor",
                    "distance.motor",
                    "ball.break",
                    "hinge.break",
                    "fixed.break",
                    "distance.break"};
        c.contactImpulses = c.rollingFriction = c.torsionalFriction = true;
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"ball.spring", kWholeRotation},
            {"cone_twist.spring", kWholeRotation},
            {"slider.break", kEqualities},
            {"wheel.break", kEqualities},
            {"six_dof.break", kEqualities},
            {"cone_twist.break", kEqualities},
            {"cone", kGeomTypes},
            {"segment", kGeomTypes},
            {"chain", kGeomTypes},
            {"triangle_mesh", kConvexMeshes},
            {"static_friction", "mujoco/mjmodel.h, geom_friction: slide, spin, roll, one coefficient each"},
            {"surface_velocity",
             "mujoco/mjdata.h, mjContact: no velocity of a surface among its parameters"}};
        return c;
    }

    std::vector<Option> options() const override {
        return {
            choice("solver", {"pgs", "cg", "newton"}, "newton", "newton", "solver of the constraints"),
            integer("iterations", 1, 100000, "100", "200", "most iterations of the solver"),
            number("tolerance", 0, 1, "1e-8", "1e-12", "improvement at which the solver ends"),
            integer("noslip_iterations", 0, 100000, "0", "0",
                    "iterations that take the slip of friction away"),
            choice("cone", {"pyramidal", "elliptic"}, "pyramidal", "elliptic", "cone of friction"),
            number("impratio", 1e-3, 1e6, "1", "100", "impedance of friction over that of normals"),
            choice("integrator", {"euler", "rk4", "implicit"}, "euler", "euler", "scheme of a step"),
            choice("jacobian", {"dense", "sparse", "auto"}, "auto", "auto",
                   "form of the constraints' Jacobian"),
            choice("warm_starting", {"on", "off"}, "on", "on", "start from the last accelerations"),
            number(
                "solref_time", 0, 1e3, "0.02", "0",
                "time constant of contacts, stops and loops [s]; 0: two steps, the least that MuJoCo takes"),
            number("solref_damping", 1e-3, 1e3, "1", "3", "their damping ratio; of loops and rods at most 1"),
            number("solimp_min", 1e-4, 0.9999, "0.9", "0.999", "impedance at no overlap"),
            number("solimp_max", 1e-4, 0.9999, "0.95", "0.999", "impedance at an overlap of 1 mm"),
            choice("restitution", {"spring", "none"}, "spring", "spring",
                   "of pairs that bounce: a damped spring, or nothing"),
            number("bounce_steps", 1, 1000, "10", "20", "steps that a bounce takes"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "mujoco");
        return std::make_unique<MujocoWorld>(scenario, dt, settings);
    }

  private:
    MujocoCollisionEngine collision_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    useLibrary();
    if (mj_version() != mjVERSION_HEADER)
        throw std::runtime_error(std::string("mujoco: the library is ") + mj_versionString() +
                                 ", another than that of the headers it was compiled with");
    return std::make_unique<MujocoEngine>();
}

}  // namespace
}  // namespace rigor::mujoco

RIGOR_ADAPTER_MODULE(rigor::mujoco::createEngine)
