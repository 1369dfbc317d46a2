// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house engine as an adapter: its identity, its features, and every choice that it offers. Algorithm
// names come from the engine's own tables.
#include <algorithm>
#include <map>

#include "adapters/interface/options.hpp"
#include "adapters/interface/presets.hpp"
#include "adapters/rigor/foreign_narrow_phase.hpp"
#include "adapters/rigor/parts.hpp"
#include "adapters/rigor/settings.hpp"
#include "engine/constraints/joint.hpp"
#include "engine/pipeline/algorithms.hpp"
#include "engine/state/world_def.hpp"

namespace rigor::adapter {
namespace {

/// The settings of the engine's preset of that name, with its own number of iterations.
Preset enginePreset(const char* name) {
    using Def = engine::WorldDef<engine::Space3d>;
    const Def none, def = Def::preset(name);
    Preset preset{name,
                  {{"solver", def.solver},
                   {"broad_phase", def.broadPhase},
                   {"integrator", def.integrator},
                   {"substeps", std::to_string(def.substeps)},
                   {"velocity_iterations", std::to_string(def.velocityIterations)},
                   {"curved_joints", def.relinearizedJoints ? "on" : "off"}}};
    const auto set = [&](const char* key, double Def::*member) {
        if (def.*member != none.*member) preset.values[key] = shown(def.*member);
    };
    set("velocity_tolerance", &Def::velocityTolerance);
    set("contact_frequency", &Def::contactFrequency);
    set("reuse_distance", &Def::cacheTolerance);
    set("box_margin", &Def::boxMargin);
    set("speculative_distance", &Def::speculativeDistance);
    set("speculative_motion", &Def::speculativeMotion);
    return preset;
}

/// Settings of `matched` that differ from `default`.
const std::map<std::string, std::string> kMatched{{"velocity_iterations", "50"},
                                                  {"restitution_threshold", "0"}};

/// The names that a setting may have: those of its family, and narrow phases of other libraries besides.
std::vector<std::string> namesOf(const std::string& key,
                                 const std::vector<engine::AlgorithmFamily>& families) {
    std::vector<std::string> names;
    for (const engine::AlgorithmFamily& family : families)
        if (family.name == key)
            for (const engine::AlgorithmInfo& algorithm : family.algorithms) names.push_back(algorithm.name);
    if (key == "narrow_phase")
        for (const std::string& foreign : foreignNarrowPhases()) names.push_back(foreign);
    std::sort(names.begin(), names.end());
    return names;
}

Option optionOf(const engine::SettingInfo& setting, const std::vector<engine::AlgorithmFamily>& families) {
    using Kind = engine::SettingKind;
    const auto found = kMatched.find(setting.key);
    const char* byDefault = setting.byDefault.c_str();
    const char* matched = found == kMatched.end() ? byDefault : found->second.c_str();
    const char *key = setting.key.c_str(), *help = setting.help.c_str();
    if (setting.kind == Kind::Algorithm)
        return choice(key, namesOf(setting.key, families), byDefault, matched, help);
    if (setting.kind == Kind::Switch) return choice(key, {"off", "on"}, byDefault, matched, help);
    if (setting.kind == Kind::Integer)
        return integer(key, setting.min, setting.max, byDefault, matched, help);
    return number(key, setting.min, setting.max, byDefault, matched, help);
}

class RigorEngine final : public EngineWithPresets {
  public:
    RigorEngine()
        : dynamics_(makeRigorDynamics()),
          collision_(makeRigorCollision()),
          broadPhase_(makeRigorBroadPhase()),
          contactSolvers_(makeRigorContactSolvers()) {}

    EngineInfo info() const override {
        return {"rigor", RIGOR_VERSION, "f64", "Rigor's own engine",
                "checks on, no contraction of multiply-adds"};
    }
    Capabilities capabilities() const override { return rigorCapabilities(); }
    std::vector<Option> options() const override {
        std::vector<Option> options;
        const std::vector<engine::AlgorithmFamily> families = engine::algorithmFamilies();
        for (const engine::SettingInfo& setting : engine::settings())
            options.push_back(optionOf(setting, families));
        options.push_back(
            choice("precision", {"f32", "f64"}, "f64", "f64", "number type of state and computation"));
        return options;
    }
    std::vector<Preset> presets() const override { return {enginePreset("accurate"), enginePreset("fast")}; }
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
    c.shapes = {"sphere",  "circle", "box",           "capsule",      "cylinder",
                "cone",    "hull",   "polygon",       "half_space",   "half_plane",
                "segment", "chain",  "triangle_mesh", "height_field", "ellipsoid"};
    for (const engine::JointEntry<engine::Space3d>& joint : engine::jointTable<engine::Space3d>())
        addJointCapabilities(joint.name, joint.axes > 0, c.joints);
    c.contactImpulses = c.contactSolvers = true;
    c.signedDistance = true;
    c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = c.staticFriction = true;
    c.rollingFriction = c.torsionalFriction = c.surfaceVelocity = true;
    c.contactFilters = c.shapeFilters = true;
    return c;
}

std::unique_ptr<Engine> makeRigorEngine() {
    return std::make_unique<RigorEngine>();
}

}  // namespace rigor::adapter
