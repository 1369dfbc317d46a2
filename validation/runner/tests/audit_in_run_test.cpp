// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of the contacts that acted in a run against the oracle: recorded contacts of known faults, each
// detected by the number meant for it. Two spheres fly through each other; the contacts of a step are those
// of the poses it began at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "validation/results/trajectory_file.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using results::ContactSample;
using results::TrajectoryFile;
using scenario::Vec3;

constexpr double kStep = 1.0 / 64, kRadius = 0.25;
constexpr int kFrames = 65;

void set(double (&into)[3], Vec3 v) {
    into[0] = v.x;
    into[1] = v.y;
    into[2] = v.z;
}

/// Turns a unit vector by an angle [rad], about any axis across it.
void turn(double (&v)[3], double angle) {
    const Vec3 n{v[0], v[1], v[2]};
    const Vec3 other = std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = (other - dot(other, n) * n) / norm(other - dot(other, n) * n);
    set(v, std::cos(angle) * n + std::sin(angle) * across);
}

class InRun : public fixtures::RunnerTest {
  protected:
    InRun() : scenario_(fixtures::load(fixtures::crossingBalls()).first) {
        file_.scenario = scenario_.name;
        file_.dt = kStep;
        for (const auto& b : scenario_.bodies) {
            file_.bodies.push_back({b.name, {"m", 3, {}}, {"1", 4, {}}, {"m/s", 3, {}}, {"rad/s", 3, {}}});
            for (int k = 0; k < kFrames; ++k) {
                const Vec3 x = b.pose.position + k * kStep * b.velocity;
                auto& channels = file_.bodies.back();
                channels.position.values.insert(channels.position.values.end(), {x.x, x.y, x.z});
                channels.orientation.values.insert(channels.orientation.values.end(), {1, 0, 0, 0});
                channels.velocity.values.insert(channels.velocity.values.end(), {0, 0, 0});
                channels.angularVelocity.values.insert(channels.angularVelocity.values.end(), {0, 0, 0});
            }
        }
        for (int k = 0; k < kFrames; ++k) file_.times.push_back(k * kStep);
        for (int k = 0; k + 1 < kFrames; ++k)
            for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) addTruth(k, a, b);
    }

    Vec3 at(int frame, int body) const {
        const double* p = &file_.bodies[body].position.values[3 * static_cast<std::size_t>(frame)];
        return {p[0], p[1], p[2]};
    }
    /// The contact that the step from frame k to k + 1 should act upon.
    void addTruth(int k, int a, int b) {
        const Vec3 other = at(k, b);
        const Vec3 between = a == 0 ? Vec3{0, other.y, 0} : other - at(k, a);
        const double distance = norm(between), depth = (a == 0 ? kRadius : 2 * kRadius) - distance;
        if (depth <= 0.0) return;
        const Vec3 n = between / distance;
        ContactSample c;
        c.time = file_.times[k];
        c.bodyA = a;
        c.bodyB = b;
        c.depth = depth;
        set(c.normal, n);
        set(c.pointA, a == 0 ? Vec3{other.x, 0, other.z} : at(k, a) + kRadius * n);
        set(c.pointB, other - kRadius * n);
        file_.contacts.push_back(c);
    }

    results::AuditRow audited() {
        const auto path = scratch_.path() / "run.h5";
        writeTrajectory(path, file_);
        return inRunRow(scenario_, findQueries(scenario_, "run", path));
    }

    scenario::Scenario scenario_;
    TrajectoryFile file_;
};

TEST_F(InRun, ContactsAsTheyShouldBe) {
    const auto row = audited();
    EXPECT_EQ(row.auditor, kInRun);
    EXPECT_GE(row.frames, 10);
    EXPECT_GT(row.overlapping, 10);
    EXPECT_EQ(row.missed + row.spurious + row.undecided, 0) << row.worst;
    EXPECT_LT(row.normalErrorMax.value(), 1e-9);
    EXPECT_LT(row.depthErrorMax.value(), 1e-12);
    EXPECT_LT(row.pointErrorMax.value(), 1e-12);
}

