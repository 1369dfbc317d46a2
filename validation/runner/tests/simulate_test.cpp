// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/simulate.hpp"

#include <gmock/gmock.h>

#include "adapters/interface/registry.hpp"
#include "validation/runner/tests/doubles/free_flight.hpp"
#include "validation/runner/tests/fixtures.hpp"

namespace rigor::validation {
namespace {

using fixtures::load;
using fixtures::thrownBall;
using scenario::Vec3;

/// Settings of the double, every option at its default.
adapter::Settings plainSettings() {
    return adapter::resolveSettings(adapter::parseSpec("double_free_flight"),
                                    doubles::DoubleEngine<doubles::FreeFlightWorld>());
}

Simulation fly(const scenario::Scenario& s, double dt, const LiveOptions& options = {}) {
    doubles::FreeFlightWorld world(s, dt, plainSettings());
    return simulate(s, dt, world, options);
}

TEST(Simulate, StepsAreTheDurationRoundedToWholeSteps) {
    scenario::Scenario s;
    s.duration = 1.0;
    EXPECT_EQ(stepCount(s, 1.0 / 60.0), 60u);
    EXPECT_EQ(stepCount(s, 1.0 / 240.0), 240u);
    EXPECT_EQ(stepCount(s, 0.3), 3u);
    EXPECT_EQ(stepCount(s, 5.0), 1u);
}

TEST(Simulate, LargeRunsAreRecordedWithAStride) {
    EXPECT_EQ(recordingStride(1000, 10), 1);
    EXPECT_EQ(recordingStride(1200, 1000), 3) << "1.2e6 states";
    EXPECT_EQ(recordingStride(1000, 1000), 4) << "at least 3, and 4 divides the steps";
    EXPECT_EQ(recordingStride(1001, 1000), 3) << "1001 = 7 * 11 * 13 has no divisor from 3 to 6";
}

/// x_n = x0 + n h v0 + h^2 g n (n + 1) / 2: every frame, its time, and the state of the last step.
TEST(Simulate, RecordsTheTrajectoryOfTheScheme) {
    const auto s = load(thrownBall("ball")).first;
    const double h = 0.0078125;
    const Simulation run = fly(s, h);
    const Trajectory& t = run.trajectory;
    EXPECT_EQ(run.steps, 64u);
    ASSERT_EQ(t.frames(), 65u);
    for (std::size_t n = 0; n < t.frames(); ++n) {
        const double k = n;
        EXPECT_EQ(t.times[n], k * h);
        const Vec3 x = Vec3{1, 2, 3} + k * h * Vec3{4, 5, -6} + 0.5 * h * h * k * (k + 1) * s.gravity;
        EXPECT_NEAR(norm(t.state(n, 1).position - x), 0.0, 1e-12) << n;
    }
    EXPECT_EQ(run.nonFinite, "");
}

TEST(Simulate, HashesTheLastStateAndNothingElse) {
    const auto s = load(thrownBall("ball")).first;
    LiveOptions sparse;
    sparse.stride = 9;
    EXPECT_EQ(fly(s, 0.01).stateHash, fly(s, 0.01, sparse).stateHash) << "recording changes nothing";
    auto moved = s;
    moved.bodies[1].pose.position.z = std::nextafter(3.0, 4.0);
    EXPECT_NE(fly(s, 0.01).stateHash, fly(moved, 0.01).stateHash) << "one bit in, another hash";
}

TEST(Simulate, CallsTheObserverAfterEveryStep) {
    const auto s = load(thrownBall("ball")).first;
    std::vector<double> times;
    LiveOptions options;
    options.stride = 10;
    options.onStep = [&](double time, std::span<const BodyState> states, const std::vector<ContactPoint>&) {
        times.push_back(time);
        EXPECT_EQ(states.size(), 2u);
    };
    const Simulation run = fly(s, 0.01, options);
    ASSERT_EQ(times.size(), 51u);
    EXPECT_EQ(times[50], 50 * 0.01);
    EXPECT_EQ(run.trajectory.frames(), 6u);
}

/// One contact after every step, as deep as there were steps.
class CountingWorld : public doubles::FreeFlightWorld {
  public:
    CountingWorld(const scenario::Scenario& s, double dt, adapter::ContactInstant instant)
        : FreeFlightWorld(s, dt, plainSettings()), instant_(instant) {}
    void readContacts(std::vector<ContactPoint>& contacts) const override {
        contacts.assign(1, ContactPoint{});
        contacts[0].depth = static_cast<double>(steps_);
    }
    adapter::ContactInstant contactInstant() const override { return instant_; }

