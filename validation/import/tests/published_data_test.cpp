// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Imported pendulums, carts and published errors: synthetic data sets of known content come back as scenarios
// with their state, their joints and their bounds; what is wrong is said with file and line; with RIGOR_DATA
// the real data sets, held against their own descriptions.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "scenarios/loader/study.hpp"
#include "validation/import/arm_model.hpp"
#include "validation/import/tests/imported.hpp"
#include "validation/import/tests/toss_folder.hpp"
#include "validation/references/reference.hpp"

namespace rigor::validation::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;

const char* const kParameters =
    R"({"double": {"m": [0.1, 0.2], "a": [0.11, 0.12], "L": [0.17, 0.0], "I": [4e-4, 1e-3],
        "k": [2e-4, 1e-5], "g": 9.8}})";

fs::path doublePendulum(const std::string& name) {
    const auto folder = freshFolder(name);
    writeText(folder / "parameters.json", kParameters);
    writeText(folder / "double_segments.csv",
              "file,rms_theta1_published_parameters,rms_theta2_published_parameters\n"
              "double_03.csv,0.01,0.02\n");
    writeText(folder / "double_03.csv",
              "t,theta1,theta2,omega1,omega2\n5.000,3,2,-1,4\n5.001,2.999,2.004,-1.1,4.1\n"
              "5.002,2.998,2.008,-1.2,4.2\n");
    return folder;
}

TEST(MultiArmPendulum, StartsInTheFirstSampleWithJointsThatBrake) {
    const Imported imported =
        importFrom("multi-arm-pendulum", doublePendulum("double"), {{"arms", "double"}, {"start", "row"}});
    ASSERT_EQ(imported.scenarios.size(), 1U);
    EXPECT_EQ(imported.scenarios[0].name, "double_03");
    const Scenario s = loaded(imported.scenarios[0]);
    EXPECT_EQ(s.gravity, (Vec3{0, -9.8, 0}));
    EXPECT_NEAR(s.duration, 0.002, 1e-15);
    ASSERT_EQ(s.bodies.size(), 2U);
    ASSERT_EQ(s.joints.size(), 2U);
    // Straight up is zero: an arm at the angle pi/2 would lie along -x.
    const Vec3 first{-std::sin(3.0), std::cos(3.0), 0}, second{-std::sin(2.0), std::cos(2.0), 0};
    EXPECT_LT(norm(s.bodies[0].pose.position - 0.11 * first), 1e-15);
    EXPECT_LT(norm(s.bodies[1].pose.position - (0.17 * first + 0.12 * second)), 1e-15);
    // The velocities are the derivatives of these places, here by differences over the given rates.
    const auto lower = [](double t) {
        const double a = 3.0 - t, b = 2.0 + 4.0 * t;
        return Vec3{-0.17 * std::sin(a) - 0.12 * std::sin(b), 0.17 * std::cos(a) + 0.12 * std::cos(b), 0};
    };
    EXPECT_LT(norm(s.bodies[1].velocity - (lower(1e-6) - lower(-1e-6)) / 2e-6), 1e-9);
    EXPECT_EQ(s.joints[1].axes[0].stiffness, 0.0);
    EXPECT_EQ(s.joints[1].axes[0].damping, 1e-5);
    EXPECT_LT(norm(s.joints[1].anchorA - (0.17 - 0.11) * Vec3{0, 1, 0}), 1e-15) << "in the frame of arm 1";
    const auto reference = makeReference(s);
    EXPECT_NEAR(2 * std::atan2(reference->measured(1, 0.001)->orientation->z,
                               reference->measured(1, 0.001)->orientation->w),
                2.004, 1e-12);
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    EXPECT_NEAR(study["parts"][0]["findings"][0]["at_least"].get<double>(), 0.02 - 5e-4, 1e-12)
        << "the worse of the two published angles";
    ASSERT_EQ(imported.parameters.size(), 2U);
    EXPECT_EQ(imported.parameters[1].key, "joints.joint_2.spring.damping");
}

TEST(MultiArmPendulum, WhatIsWrongIsSaid) {
    const std::map<std::string, std::string> two{{"arms", "double"}, {"start", "row"}};
    auto folder = doublePendulum("gap");
    writeText(folder / "double_03.csv", "t,theta1,theta2,omega1,omega2\n0,3,2,0,0\n0.002,3,2,0,0\n");
    EXPECT_THAT(refusal("multi-arm-pendulum", folder, two), HasSubstr("times that rise by 0.001 s"));
    folder = doublePendulum("no-parameters");
    writeText(folder / "parameters.json", R"({"double": {"m": [0.1]}})");
    EXPECT_THAT(refusal("multi-arm-pendulum", folder, two), HasSubstr("2 numbers, one for each arm"));
    folder = doublePendulum("few-samples");
    EXPECT_THAT(refusal("multi-arm-pendulum", folder, {{"arms", "double"}}), HasSubstr("at least 20"));
    EXPECT_THAT(refusal("multi-arm-pendulum", folder), HasSubstr("no triple_NNN.csv"));
}

