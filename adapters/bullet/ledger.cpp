// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what Bullet really does. Numbers are of this build's world; reasons
// are measured properties of Bullet 3.24.
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include <algorithm>

#include "adapters/bullet/world.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::bullet {

using adapter::LedgerEntry;
using adapter::numberSetting;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> BulletWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto setting = [&](const char* key) { return adapter::textSetting(settings_, key); };
    const btContactSolverInfo& info = world_->getSolverInfo();

    add("precision", "f64", sizeof(btScalar) == sizeof(double) ? "f64" : "f32",
        sizeof(btScalar) == sizeof(double) ? Realisation::Exact : Realisation::Approximate,
        sizeof(btScalar) == sizeof(double) ? "" : "this build of the library computes in single precision");
    add("integrator", "symplectic_euler", "symplectic_euler");
    add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    add("solver", setting("solver"),
        setting("solver") + ", " + std::to_string(info.m_numIterations) + " iterations");
    if (mlcpSolver_ != nullptr && mlcpSolver_->getNumFallbacks() > 0)
        add("solver_fallback", setting("solver"),
            "sequential impulses in " + std::to_string(mlcpSolver_->getNumFallbacks()) + " solves",
            Realisation::Approximate, "the direct solver failed there and Bullet fell back");
    add("warm_starting", setting("warm_starting"), shown(info.m_warmstartingFactor));
    const bool pyramid = (info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) != 0;
    add("friction_law", "coulomb cone, pair coefficient",
        pyramid ? "two rows, each within mu N" : "one row within mu N", Realisation::Approximate,
        pyramid ? "a square pyramid, turned so that one axis follows the sliding velocity"
                : "along the sliding velocity; where nothing slides, one fixed tangent alone is held");
    add("friction_pair", "pair table", "written into each contact point");
    const auto examples = pairs_.examples();
    const auto has = [&](double scenario::PairCoefficients::*coefficient) {
        return std::any_of(examples.begin(), examples.end(), [&](const adapter::PairTable::Example& m) {
            return pairs_.coefficients(m.materialA, m.materialB).*coefficient > 0.0;
        });
    };
    for (const auto& [name, coefficient] :
         {std::pair("rolling_friction", &scenario::PairCoefficients::rollingFriction),
          std::pair("torsional_friction", &scenario::PairCoefficients::torsionalFriction)})
        if (has(coefficient))
            add(name, "moment up to the coefficient times the normal impulse",
                "row by row, up to the coefficient times the normal impulse and 1 N s",
                Realisation::Approximate,
                "Bullet bounds the moment by the coefficient alone where the impulse of a step is above 1 N "
                "s");
    add("restitution", "pair coefficient, no threshold",
        "pair coefficient, none below " + shown(info.m_restitutionVelocityThreshold) + " m/s",
        info.m_restitutionVelocityThreshold > 0 ? Realisation::Approximate : Realisation::Exact,
        info.m_restitutionVelocityThreshold > 0 ? "Bullet's velocity threshold" : "");
    const bool speculative = is("speculative_contacts", "on");
    add("speculative_contacts", "none",
        speculative ? "within the contact breaking distance" : "0 for bodies that bounce, else within 1e-4 m",
        speculative ? Realisation::Approximate : Realisation::Exact,
        speculative ? "a contact still apart takes gap/dt off the approach, and off the rebound" : "");
    const bool allSplit = is("split_impulse", "on") && info.m_splitImpulsePenetrationThreshold > 1e6;
    add("position_correction", "no change of velocity",
        allSplit ? "split impulses, ERP " + shown(info.m_erp2)
                 : "Baumgarte velocity for shallow contacts, split impulses below " +
                       setting("split_impulse_threshold") + " m",
        allSplit ? Realisation::Exact : Realisation::Approximate,
        allSplit ? "" : "the correction adds energy to shallow impacts");
    add("joint_error_reduction", "rigid", "ERP " + setting("erp"),
        scenario_.joints.empty() ? Realisation::Exact : Realisation::Approximate,
        scenario_.joints.empty() ? "" : "drift is corrected through velocities");
    appendJointLedger(lines);
    add("sleeping", "off", is("sleeping", "on") ? "on: below 0.8 m/s and 1 rad/s for 2 s" : "off",
        is("sleeping", "on") ? Realisation::Approximate : Realisation::Exact,
        is("sleeping", "on") ? "Bullet sets the velocity of slow bodies to zero, even in free space" : "");
    appendGeometryLedger(lines);
    return lines;
}

