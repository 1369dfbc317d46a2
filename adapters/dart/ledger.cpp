// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what DART really does. Reasons are measured properties of DART 6.12.1.
#include <algorithm>

#include "adapters/dart/shapes.hpp"
#include "adapters/dart/swing.hpp"
#include "adapters/dart/world.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::dart_adapter {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> DartWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    // A line with a reason is approximate.
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         std::string reason = "") {
        const auto realisation = reason.empty() ? Realisation::Exact : Realisation::Approximate;
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto text = [&](const char* key) { return adapter::textSetting(settings_, key); };
    add("precision", "f64", "f64");
    add("integrator", "symplectic_euler", "semi-implicit Euler in reduced coordinates");
    add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    add("solver", text("solver"),
        is("solver", "dantzig") ? "Dantzig's method; where it fails, projected Gauss-Seidel"
                                : "projected Gauss-Seidel, at most " + text("pgs_iterations") + " sweeps");
    add("warm_starting", "on", "off", "DART begins every step from zero");
    const std::string phase = text("narrow_phase");
    add("narrow_phase", phase, phase);
    add("position_correction", "full",
        "ERP " + text("contact_erp") + ", at most " + text("contact_max_speed") +
            " m/s; joints' stops and loops " + text("joint_erp") + ", " + text("joint_max_speed"),
        "overlap is taken away by a part of it in each step, by a velocity");
    add("contact_softness", "rigid", "CFM " + text("contact_cfm"),
        "the diagonal of the problem is that much larger");
    add("friction_law", "coulomb cone, pair coefficient",
        "two directions, each bounded by mu times the normal",
        "the cone is a pyramid: along its edges friction is sqrt 2 of it");
    add("friction_pair", "pair table", "pair table, given to the two shapes of each contact");
    const auto examples = pairs_.examples();
    if (std::any_of(examples.begin(), examples.end(), [&](const auto& m) {
            return pairs_.coefficients(m.materialA, m.materialB).restitution > 0.0;
        }))
        add("restitution", "pair coefficient, no threshold", "pair coefficient above 0.1 m/s of rebound",
            "DART has a threshold of its own, and its velocity of approach has the step's gravity in it");
    if (phase != "ode" && adapter::hasCollidingShape<scenario::HalfSpace>(scenario_))
        add("half_space", "unbounded", "a box of " + shown(2.0 * kGroundHalfSide) + " m",
            "this narrow phase has no planes");
    if (phase == "fcl_mesh")
        add("shapes", "exact", "triangle meshes",
            "FCL's primitives are not DART's default: balls have facets");
    if (adapter::hasCollidingShape<scenario::ConvexHull, scenario::TriangleMesh>(scenario_))
        add("mesh_vertices", "f64", "f32", "assimp's vertices are single precision; a hull is its surface");
    if (!scenario_.joints.empty()) {
        add("joints", "between two bodies", "reduced coordinates of trees");
        if (!model_.loops.empty())
            add("loops", "rigid", std::to_string(model_.loops.size()) + " joints as constraints",
                "points are pulled together by the error reduction of joints");
    }
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), hasEulerAngles))
        add("six_dof_angles", "twist and swing", "successive turns: swing_y, swing_z, twist",
            "equal where one swing alone is open, else from the second order on different");
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), hasSwingSpring))
        add("swing_springs", "spring and damper", "a torque by the swing at the start of the step",
            "DART's implicit springs are of single coordinates");
    if (!model_.motors.empty()) add("motors", "speed and largest force", "servo, bounded");
    add("sleeping", "off", "off");
    add("continuous_collision", "off", "off");
    add("velocity_limits", "none",
        "none; beyond 1e10 the run ends, before an assertion of DART ends the process");
    const auto any = [&](const auto& of) {
        return std::any_of(scenario_.bodies.begin(), scenario_.bodies.end(), of);
    };
    if (any([](const scenario::Body& b) { return b.type == scenario::BodyType::Kinematic; }))
        add("kinematic_bodies", "moved", "prescribed velocities, put on their path after each step");
    if (any([](const scenario::Body& b) { return b.gravityScale != 1.0; }))
        add("gravity_scale", "per body", "a force on the body");
    if (any([](const scenario::Body& b) {
            return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0;
        }))
        add("damping", "v(t) = v0 kept^t",
            "a force at the start of the step, exact for bodies without contacts");
    return lines;
}

}  // namespace rigor::dart_adapter
