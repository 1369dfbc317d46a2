// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The in-house engine as an adapter: who it is, what it can do, and every choice it offers. Algorithm names
// come from the engine's own tables.
#include "adapters/interface/options.hpp"
#include "adapters/rigor/parts.hpp"
#include "adapters/rigor/settings.hpp"
#include "engine/constraints/joint.hpp"
#include "engine/pipeline/algorithms.hpp"

namespace rigor::adapter {
namespace {

class RigorEngine final : public Engine {
  public:
    RigorEngine()
        : dynamics_(makeRigorDynamics()),
          collision_(makeRigorCollision()),
          broadPhase_(makeRigorBroadPhase()) {}

    EngineInfo info() const override {
        return {"rigor", "0.1.0", "f64", "Rigor's own engine", "checks on, no contraction of multiply-adds"};
    }
    Capabilities capabilities() const override { return rigorCapabilities(); }
    std::vector<Option> options() const override {
        std::vector<Option> options;
        for (const engine::AlgorithmFamily& family : engine::algorithmFamilies()) {
            std::vector<std::string> names;
            for (const engine::AlgorithmInfo& algorithm : family.algorithms) names.push_back(algorithm.name);
            options.push_back(choice(family.name.c_str(), names, family.defaultChoice.c_str(),
                                     family.defaultChoice.c_str(), family.summary.c_str()));
        }
        options.push_back(integer("substeps", 1, 1000, "1", "1",
                                  "equal parts that a step is solved in; contacts are found once"));
        options.push_back(
            number("contact_frequency", 1e-3, 1e6, "30", "30",
                   "soft contacts: spring frequency, at most a quarter of the sub-step rate [Hz]"));
        options.push_back(
            number("contact_damping_ratio", 0, 1000, "10", "10", "soft contacts: damping ratio"));
        options.push_back(
            number("joint_frequency", 1e-3, 1e6, "60", "60",
                   "soft joints: spring frequency, at most a quarter of the sub-step rate [Hz]"));
        options.push_back(number("joint_damping_ratio", 0, 1000, "2", "2", "soft joints: damping ratio"));
        options.push_back(
            integer("velocity_iterations", 1, 100000, "50", "50", "most iterations of the velocity solver"));
        options.push_back(number("velocity_tolerance", 0, 1, "1e-6", "1e-6",
                                 "iterations end when one changes less than this share of the speed gravity "
                                 "adds in a step; 0: never"));
        options.push_back(
            integer("position_iterations", 0, 100000, "10", "10", "iterations of position correction"));
        options.push_back(
            integer("first_step_iterations", 1, 100000, "400", "400",
                    "most velocity iterations of the first step, which has no impulses to start from"));
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
            choice("precision", {"f32", "f64"}, "f64", "f64", "number type of state and computation"));
        return options;
    }
    const DynamicsEngine* dynamics() const override { return dynamics_.get(); }
    const CollisionEngine* collision() const override { return collision_.get(); }
    const BroadPhaseEngine* broadPhase() const override { return broadPhase_.get(); }

  private:
    std::unique_ptr<DynamicsEngine> dynamics_;
    std::unique_ptr<CollisionEngine> collision_;
    std::unique_ptr<BroadPhaseEngine> broadPhase_;
};

std::unique_ptr<Engine> makeRigor() {
    return std::make_unique<RigorEngine>();
}

}  // namespace

Capabilities rigorCapabilities() {
    Capabilities c;
    c.dynamics = c.collision = c.broadPhase = true;
    c.dimensions = {2, 3};
    c.shapes = {"sphere",  "circle", "box",           "capsule",     "cylinder",
                "cone",    "hull",   "polygon",       "half_space",  "half_plane",
                "segment", "chain",  "triangle_mesh", "height_field"};
    for (const engine::JointEntry<engine::Space3d>& joint : engine::jointTable<engine::Space3d>())
        c.joints.push_back(joint.name);
    c.contactImpulses = true;
    // Separated polytopes get no distance from the separating axis; see collision.cpp.
    // Separating axes only bound the distance of polytopes that are apart; it is told where it is exact.
    c.signedDistance = false;
    c.kinematicBodies = c.damping = c.gravityScale = c.centerOfMassOffset = true;
    return c;
}

}  // namespace rigor::adapter

RIGOR_ADAPTER_MODULE(rigor::adapter::makeRigor)