  private:
    adapter::ContactInstant instant_;
};

/// Contacts stand at the frame where their step began or, if the world says so, ended, whatever the stride is.
TEST(Simulate, ContactsStandAtTheirInstant) {
    const auto s = load(thrownBall("ball")).first;
    for (const auto instant : {adapter::ContactInstant::StepStart, adapter::ContactInstant::StepEnd}) {
        const bool atEnd = instant == adapter::ContactInstant::StepEnd;
        LiveOptions options;
        options.stride = 10;
        CountingWorld world(s, 0.01, instant);
        const Trajectory t = simulate(s, 0.01, world, options).trajectory;
        EXPECT_EQ(t.contactInstant, instant);
        ASSERT_EQ(t.contacts.size(), 6u);
        for (std::size_t f = 0; f < 6; ++f) {
            const std::size_t without = atEnd ? 0 : 5;
            ASSERT_EQ(t.contacts[f].size(), f == without ? 0u : 1u) << f;
            if (f == without) continue;
            EXPECT_EQ(t.contacts[f][0].depth, 10.0 * f + (atEnd ? 0.0 : 1.0)) << f;
        }
    }
}

/// A constant force is part of the step: the velocity after n steps is v0 + n h (g + F / m).
TEST(Simulate, ForcesActInEveryStep) {
    auto s = load(thrownBall("ball")).first;
    s.forces = {scenario::ConstantForce{1, {1, 0, 0}, {}, 0.0, 1e300}};
    const Simulation run = fly(s, 0.01);
    const Vec3 v = Vec3{4, 5, -6} + 0.5 * (s.gravity + Vec3{0.5, 0, 0});
    EXPECT_NEAR(norm(run.trajectory.states.back().velocity - v), 0.0, 1e-12);
}

class NanWorld : public doubles::FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override {
        if (steps_ == 7) states_[1].angularVelocity.z = std::nan("");
    }
};

TEST(Simulate, StopsAtTheFirstStateThatIsNotFinite) {
    const auto s = load(thrownBall("ball")).first;
    NanWorld world(s, 0.0078125, plainSettings());
    const Simulation run = simulate(s, 0.0078125, world, {});
    EXPECT_EQ(run.steps, 7u);
    EXPECT_THAT(run.nonFinite, testing::HasSubstr("ball is not finite at t = 0.0546"));
    EXPECT_EQ(run.trajectory.frames(), 8u);
}

class SlowWorld : public doubles::FreeFlightWorld {
  public:
    using FreeFlightWorld::FreeFlightWorld;
    void misbehave() override { usleep(steps_ % 10 == 0 ? 20000 : 2000); }
    adapter::StepCounters counters() const override {
        adapter::StepCounters c;
        c.contacts = steps_ % 2 == 0 ? 4 : 0;
        c.phaseSeconds["collide"] = 0.25 * steps_;
        return c;
    }
};

/// Nine steps of 2 ms for one of 20 ms: median and tenth say 2, the total says 190.
TEST(Simulate, TimesStepsAndPhases) {
    const auto s = load(thrownBall("ball")).first;
    SlowWorld world(s, 0.01, plainSettings());
    const Simulation run = simulate(s, 0.01, world, {});
    ASSERT_EQ(run.timings.size(), 2u);
    const auto& step = run.timings[0];
    EXPECT_EQ(step.phase, "step");
    EXPECT_EQ(step.samples, 50);
    EXPECT_GE(step.p10, 0.002);
    EXPECT_LT(step.median, 0.015);
    EXPECT_GE(step.total, 0.19);
    EXPECT_EQ(step.meanContacts, 2.0);
    ASSERT_TRUE(step.low && step.high);
    EXPECT_LE(*step.low, step.median);
    EXPECT_GE(*step.high, step.median);
    const auto& collide = run.timings[1];
    EXPECT_EQ(collide.phase, "collide");
    EXPECT_NEAR(collide.total, 0.25 * 50 * 51 / 2, 1e-9);
    EXPECT_NEAR(collide.median, 0.25 * 25.5, 1e-9);
    EXPECT_NEAR(collide.p90, 0.25 * (1 + 0.9 * 49), 1e-9);
    // The bounds are the 18th and the 33rd of fifty samples: P(Bin(50, 1/2) < 18) = 0.0164, < 19: 0.0325.
    ASSERT_TRUE(collide.low && collide.high);
    EXPECT_NEAR(*collide.low, 0.25 * 18, 1e-9);
    EXPECT_NEAR(*collide.high, 0.25 * 33, 1e-9);
}

}  // namespace
}  // namespace rigor::validation
