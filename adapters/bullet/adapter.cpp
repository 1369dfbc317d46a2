// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bullet Physics as an engine: its identity, its features, and its option keys.
#include <btBulletDynamicsCommon.h>

#include "adapters/bullet/broadphase.hpp"
#include "adapters/bullet/collision.hpp"
#include "adapters/bullet/contact_solver.hpp"
#include "adapters/bullet/world.hpp"
#include "adapters/interface/input_check.hpp"
#include "adapters/interface/options.hpp"
#include "adapters/interface/replay.hpp"

namespace rigor::bullet {
namespace {

using adapter::choice;
using adapter::number;
using adapter::Option;

/// "f32" or "f64" as the loaded library stores its bodies: the size is computed inside the library.
std::string libraryPrecision() {
    btEmptyShape shape;
    const btRigidBody body(btScalar(0.0), nullptr, &shape);
    const int size = body.calculateSerializeBufferSize();
    if (size == static_cast<int>(sizeof(btRigidBodyDoubleData))) return "f64";
    if (size == static_cast<int>(sizeof(btRigidBodyFloatData))) return "f32";
    return "unknown";
}

constexpr const char* kHeaderPrecision = sizeof(btScalar) == sizeof(double) ? "f64" : "f32";

class BulletEngine final : public adapter::Engine, public adapter::DynamicsEngine {
  public:
    adapter::EngineInfo info() const override {
        const int version = btGetVersion();
        const int minor = version % 100;
        return {"bullet",
                std::to_string(version / 100) + "." + (minor < 10 ? "0" : "") + std::to_string(minor),
                libraryPrecision(), "Bullet Physics",
                std::string("btScalar ") + kHeaderPrecision + ", asserts off"};
    }

    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dynamics = c.collision = c.broadPhase = true;
        c.dimensions = {3};
        c.planar = true;
        c.shapes = {"sphere", "box",     "capsule",    "cylinder",      "cone",         "hull",  "half_space",
                    "circle", "polygon", "half_plane", "triangle_mesh", "height_field", "chain", "segment"};
        c.joints = {"ball", "ball.limit", "ball.spring", "fixed"};
        for (const char* type : {"cone_twist", "hinge", "slider", "six_dof", "wheel"}) {
            c.joints.push_back(type);
            for (const char* feature : {".limit", ".motor", ".spring"})
                c.joints.push_back(std::string(type) + feature);
        }
        for (const char* type : {"ball", "cone_twist", "fixed", "hinge", "slider", "six_dof", "wheel"})
            c.joints.push_back(std::string(type) + ".break");
        c.contactImpulses = c.signedDistance = c.contactSolvers = true;
        c.queryOptions = {"sat", "box_margin", "cylinder_margin", "hull_margin", "query_path"};
        c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
        c.rollingFriction = c.torsionalFriction = c.surfaceVelocity = true;
        c.contactFilters = c.shapeFilters = true;
        c.libraryLacks = {
            {"ellipsoid", "btBroadphaseProxy.h, enum BroadphaseNativeTypes: none is an ellipsoid"},
            {"distance", "btTypedConstraint.h, enum btTypedConstraintType: none keeps a distance"},
            {"static_friction", "btCollisionObject.h, setFriction: the one coefficient of sliding"}};
        return c;
    }

