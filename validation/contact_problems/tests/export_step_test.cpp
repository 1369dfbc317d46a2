// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Exported steps of runs: impulses that are known by hand, and the solution of the problem against what
// the engine itself did.
#include <gmock/gmock.h>

#include <cmath>

#include "scenarios/loader/loader.hpp"
#include "validation/contact_problems/export_step.hpp"
#include "validation/contact_problems/joint_rows.hpp"
#include "validation/contact_problems/residual.hpp"
#include "validation/contact_problems/tests/small_problems.hpp"

namespace rigor::validation::testing {
namespace {

using adapter::ContactSolution;

constexpr double kDt = 0.0078125, kMass = 2.0, kGravity = 10.0;

/// A block on a slope of 30 degrees, that is, gravity leans; a ball beside it bounces on the floor.
std::string slope(double friction) {
    const double s = 0.5, c = std::sqrt(0.75);
    return R"({"rigor": 1, "name": "slope", "title": "slope", "dimension": 3, "isolates": ["friction"], "source": "none",
      "gravity": [)" +
           std::to_string(kGravity * s) + ", " + std::to_string(-kGravity * c) +
           R"(, 0], "duration": 1, "dt": [)" + std::to_string(kDt) +
           R"(], "materials": {"wood": {"friction": )" + std::to_string(friction) +
           R"(, "restitution": 0}},
      "bodies": [
        {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
        {"name": "block", "mass": 2, "position": [0, 0.125, 0],
         "shapes": [{"box": {"half_extents": [0.25, 0.125, 0.25]}}]}],
      "metrics": ["penetration_max"]})";
}

ExportRequest request(const std::string& text, const std::string& spec, double dt, std::size_t step) {
    return {text, "test", adapter::parseSpec(spec), dt, step};
}
ExportedProblem runAndExport(const ExportRequest& r) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    const scenario::Scenario s = scenario::loadScenarioText(r.scenarioText, r.scenarioName).scenario;
    return exportStep(s, runToStep(s, r));
}
ContactSolution solveNsgs(const ExportedProblem& exported) {
    const auto engine = loadEngineOfBuild("rigor");
    return take(engine, "rigor:solver=nsgs", exported.problem)->run(2000, 1e-14);
}
/// Sum over the contacts of component k.
double total(const std::vector<double>& r, int dimension, int k) {
    double sum = 0.0;
    for (std::size_t i = k; i < r.size(); i += dimension) sum += r[i];
    return sum;
}

/// m g cos(a) h on the floor; along it m g sin(a) h where that holds, else mu times the normal.
TEST(ExportStep, ABlockOnASlopePressesByItsWeight) {
    const double c = std::sqrt(0.75);
    for (const double mu : {0.8, 0.3}) {
        for (const std::size_t step : {std::size_t{1}, std::size_t{20}}) {
            const ExportedProblem exported = runAndExport(request(slope(mu), "rigor:solver=nsgs", kDt, step));
            ASSERT_EQ(exported.problem.contacts(), 4u);
            const ContactSolution found = solveNsgs(exported);
            EXPECT_LT(contactResidual(exported.problem, found.r).relative, 1e-10);
            const double weight = kMass * kGravity * kDt;
            // to_string writes six digits
            EXPECT_NEAR(total(found.r, 3, 0), weight * c, 2e-6);
            const double along = std::hypot(total(found.r, 3, 1), total(found.r, 3, 2));
            EXPECT_NEAR(along, std::min(0.5, mu * c) * weight, 2e-6);
            // The engine solved the same problem.
            ASSERT_EQ(exported.storedR.size(), exported.problem.size());
            EXPECT_NEAR(total(exported.storedR, 3, 0), weight * c, 2e-6);
        }
    }
}

/// The engine's own solver on the exported step leads to the engine's own next velocities. With the midpoint rule friction
/// opposes the mean slip of the step, which the problem does not state.
TEST(ExportStep, SolvingItIsTheEnginesStep) {
    const char* spec = "rigor:gap_slop=0,integrator=symplectic_euler,solver=nsgs";
    for (const char* name :
         {"stack_forces", "box_stack_2d", "heavy_on_light", "slide_and_stop", "tripod_slide"})
        for (const std::size_t step : {std::size_t{1}, std::size_t{30}}) {
            SCOPED_TRACE(std::string(name) + " step " + std::to_string(step));
            const auto loaded = scenario::loadScenario(scenario::findScenario(name));
            const auto r = request(loaded.text, spec, loaded.scenario.timeSteps.front(), step);
            const ExportedProblem exported = runAndExport(r);
            const ContactSolution found = solveNsgs(exported);
            const std::vector<double> v = velocitiesFor(exported, found.r);
            ASSERT_EQ(v.size(), exported.storedV.size());
            for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], exported.storedV[i], 1e-9) << i;
        }
}

