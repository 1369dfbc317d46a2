// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The event log against synthetic steps: what begins, goes on and ends, impacts seen in the velocities, an
// engine's reports on sleep and joints.
#include "validation/runner/event_log.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "scenarios/loader/loader.hpp"

namespace rigor::validation {
namespace {

scenario::Scenario scene() {
    return scenario::loadScenarioText(R"({
        "rigor": 1, "name": "log", "title": "A ball on a floor", "description": "For the event log.",
        "isolates": ["impact"], "source": "none", "dimension": 3, "gravity": [0, -10, 0], "duration": 1, "dt": [0.01],
        "materials": {"rubber": {"friction": 0.5, "restitution": 0.5}},
        "bodies": [
            {"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}, "material": "rubber"}]},
            {"name": "ball", "mass": 1, "position": [0, 1, 0],
             "shapes": [{"sphere": {"radius": 0.5}, "material": "rubber"}]}],
        "joints": [{"name": "rope", "type": "distance", "a": "world", "b": "ball", "anchor_a": [0, 2, 0],
                    "anchor_b": [0, 0, 0], "length": 1, "break_force": 100}],
        "observe": ["ball"]})",
                                      "log.json")
        .scenario;
}

std::vector<BodyState> states(double vy) {
    std::vector<BodyState> s(2);
    s[1].position = {0, 0.5, 0};
    s[1].velocity = {0, vy, 0};
    return s;
}

ContactPoint contact(double depth, double jn) {
    ContactPoint c;
    c.bodyA = 0;
    c.bodyB = 1;
    c.normal = {0, 1, 0};
    c.depth = depth;
    c.hasImpulse = true;
    c.normalImpulse = jn;
    c.frictionImpulse = {0.25, 0, 0};
    return c;
}

std::vector<std::string> lines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> list;
    for (std::string line; std::getline(in, line);) list.push_back(line);
    return list;
}

class EventLogTest : public testing::Test {
  protected:
    std::vector<std::string> step(EventLog& log, double vy, const std::vector<ContactPoint>& contacts) {
        return lines(log.step(0.01 * steps_++, states(vy), contacts, reports_));
    }
    const scenario::Scenario scene_ = scene();
    EventLog::EngineReports reports_;
    int steps_ = 0;
};

TEST_F(EventLogTest, ContactsBeginPersistAndEnd) {
    EventLog log(scene_, 0.01, LogWhat::Contacts);
    EXPECT_TRUE(step(log, -1, {}).empty());
    const std::string ids = " a_id=0 b_id=1 a_shape=0:half_space b_shape=0:sphere";
    // Two points: the deeper one gives normal and depth, impulses are added up.
    EXPECT_EQ(step(log, -1, {contact(1e-4, 1.5), contact(2e-3, 0.5)}),
              std::vector<std::string>{"t=0 step=0 begin contact a=floor b=ball n=(0,1,0) depth=0.002 jn=2 "
                                       "jt=(0.5,0,0) points=2 p=(0,0,0)" +
                                       ids});
    const auto persists = step(log, -1, {contact(1e-4, 0.5)});
    ASSERT_EQ(persists.size(), 1u);
    EXPECT_EQ(persists[0].find("t=0.01 step=1 persist contact a=floor b=ball n=(0,1,0) depth=0.0001 jn=0.5"),
              0u);
    EXPECT_EQ(step(log, -1, {}), std::vector<std::string>{"t=0.02 step=2 end contact a=floor b=ball" + ids +
                                                          " since=0 steps=2 jn_sum=2.5"});
    EXPECT_TRUE(step(log, -1, {}).empty());
    EXPECT_NE(step(log, -1, {contact(0, 0)}).at(0).find("begin"), std::string::npos) << "begins anew";
}

TEST_F(EventLogTest, WhatTheEngineDoesNotTellIsLeftOut) {
    EventLog log(scene_, 0.01, LogWhat::All);
    step(log, 0, {});
    ContactPoint untold = contact(1e-4, 0);
    untold.hasImpulse = false;
    const auto begin = step(log, 0, {untold});
    ASSERT_EQ(begin.size(), 1u);
    EXPECT_EQ(begin[0].find("jn="), std::string::npos);
    EXPECT_EQ(step(log, 0, {}).at(0).find("jn_sum"), std::string::npos);
}

