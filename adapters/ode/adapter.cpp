// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The Open Dynamics Engine: its identity, its features, and its option keys.
#include <ode/ode.h>

#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/ode/broadphase.hpp"
#include "adapters/ode/collision.hpp"
#include "adapters/ode/library.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {
namespace {

using adapter::choice;
using adapter::integer;
using adapter::number;
using adapter::Option;

const char* libraryPrecision() {
    return dCheckConfiguration("ODE_double_precision") != 0 ? "f64" : "f32";
}
constexpr const char* kHeaderPrecision = sizeof(dReal) == sizeof(double) ? "f64" : "f32";

class OdeEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override {
        return {"ode", dODE_VERSION, libraryPrecision(), "Open Dynamics Engine", dGetConfiguration()};
    }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = c.broadPhase = true;
        c.dimensions = {3};
        c.planar = true;
        c.shapes = {"sphere",     "box",           "capsule",      "cylinder", "hull",
                    "half_space", "triangle_mesh", "height_field", "circle",   "polygon",
                    "half_plane", "segment",       "chain"};
        c.joints = {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_dof", "wheel"};
        for (const char* joint : {"ball", "hinge", "slider", "cone_twist", "distance", "six_dof", "wheel"})
            for (const char* what : {".limit", ".motor", ".spring"})
                c.joints.push_back(joint + std::string(what));
        for (const char* joint :
             {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_dof", "wheel"})
            c.joints.push_back(joint + std::string(".break"));
        c.contactImpulses = c.rollingFriction = c.torsionalFriction = c.surfaceVelocity = true;
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"ellipsoid", "ode/collision.h, geom class numbers: none is an ellipsoid"},
            {"cone", "ode/collision.h, geom class numbers: none is a cone"},
            {"static_friction", "ode/contact.h, dSurfaceParameters: mu, one coefficient in each direction"}};
        return c;
    }

    std::vector<Option> options() const override {
        return {
            choice("stepper", {"worldstep", "quickstep"}, "worldstep", "worldstep",
                   "direct Dantzig LCP, or projected Gauss-Seidel with over-relaxation"),
            integer("iterations", 1, 1000000, "20", "200", "QuickStep iterations"),
            number("sor", 0.1, 2.0, "1.3", "1.3", "QuickStep over-relaxation"),
            integer("worldstep_limit", 0, 1000000, "160", "160",
                    "a step with more contacts than this is done by QuickStep; 0: never"),
            number("erp", 0, 1, "0.2", "0.2", "error reduction of contacts and joints per step"),
            number("cfm", 1e-15, 1, "1e-10", "1e-10", "constraint force mixing; 0 would be singular"),
            number("contact_cfm", 0, 1, "0", "3e-6",
                   "of the normals of contacts that do not bounce; 0: that of everything else"),
            number("max_correcting_velocity", 0, 1e30, "1e30", "0.1",
                   "fastest push out of penetration [m/s]; 1e30: none"),
            number("surface_layer", 0, 1, "0", "0", "penetration left uncorrected [m]"),
            choice("friction", {"pyramid_world", "pyramid_velocity"}, "pyramid_world", "pyramid_velocity",
                   "axes of the friction square: fixed by the normal, or along the predicted sliding"),
            number("bounce_threshold", 0, 1e9, "0", "0", "no bounce below this speed [m/s]"),
            choice("gyroscopic", {"none", "ode", "external"}, "ode", "ode",
                   "gyroscopic torque; external: outside of ODE, keeping the angular momentum"),
            choice("rotation", {"infinitesimal", "finite"}, "infinitesimal", "finite",
                   "orientation update: first order and normalised, or exact for constant velocity"),
            integer("max_contacts", 1, 64, "8", "4", "points kept per pair of shapes"),
            number(
                "ball_merge_deg", 0, 90, "0", "5",
                "points of a ball on triangles whose normals differ by less are one, the deepest; 0: none"),
            choice("space", {"simple", "hash", "sap", "quadtree"}, "hash", "hash", "broad phase"),
            integer("seed", 0, 2147483647, "1", "1", "of QuickStep's row order, set before each step"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }
    const adapter::BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "ode");
        return std::make_unique<OdeWorld>(scenario, dt, settings);
    }

  private:
    OdeCollisionEngine collision_;
    OdeBroadPhaseEngine broadPhase_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    useLibrary();
    if (std::string(libraryPrecision()) != kHeaderPrecision)
        throw std::runtime_error(std::string("ode: the library is ") + libraryPrecision() +
                                 ", its headers were compiled for " + kHeaderPrecision);
    return std::make_unique<OdeEngine>();
}

}  // namespace
}  // namespace rigor::ode

RIGOR_ADAPTER_MODULE(rigor::ode::createEngine)
