// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house engine as an adapter: who it is, what it can do, and every choice it offers. Algorithm names
// come from the engine's own tables.
#include <algorithm>

#include "adapters/interface/options.hpp"
#include "adapters/interface/presets.hpp"
#include "adapters/rigor/foreign_narrow_phase.hpp"
#include "adapters/rigor/parts.hpp"
#include "adapters/rigor/settings.hpp"
#include "engine/constraints/joint.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/state/prefer_speed.hpp"

namespace rigor::adapter {
namespace {

/// What engine::preferSpeed sets, with the solver's own number of iterations.
Preset fastPreset() {
    engine::WorldDef<engine::Space3d> def;
    engine::preferSpeed(def);
    return {"fast",
            {{"solver", def.solver},
             {"broad_phase", def.broadPhase},
             {"substeps", std::to_string(def.substeps)},
             {"velocity_iterations", std::to_string(def.velocityIterations)},
             {"contact_frequency", shown(def.contactFrequency)},
             {"reuse_distance", shown(def.reuseDistance)},
             {"box_margin", shown(def.boxMargin)},
             {"speculative_distance", shown(def.speculativeDistance)},
             {"curved_joints", def.curvedJoints ? "on" : "off"}}};
}

class RigorEngine final : public EngineWithPresets {
  public:
    RigorEngine()
        : dynamics_(makeRigorDynamics()),
          collision_(makeRigorCollision()),
          broadPhase_(makeRigorBroadPhase()),
          contactSolvers_(makeRigorContactSolvers()) {}

    EngineInfo info() const override {
        return {"rigor", "0.1.0", "f64", "Rigor's own engine", "checks on, no contraction of multiply-adds"};
    }
    Capabilities capabilities() const override { return rigorCapabilities(); }
    std::vector<Option> options() const override {
        std::vector<Option> options;
        for (const engine::AlgorithmFamily& family : engine::algorithmFamilies()) {
            std::vector<std::string> names;
            for (const engine::AlgorithmInfo& algorithm : family.algorithms) names.push_back(algorithm.name);
            if (family.name == "narrow_phase")
                for (const std::string& foreign : foreignNarrowPhases()) names.push_back(foreign);
            std::sort(names.begin(), names.end());
            options.push_back(choice(family.name.c_str(), names, family.defaultChoice.c_str(),
                                     family.defaultChoice.c_str(), family.summary.c_str()));
        }
        options.push_back(integer("substeps", 0, 1000, "0", "0",
                                  "equal parts that a step is solved in; contacts are found once; 0: the "
                                  "solver's own number, 1 for most"));
        options.push_back(
            number("contact_frequency", 1e-3, 1e6, "30", "30",
                   "soft contacts: spring frequency, at most a quarter of the sub-step rate [Hz]"));
        options.push_back(
            number("contact_damping_ratio", 0, 1000, "10", "10", "soft contacts: damping ratio"));
        options.push_back(
            number("joint_frequency", 1e-3, 1e6, "60", "60",
                   "soft joints: spring frequency, at most a quarter of the sub-step rate [Hz]"));
        options.push_back(number("joint_damping_ratio", 0, 1000, "2", "2", "soft joints: damping ratio"));
        options.push_back(integer(
            "velocity_iterations", 0, 100000, "0", "50",
            "most iterations of the solver in each sub-step; 0: the solver's own number, 50 for most"));
        options.push_back(number("velocity_tolerance", 0, 1, "1e-6", "1e-6",
                                 "iterations end when one changes less than this share of the speed gravity "
                                 "adds in a step; 0: never"));
        options.push_back(
            integer("position_iterations", 0, 100000, "10", "10", "iterations of position correction"));
        options.push_back(
            integer("first_step_iterations", 1, 100000, "400", "400",
                    "most velocity iterations of the first step, which has no impulses to start from"));
        options.push_back(number("residual_tolerance", 0, 1, "1e-10", "1e-10",
                                 "nsgs, dantzig, lemke: natural map at which they are done [m/s]"));
        options.push_back(choice("measure_residuals", {"off", "on"}, "off", "off",
                                 "report the natural map after each iteration instead of its change"));
        options.push_back(integer("pyramid_directions", 2, 64, "4", "4",
                                  "lemke: directions of its friction pyramid, even"));
        options.push_back(integer("threads", 1, 1024, "1", "1",
                                  "threads that share the work of a step; the results are the same bits"));
        options.push_back(
            choice("warm_starting", {"off", "on"}, "on", "on", "start from the impulses of the last step"));
        options.push_back(choice("curved_joints", {"off", "on"}, "on", "on",
                                 "joint rows aim at the constraint at the end of the step"));
        options.push_back(
            number("restitution_threshold", 0, 100, "0.01", "0", "slower approaches do not bounce [m/s]"));
        options.push_back(number("slop", 0, 1, "1e-5", "1e-5", "overlap that is not corrected [m]"));
        options.push_back(
            number("gap_slop", 0, 1, "5e-4", "5e-4", "gaps of resting contacts that count as closed [m]"));
        options.push_back(number("speculative_distance", 0, 1, "1e-3", "1e-3",
                                 "contacts are found up to this separation [m]"));
        options.push_back(
            number("reuse_distance", 0, 1, "0", "0",
                   "manifolds are kept until two shapes have moved by this against each other [m]"));
        options.push_back(number("box_margin", 0, 10, "0", "0",
                                 "broad phase: share of a box's longest edge that it may move before it is "
                                 "asked again; no part of the results"));
        options.push_back(number("sleep_linear_velocity", 0, 100, "0.01", "0.01",
                                 "sleeping=islands: bodies slower than this are at rest [m/s]"));
        options.push_back(number("sleep_angular_velocity", 0, 100, "0.02", "0.02",
                                 "sleeping=islands: and turning slower than this [rad/s]"));
        options.push_back(number("time_to_sleep", 0, 1e6, "0.5", "0.5",
                                 "sleeping=islands: how long all of an island must have been at rest [s]"));
        options.push_back(
            choice("precision", {"f32", "f64"}, "f64", "f64", "number type of state and computation"));
        return options;
    }
    std::vector<Preset> presets() const override { return {fastPreset()}; }
    const DynamicsEngine* dynamics() const override { return dynamics_.get(); }
    const CollisionEngine* collision() const override { return collision_.get(); }
    const BroadPhaseEngine* broadPhase() const override { return broadPhase_.get(); }
    const ContactSolverEngine* contactSolvers() const override { return contactSolvers_.get(); }

