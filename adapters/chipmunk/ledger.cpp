// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what Chipmunk really does. Reasons are measured properties of Chipmunk 7.0.3.
#include <algorithm>

#include "adapters/chipmunk/world.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::chipmunk {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> ChipmunkWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto when = [](bool approximate) {
        return approximate ? Realisation::Approximate : Realisation::Exact;
    };
    add("precision", "f64", sizeof(cpFloat) == sizeof(double) ? "f64" : "f32");
    add("integrator", "symplectic_euler", adapter::schemeName(scheme()), when(!positionsLast_),
        positionsLast_ ? "" : "cpSpaceStep moves bodies before it changes their velocities");
    add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    add("solver", "sequential impulses", std::to_string(cpSpaceGetIterations(space_.get())) + " iterations");
    add("warm_starting", "on", "on: contacts and joints, for as long as shapes overlap");
    add("friction_law", "coulomb, pair coefficient", "coulomb, pair coefficient");
    add("restitution", "pair coefficient e, no threshold", "e, no threshold");
    const double slop = cpSpaceGetCollisionSlop(space_.get());
    add("collision_slop", "0", shown(slop) + " m", when(slop > 0.0),
        slop > 0.0 ? "overlap that is not corrected" : "");
    add("position_correction", "no change of velocity",
        "pseudo-velocities; of the overlap beyond the slop, " + shown(cpSpaceGetCollisionBias(space_.get())) +
            " is left after a second",
        Realisation::Approximate, "the overlap is taken away over several steps");
    add("sleeping", "off", "off");
    add("continuous_collision", "off", "off");
    if (adapter::hasCollidingShape<scenario::HalfSpace>(scenario_))
        add("half_plane", "unbounded",
            "rectangle of half extents " + shown(halfPlane_.reach) + " x " + shown(halfPlane_.depth) + " m",
            Realisation::Approximate, "Chipmunk has no half-plane");
    if (!scenario_.joints.empty())
        add("joint_correction", "no change of velocity", "Baumgarte: velocities carry the correction",
            Realisation::Approximate,
            "cpConstraintSetErrorBias: a tenth of the error is left after 1/60 s of 60");
    const auto sprung = [](const scenario::Joint& joint) {
        return std::any_of(joint.axes.begin(), joint.axes.end(),
                           [](const auto& axis) { return axis.hasSpring(); });
    };
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), sprung))
        add("joint_springs", "stiffness and damping",
            "stiffness explicit, damping as an exponential of the step");
    const auto breaks = [](const scenario::Joint& j) {
        return j.breakForce < 1e299 || j.breakTorque < 1e299;
    };
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), breaks))
        add("breaking_joints", "a step's mean reaction above the strength",
            "cpConstraintGetImpulse after each step; broken from the next step on");
    return lines;
}

}  // namespace rigor::chipmunk