/// Every engine that reports contacts can be exported: what it says carries the block's weight.
TEST(ExportStep, WorksForEveryEngineWithContacts) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    std::size_t engines = 0;
    for (const std::string& name : adapter::availableEngines()) {
        SCOPED_TRACE(name);
        const auto engine = loadEngineOfBuild(name);
        const auto dimensions = engine->capabilities().dimensions;
        if (engine->dynamics() == nullptr || !engine->capabilities().contactImpulses) continue;
        if (std::find(dimensions.begin(), dimensions.end(), 3) == dimensions.end()) continue;
        ++engines;
        const ExportedProblem exported = runAndExport(request(slope(0.8), name + ":preset=matched", kDt, 40));
        EXPECT_GE(exported.problem.contacts(), 3u);
        const ContactSolution found = solveNsgs(exported);
        EXPECT_LT(contactResidual(exported.problem, found.r).relative, 1e-10);
        ASSERT_FALSE(exported.storedR.empty());
        // Its own impulses carry the weight as its own states say: 1 % for what it does about overlap.
        const double weight = kMass * kGravity * std::sqrt(0.75) * kDt;
        EXPECT_NEAR(total(exported.storedR, 3, 0), weight, 0.01 * weight);
    }
    EXPECT_GE(engines, 1u);
}

TEST(ExportStep, RestitutionGapsAndMovingGroundAreInTheProblem) {
    const auto s = scenario::loadScenarioText(slope(0.5), "test").scenario;
    RecordedStep step;
    step.dt = 0.01;
    BodyState floor, block;
    block.position = {0, 0.125, 0};
    block.velocity = {1, -3, 0};
    step.before = step.after = {floor, block};
    step.loads.resize(2);
    step.loads[1].force = {7, 0, 0};
    ContactPoint c;
    c.bodyA = 0;
    c.bodyB = 1;
    c.normal = {0, 1, 0};
    c.pointA = c.pointB = {0, 0, 0};
    step.contacts = {c};
    const auto w = [&](const scenario::Scenario& of) { return exportStep(of, step).problem.w; };
    EXPECT_EQ(w(s), (std::vector<double>{0, 0, 0}));
    auto bouncy = s;
    bouncy.materials[0].restitution = 0.5;
    EXPECT_NEAR(w(bouncy)[0], -1.5, 1e-15);
    step.contacts[0].depth = -0.002;
    EXPECT_NEAR(w(bouncy)[0], 0.2, 1e-15) << "apart: it may close the gap";
    step.contacts[0].depth = 0.0;
    auto belt = s;
    belt.bodies[0].type = scenario::BodyType::Kinematic;
    step.before[0].velocity = {0, 0.5, 0};
    EXPECT_NEAR(w(belt)[0], -0.5, 1e-15);
    const ExportedProblem exported = exportStep(s, step);
    EXPECT_NEAR(exported.problem.f[0], 2 * 1 + 0.01 * (2 * 5 + 7), 1e-5);
    EXPECT_TRUE(exported.storedR.empty()) << "no impulses were reported";
    auto held = s;
    held.pairs = {{0, 0, 0.5, 0.0, 0.7}};
    EXPECT_THROW(exportStep(held, step), adapter::Unsupported);
    step.contacts.clear();
    EXPECT_THROW(exportStep(s, step), adapter::BadInput);
}

/// A rod on a hinge, its other end on a disc: each carries half of it.
TEST(ExportStep, AHingeCarriesHalfOfALever) {
    const std::string lever =
        R"({"rigor": 1, "name": "lever", "title": "lever", "dimension": 2, "isolates": ["joints"], "source": "none",
      "gravity": [0, -10], "duration": 1, "dt": [0.0078125], "materials": {"wood": {"friction": 0, "restitution": 0}},
      "bodies": [
        {"name": "post", "type": "static", "position": [1, -0.15], "shapes": [{"circle": {"radius": 0.1}}]},
        {"name": "rod", "mass": 2, "position": [0.5, 0], "shapes": [{"box": {"half_extents": [0.6, 0.05]}}]}],
      "joints": [{"name": "pivot", "type": "hinge", "a": "world", "b": "rod", "anchor": [0, 0]}],
      "metrics": ["penetration_max"]})";
    for (const char* spec : {"rigor", "ode"}) {
        SCOPED_TRACE(spec);
        const ExportedProblem exported = runAndExport(request(lever, spec, kDt, 10));
        ASSERT_EQ(exported.problem.contacts(), 1u);
        EXPECT_EQ(exported.G.columns, 2);
        EXPECT_FALSE(exported.problem.hasBodies) << "solvers of rows on bodies know nothing of G";
        const ContactSolution found = solveNsgs(exported);
        EXPECT_LT(contactResidual(exported.problem, found.r).relative, 1e-10);
        EXPECT_NEAR(found.r[0], 0.5 * kMass * kGravity * kDt, 1e-5);
        const auto v = velocitiesFor(exported, found.r);
        for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], exported.storedV[i], 1e-4);
    }
}

TEST(ExportStep, WhatAJointDoesBeyondHoldingIsRefusedByName) {
    for (const char* name : {"hinge_limit", "slider_motor", "rope"}) {
        const auto loaded = scenario::loadScenario(scenario::findScenario(name));
        const auto& s = loaded.scenario;
        try {
            for (const auto& joint : s.joints) jointRows(s, joint, std::vector<BodyState>(s.bodies.size()));
            FAIL() << name;
        } catch (const adapter::Unsupported& error) {
            EXPECT_THAT(error.what(), ::testing::HasSubstr("joint " + s.joints.front().name)) << name;
        }
    }
}

}  // namespace
}  // namespace rigor::validation::testing
