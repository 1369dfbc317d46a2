// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what ODE really does. Reasons are measured properties of ODE 0.16.2.
#include <algorithm>

#include "adapters/interface/options.hpp"
#include "adapters/ode/world.hpp"

namespace rigor::ode {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

namespace {

/// Adds lines; a reason makes a line approximate.
class Lines {
  public:
    explicit Lines(std::vector<LedgerEntry>& lines) : lines_(lines) {}
    void add(const char* topic, std::string requested, std::string resolved, std::string reason = "") {
        const auto realisation = reason.empty() ? Realisation::Exact : Realisation::Approximate;
        lines_.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    }

  private:
    std::vector<LedgerEntry>& lines_;
};

}  // namespace

std::vector<LedgerEntry> OdeWorld::ledger() const {
    std::vector<LedgerEntry> all;
    Lines lines(all);
    const auto setting = [&](const char* key) { return adapter::textSetting(settings_, key); };
    lines.add(
        "precision", "f64", sizeof(dReal) == sizeof(double) ? "f64" : "f32",
        sizeof(dReal) == sizeof(double) ? "" : "this build of the library computes in single precision");
    lines.add("integrator", "symplectic_euler", "symplectic_euler");
    lines.add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    if (quickStep_)
        lines.add("solver", "quickstep",
                  "quickstep, " + setting("iterations") + " iterations, sor " + setting("sor") + ", seed " +
                      setting("seed"),
                  "a fixed number of iterations, no warm starting");
    else
        lines.add("solver", "worldstep", "worldstep, direct Dantzig LCP");
    if (fallbackSteps_ > 0)
        lines.add(
            "solver_fallback", "worldstep",
            "quickstep in " + std::to_string(fallbackSteps_) + " of " + std::to_string(steps_) + " steps",
            "more than " + setting("worldstep_limit") +
                " contacts: the direct solver's cost grows with the cube (tens of seconds per step)");
    if (messages_ > 0)
        lines.add("solver_messages", "0", std::to_string(messages_),
                  "ODE reported trouble inside the LCP solver");
    lines.add(
        "friction_law", "coulomb cone, pair coefficient",
        friction_ == Friction::PyramidVelocity ? "square pyramid along the predicted sliding"
                                               : "square pyramid on axes fixed by the normal",
        quickStep_ || fallbackSteps_ > 0
            ? "each axis within mu N of its own"
            : "each axis within mu N of its own, N of a solution without friction: dWorldStep takes it once");
    lines.add("friction_pair", "pair table", "written into each contact");
    const auto examples = pairs_.examples();
    if (std::any_of(examples.begin(), examples.end(), [&](const adapter::PairTable::Example& m) {
            return pairs_.coefficients(m.materialA, m.materialB).rollingFriction > 0.0;
        }))
        lines.add("rolling_friction", "disc, pair coefficient", "square, pair coefficient",
                  "each axis within rho N of its own");
    lines.add("restitution", "pair coefficient, no threshold",
              "pair coefficient, none below " + setting("bounce_threshold") + " m/s",
              bounceThreshold_ > 0.0 ? "velocity threshold" : "");
    const bool capped = adapter::numberSetting(settings_, "max_correcting_velocity") < 1e30;
    lines.add("position_correction", "no change of velocity",
              "ERP " + setting("erp") +
                  (capped ? ", at most " + setting("max_correcting_velocity") + " m/s" : ", unlimited"),
              "penetration is pushed out through the velocity and leaves it behind");
    lines.add(
        "contact_softness", "rigid",
        contactCfm_ > 0.0 ? "CFM " + setting("contact_cfm") + ", of contacts that bounce " + setting("cfm")
                          : "CFM " + setting("cfm"),
        contactCfm_ > 0.0
            ? "regularises redundant contacts; bodies sink in proportion to it"
            : "redundant contacts are singular beside it, and stacks depend on the order of their bodies");
    lines.add("joint_error_reduction", "rigid", "ERP " + setting("erp"),
              scenario_.joints.empty() ? "" : "drift is corrected through velocities");
    const bool rope = std::any_of(scenario_.joints.begin(), scenario_.joints.end(), [](const auto& joint) {
        return joint.type == scenario::JointType::Distance &&
               joint.axes[0].mode == scenario::AxisMode::Limited;
    });
    if (rope)
        lines.add("distance_limit", "bound of the distance of two anchors",
                  "frictionless contact joint along their line in steps that start at the bound or beyond",
                  "ODE's distance joint (DBall) has no stops; the overrun is corrected like a contact's");
    lines.add("contacts_per_pair", "all", "at most " + setting("max_contacts"),
              "the deepest and those farthest apart: the direct solver's cost grows with the cube");
    lines.add("sleeping", "off", "off");
    lines.add("velocity_limits", "none", "none");
    appendGeometryLedger(all);
    return all;
}

void OdeWorld::appendGeometryLedger(std::vector<LedgerEntry>& all) const {
    Lines lines(all);
    const auto setting = [&](const char* key) { return adapter::textSetting(settings_, key); };
    const auto anyShape = [&](auto&& predicate) {
        for (const auto& body : scenario_.bodies)
            for (const auto& shape : body.shapes)
                if (body.collides && predicate(shape.geometry)) return true;
        return false;
    };
    const auto anyBody = [&](auto&& predicate) {
        return std::any_of(scenario_.bodies.begin(), scenario_.bodies.end(), predicate);
    };
    lines.add("collision_margin", "0", "0");
    if (anyShape([](const auto& g) { return std::holds_alternative<scenario::ConvexHull>(g); }))
        lines.add("hull_contacts", "full manifold", "one point against anything but a half-space",
                  "libccd's MPR: hulls rock on each other and 5% of depths are off by more than 1%");
    if (anyShape([](const auto& g) { return std::holds_alternative<scenario::Capsule>(g); }))
        lines.add("capsule_contacts", "full manifold", "one point against boxes",
                  "a capsule lying on a box rests on a single moving point");
    if (anyShape([](const auto& g) {
            return std::holds_alternative<scenario::TriangleMesh>(g) ||
                   std::holds_alternative<scenario::HeightField>(g);
        })) {
        const double merge = adapter::numberSetting(settings_, "ball_merge_deg");
        lines.add(
            "surface_contacts", "full manifold",
            merge > 0.0 ? "points of each triangle, of a ball the deepest of those within " +
                              setting("ball_merge_deg") + " degrees of normal"
                        : std::string("points of each triangle"),
            "triangles ahead that a body dips into act as walls; a ball at an edge gets the face's normal; "
            "hulls find triangles from the front alone");
    }
    if (planar_) {
        lines.add("planar", "two dimensions",
                  "3D prisms of half depth 0.5 m, Plane2D joints, contacts merged in the plane z = 0",
                  "contacts are found on solids; rounding out of the plane is removed after each step");
    } else {
        const std::string gyro = setting("gyroscopic");
        lines.add("gyroscopic_term", "exact rigid-body rotation", gyro,
                  gyro == "none" ? "angular velocity is constant without torque, whatever the inertia"
                  : gyro == "ode"
                      ? "first order in dt, in energy and momentum"
                      : "w := I(R1)^-1 I(R0) w between steps: momentum exact, energy first order");
        lines.add("rotation_update", "exact for constant angular velocity", setting("rotation"),
                  setting("rotation") == "finite" ? "" : "turns by atan-like less: w dt = 1 turns 0.927 rad");
    }
    if (anyBody([](const auto& b) { return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0; }))
        lines.add("damping", "v(t) = v0 kept^t", "v *= kept^dt at the end of each step, no threshold");
    if (anyBody([](const auto& b) { return b.gravityScale != 1.0; }))
        lines.add("gravity_scale", "factor on gravity", "own weight as a force on each step");
}

}  // namespace rigor::ode
