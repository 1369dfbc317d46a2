// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The recorded motion: its samples come back bit for bit; between them it is held against a second way of
// interpolating (the rotation vector of the turn from one sample to the next); recordings that are broken are
// refused with what is wrong.
#include <gmock/gmock.h>

#include <cmath>

#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

using Numbers = std::vector<double>;
using ::testing::HasSubstr;

/// Five samples, not equally spaced, of a cube that tumbles; the sign of one quaternion is turned over.
struct Recording {
    Numbers times{0, 0.01, 0.025, 0.03, 0.05}, positions, orientations;
    Recording() {
        for (std::size_t k = 0; k < times.size(); ++k) {
            const double t = times[k];
            for (const double x : {0.3 + t, 0.1 - 7 * t * t, std::sin(40 * t) / 40}) positions.push_back(x);
            const double sign = k == 2 ? -1.0 : 1.0;
            const Quat q = fromAxisAngle({0.6, 0, 0.8}, 60 * t) * fromAxisAngle({0, 1, 0}, 0.4 + 20 * t);
            for (const double x : {q.w, q.x, q.y, q.z}) orientations.push_back(sign * x);
        }
    }
    Quat q(std::size_t k) const {
        const double* v = orientations.data() + 4 * k;
        return {v[0], v[1], v[2], v[3]};
    }
    Vec3 p(std::size_t k) const { return {positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]}; }
};

Scenario tossed(const Recording& r) {
    Scenario s = emptyScene(3, {0, -10, 0}, 0.05);
    addBox(s, "cube", {0.05, 0.05, 0.05}, 1, r.p(0));
    s.bodies[0].pose.orientation = r.q(0);
    setReference(s, "measured_motion",
                 {{"body", std::string("cube")},
                  {"times", r.times},
                  {"positions", r.positions},
                  {"orientations", r.orientations}});
    return s;
}

/// Angle between two attitudes, whatever the signs of their quaternions.
double angleBetween(Quat a, Quat b) {
    const Quat d = conjugate(a) * b;
    return 2 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}

TEST(MeasuredMotion, SamplesComeBackBitForBit) {
    const Recording r;
    const Scenario s = tossed(r);
    const auto reference = makeReference(s);
    EXPECT_EQ(reference->bodies(), std::vector<int>{0});
    EXPECT_NEAR(reference->validUntil(), 0.05, 1e-8);
    EXPECT_FALSE(reference->exact(0, 0.01).position) << "a measurement is not exact";
    for (std::size_t k = 0; k < r.times.size(); ++k) {
        const auto state = *reference->measured(0, r.times[k]);
        EXPECT_EQ(*state.position, r.p(k)) << k;
        EXPECT_LT(angleBetween(*state.orientation, r.q(k)), 1e-15) << k;
        EXPECT_FALSE(state.velocity);
    }
    EXPECT_EQ(*reference->measured(0, 1.0)->position, r.p(4)) << "held at the end";
}