void BulletWorld::appendJointLedger(std::vector<LedgerEntry>& lines) const {
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto setting = [&](const char* key) { return adapter::textSetting(settings_, key); };
    bool sprung = false, dampers = false, breaking = false, angles = false, cones = false, hinges = false;
    for (const scenario::Joint& joint : scenario_.joints) {
        const auto limited = [&](std::size_t k) { return joint.axes[k].mode == scenario::AxisMode::Limited; };
        for (const auto& axis : joint.axes) {
            const bool damper = axis.stiffness == 0.0 && axis.hasSpring();
            sprung = sprung || (axis.hasSpring() && !damper);
            dampers = dampers || damper;
        }
        breaking = breaking || joint.breakForce < 1e299 || joint.breakTorque < 1e299;
        if (joint.type == scenario::JointType::SixDof) {
            int turns = 0;
            for (std::size_t k = 3; k < 6; ++k)
                turns += joint.axes[k].mode == scenario::AxisMode::Free || limited(k) ? 1 : 0;
            angles = angles || turns > 1;
        }
        cones = cones || joint.type == scenario::JointType::ConeTwist;
        hinges = hinges || joint.type == scenario::JointType::Hinge;
    }
    if (articulations_) {
        const std::string damping = setting("multibody_damping");
        const bool damped = numberSetting(settings_, "multibody_damping") > 0.0;
        add("articulation", "rigid joints",
            "btMultiBody, " + std::to_string(articulations_->loops()) + " loops closed by constraints");
        add("multibody_damping", "0", damping, damped ? Realisation::Approximate : Realisation::Exact,
            damped ? "a force against the motion that grows with its speed and its square" : "");
        add("multibody_integrator", "symplectic_euler", setting("multibody_integrator"),
            Realisation::Approximate,
            "forces of the velocities at the start of the step (explicit): fast spherical joints gain "
            "energy");
        if (sprung || dampers)
            add("joint_springs", "stiffness and damping of the coordinate",
                "torque of the start of the step (btMultiBody::addJointTorque)", Realisation::Approximate,
                "explicit in position and velocity: what swings or decays faster than 2/dt grows");
        return;
    }
    if (hinges)
        add("hinge_anchors", "each body's own",
            setting("frame_offset") == "off"
                ? "each body's own"
                : "weighted by the masses" + std::string(setting("frame_offset") == "on"
                                                             ? ""
                                                             : ", but for hinges to kinematic bodies"),
            setting("frame_offset") == "on" ? Realisation::Approximate : Realisation::Exact,
            setting("frame_offset") == "on" ? "a hinge to a turning kinematic body drifts (measured: 4 times "
                                              "farther at 1/60 s than with each body's own)"
                                            : "");
    if (sprung)
        add("joint_springs", "stiffness and damping of the coordinate",
            is("spring_limits", "on")
                ? "force of the start of the step, softened where it is stiff for the step"
                : "force of the start of the step",
            Realisation::Approximate,
            is("spring_limits", "on")
                ? "Bullet lowers a stiffness k above m / (16 dt^2) and a damping above m / dt; what other "
                  "forces of the step push the same way is taken off the spring's force"
                : "explicit in position and velocity; what other forces of the step push the same way is "
                  "taken off the spring's force");
    if (dampers)
        add("joint_dampers", "damping of the coordinate",
            "motor towards rest, at most damping times the speed of the start of the step",
            Realisation::Approximate,
            "explicit; Bullet's own damper (setDamping) loses what other forces of the step slow");
    if (breaking)
        add("breaking", "force and torque of a step",
            is("breaking", "feedback") ? "norms of the joint feedback's vectors" : "each row's impulse",
            is("breaking", "feedback") ? Realisation::Exact : Realisation::Approximate,
            is("breaking", "feedback")
                ? ""
                : "along each axis of the joint by itself, torques by the same number");
    if (angles)
        add("six_dof_angles", "twist and swing", "Euler angles", Realisation::Approximate,
            "equal where one turn alone is free, else from the second order on different");
    if (cones)
        add("cone_twist_limits", "stops without rebound", "btConeTwistConstraint, bias 0.3, relaxation 1",
            Realisation::Approximate,
            "a twist stop gives back 0.3 of the speed; relaxation 0 would lift the limits");
}