TEST_F(InRun, TheContactsOfAStepLaterAreNoticed) {
    for (auto& c : file_.contacts) c.time += kStep;
    EXPECT_GT(audited().depthErrorMax.value(), 1e-3);
}

TEST_F(InRun, FlippedNormals) {
    for (auto& c : file_.contacts)
        for (double& x : c.normal) x = -x;
    const auto row = audited();
    EXPECT_NEAR(row.normalErrorMedian.value(), std::numbers::pi, 1e-9);
    EXPECT_LT(row.depthErrorMax.value(), 1e-12);
}

/// One contact of one step, between the frames that are sampled.
TEST_F(InRun, AWrongNormalOfASingleStepIsFound) {
    const auto path = scratch_.path() / "run.h5";
    writeTrajectory(path, file_);
    std::set<double> sampled;
    for (const auto& q : findQueries(scenario_, "run", path).queries) sampled.insert(q.time);
    const auto between = std::find_if(file_.contacts.begin(), file_.contacts.end(), [&](const auto& c) {
        return !sampled.contains(c.time) && c.depth > 1e-3;
    });
    ASSERT_NE(between, file_.contacts.end());
    const double angle = 0.3;  // [rad]
    turn(between->normal, angle);
    const auto row = audited();
    EXPECT_NEAR(row.normalErrorMax.value(), angle, 1e-9);
    EXPECT_LT(row.normalErrorMedian.value(), 1e-9);
}

/// The deepest point of a pair has its normal, another one an old one.
TEST_F(InRun, TheWorstPointIsAFindingOfItsOwn) {
    const auto contact = std::find_if(file_.contacts.begin(), file_.contacts.end(),
                                      [](const auto& c) { return c.depth > 1e-2; });
    ASSERT_NE(contact, file_.contacts.end());
    ContactSample old = *contact;
    old.depth = -1e-3;
    turn(old.normal, 0.5);
    file_.contacts.insert(contact + 1, old);
    const auto row = audited();
    EXPECT_LT(row.normalErrorMax.value(), 1e-9);
    const auto findings = nlohmann::json::parse(row.findings);
    ASSERT_EQ(findings.size(), 1u) << findings;
    EXPECT_EQ(findings[0]["what"], "point_normal");
    EXPECT_EQ(findings[0]["unit"], "rad");
    EXPECT_NEAR(findings[0]["error"], 0.5, 1e-9);
    EXPECT_NEAR(findings[0]["said"]["depth"], -1e-3, 1e-12);
    EXPECT_EQ(findings[0]["step"], std::lround(old.time / kStep));
}

TEST_F(InRun, TheCurveOfNormalErrorsShowsWhenTheyWereWrong) {
    const double from = 0.5;  // [s]
    for (auto& c : file_.contacts)
        if (c.time > from - 0.5 * kStep)
            for (double& x : c.normal) x = -x;
    const auto path = scratch_.path() / "run.h5";
    writeTrajectory(path, file_);
    const auto errors = normalErrors(findQueries(scenario_, "run", path));
    ASSERT_GE(errors.size(), 10u);
    EXPECT_LT(errors.front().first, from);
    EXPECT_GE(errors.back().first, from);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        EXPECT_GT(errors[i].first, i > 0 ? errors[i - 1].first : -1.0);
        EXPECT_NEAR(errors[i].second, errors[i].first < from ? 0.0 : std::numbers::pi, 1e-9);
    }
}

TEST_F(InRun, DepthsWithAMargin) {
    for (auto& c : file_.contacts) c.depth += 0.04;
    EXPECT_NEAR(audited().depthErrorMedian.value(), 0.04, 1e-12);
}