TEST(MeasuredMotion, BetweenSamplesPositionIsLinearAndTheTurnUniformAndShort) {
    const Recording r;
    const Scenario s = tossed(r);
    const auto reference = makeReference(s);
    for (std::size_t k = 0; k + 1 < r.times.size(); ++k) {
        // A second way: the world rotation vector of the whole turn, a fraction of it in front.
        Quat turn = r.q(k + 1) * conjugate(r.q(k));
        if (turn.w < 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
        const Vec3 v{turn.x, turn.y, turn.z};
        const double angle = 2 * std::asin(norm(v));
        for (const double u : {0.1, 0.5, 0.75}) {
            const double t = r.times[k] + u * (r.times[k + 1] - r.times[k]);
            const auto state = *reference->measured(0, t);
            EXPECT_LT(norm(*state.position - (r.p(k) + u * (r.p(k + 1) - r.p(k)))), 1e-15);
            EXPECT_LT(angleBetween(*state.orientation, fromAxisAngle(v / norm(v), u * angle) * r.q(k)),
                      1e-12);
            EXPECT_NEAR(norm(*state.orientation), 1, 1e-15);
        }
    }
}

TEST(MeasuredMotion, PlanarRecordingsHaveAngles) {
    Scenario s = emptyScene(2, {0, -10, 0}, 1);
    addBox(s, "plate", {0.1, 0.2, 0.1}, 1, {1, 2, 0});
    setReference(s, "measured_motion",
                 {{"times", Numbers{0, 1}}, {"positions", Numbers{1, 2, 3, 6}}, {"angles", Numbers{0, 0.5}}});
    const auto reference = makeReference(s);
    const auto state = *reference->measured(0, 0.25);
    EXPECT_EQ(*state.position, (Vec3{1.5, 3, 0}));
    EXPECT_NEAR(angleAboutZ(*state.orientation), 0.125, 1e-15);
}

TEST(MeasuredMotion, SeveralBodiesWithAnglesAloneShareTheSamples) {
    Scenario s = emptyScene(2, {0, -10, 0}, 1);
    addBox(s, "upper", {0.1, 0.2, 0.1}, 1, {1, 2, 0});
    addBox(s, "lower", {0.1, 0.2, 0.1}, 1, {1, 1, 0});
    setReference(s, "measured_motion",
                 {{"bodies", std::vector<std::string>{"upper", "lower"}},
                  {"times", Numbers{0, 1}},
                  {"angles", Numbers{0, 0.01, 0.4, 0.81}}});
    const auto reference = makeReference(s);
    EXPECT_EQ(reference->bodies(), (std::vector<int>{0, 1}));
    EXPECT_FALSE(reference->measured(0, 0.5)->position);
    EXPECT_NEAR(angleAboutZ(*reference->measured(0, 0.5)->orientation), 0.2, 1e-15);
    EXPECT_NEAR(angleAboutZ(*reference->measured(1, 0.5)->orientation), 0.41, 1e-15);
    s.reference->parameters["angles"] = Numbers{0, 0.4};
    EXPECT_THROW(makeReference(s), std::invalid_argument);
    s.reference->parameters.erase("angles");
    EXPECT_THROW(makeReference(s), std::invalid_argument) << "neither positions nor angles";
}

/// The message of the refusal; "" when the recording is taken.
std::string refusal(const std::function<void(Recording&)>& change) {
    Recording r;
    const Scenario good = tossed(r);
    change(r);
    Scenario s = good;
    setReference(s, "measured_motion",
                 {{"times", r.times}, {"positions", r.positions}, {"orientations", r.orientations}});
    try {
        makeReference(s);
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(MeasuredMotion, BrokenRecordingsAreRefused) {
    EXPECT_EQ(refusal([](Recording&) {}), "");
    EXPECT_THAT(refusal([](Recording& r) { r.times[3] = r.times[2]; }), HasSubstr("expected rising times"));
    EXPECT_THAT(refusal([](Recording& r) { r.times[0] = 0.001; }), HasSubstr("expected 0"));
    EXPECT_THAT(refusal([](Recording& r) { r.times.clear(); }), HasSubstr("expected at least 2"));
    EXPECT_THAT(refusal([](Recording& r) { r.positions.pop_back(); }),
                HasSubstr("expected 15: 3 for each of the 5"));
    EXPECT_THAT(refusal([](Recording& r) { r.orientations[9] *= 1.1; }), HasSubstr("expected 1"));
    EXPECT_THAT(refusal([](Recording& r) { r.positions[0] += 0.1; }), HasSubstr("its recording at"));
    EXPECT_THAT(refusal([](Recording& r) {
                    for (std::size_t k = 0; k < 4; ++k) r.orientations[k] = k == 0;
                }),
                HasSubstr("another attitude"));
}

TEST(MeasuredMotion, ARecordingThatIsNotThereIsSaid) {
    Scenario s = tossed({});
    s.reference->parameters["positions"] = std::string("toss.csv");
    try {
        makeReference(s);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("the recording stands in the scenario"));
    }
}

}  // namespace
}  // namespace rigor::validation::testing
