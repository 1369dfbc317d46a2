// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what Simbody really does.
#include <algorithm>

#include "adapters/interface/options.hpp"
#include "adapters/simbody/world.hpp"

namespace rigor::simbody {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> SimbodyWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    // A line with a reason is approximate.
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         std::string reason = "") {
        const auto realisation = reason.empty() ? Realisation::Exact : Realisation::Approximate;
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto text = [&](const char* key) { return adapter::textSetting(settings_, key); };
    add("precision", "f64", "f64");
    add("integrator", text("integrator"), integrator_->getMethodName());
    if (is("step", "fixed"))
        add("time_step", shown(dt_), shown(dt_) + ", one step of the integrator per call");
    else
        add("time_step", shown(dt_), "steps by an accuracy of " + text("accuracy") + " within each",
            "the integrator takes as many steps as its accuracy needs, at least one per call");
    if (!scenario_.joints.empty()) add("joints", "between two bodies", "reduced coordinates of trees");
    if (!model_->loops.empty())
        add("loops", "rigid",
            std::to_string(model_->loops.size()) + " joints as constraints, projected to " +
                text("constraint_tolerance") + (is("projection", "every_step") ? " after every step" : ""));
    if (!model_->motors.empty())
        add("motors", "speed and largest force",
            "a constant speed while the force is enough, else one force per step",
            "whether it is enough is evaluated once per step");
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), adapter::canBreak))
        add("breaking", "mean force of a step", "force at the start or the end of a step",
            "Simbody's multipliers are those of an instant");
    add("contacts", "none can be made", "none", "");
    add("sleeping", "off", "off");
    add("velocity_limits", "none",
        is("step", "fixed")
            ? "none; where an exception of Simbody ends a step, the run has no numbers from there on"
            : "none");
    const auto any = [&](const auto& of) {
        return std::any_of(scenario_.bodies.begin(), scenario_.bodies.end(), of);
    };
    if (any([](const scenario::Body& b) { return b.type == scenario::BodyType::Kinematic; }))
        add("kinematic_bodies", "moved", "prescribed as functions of time");
    if (any([](const scenario::Body& b) { return b.gravityScale != 1.0; }))
        add("gravity_scale", "per body", "a force on the body");
    if (any([](const scenario::Body& b) {
            return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0;
        }))
        add("damping", "v(t) = v0 kept^t", "a force that the integrator evaluates");
    return lines;
}

}  // namespace rigor::simbody