TEST_F(InRun, ForgottenAndInvented) {
    std::erase_if(file_.contacts, [](const ContactSample& c) { return c.bodyA == 1; });
    const auto forgotten = audited();
    EXPECT_GT(forgotten.missed, 3);
    EXPECT_EQ(forgotten.spurious, 0);
    EXPECT_NE(forgotten.worst.find("left|right"), std::string::npos) << forgotten.worst;
    EXPECT_NE(forgotten.worst.find("(missed)"), std::string::npos) << forgotten.worst;

    ContactSample invented;
    invented.bodyA = 1;
    invented.bodyB = 2;
    invented.depth = 0.01;
    invented.normal[0] = 1;
    file_.contacts.clear();
    for (int k = 0; k + 1 < kFrames; ++k) {
        invented.time = k * kStep;
        file_.contacts.push_back(invented);
    }
    const auto far = audited();
    EXPECT_GT(far.spurious, 5);
    for (auto& c : file_.contacts) c.depth = -0.01;  // keeps its distance: nothing is claimed
    EXPECT_EQ(audited().spurious, 0);
}

/// A finding has what a drawing of it needs: the engine's normal, the exact one, their angle, witness points.
TEST_F(InRun, TheWorstOfEachKindIsKeptWithTheExactSolution) {
    EXPECT_EQ(audited().findings, "");
    const double tilt = 0.2, deeper = 0.03;  // [rad/s], [m/s]
    for (auto& c : file_.contacts) {
        turn(c.normal, tilt * c.time);
        c.depth += deeper * c.time;
    }
    const auto row = audited();
    const auto found = nlohmann::json::parse(row.findings);
    ASSERT_EQ(found.size(), 2u) << row.findings;
    for (const auto& f : found) {
        const bool ofNormal = f.at("what") == "normal";
        EXPECT_EQ(f.at("unit"), ofNormal ? "rad" : "m");
        const double time = f.at("time");
        EXPECT_GT(time, 0.5) << "the worst is late";
        EXPECT_EQ(f.at("step"), std::lround(time / kStep));
        EXPECT_NEAR(f.at("error").get<double>(), (ofNormal ? tilt : deeper) * time, 1e-9);
        const auto& exact = f.at("exact");
        const auto vec = [](const nlohmann::json& j) { return Vec3{j.at(0), j.at(1), j.at(2)}; };
        const Vec3 across = vec(exact.at("pointB")) - vec(exact.at("pointA"));
        const double distance = exact.at("distance");
        EXPECT_NEAR(norm(across - distance * vec(exact.at("normals").at(0))), 0.0, 1e-9);
        EXPECT_NEAR(dot(vec(f.at("said").at("normal")), vec(exact.at("normals").at(0))),
                    std::cos(tilt * time), 1e-9);
        EXPECT_NEAR(f.at("said").at("depth").get<double>() + distance, deeper * time, 1e-9);
    }
}

TEST_F(InRun, AMissedOverlapIsKeptAtItsDeepest) {
    double deepest = 0.0;
    for (const auto& c : file_.contacts)
        if (c.bodyA == 1) deepest = std::max(deepest, c.depth);
    std::erase_if(file_.contacts, [](const ContactSample& c) { return c.bodyA == 1; });
    const auto found = nlohmann::json::parse(audited().findings);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].at("what"), "missed");
    EXPECT_TRUE(found[0].at("said").is_null());
    EXPECT_EQ(found[0].at("bodies"), (nlohmann::json{1, 2}));
    EXPECT_GT(found[0].at("error").get<double>(), 0.0);
    EXPECT_LE(found[0].at("error").get<double>(), deepest + 1e-12);
}

/// No result is given for frames whose contacts were not stored.
TEST_F(InRun, FramesWithoutStoredContactsAreNotQueried) {
    file_.contactStride = 4;
    std::erase_if(file_.contacts,
                  [](const ContactSample& c) { return std::lround(c.time / kStep) % 4 != 0; });
    const auto thinned = audited();
    EXPECT_GT(thinned.overlapping, 5);
    EXPECT_EQ(thinned.missed, 0) << thinned.worst;
}

