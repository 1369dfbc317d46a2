// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Imported pushes: synthetic ones of closed form come back with the point of the hand that pushes, the friction
// of the slide and a finger on the hand's path.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/import/push_recording.hpp"
#include "validation/import/tests/imported.hpp"
#include "validation/import/tests/toss_folder.hpp"
#include "validation/references/reference.hpp"

namespace rigor::validation::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;

constexpr double kHalf = 0.0375, kFriction = 0.25, kGravity = 9.81, kRate = 100;

/// A hand that accelerates from rest at `start` and turns about y; from the contact on the cube moves with
/// its pushing point, from the largest speed on it slides alone and the hand stays where it then is.
struct SyntheticPush {
    double start = 2.0, acceleration = 0.5, reach = 0.5;  // [s], [m/s^2], [s]
    Vec3 point{0, -0.04, -0.14};                          // position of the hand
    double rear = 0.462;                                  // rear face of the cube at rest [m]

    double tip(double t) const {
        const double s = std::clamp(t - start, 0.0, reach);
        return 0.455 + 0.5 * acceleration * s * s;
    }
    double cube(double t) const {
        if (t <= start + reach) return std::max(rear, tip(t)) + kHalf;
        const double speed = acceleration * reach, braking = kFriction * kGravity;
        const double s = std::min(t - start - reach, speed / braking);
        return tip(t) + kHalf + speed * s - 0.5 * braking * s * s;
    }
    Quat turn(double t) const {
        return fromAxisAngle({0, 1, 0}, -0.2 * std::clamp(t - start, 0.0, 1.0)) *
               fromAxisAngle(Vec3{2, 2, 1} / 3.0, 2.0);
    }
    Vec3 hand(double t) const {
        const double lift = 0.1 * std::max(0.0, t - start - reach);
        return Vec3{tip(t), 0.003, 0.1 + lift} - rotate(turn(t), point);
    }
    std::string text() const {
        std::string all = "t,hx,hy,hz,hqw,hqx,hqy,hqz,cx,cy,cz,cqw,cqx,cqy,cqz\n";
        for (int k = 0; k < 450; ++k) {
            const double t = k / kRate;
            const Vec3 h = hand(t);
            const Quat q = turn(t);
            char line[400];
            std::snprintf(line, sizeof line,
                          "%.2f,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,0.003,0.039,1,0,0,0\n", t,
                          h.x, h.y, h.z, q.w, q.x, q.y, q.z, cube(t));
            all += line;
        }
        return all;
    }
};

fs::path pushes(const std::string& name) {
    const auto folder = freshFolder(name);
    writeText(folder / "push_0001.csv", SyntheticPush{}.text());
    SyntheticPush other;
    other.acceleration = 0.6;
    writeText(folder / "push_0004.csv", other.text());
    return folder;
}

TEST(Push, StagesPointAndFrictionComeBack) {
    const auto folder = pushes("push-stages");
    const Push one = readPush(folder / "push_0001.csv");
    EXPECT_NEAR(one.displacement, 0.455 + 0.0625 + 0.25 * 0.25 / (2 * kFriction * kGravity) - 0.462, 1e-9);
    // The cube has moved by 3 mm when the tip is at 0.465: sqrt(2 0.01/0.5) = 0.2 s after the start.
    EXPECT_NEAR((static_cast<double>(one.moved) + 20) / kRate, 2.2, 0.0101);
    EXPECT_NEAR((static_cast<double>(one.fastest) + 20) / kRate, 2.5, 0.0101);
    EXPECT_NEAR(slideDeceleration(one), kFriction * kGravity, 1e-4);
    const PushPoint point = fitPushPoint({one, readPush(folder / "push_0004.csv")}, kHalf);
    EXPECT_LT(norm(point.inHand - Vec3{0, -0.04, -0.14}), 1e-6);
    EXPECT_LT(point.rms, 1e-7);
    const auto path = pathOf(one, point.inHand);
    for (std::size_t k = 10; k < 220; ++k)
        EXPECT_NEAR(path[k].x, SyntheticPush{}.tip((static_cast<double>(k) + 20) / kRate), 1e-4) << k;
}

TEST(CubePush, TheFingerIsDrivenAlongTheHandsPath) {
    const Imported imported = importFrom("cube-push", pushes("push"));
    ASSERT_EQ(imported.scenarios.size(), 2U);
    EXPECT_EQ(imported.scenarios[0].name, "push_0001");
    const Scenario s = loaded(imported.scenarios[0]);
    EXPECT_NEAR(pairCoefficients(s, 2, 0).friction, kFriction, 1e-4);
    const auto body = static_cast<std::size_t>(findBody(s, "finger"));
    EXPECT_EQ(s.bodies[body].gravityScale, 0.0);
    // Integrate the impulses: where the finger's front is when the cube is fastest.
    Vec3 place = s.bodies[body].pose.position, velocity = s.bodies[body].velocity;
    double now = 0.0;
    const auto reference = makeReference(s);
    const double begin = 2.5 - [&] {  // the recording's time at the scenario's start
        for (double t = 0.0; t < s.duration; t += 0.01)
            if (reference->measured(2, t)->position->x > SyntheticPush{}.cube(2.5) - 1e-9) return t;
        return 0.0;
    }();
    for (const Event& event : s.events) {
        place += (event.time - now) * velocity;
        now = event.time;
        velocity += event.impulse / s.bodies[body].massProperties.mass;
        if (begin + now < 2.46) {  // times at which the path has no kink
            EXPECT_NEAR(place.x + 0.005, SyntheticPush{}.tip(begin + now), 1e-4) << now;
        }
        EXPECT_GE(place.z, 0.01 - 1e-9) << "clear of the table";
    }
    EXPECT_NEAR(reference->measured(2, s.duration)->position->x, SyntheticPush{}.cube(4.4), 1e-9);
    EXPECT_NEAR(reference->measured(2, 0.0)->position->z, kHalf, 1e-12) << "heights count from the table";
    ASSERT_EQ(imported.parameters.size(), 2U);
    EXPECT_EQ(imported.parameters[1].key, "pairs.1.friction");
    const auto study = nlohmann::json::parse(imported.studies.at(0).text);
    ASSERT_EQ(study["parts"][0]["scenarios"].size(), 1U) << "only what was not fitted on";
    EXPECT_NEAR(study["parts"][0]["findings"][0]["at_most"].get<double>(), 0.0175 / 0.075, 1e-12);
}

TEST(CubePush, WhatIsWrongIsSaid) {
    const auto folder = freshFolder("push-wrong");
    EXPECT_THAT(refusal("cube-push", folder), HasSubstr("no push_NNN.csv"));
    SyntheticPush still;
    still.acceleration = 0.01;
    writeText(folder / "push_0001.csv", still.text());
    EXPECT_THAT(refusal("cube-push", folder), HasSubstr("a cube that moves by"));
    SyntheticPush touching;
    touching.rear = 0.4555;
    writeText(folder / "push_0001.csv", touching.text());
    EXPECT_THAT(refusal("cube-push", folder), HasSubstr("never clear of the cube"));
    std::string text = SyntheticPush{}.text();
    text.replace(text.rfind("0.003,0.039,1,0,0,0"), 19, "0.003,0.039,2,0,0,0");
    writeText(folder / "push_0001.csv", text);
    EXPECT_THAT(refusal("cube-push", folder), HasSubstr("a quaternion of length 2"));
}

}  // namespace
}  // namespace rigor::validation::testing