TEST_F(EventLogTest, AnImpactIsASpeedOfApproachThatIsTakenAway) {
    EventLog log(scene_, 0.01, LogWhat::Events);
    step(log, -3, {});
    const auto hit = step(log, 1.5, {contact(0, 4.5)});
    ASSERT_EQ(hit.size(), 2u);
    EXPECT_EQ(hit[1].find("t=0 step=0 impact a=floor b=ball n=(0,1,0) vn=-3 vn_after=1.5 jn=4.5"), 0u)
        << hit[1];
    EXPECT_EQ(hit[0].find("t=0 step=0 begin contact"), 0u);
    // Rest, and a speed that one step of gravity makes, are none; nor is what goes on approaching.
    step(log, -0.1, {});
    EXPECT_EQ(step(log, 0, {contact(0, 1)}).size(), 1u) << "begin alone";
    EXPECT_TRUE(step(log, -3, {contact(0, 1)}).empty());
    EXPECT_TRUE(step(log, -2.9, {contact(0, 1)}).empty());
    // A contact that is there already may be hit as well.
    EXPECT_EQ(step(log, 0, {contact(0, 1)}).size(), 1u);
}

/// Contacts of the end of a step have its time, and its poses; what they take away is the approach before.
TEST_F(EventLogTest, ContactsOfTheStepsEndHaveItsTime) {
    reports_.contactInstant = adapter::ContactInstant::StepEnd;
    EventLog log(scene_, 0.01, LogWhat::Events);
    step(log, -3, {});
    const auto hit = step(log, 1.5, {contact(0, 4.5)});
    ASSERT_EQ(hit.size(), 2u);
    EXPECT_EQ(hit[0].find("t=0.01 step=1 begin contact"), 0u) << hit[0];
    EXPECT_EQ(hit[1].find("t=0.01 step=1 impact a=floor b=ball n=(0,1,0) vn=-3 vn_after=1.5 jn=4.5"), 0u)
        << hit[1];
    const auto left = step(log, 1.5, {});
    ASSERT_EQ(left.size(), 1u);
    EXPECT_NE(left[0].find("since=0.01 steps=1"), std::string::npos) << left[0];
}

TEST_F(EventLogTest, SleepAndBreakingAreReportedOnce) {
    EventLog log(scene_, 0.01, LogWhat::Events);
    bool asleep = false, holds = true;
    reports_ = {[&](int body) { return asleep && body == 1; }, [&](int) { return holds; }};
    EXPECT_TRUE(step(log, 0, {}).empty());
    asleep = true;
    holds = false;
    EXPECT_EQ(step(log, 0, {}), (std::vector<std::string>{"t=0.01 step=1 sleep body=ball id=1",
                                                          "t=0.01 step=1 break joint=rope a=world b=ball"}));
    EXPECT_TRUE(step(log, 0, {}).empty());
    asleep = false;
    EXPECT_EQ(step(log, 0, {}), std::vector<std::string>{"t=0.03 step=3 wake body=ball id=1"});
}

TEST_F(EventLogTest, EventsLeaveOutWhatGoesOnAndContactsWhatIsNoContact) {
    EventLog events(scene_, 0.01, LogWhat::Events), contacts(scene_, 0.01, LogWhat::Contacts);
    for (EventLog* log : {&events, &contacts}) step(*log, -3, {});
    EXPECT_EQ(step(contacts, 1, {contact(0, 4)}).size(), 1u);
    EXPECT_EQ(step(events, 1, {contact(0, 4)}).size(), 2u);
    EXPECT_EQ(step(contacts, 1, {contact(0, 4)}).size(), 1u);
    EXPECT_EQ(step(events, 1, {contact(0, 4)}).size(), 0u);
}

}  // namespace
}  // namespace rigor::validation
