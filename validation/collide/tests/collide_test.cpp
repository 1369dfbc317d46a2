// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Judgement of results whose errors are known, and children that misbehave.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "validation/collide/print.hpp"

namespace rigor::validation {
namespace {

using scenario::Vec3;

scenario::CollisionCase balls(double distance, double radiusA = 1.0, double radiusB = 0.5) {
    scenario::CollisionCase c;
    c.name = "balls";
    c.a.geometry = scenario::Sphere{radiusA};
    c.b.geometry = scenario::Sphere{radiusB};
    c.b.pose.position = {distance, 0, 0};
    return c;
}

scenario::CollisionCase boxes(Vec3 offset) {
    scenario::CollisionCase c;
    c.a.geometry = c.b.geometry = scenario::Box{{1, 1, 1}};
    c.b.pose.position = offset;
    return c;
}

CollideAnswer answer(double signedDistance, std::optional<Vec3> normal) {
    CollideAnswer a;
    a.answered = true;
    a.overlap = signedDistance < 0.0;
    a.signedDistance = signedDistance;
    a.normal = normal;
    return a;
}

CollideVerdict judged(const scenario::CollisionCase& c, CollideAnswer a) {
    const CollideTolerance tolerance;
    judgeAnswer(c, truthOf(c, tolerance), tolerance, a);
    return a.verdict;
}

TEST(Judge, ExactAnswersAreRight) {
    EXPECT_EQ(judged(balls(1.25), answer(-0.25, Vec3{1, 0, 0})), CollideVerdict::Ok);
    EXPECT_EQ(judged(balls(3.5), answer(2.0, std::nullopt)), CollideVerdict::Ok);
    EXPECT_EQ(judged(boxes({1.9, 0, 0}), answer(-0.1, Vec3{1, 0, 0})), CollideVerdict::Ok);
}

TEST(Judge, EachMistakeHasItsVerdict) {
    EXPECT_EQ(judged(balls(1.25), answer(0.25, std::nullopt)), CollideVerdict::WrongOverlap);
    EXPECT_EQ(judged(balls(3.5), answer(-0.1, Vec3{1, 0, 0})), CollideVerdict::WrongOverlap);
    EXPECT_EQ(judged(balls(1.25), answer(-0.25 * (1 + 3e-6), Vec3{1, 0, 0})), CollideVerdict::WrongDepth);
    EXPECT_EQ(judged(balls(1.25), answer(-0.25, Vec3{-1, 0, 0})), CollideVerdict::WrongNormal);
    EXPECT_EQ(judged(balls(1.25), answer(-0.25, Vec3{std::cos(1e-2), std::sin(1e-2), 0})),
              CollideVerdict::WrongNormal);
    EXPECT_EQ(judged(balls(1.25), answer(-0.25, std::nullopt)), CollideVerdict::NoNormal);
}

TEST(Judge, ErrorsAreTheOnesThatWereMade) {
    const auto c = balls(1.25);
    const CollideTolerance tolerance;
    CollideAnswer a = answer(-0.25 + 1e-4, Vec3{std::cos(1e-3), std::sin(1e-3), 0});
    judgeAnswer(c, truthOf(c, tolerance), tolerance, a);
    EXPECT_NEAR(a.distanceError.value(), 1e-4, 1e-15);
    EXPECT_NEAR(a.normalAngle.value(), 1e-3, 1e-12);
    // Spheres at the distance d overlap along a direction turned by t by rA + rB - d cos t: deeper by d (1 -
    // cos t).
    EXPECT_NEAR(a.normalExcess.value(), 1.25 * (1 - std::cos(1e-3)), 1e-12);
}

TEST(Judge, PointsAreMeasured) {
    const auto c = balls(1.25);  // surfaces at x = 1 and x = 0.75
    const CollideTolerance tolerance;
    const auto error = [&](Vec3 onA, Vec3 onB) {
        CollideAnswer a = answer(-0.25, Vec3{1, 0, 0});
        a.witnessA = onA;
        a.witnessB = onB;
        judgeAnswer(c, truthOf(c, tolerance), tolerance, a);
        return a.pointError.value();
    };
    EXPECT_NEAR(error({1, 0, 0}, {0.75, 0, 0}), 0, 1e-15);
    EXPECT_NEAR(error({0.9, 0, 0}, {0.65, 0, 0}), 0.1, 1e-15) << "both off their surfaces, the gap right";
    EXPECT_NEAR(error({0.75, 0, 0}, {1, 0, 0}), 0.5, 1e-15) << "exchanged";
    EXPECT_NEAR(error({std::cos(0.01), std::sin(0.01), 0}, {0.75, 0, 0}), 0.01, 1e-4) << "on another place";
}

TEST(Judge, KindsAreTallied) {
    CollideRun run;
    run.specs = {adapter::parseSpec("one"), adapter::parseSpec("two")};
    for (const char* kind : {"deep", "thin", "deep", ""}) {
        CollideCase c;
        if (*kind) c.query.tags = {kind, "box"};
        c.answers = {answer(-1, std::nullopt), answer(-1, std::nullopt)};
        c.answers[0].verdict = CollideVerdict::Ok;
        c.answers[1].verdict = CollideVerdict::WrongDepth;
        run.cases.push_back(c);
    }
    run.cases[2].answers[1].verdict = CollideVerdict::Unsupported;
    run.cases[2].answers[1].answered = false;
    const auto kinds = countKinds(run);
    ASSERT_EQ(kinds.size(), 2u);
    EXPECT_EQ(kinds[0].kind, "deep");
    EXPECT_EQ(kinds[0].queried, 2);
    EXPECT_EQ(kinds[0].answered, (std::vector<int>{2, 1}));
    EXPECT_EQ(kinds[0].wrong, (std::vector<int>{0, 1}));
    EXPECT_EQ(kinds[1].wrong, (std::vector<int>{0, 1}));
}

/// Both verdicts are right within the tolerance of touching; beyond it only one is.
TEST(Judge, TouchingMayBeCalledEitherWay) {
    for (const double gap : {-0.5e-9, 0.0, 0.5e-9}) {
        EXPECT_EQ(judged(boxes({2 + gap, 0, 0}), answer(-1e-12, Vec3{1, 0, 0})), CollideVerdict::Ok) << gap;
        EXPECT_EQ(judged(boxes({2 + gap, 0, 0}), answer(1e-12, std::nullopt)), CollideVerdict::Ok) << gap;
    }
    EXPECT_EQ(judged(boxes({2 - 1e-8, 0, 0}), answer(1e-12, std::nullopt)), CollideVerdict::WrongOverlap);
    EXPECT_EQ(judged(boxes({2 + 1e-8, 0, 0}), answer(-1e-12, Vec3{1, 0, 0})), CollideVerdict::WrongOverlap);
}

/// Every minimising direction is right: the second of a tie, any of a continuum.
TEST(Judge, SetsOfNormals) {
    EXPECT_EQ(judged(boxes({1.9, 1.9, 0}), answer(-0.1, Vec3{0, 1, 0})), CollideVerdict::Ok);
    EXPECT_EQ(judged(boxes({1.9, 1.8, 0}), answer(-0.1, Vec3{0, 1, 0})), CollideVerdict::WrongNormal);
    const Vec3 odd = Vec3{0.36, 0.48, 0.8};
    EXPECT_EQ(judged(balls(0.0), answer(-1.5, odd)), CollideVerdict::Ok) << "concentric: every direction";
}

/// The nearest sample of a continuum is no measure of a normal between two of them.
TEST(Judge, ANormalOfAContinuumHasAnAngleWhereItIsWrongAlone) {
    scenario::CollisionCase c;
    c.a.geometry = scenario::Cylinder{1.0, 2.0};
    c.b.geometry = scenario::Cylinder{1.0, 2.0};
    const CollideTolerance tolerance;
    const CollideTruth truth = truthOf(c, tolerance);
    ASSERT_TRUE(truth.continuum);
    const auto angleOf = [&](Vec3 normal) {
        CollideAnswer a = answer(truth.signedDistance, normal);
        judgeAnswer(c, truth, tolerance, a);
        return std::pair(a.verdict, a.normalAngle);
    };
    const double turn = 0.123456;
    const Vec3 side =
        norm(cross(truth.normals[0], truth.normals[1])) > 0.1 ? truth.normals[1] : truth.normals[2];
    const Vec3 axis = cross(truth.normals[0], side) / norm(cross(truth.normals[0], side));
    const Vec3 between = std::cos(turn) * truth.normals[0] + std::sin(turn) * cross(axis, truth.normals[0]);
    EXPECT_EQ(angleOf(between), std::pair(CollideVerdict::Ok, std::optional<double>()));
    const Vec3 tilted = (between + 0.5 * axis) / norm(between + 0.5 * axis);
    EXPECT_EQ(angleOf(tilted).first, CollideVerdict::WrongNormal);
    EXPECT_GT(angleOf(tilted).second.value_or(0.0), 0.4);
}

/// Eight roundings of the largest coordinate, 1.5 m here, are 1.4e-6 m.
TEST(Judge, SinglePrecisionIsJudgedByItsRounding) {
    const auto c = balls(1.0);
    const CollideTolerance tolerance, single = singleTolerance(c, tolerance);
    const CollideTruth truth = truthOf(c, tolerance);
    const auto verdict = [&](double off, const CollideTolerance& by) {
        CollideAnswer a = answer(-0.5 + off, Vec3{1, 0, 0});
        judgeAnswer(c, truth, by, a);
        return a.verdict;
    };
    EXPECT_EQ(verdict(1e-6, tolerance), CollideVerdict::WrongDepth);
    EXPECT_EQ(verdict(1e-6, single), CollideVerdict::Ok);
    EXPECT_EQ(verdict(2e-6, single), CollideVerdict::WrongDepth);
    auto far = c;
    far.a.pose.position = {100, 0, 0};
    EXPECT_NEAR(singleTolerance(far, tolerance).touch, 101 * 8 / std::pow(2.0, 23), 1e-12);
    EXPECT_EQ(singleTolerance(c, {1e-3, 1e-6, 0.1}).touch, 1e-3) << "a wider tolerance of the user stays";
}

TEST(Judge, ShapesTheOracleLacksAreJudgedByTheFile) {
    scenario::CollisionCase c;
    c.dimension = 2;  // a cylinder is no 2D shape
    c.a.geometry = scenario::Cylinder{1.0, 1.0};
    c.b.geometry = scenario::Cylinder{1.0, 1.0};
    c.b.pose.position = {0, 1.75, 0};
    EXPECT_EQ(judged(c, answer(-0.25, Vec3{0, 1, 0})), CollideVerdict::Undecided);
    c.expected.signedDistance = -0.25;
    c.expected.normals = {{0, 1, 0}};
    c.expected.accuracy = 1e-9;
    EXPECT_EQ(judged(c, answer(-0.25, Vec3{0, 1, 0})), CollideVerdict::Ok);
    EXPECT_EQ(judged(c, answer(-0.26, Vec3{0, 1, 0})), CollideVerdict::WrongDepth);
    EXPECT_EQ(judged(c, answer(-0.25, Vec3{1, 0, 0})), CollideVerdict::WrongNormal);
}

TEST(Judge, AFileThatContradictsTheOracleIsSaid) {
    auto c = balls(1.25);
    c.expected.signedDistance = -0.25;
    EXPECT_EQ(truthOf(c, {}).conflict, "");
    c.expected.signedDistance = -0.26;
    EXPECT_NE(truthOf(c, {}).conflict, "");
}

// -------------------------------------------------------------------------------------------- children

scenario::CollisionFile fileOfBalls(const std::vector<double>& depths) {
    scenario::CollisionFile file;
    file.file = "balls.json";
    for (const double depth : depths) {
        std::ostringstream text;
        text.precision(17);
        text
            << R"({"name": "d)" << file.cases.size()
            << R"(", "dimension": 3, "a": {"sphere": {"radius": 3}}, "b": {"sphere": {"radius": 1}, "position": [)"
            << 4.0 - depth << R"(, 0, 0]}})";
        file.cases.push_back(scenario::readCollisionCase(text.str()));
        file.cases.back().text = text.str();
    }
    return file;
}

CollideRun runDoubles(const std::vector<double>& depths, const char* engine, double seconds = 1.0) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/tests/doubles").c_str(), 1);
    CollideOptions options;
    options.binary = std::string(RIGOR_BINARY_DIR) + "/bin/rigor";
    options.jobs = 2;
    options.secondsPerQuery = seconds;
    const std::atomic<bool> never{false};
    return runCollide({fileOfBalls(depths)}, {adapter::parseSpec(engine)}, options, {}, never);
}

std::vector<CollideVerdict> verdicts(const CollideRun& run) {
    std::vector<CollideVerdict> list;
    for (const CollideCase& c : run.cases) list.push_back(c.answers.front().verdict);
    return list;
}

/// A query that kills its library costs that one result; those before and behind it are there.
TEST(Children, OneFatalQueryCostsOneAnswer) {
    const auto run = runDoubles({0.1, 2.5, 0.2, 1.5, 0.3, 0.75, 0.4, -1.0}, "double_auditor_moody");
    using V = CollideVerdict;
    EXPECT_EQ(verdicts(run),
              (std::vector<V>{V::Ok, V::Crashed, V::Ok, V::Crashed, V::Ok, V::Timeout, V::Ok, V::Ok}));
    EXPECT_NE(run.cases[1].answers[0].message.find("SIGABRT"), std::string::npos);
    EXPECT_NE(run.cases[3].answers[0].message.find("exit code 0"), std::string::npos);
    EXPECT_EQ(run.summaries[0].failed, 3);
    EXPECT_EQ(run.summaries[0].answered, 5);
}

TEST(Children, FaultyEnginesAreCaught) {
    const std::vector<double> depths{0.1, 0.2};
    EXPECT_EQ(verdicts(runDoubles(depths, "double_auditor"))[0], CollideVerdict::Ok);
    EXPECT_EQ(verdicts(runDoubles(depths, "double_auditor_flipped"))[0], CollideVerdict::WrongNormal);
    EXPECT_EQ(verdicts(runDoubles(depths, "double_auditor_deep"))[1], CollideVerdict::WrongDepth);
    EXPECT_EQ(verdicts(runDoubles(depths, "double_auditor_blind"))[1], CollideVerdict::WrongOverlap);
    EXPECT_EQ(verdicts(runDoubles({-0.1}, "double_auditor_anxious"))[0], CollideVerdict::WrongOverlap);
    EXPECT_EQ(verdicts(runDoubles(depths, "double_auditor_abort"))[1], CollideVerdict::Crashed);
}

TEST(Children, ManyCasesComeBackInOrder) {
    std::vector<double> depths;
    for (int i = 0; i < 2500; ++i) depths.push_back(0.4 * (i + 1) / 2500.0);
    const auto run = runDoubles(depths, "double_auditor");
    for (std::size_t i = 0; i < depths.size(); ++i)
        ASSERT_NEAR(run.cases[i].answers[0].signedDistance.value(), -depths[i], 1e-12) << i;
    EXPECT_EQ(run.summaries[0].answered, 2500);
    EXPECT_LT(run.summaries[0].depthErrorMax.value(), 1e-12);
}

TEST(Print, JsonHasRoundTripDigits) {
    const auto run = runDoubles({1.0 / 3.0}, "double_auditor");
    const auto json = nlohmann::json::parse(collideJson(run).dump());
    const auto& c = json.at("cases").at(0);
    EXPECT_EQ(c.at("answers").at(0).at("signed_distance").get<double>(),
              run.cases[0].answers[0].signedDistance.value());
    EXPECT_EQ(c.at("truth").at("source"), "oracle");
    EXPECT_EQ(c.at("answers").at(0).at("verdict"), "ok");
    EXPECT_EQ(json.at("summary").at(0).at("name"), "double_auditor");
    EXPECT_EQ(json.at("summary").at(0).at("precision"), "f64");
    EXPECT_NE(collideText(run, false).find("double_auditor"), std::string::npos);
}

}  // namespace
}  // namespace rigor::validation
