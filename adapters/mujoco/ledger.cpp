// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what MuJoCo really does. Reasons are measured properties of MuJoCo 2.2.2.
#include <algorithm>

#include "adapters/interface/options.hpp"
#include "adapters/mujoco/world.hpp"

namespace rigor::mujoco {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> MujocoWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    // A line with a reason is approximate.
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         std::string reason = "") {
        const auto realisation = reason.empty() ? Realisation::Exact : Realisation::Approximate;
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto text = [&](const char* key) { return adapter::textSetting(settings_, key); };
    const mjModel& model = *model_.model;
    add("precision", "f64", sizeof(mjtNum) == sizeof(double) ? "f64" : "f32");
    add("integrator", text("integrator"),
        adapter::schemeName(scheme()) +
            std::string(is("integrator", "implicit") ? ", implicit in velocities" : ""));
    add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    add("solver", text("solver"),
        text("solver") + ", at most " + text("iterations") + " iterations, until an improvement below " +
            text("tolerance"));
    add("warm_starting", text("warm_starting"), text("warm_starting") + ", by the last accelerations");
    add("contact_softness", "rigid",
        "solref " + shown(modelSettings().softness.solref[0]) + " s, damping ratio " +
            text("solref_damping") + ", solimp " + text("solimp_min") + " to " + text("solimp_max"),
        "constraints are springs: bodies sink under their weight");
    const bool pyramid = is("cone", "pyramidal");
    add("friction_law", "coulomb cone, pair coefficient",
        pyramid ? "convex, pyramid of 4 edges" : "convex, cone, impratio " + text("impratio"),
        std::string("a surface that slides at v leaves the other at mu v; ") +
            (pyramid ? "between the pyramid's edges friction is down to 1 / sqrt 2 of it"
                     : "bodies that stick creep"));
    add("friction_pair", "pair table",
        std::to_string(model_.explicitPairs) + " pairs of geoms named, one surface for all others");
    const auto examples = pairs_.examples();
    if (std::any_of(examples.begin(), examples.end(), [&](const auto& m) {
            return pairs_.coefficients(m.materialA, m.materialB).restitution > 0.0;
        }))
        add("restitution", "pair coefficient, no threshold",
            is("restitution", "spring")
                ? "damped spring of half a period in " + text("bounce_steps") + " steps"
                : "none",
            is("restitution", "spring") ? "MuJoCo has no coefficient: solref's damping gives it, up to where "
                                          "in a step a contact begins"
                                        : "MuJoCo has no coefficient of restitution");
    if (!scenario_.joints.empty()) {
        add("joints", "between two bodies",
            "reduced coordinates: " + std::to_string(model.njnt) + " joints of trees");
        if (model.neq > 0)
            add("loops", "rigid", std::to_string(model.neq) + " equality constraints",
                "soft, as contacts are");
        if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), canBreak))
            add("breaking_joints", "a step's mean reaction above the strength",
                "forces of equality constraints after each step; off from the next step on");
    }
    if (!model_.motors.empty())
        add("motors", "speed and largest force", "a force set at the start of each step, bounded",
            "under a load the speed lags by the load times the step over the inertia");
    add("sleeping", "off", "off");
    add("continuous_collision", "off", "off");
    add("velocity_limits", "none",
        "none; beyond " + shown(mjMAXVAL) + " MuJoCo starts again, which ends the run");
    const auto any = [&](const auto& is) {
        return std::any_of(scenario_.bodies.begin(), scenario_.bodies.end(), is);
    };
    if (any([](const scenario::Body& b) { return b.type == scenario::BodyType::Kinematic; }))
        add("kinematic_bodies", "moved",
            "bodies of " + shown(kKinematicMass) + " kg, put on their path after each step");
    if (any([](const scenario::Body& b) { return b.gravityScale != 1.0; }))
        add("gravity_scale", "per body", "a force on the body");
    if (any([](const scenario::Body& b) {
            return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0;
        }))
        add("damping", "v(t) = v0 kept^t",
            "of free bodies that of their joint, exact per step; of others a force at the start of the step");
    if (adapter::hasCollidingShape<scenario::ConvexHull>(scenario_) || planar_)
        add("hull_vertices", "f64", "f32", "mjModel::mesh_vert is single precision");
    if (adapter::hasCollidingShape<scenario::HeightField>(scenario_))
        add("height_field", "f64", "f32", "mjModel::hfield_data is single precision");
    return lines;
}

}  // namespace rigor::mujoco
