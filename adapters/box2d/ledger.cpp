// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ledger of the requested settings and what Box2D really does. Reasons are measured properties of Box2D
// 2.4.1.
#include <algorithm>

#include "adapters/box2d/world.hpp"
#include "adapters/interface/options.hpp"

namespace rigor::box2d {

using adapter::LedgerEntry;
using adapter::Realisation;
using adapter::shown;

std::vector<LedgerEntry> Box2dWorld::ledger() const {
    std::vector<LedgerEntry> lines;
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const auto whenOff = [](bool on) { return on ? Realisation::Approximate : Realisation::Exact; };

    add("precision", "f64", "f32", Realisation::Approximate, "Box2D is single precision only");
    add("integrator", "symplectic_euler", "symplectic_euler");
    add("time_step", shown(dt_), shown(dt_) + ", one step per call");
    add("world_scale", "1", shown(scale_));
    add("solver", "sequential impulses",
        std::to_string(velocityIterations_) + " velocity and " + std::to_string(positionIterations_) +
            " position iterations");
    add("warm_starting", adapter::textSetting(settings_, "warm_starting"),
        world_->GetWarmStarting() ? "on" : "off");
    add("friction_law", "coulomb, pair coefficient", "coulomb, pair coefficient");
    const bool corrected = is("restitution", "corrected");
    const double threshold = adapter::numberSetting(settings_, "restitution_threshold");
    add("restitution", "pair coefficient e, no threshold",
        std::string(corrected ? "e v / (v + dt a) each step" : "e") + ", none below " + shown(threshold) +
            " m/s",
        whenOff(!corrected || threshold > 0.0),
        !corrected        ? "Box2D bounces with the speed after this step's forces: e (v + g dt)"
        : threshold > 0.0 ? "Box2D's velocity threshold"
                          : "");
    add("position_correction", "no change of velocity",
        "non-linear Gauss-Seidel, a fifth of the error per iteration, at most " +
            shown(b2_maxLinearCorrection / scale_) + " m",
        Realisation::Approximate,
        "leaves one slop (" + shown(b2_linearSlop / scale_) + " m); drains energy from swinging joints");
    const bool sleeps = world_->GetAllowSleeping(), continuous = world_->GetContinuousPhysics();
    add("sleeping", "off", sleeps ? "on: below 0.01 m/s and 2 deg/s for 0.5 s" : "off", whenOff(sleeps),
        sleeps ? "slow bodies are stopped, even in free space" : "");
    add("continuous_collision", "off", continuous ? "on" : "off", whenOff(continuous),
        continuous
            ? "fast bodies are stopped at the time of impact with static ones and lose the rest of the step"
            : "");
    add("linear_step_limit", "none", shown(b2_maxTranslation / (scale_ * dt_)) + " m/s",
        Realisation::Approximate, "compiled-in limit of 2 lengths per step: faster bodies are slowed down");
    add("angular_step_limit", "none", shown(b2_maxRotation / dt_) + " rad/s", Realisation::Approximate,
        "compiled-in limit of pi/2 per step: faster bodies are slowed down");
    appendShapeLedger(lines);
    return lines;
}

void Box2dWorld::appendShapeLedger(std::vector<LedgerEntry>& lines) const {
    const auto add = [&](const char* topic, std::string requested, std::string resolved,
                         Realisation realisation = Realisation::Exact, std::string reason = "") {
        lines.push_back({topic, std::move(requested), std::move(resolved), realisation, std::move(reason)});
    };
    const bool least = is("skin", "least");
    add("collision_skin", "0",
        "radius " + shown(shapes_.skin.polygon / scale_) + " m around polygons and edges, " +
            shown(shapes_.skin.circle / scale_) + " m around circles",
        Realisation::Approximate,
        least ? "surfaces touch when at rest on each other, to within a slop"
              : "shapes rest up to 3 slops apart (" + shown(3.0 * b2_linearSlop / scale_) + " m)");
    if (adapter::hasCollidingShape<scenario::HalfSpace>(scenario_))
        add("half_plane", "unbounded",
            "rectangle of half extents " + shown(shapes_.halfPlaneReach) + " x " + shown(kHalfPlaneDepth) +
                " m",
            Realisation::Approximate, "Box2D has no half-plane");
    if (adapter::hasCollidingShape<scenario::Capsule>(scenario_))
        add("capsule", "one shape", "a rectangle and two circles", Realisation::Approximate,
            "Box2D has no capsule; contacts may come twice where the parts meet");
    if (adapter::hasCollidingShape<scenario::Chain>(scenario_))
        add("chain", "two-sided",
            "two b2ChainShapes back to back, one-sided each, ghost vertices at the joints",
            Realisation::Approximate,
            "Box2D's chains have one side; what lies on one side by its centroid "
            "meets that side alone");
    const auto sprung = [](const scenario::Joint& j) {
        return (j.type == scenario::JointType::Hinge || j.type == scenario::JointType::Slider) &&
               j.axes[0].hasSpring();
    };
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), sprung))
        add("joint_springs", "of hinges and sliders",
            "a weld joint with an angular spring, a wheel joint along the slider's axis");
    const auto breaks = [](const scenario::Joint& j) {
        return j.breakForce < 1e299 || j.breakTorque < 1e299;
    };
    if (std::any_of(scenario_.joints.begin(), scenario_.joints.end(), breaks))
        add("breaking_joints", "a step's mean reaction above the strength",
            "GetReactionForce and GetReactionTorque after each step; broken from the next step on");
    const bool damped = std::any_of(
        scenario_.bodies.begin(), scenario_.bodies.end(),
        [](const scenario::Body& b) { return b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0; });
    if (damped)
        add("damping", "v(t) = v0 kept^t",
            "v /= 1 + dt c with c = (kept^-dt - 1) / dt, after the step's forces");
}

}  // namespace rigor::box2d