  private:
    std::unique_ptr<DynamicsEngine> dynamics_;
    std::unique_ptr<CollisionEngine> collision_;
    std::unique_ptr<BroadPhaseEngine> broadPhase_;
    std::unique_ptr<ContactSolverEngine> contactSolvers_;
};

std::unique_ptr<Engine> makeRigor() {
    return std::make_unique<RigorEngine>();
}

/// Everything that has a coordinate can be limited and sprung; only cones cannot be driven.
void addJointCapabilities(const std::string& name, bool moves, std::vector<std::string>& joints) {
    joints.push_back(name);
    joints.push_back(name + ".break");
    if (!moves) return;
    for (const char* feature : {".limit", ".spring"}) joints.push_back(name + feature);
    if (name != "ball") joints.push_back(name + ".motor");
}

}  // namespace

Capabilities rigorCapabilities() {
    Capabilities c;
    c.dynamics = c.collision = c.broadPhase = true;
    c.queryOptions = {"precision"};
    c.dimensions = {2, 3};
    c.shapes = {"sphere",  "circle", "box",           "capsule",     "cylinder",
                "cone",    "hull",   "polygon",       "half_space",  "half_plane",
                "segment", "chain",  "triangle_mesh", "height_field"};
    for (const engine::JointEntry<engine::Space3d>& joint : engine::jointTable<engine::Space3d>())
        addJointCapabilities(joint.name, joint.axes > 0, c.joints);
    c.contactImpulses = c.contactSolvers = true;
    c.signedDistance = true;
    c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = c.staticFriction = true;
    return c;
}

}  // namespace rigor::adapter

RIGOR_ADAPTER_MODULE(rigor::adapter::makeRigor)