    std::vector<Option> options() const override {
        Option iterations = number("iterations", 1, 100000, "10", "100", "velocity iterations per step");
        iterations.integer = true;
        return {
            choice("solver", {"si", "nncg", "mlcp_dantzig", "mlcp_pgs", "mlcp_lemke"}, "si", "si",
                   "constraint solver"),
            iterations,
            choice("friction_directions", {"1", "2"}, "1", "2",
                   "friction rows per contact; with 1 an impact without sliding has no friction along x"),
            choice("friction_axis", {"velocity", "fixed"}, "velocity", "velocity",
                   "first friction row along the sliding velocity, or along fixed axes of the normal"),
            choice("split_impulse", {"on", "off"}, "on", "on",
                   "penetration goes to pseudo velocities instead of velocities"),
            number("split_impulse_threshold", -1e9, 1e9, "-0.04", "1e9",
                   "penetrations deeper than this are split [m, negative inside]; 1e9: all"),
            number("restitution_threshold", 0, 1e9, "0.2", "0", "no bounce below this speed [m/s]"),
            number("warm_starting", 0, 1, "0.85", "0.85", "part of the last impulses to start from; 0: none"),
            choice("speculative_contacts", {"on", "by_restitution"}, "on", "by_restitution",
                   "solve contacts that are still apart; by_restitution: none for bodies that bounce, 1e-4 m "
                   "for others"),
            choice("gyroscopic", {"none", "explicit", "implicit_body", "implicit_world", "external"},
                   "implicit_body", "implicit_body",
                   "gyroscopic torque; external: after each step, keeping the angular momentum"),
            choice("sat", {"on", "off"}, "off", "on",
                   "separating-axis test and clipping between hulls and boxes"),
            number("box_margin", 0, 0.04, "0.04", "0", "of boxes, inside the shape [m]"),
            number("cylinder_margin", 0, 0.04, "0.04", "0.04", "of cylinders, inside the shape [m]"),
            number("hull_margin", 0, 0.04, "0.04", "0", "of hulls and cones; grows hulls [m]"),
            choice(
                "query_path", {"stepping", "contact_pair_test"}, "stepping", "stepping",
                "of collision queries alone: as a step finds contacts, or btCollisionWorld::contactPairTest"),
            choice("half_space", {"plane", "box"}, "plane", "box",
                   "half-spaces as btStaticPlaneShape, or as a large box with full manifolds"),
            choice("articulation", {"maximal", "multibody"}, "maximal", "maximal",
                   "bodies on joints as rigid bodies with constraints, or as links of btMultiBody "
                   "(Featherstone)"),
            choice("multibody_integrator", {"euler", "rk4"}, "euler", "euler",
                   "of btMultiBody; rk4 is btMultiBody::useRK4Integration"),
            number("multibody_damping", 0, 1, "0.04", "0",
                   "of btMultiBody: linear and angular, grows with the speed"),
            number("multibody_velocity_limit", 1, 1e9, "100", "1e9",
                   "of btMultiBody: no coordinate goes faster [m/s or rad/s]"),
            choice("internal_edges", {"on", "off"}, "off", "on",
                   "contacts with inner edges of triangle meshes and height fields take the face's normal "
                   "(btGenerateInternalEdgeInfo)"),
            choice("frame_offset", {"on", "off", "by_body"}, "on", "by_body",
                   "of hinges: anchors weighted by the bodies' masses (setUseFrameOffset); by_body: but for "
                   "hinges to kinematic bodies"),
            choice("spring_limits", {"on", "off"}, "on", "off",
                   "springs of joints are softened where they are stiff for the step, dampers likewise"),
            choice("breaking", {"impulse_threshold", "feedback"}, "impulse_threshold", "feedback",
                   "joints with a break force alone: by Bullet's threshold on each row's impulse, or by the "
                   "force that its joint feedback reports; with a break torque always the latter"),
            choice("broadphase", {"dbvt", "axis_sweep_3", "simple"}, "dbvt", "dbvt", "broad phase"),
            choice("sleeping", {"on", "off"}, "on", "off", "bodies at rest are stopped and skipped"),
            number("erp", 0, 1, "0.2", "0.2", "error reduction of joints per step"),
            number("contact_erp", 0, 1, "0.2", "0.2", "error reduction of contacts per step"),
            number("cfm", 0, 1, "0", "0", "global constraint force mixing"),
            number("linear_slop", 0, 1, "0", "0", "penetration left uncorrected [m]"),
        };
    }

    const adapter::DynamicsEngine* dynamics() const override { return this; }
    const adapter::CollisionEngine* collision() const override { return &collision_; }
    const adapter::BroadPhaseEngine* broadPhase() const override { return &broadPhase_; }
    const adapter::ContactSolverEngine* contactSolvers() const override { return &contactSolvers_; }

    std::unique_ptr<adapter::World> build(const adapter::Scenario& scenario, double dt,
                                          const adapter::Settings& settings) const override {
        adapter::checkScenarioInput(scenario, dt);
        adapter::checkSupported(scenario, capabilities(), "bullet");
        // Bullet takes a step no longer than its scalar's epsilon for no step at all.
        if (static_cast<btScalar>(dt) <= 2 * SIMD_EPSILON)
            throw adapter::Unsupported("bullet's precision has no time step this small");
        return std::make_unique<adapter::ReplayWorld>(
            [=] { return std::make_unique<BulletWorld>(scenario, dt, settings); });
    }

  private:
    BulletCollisionEngine collision_;
    BulletBroadPhaseEngine broadPhase_;
    BulletContactSolvers contactSolvers_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    if (libraryPrecision() != kHeaderPrecision)
        throw std::runtime_error("bullet: the library holds " + libraryPrecision() +
                                 " scalars, its headers were compiled for " + kHeaderPrecision);
    return std::make_unique<BulletEngine>();
}

}  // namespace
}  // namespace rigor::bullet

RIGOR_ADAPTER_MODULE(rigor::bullet::createEngine)