/// Two unit rods under g = 9.81 from the horizontal, angles from straight up; the values are the catalogue's.
TEST(ArmModel, FollowsTheDoublePendulumOfTheCatalogue) {
    const ArmModel model{9.81, {1, 1}, {0.5, 0.5}, {1, 0}, {1.0 / 12, 1.0 / 12}, {0, 0}};
    const auto angles = predictAngles(model, {{1.5 * M_PI, 1.5 * M_PI}, {0, 0}}, 1e-3, 2001);
    EXPECT_NEAR(angles[2 * 1000], M_PI - 1.207716238, 1e-8);
    EXPECT_NEAR(angles[2 * 1000 + 1], M_PI - 0.8143910231, 1e-8);
    EXPECT_NEAR(angles[2 * 2000], M_PI - 0.08275830682, 1e-8);
    EXPECT_NEAR(angles[2 * 2000 + 1], M_PI + 0.4073620749, 1e-8);
}

TEST(ArmModel, ItsJointsBrake) {
    // One arm that turns about its centre of mass loses its speed as exp(-k t / I).
    const ArmModel model{9.81, {1}, {0}, {0}, {0.5}, {0.2}};
    const auto angles = predictAngles(model, {{0}, {3}}, 1e-3, 1001);
    EXPECT_NEAR(angles[1000], 3 * 0.5 / 0.2 * (1 - std::exp(-0.2 / 0.5)), 1e-10);
}

/// A synthetic record of the double pendulum with the parameters above, angles rounded as the data are.
fs::path longRecord(const std::string& name, ArmState& middle) {
    const auto folder = doublePendulum(name);
    const ArmModel model{9.8, {0.1, 0.2}, {0.11, 0.12}, {0.17, 0.0}, {4e-4, 1e-3}, {2e-4, 1e-5}};
    const auto angles = predictAngles(model, {{4.5, 2.5}, {1, -2}}, 1e-3, 1001);
    std::string text = "t,theta1,theta2,omega1,omega2\n";
    char line[120];
    for (std::size_t k = 0; k <= 1000; ++k) {
        std::snprintf(line, sizeof line, "%.3f,%.5f,%.5f,0,0\n", 5 + 1e-3 * k, angles[2 * k],
                      angles[2 * k + 1]);
        text += line;
    }
    writeText(folder / "double_03.csv", text);
    middle = {{angles[800], angles[801]},
              {(angles[802] - angles[798]) / 2e-3, (angles[803] - angles[799]) / 2e-3}};
    return folder;
}

TEST(MultiArmPendulum, AnySpanIsTakenAndItsStartIsFitted) {
    ArmState middle;
    const auto folder = longRecord("span", middle);
    const auto list = folder / "list.csv";
    writeText(list, "file,start,end\ndouble_03.csv,5.4,5.9\ndouble_03,5.0,5.25\n");
    const ImporterEntry& importer = findImporter("multi-arm-pendulum");
    const auto options = resolveChoices(importer, {{"arms", "double"}});
    const Imported imported = importer.read({folder, list.string(), "", options});
    ASSERT_EQ(imported.scenarios.size(), 2U);
    EXPECT_EQ(imported.scenarios[0].name, "double_03_5400_5900");
    EXPECT_NE(imported.scenarios[0].train, imported.scenarios[1].train);
    const Scenario s = loaded(imported.scenarios[0]);
    EXPECT_NEAR(s.duration, 0.5, 1e-12);
    // The column of rates is zero in this record: what the scenario starts with is fitted.
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(s.bodies[i].angularVelocity.z, middle.rates[i], 1e-3) << i;
        EXPECT_NEAR(
            std::remainder(2 * std::atan2(s.bodies[i].pose.orientation.z, s.bodies[i].pose.orientation.w) -
                               middle.angles[i],
                           2 * M_PI),
            0, 1e-5)
            << i;
    }
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    EXPECT_LT(study["parts"][0]["findings"][0]["at_most"].get<double>(), 6e-4)
        << "the model is as near as the rounding";
    const auto wrong = [&](const std::string& line) {
        writeText(list, "file,start,end\n" + line);
        try {
            importer.read({folder, list.string(), "", options});
            return std::string();
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
    };
    EXPECT_THAT(wrong("double_03.csv,5.4,6.2\n"), HasSubstr("5.0 .. 6.0"));
    EXPECT_THAT(wrong("double_03.csv,5.4,5.3\n"), HasSubstr("5.4 .. 5.3"));
    EXPECT_THAT(wrong("double_04.csv,5.4,5.5\n"), HasSubstr("double_04.csv"));
    EXPECT_THAT(wrong("double_03.csv,5.1,5.3\ndouble_03.csv,5.1,5.3\n"), HasSubstr("a second time"));
}

fs::path cart(const std::string& name, const std::string& pairs) {
    const auto folder = freshFolder(name);
    writeText(folder / "experimental-data-1.csv", "index,t1,t2\n" + pairs);
    writeText(folder / "experimental-data-2.csv",
              "description,value\nMassa ruota grande 1 (dx),1\nMassa ruota grande 2 (sx),1\n"
              "Massa carrello (privo di ruote grandi),4\nDiametro ruote piccole,0.05\n"
              "Diametro ruote grandi,0.1\n");
    return folder;
}