void BulletWorld::appendGeometryLedger(std::vector<LedgerEntry>& lines) const {
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto setting = [&](const char* key) { return adapter::textSetting(settings_, key); };
    const ShapeSettings shapes = shapeSettings();
    if (adapter::hasCollidingShape<scenario::HalfSpace>(scenario_)) {
        if (shapes.halfSpaceAsBox)
            add("half_space", "unbounded",
                "box of half extents " + shown(shapes.halfSpaceReach) + " x " + shown(kHalfSpaceDepth) +
                    " x " + shown(shapes.halfSpaceReach) + " m below the bodies' middle",
                Realisation::Approximate,
                "a plane gives polyhedra one point per step; the box ends somewhere");
        else
            add("half_space", "unbounded", "btStaticPlaneShape", Realisation::Approximate,
                "a polyhedron gets one new contact point per step and turns at a flat impact");
    }
    const auto addMargin = [&](const char* topic, double margin, const char* effect) {
        add(topic, "0", shown(margin) + " m", margin > 0.0 ? Realisation::Approximate : Realisation::Exact,
            margin > 0.0 ? effect : "");
    };
    if (adapter::hasCollidingShape<scenario::Box>(scenario_))
        addMargin("box_margin", shapes.boxMargin, "rounds edges against spheres, capsules, cylinders (GJK)");
    if (adapter::hasCollidingShape<scenario::Cylinder>(scenario_))
        addMargin("cylinder_margin", shapes.cylinderMargin,
                  "rounds rims (GJK); 0 would leave flat contacts to EPA");
    if (adapter::hasCollidingShape<scenario::ConvexHull, scenario::Cone>(scenario_))
        addMargin("hull_margin", shapes.hullMargin,
                  "hulls and cones are grown outwards: what touches at the start overlaps by the margin, two "
                  "hulls by twice that");
    if (adapter::hasCollidingShape<scenario::ConvexHull>(scenario_))
        add("hull_contacts", "full manifold",
            shapes.polyhedralFeatures ? "SAT and clipping with hulls and boxes"
                                      : "GJK/EPA, one point per step",
            Realisation::Approximate,
            shapes.polyhedralFeatures ? "edge-edge contacts are clipped as faces, and may read too deep"
                                      : "the manifold fills over several steps");
    if (adapter::hasCollidingShape<scenario::HeightField>(scenario_))
        add("height_field", "solid under the surface", "surface alone", Realisation::Approximate,
            "what gets below a triangle is pushed down");
    if (adapter::hasCollidingShape<scenario::HeightField, scenario::TriangleMesh>(scenario_))
        add("internal_edges", "do not catch", setting("internal_edges"),
            is("internal_edges", "on") ? Realisation::Exact : Realisation::Approximate,
            is("internal_edges", "on")
                ? ""
                : "each triangle meets a body by itself, edges between faces included");
    if (planar_) {
        add("planar", "two dimensions",
            "3D prisms of half depth 0.5 m, z translation and x, y rotation locked", Realisation::Approximate,
            "contacts are found on solids; each 2D contact is two at z = +-0.5 m");
    } else {
        const std::string& gyro = adapter::textSetting(settings_, "gyroscopic");
        add("gyroscopic_term", "exact rigid-body rotation", gyro, Realisation::Approximate,
            gyro == "none"       ? "angular velocity is constant without torque, whatever the inertia"
            : gyro == "external" ? "w := I(R1)^-1 I(R0) w after each step: momentum exact, energy first order"
                                 : "first order in dt, in energy and momentum");
    }
    add("angular_step_limit", "none",
        "exact below pi/4 rad per step (" + shown(0.7853981633974483 / dt_) + " rad/s)",
        Realisation::Approximate, "above it the exponential map's sine is clamped and the body turns less");
    const bool damped = std::any_of(
        scenario_.bodies.begin(), scenario_.bodies.end(),
        [](const scenario::Body& b) { return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0; });
    if (damped) add("damping", "v(t) = v0 kept^t", "v *= kept^dt, before the step's forces");
}

}  // namespace rigor::bullet