/// Several steps between frames change nothing: contacts belong to the poses of the frame they are stored at.
TEST_F(InRun, FramesSeveralStepsApartAreQueried) {
    file_.stride = 3;
    const auto row = audited();
    EXPECT_GT(row.overlapping, 10);
    EXPECT_EQ(row.missed + row.spurious, 0) << row.worst;
    EXPECT_LT(row.normalErrorMax.value(), 1e-9);
}

/// The worst place names the step, which identifies the frame where six digits of its time do not.
TEST_F(InRun, TheWorstPlaceNamesItsStep) {
    file_.stride = 2;
    for (auto& c : file_.contacts)
        for (double& x : c.normal) x = -x;
    const auto row = audited();
    const auto at = row.worst.find(", step ");
    ASSERT_NE(at, std::string::npos) << row.worst;
    const double time = std::stod(row.worst.substr(row.worst.find(" at t=") + 6));
    EXPECT_NEAR(std::stol(row.worst.substr(at + 7)) * (kStep / 2), time, 1e-4) << row.worst;
}

/// The contact that was measured is the deepest, wherever it stands among those of its frame.
TEST_F(InRun, TheWorstPlaceNamesItsContact) {
    std::vector<ContactSample> doubled;
    for (const ContactSample& c : file_.contacts) {
        doubled.push_back(c);
        doubled.back().depth /= 2.0;
        doubled.push_back(c);
        for (double& x : doubled.back().normal) x = -x;
    }
    file_.contacts = std::move(doubled);
    const auto row = audited();
    EXPECT_NEAR(row.normalErrorMax.value(), std::numbers::pi, 1e-9);
    const auto at = row.worst.find(", contact ");
    ASSERT_NE(at, std::string::npos) << row.worst;
    const double time = std::stol(row.worst.substr(row.worst.find(", step ") + 7)) * kStep;
    const auto first =
        std::find_if(file_.contacts.begin(), file_.contacts.end(),
                     [&](const ContactSample& c) { return std::abs(c.time - time) < kStep / 2; });
    const auto& named = *(first + std::stol(row.worst.substr(at + 10)));
    EXPECT_NEAR(named.time, time, kStep / 2) << "of the same frame";
    EXPECT_LT(named.depth, 2.0 * first->depth + 1e-12);
    EXPECT_EQ(std::stol(row.worst.substr(at + 10)) % 2, 1) << "the deeper one of its pair: " << row.worst;
}

/// Contacts of the ends of steps are those of the frames there: the first frame has none, and is not held against the engine.
TEST_F(InRun, ContactsOfTheStepsEndAreJudgedAtItsFrame) {
    const bool touches = file_.contacts.front().time == 0.0;
    file_.contactsAtStepEnd = true;
    std::erase_if(file_.contacts, [](const ContactSample& c) { return c.time == 0.0; });
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) addTruth(kFrames - 1, a, b);
    const auto row = audited();
    EXPECT_TRUE(touches) << "else frame 0 would show nothing";
    EXPECT_GE(row.frames, 10);
    EXPECT_EQ(row.missed + row.spurious + row.undecided, 0) << row.worst;
    EXPECT_LT(row.normalErrorMax.value(), 1e-9);
}

/// A file of an older format does not store which poses its contacts belong to: they are not judged.
TEST_F(InRun, ContactsOfAnUnknownInstantAreNotJudged) {
    EXPECT_GT(audited().queries, 0);
    file_.contactInstantsKnown = false;
    const auto path = scratch_.path() / "run.h5";
    writeTrajectory(path, file_);
    const auto found = findQueries(scenario_, "run", path);
    const auto row = inRunRow(scenario_, found);
    EXPECT_EQ(row.queries, 0);
    EXPECT_NE(row.note, "");
    EXPECT_GT(oracleRow(found).queries, 0) << "the poses are queried all the same";
}

}  // namespace
}  // namespace rigor::validation