TEST(RollingCart, TheBoundIsTwoStandardErrorsOfTheRatio) {
    // Ratios 1.2 and 1.4: mean of the times 1 and 1.3, standard error 0.1.
    const Imported imported = importFrom("rolling-cart", cart("cart", "1,1,1.2\n2,1,1.4\n"));
    ASSERT_EQ(imported.scenarios.size(), 2U);
    const Scenario rest = loaded(imported.scenarios[0]), turning = loaded(imported.scenarios[1]);
    EXPECT_NEAR(rest.gravity.x, 2.0, 1e-12) << "1 m in 1 s";
    EXPECT_NEAR(norm(rest.gravity), 9.81, 1e-12);
    EXPECT_NEAR(turning.duration, 1.3, 1e-12);
    EXPECT_EQ(pairCoefficients(rest, 0, 1).friction, 0.0);
    EXPECT_GT(pairCoefficients(turning, 0, 1).friction, 0.1);
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    // 1 m (2 dt/t) for two standard errors, in widths of 0.1 m.
    EXPECT_NEAR(study["parts"][1]["findings"][0]["at_most"].get<double>(), 2 * 2 * 0.1 / 1.3 / 0.1, 1e-12);
    EXPECT_THAT(refusal("rolling-cart", cart("late", "1,1.3,1.2\n2,1,1.4\n")), HasSubstr("0 < t1 < t2"));
}

TEST(GazeboBoxes, PublishedErrorsBecomeBounds) {
    const auto folder = freshFolder("boxes");
    std::string text =
        "engine,dt,isComplex,collision,modelCount,linPositionErr_maxAbs,angMomentumErr_maxAbs,"
        "energyError_maxAbs,angPositionErr_mag_maxAbs\n";
    for (const char* engine : {"ode", "bullet"})
        for (const char* isComplex : {"0", "1"})
            text += std::string(engine) + ",0.001," + isComplex + ",1,1,0.049,0.013,0.0125,1e-7\n";
    writeText(folder / "BENCHMARK_boxes_dt.csv", text);
    const Imported imported = importFrom("gazebo-boxes", folder);
    ASSERT_EQ(imported.scenarios.size(), 2U);
    const Scenario complex = loaded(imported.scenarios[1]);
    EXPECT_EQ(complex.bodies[0].velocity, (Vec3{-2, 2, 8}));
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    const auto& energy = study["parts"][3]["findings"][2];
    ASSERT_EQ(energy["metric"], "energy_drift");
    // The scale is the kinetic energy at the end, 5 (4 + 4 + 90^2) + 8.55 J, instead of that at the
    // start, 5 * 72 + 8.55 J.
    EXPECT_NEAR(energy["at_most"].get<double>(), 1.02 * 0.0125 * 368.546 / 40548.546, 1e-7);
    writeText(folder / "BENCHMARK_boxes_dt.csv", text.substr(0, text.find("bullet")));
    EXPECT_THAT(refusal("gazebo-boxes", folder), HasSubstr("no line of bullet"));
}

/// Test with RIGOR_DATA: every scenario and study of a data set loads, and its references have solutions.
void expectWhole(const std::string& dataSet, const std::string& inside,
                 const std::map<std::string, std::string>& options, std::size_t least) {
    const fs::path folder = fs::path(std::getenv("RIGOR_DATA")) / inside;
    const Imported imported = importFrom(dataSet, folder, options);
    EXPECT_GE(imported.scenarios.size(), least);
    const auto out = freshFolder("whole-" + dataSet) / "out";
    writeImported(imported, "whole", out);
    for (const ImportedScenario& one : imported.scenarios)
        EXPECT_TRUE(makeReference(loaded(one))) << one.name;
    for (const ImportedStudy& study : imported.studies)
        EXPECT_FALSE(loadStudy(out / (study.name + ".json")).parts.empty());
    EXPECT_TRUE(fs::exists(out / "LICENSE"));
}

TEST(RealData, IsImportedWhole) {
    const char* data = std::getenv("RIGOR_DATA");
    if (data == nullptr || !fs::exists(fs::path(data) / "multi-arm-pendulum"))
        GTEST_SKIP()
            << "RIGOR_DATA names no folder with multi-arm-pendulum/ in it: measured data are not part "
               "of the repo";
    for (const char* arms : {"single", "double", "triple"})
        expectWhole("multi-arm-pendulum", "multi-arm-pendulum", {{"arms", arms}}, 4);
    expectWhole("cube-push", "cube-push", {}, 10);
    expectWhole("compound-pendulum", "lab-catania/compound-pendulum", {}, 10);
    expectWhole("incline-sliding", "lab-catania/incline-sliding", {}, 5);
    expectWhole("simple-pendulum", "lab-catania/simple-pendulum", {}, 6);
    expectWhole("rolling-cart", "lab-catania/rolling-cart", {}, 2);
    expectWhole("gazebo-boxes", "published/gazebo-boxes", {}, 2);
}

}  // namespace
}  // namespace rigor::validation::testing
