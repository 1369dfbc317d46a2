// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Imported laboratory experiments: synthetic tables with known results give the scene, the time and the
// bounds that the formulas give.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "validation/import/tests/imported.hpp"
#include "validation/import/tests/toss_folder.hpp"
#include "validation/references/reference.hpp"

namespace rigor::validation::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kAmplitude = 5 * kPi / 180;

nlohmann::json findingOf(const Imported& imported, std::size_t part) {
    return nlohmann::json::parse(imported.studies.at(0).text)["parts"][part]["findings"][0];
}

fs::path pivots(const std::string& name, const std::string& lines) {
    const auto folder = freshFolder(name);
    writeText(folder / "output-data-2.csv",
              "configuration,distance_CM,uncertainty_distance,uom_distance,time,uncertainty_time,uom_time\n" +
                  lines);
    return folder;
}

TEST(CompoundPendulum, PeriodAndPlaceMakeTheBound) {
    const Imported imported =
        importFrom("compound-pendulum",
                   pivots("compound", "d1,0.05,0.005,MTR,3,0.05,SEC\nd2,0.4,0.005,MTR,1.6,0.05,SEC\n"));
    ASSERT_EQ(imported.scenarios.size(), 2U);
    const Scenario s = loaded(imported.scenarios[1]);
    EXPECT_NEAR(s.duration, 1.6, 1e-12);
    EXPECT_NEAR(s.bodies[0].massProperties.inertia(2, 2), 1.0 / 12, 1e-12);
    EXPECT_EQ(s.bodies[0].pose.position, (Vec3{0, -0.4, 0}));
    EXPECT_NEAR(s.bodies[0].velocity.x, 0.4 * kAmplitude * 2 * kPi / 1.6, 1e-12);
    EXPECT_LT(norm(s.joints[0].anchorB - Vec3{0, 0.4, 0}), 1e-15) << "the axis is the origin";
    EXPECT_EQ(makeReference(s)->measured(0, 1.6)->position->x, 0.0);
    // Derivative of a rod's period by the place of its pivot, by differences.
    const auto period = [](double h) { return 2 * kPi * std::sqrt((1.0 / 12 + h * h) / (9.7996 * h)); };
    const double byPlace = (period(0.405) - period(0.395)) / 0.01 * 0.005 * 1.6 / period(0.4);
    const double late = 2 * std::hypot(0.05, byPlace);
    EXPECT_NEAR(findingOf(imported, 1)["at_most"].get<double>(),
                0.4 * kAmplitude * std::sin(2 * kPi * late / 1.6) / 0.02, 2e-3);
    EXPECT_TRUE(findingOf(imported, 0).contains("at_least")) << "the pivot that the authors leave out";
    EXPECT_TRUE(findingOf(imported, 2).contains("at_least")) << "a point mass";
    EXPECT_THAT(refusal("compound-pendulum", pivots("off", "d2,0.6,0.005,MTR,1.6,0.05,SEC\n")),
                HasSubstr("a pivot on the rod"));
}

TEST(SimplePendulum, TenPeriodsBecomeOne) {
    const auto folder = freshFolder("simple");
    writeText(folder / "output-data-1.csv",
              "l,length,period_s,g,uncertainty_g,uom,relative_error_g\nl1,0.4,12.7,9.8,0.2,MSK,2.04\n");
    const Imported imported = importFrom("simple-pendulum", folder);
    ASSERT_EQ(imported.scenarios.size(), 1U);
    const Scenario s = loaded(imported.scenarios[0]);
    EXPECT_NEAR(s.duration, 1.27, 1e-12);
    EXPECT_EQ(s.bodies[0].pose.position, (Vec3{0, -0.4, 0}));
    EXPECT_LT(s.bodies[0].massProperties.inertia(2, 2), 1e-3 * 0.1 * 0.4 * 0.4) << "a point, nearly";
    // Two uncertainties of g are two halves of the period's.
    EXPECT_NEAR(findingOf(imported, 0)["at_most"].get<double>(),
                0.4 * kAmplitude * std::sin(2 * kPi * 0.2 / 9.8) / 0.01, 2e-3);
    EXPECT_THAT(refusal("simple-pendulum", freshFolder("no-simple")), HasSubstr("output-data-1.csv"));
}

fs::path rail(const std::string& name, const std::string& times) {
    const auto folder = freshFolder(name);
    writeText(folder / "experimental-data-1.csv",
              "dimension,value,uncertainty,uom\nh2,0.4,0.001,MTR\nh1,1.0,0.001,MTR\ns1,2.0,0.001,MTR\n"
              "s2,1.0,0.001,MTR\n");
    writeText(folder / "experimental-data-2.csv", "index,mass,t,uncertainty,uom\n" + times);
    writeText(folder / "output-data-1.csv",
              "configuration,acceleration,uncertainty,uom,relative_error\nm1,2,0.1,MSK,5\n");
    writeText(folder / "output-data-2.csv",
              "configuration,coefficient_friction,uncertainty,relative_error\nm1,0.6,0.02,3\n");
    return folder;
}

TEST(InclineSliding, FrictionIsThatOfTheMeanTime) {
    const Imported imported =
        importFrom("incline-sliding", rail("rail", "1,m1,0.9,0.01,SEC\n2,m1,1.1,0.01,SEC\n"));
    ASSERT_EQ(imported.scenarios.size(), 1U);
    const Scenario s = loaded(imported.scenarios[0]);
    EXPECT_NEAR(s.duration, 1.0, 1e-12);
    // sin 0.6, cos 0.8: 1 m in 1 s is 2 m/s^2 = g (0.6 - 0.8 mu).
    EXPECT_NEAR(s.gravity.x, 0.6 * 9.7996, 1e-12);
    EXPECT_NEAR(pairCoefficients(s, 1, 0).friction, (0.6 - 2 / 9.7996) / 0.8, 1e-12);
    EXPECT_NEAR(makeReference(s)->measured(1, 1.0)->position->x, 1.0, 1e-12);
    EXPECT_NEAR(findingOf(imported, 0)["at_most"].get<double>(), 2 * 0.5 * 0.1 / 0.02, 1e-9);
    EXPECT_NEAR(findingOf(imported, 1)["at_least"].get<double>(), 2 * 0.5 * 0.02 * 9.7996 * 0.8 / 0.02, 1e-9);
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    EXPECT_EQ(study["parts"][1]["set"][0], "pairs.0.friction=0.6");
    EXPECT_THAT(refusal("incline-sliding", rail("fast", "1,m1,0.2,0.01,SEC\n")),
                HasSubstr("faster than without friction"));
    EXPECT_THAT(refusal("incline-sliding", rail("other", "1,m2,1,0.01,SEC\n")), HasSubstr("no line 'm2'"));
}

}  // namespace
}  // namespace rigor::validation::testing
