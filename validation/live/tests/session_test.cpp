// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/session.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "scenarios/loader/loader.hpp"
#include "validation/live/tests/live_fixtures.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

/// State of a page: the last state and the last frame of every instance.
class Viewer {
  public:
    explicit Viewer(Session& session) : session_(session) {}
    void look(double seconds = 0.05) {
        const Packet packet = session_.frames(after_, seconds);
        bytes_ = packet.encode().size();
        after_ = packet.header["sequence"];
        state_ = packet.header["session"];
        for (const json& frame : packet.header["frames"]) {
            frames_[frame["instance"]] = frame;
            const std::string instance = std::to_string(frame["instance"].get<int>());
            poses_[frame["instance"]] = packet.arrays.doubles(instance + "/position");
        }
    }
    bool until(const std::function<bool()>& condition) {
        return fixtures::eventually([&] {
            look();
            return condition();
        });
    }
    const json& instance(std::size_t i) const { return state_["instances"][i]; }
    bool allReady() const {
        return std::all_of(state_["instances"].begin(), state_["instances"].end(),
                           [](const json& instance) { return instance["state"] != "loading"; });
    }
    bool allAt(std::size_t step) const {
        return std::all_of(state_["instances"].begin(), state_["instances"].end(),
                           [&](const json& instance) { return instance["step"] == step; });
    }
    json state_;
    std::map<int, json> frames_;
    std::map<int, std::vector<double>> poses_;
    std::size_t bytes_ = 0;

  private:
    Session& session_;
    std::uint64_t after_ = 0;
};

class Sessions : public testing::Test {
  protected:
    void open(const std::string& specs, const std::string& text = fixtures::slidingBlock()) {
        fixtures::useEngines();
        SessionOptions options;
        options.binary = fixtures::childProgram();
        options.saveFolder = scratch_.path();
        options.limits.answerSeconds = 1.0;
        session_ = std::make_unique<Session>(options, text, adapter::parseSpecList(specs));
        viewer_ = std::make_unique<Viewer>(*session_);
        ASSERT_TRUE(viewer_->until([&] { return viewer_->allReady(); }));
    }
    json send(json request) { return session_->command(request); }

    ScratchFolder scratch_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<Viewer> viewer_;
};

TEST_F(Sessions, InstancesStepTogetherForwardsAndBack) {
    open("rigor,rigor:solver=tgs_soft");
    send({{"command", "step"}, {"steps", 7}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(7); }));
    const auto seven = viewer_->poses_;
    send({{"command", "step"}, {"steps", 5}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(12); }));
    EXPECT_NE(viewer_->poses_, seven);
    send({{"command", "back"}, {"steps", 5}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(7); }));
    EXPECT_EQ(viewer_->poses_, seven);
    send({{"command", "reset"}});
    EXPECT_TRUE(viewer_->until([&] { return viewer_->allAt(0); }));
}

TEST_F(Sessions, PlayFollowsRealTimeTimesTheSpeed) {
    open("rigor");
    send({{"command", "speed"}, {"factor", 0.5}});
    const auto begin = std::chrono::steady_clock::now();
    send({{"command", "play"}});
    std::this_thread::sleep_for(std::chrono::seconds(1));
    send({{"command", "pause"}});
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    viewer_->look(0);
    const double simulated = viewer_->state_["step"].get<double>() / 120;
    EXPECT_LE(simulated, 0.5 * wall + 0.02);
    EXPECT_GE(simulated, 0.2 * wall) << "a busy machine may be late, never early";
    const auto step = viewer_->state_["step"];
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    viewer_->look(0);
    EXPECT_EQ(viewer_->state_["step"], step) << "paused";
}

/// One engine aborts, one hangs, one leaves the numbers at step 5: each says so, the others play on.
TEST_F(Sessions, EnginesThatFailLeaveTheOthersAlone) {
    open("double_abort,double_hang,double_nan,double_free_flight,no_such_engine");
    send({{"command", "play"}});
    ASSERT_TRUE(viewer_->until(
        [&] { return viewer_->instance(3)["step"] > 120 && viewer_->instance(1)["state"] == "timeout"; }));
    EXPECT_EQ(viewer_->instance(0)["state"], "crashed");
    EXPECT_THAT(viewer_->instance(0)["message"].get<std::string>(), testing::HasSubstr("SIGABRT"));
    EXPECT_EQ(viewer_->instance(2)["state"], "non_finite");
    EXPECT_EQ(viewer_->instance(2)["step"], 5);
    EXPECT_EQ(viewer_->instance(3)["state"], "ready");
    EXPECT_EQ(viewer_->instance(4)["state"], "bad_input");
    EXPECT_THAT(viewer_->instance(4)["message"].get<std::string>(), testing::HasSubstr("no_such_engine"));
    EXPECT_THROW(send({{"command", "restart"}, {"instance", 3}}), CommandError) << "it runs";
    send({{"command", "reset"}});
    EXPECT_TRUE(viewer_->until([&] {
        return viewer_->instance(0)["state"] == "ready" && viewer_->instance(2)["state"] == "ready";
    })) << "a reset begins anew";
}

/// An engine that is started again stands at its last frame, with all others, and not once more at the step that ended it.
TEST_F(Sessions, ARestartLeadsToTheLastFrameBeforeTheEnd) {
    open("double_abort,double_free_flight");
    std::size_t last = 0;
    while (last < 100) {
        send({{"command", "step"}});
        ASSERT_TRUE(viewer_->until([&] {
            return viewer_->instance(1)["step"] == last + 1 &&
                   (viewer_->instance(0)["step"] == last + 1 || viewer_->instance(0)["state"] == "crashed");
        }));
        if (viewer_->instance(0)["state"] == "crashed") break;
        ++last;
    }
    ASSERT_LT(last, 100) << "it aborts";
    ASSERT_GT(last, 0);
    const std::vector<double> before = viewer_->poses_[0];
    send({{"command", "step"}, {"steps", 50}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->instance(1)["step"] == last + 51; }));
    send({{"command", "restart"}, {"instance", viewer_->instance(0)["id"]}});
    ASSERT_TRUE(
        viewer_->until([&] { return viewer_->instance(0)["state"] == "ready" && viewer_->allAt(last); }));
    EXPECT_EQ(viewer_->state_["step"], last);
    EXPECT_EQ(viewer_->state_["playing"], false);
    EXPECT_EQ(viewer_->poses_[0], before) << "the frame that it had";
    send({{"command", "step"}});
    EXPECT_TRUE(viewer_->until([&] {
        return viewer_->instance(0)["state"] == "crashed" && viewer_->instance(1)["step"] == last + 1;
    })) << "and dies again, beside one that goes on";
}

/// An engine that hangs is alive until its time is up: a reset that comes before is not lost with it.
TEST_F(Sessions, AResetWhileAnEngineIsDyingBeginsItAnew) {
    open("double_hang,double_free_flight");
    send({{"command", "step"}, {"steps", 40}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->instance(1)["step"] == 40; }));
    viewer_->look(0);
    ASSERT_EQ(viewer_->instance(0)["state"], "ready") << "it hangs, and its time is not up yet";
    const auto reached = viewer_->instance(0)["step"];
    const auto frames = viewer_->instance(0)["frames"].get<int>();
    ASSERT_LT(reached, 40);
    send({{"command", "reset"}});
    EXPECT_TRUE(viewer_->until([&] {
        return viewer_->instance(0)["state"] == "ready" && viewer_->instance(0)["frames"] > frames &&
               viewer_->allAt(0);
    })) << "a frame of a new process";
    // It is as able as at first, and hangs at the same step.
    send({{"command", "step"}, {"steps", 40}});
    EXPECT_TRUE(viewer_->until([&] { return viewer_->instance(0)["state"] == "timeout"; }));
    EXPECT_EQ(viewer_->instance(0)["step"], reached);
}

TEST_F(Sessions, StagesStopInsideAStep) {
    open("rigor,double_free_flight");
    EXPECT_TRUE(viewer_->instance(0)["has_stages"].get<bool>());
    EXPECT_FALSE(viewer_->instance(1)["has_stages"].get<bool>());
    send({{"command", "step"}, {"steps", 3}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(3); }));
    send({{"command", "stage"}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->frames_[0]["stage"]["done"] == "broad_phase"; }));
    EXPECT_TRUE(viewer_->frames_[0]["has_stages"].get<bool>());
    EXPECT_THROW(send({{"command", "save"}, {"instance", 0}}), CommandError) << "in the middle of a step";
    for (int i = 0; i < 20 && viewer_->instance(0)["step"] == 3; ++i) {
        const json before = viewer_->frames_[0]["stage"]["done"];
        send({{"command", "stage"}});
        ASSERT_TRUE(viewer_->until([&] { return viewer_->frames_[0]["stage"]["done"] != before; }));
    }
    EXPECT_TRUE(viewer_->until([&] { return viewer_->allAt(4); })) << "the other takes the step as a whole";
    send({{"command", "stage"}});
    send({{"command", "step"}});
    EXPECT_TRUE(viewer_->until([&] { return viewer_->allAt(5); }));
    EXPECT_FALSE(viewer_->frames_[0]["stage"]["in_step"].get<bool>());
}

/// Both branches are displayed: the original goes on unchanged, the branch from there with other physics.
TEST_F(Sessions, ABranchLeavesFromWhereItsOriginIs) {
    open("rigor");
    send({{"command", "step"}, {"steps", 40}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(40); }));
    const auto same = send({{"command", "branch"}, {"instance", 0}});
    const auto other = send({{"command", "branch"}, {"instance", 0}, {"options", {{"solver", "xpbd"}}}});
    const auto moon = send({{"command", "branch"}, {"instance", 0}, {"set", {"gravity=[0,-1.6,0]"}}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(40); }));
    EXPECT_EQ(viewer_->instance(2)["options"]["solver"], "xpbd");
    EXPECT_EQ(viewer_->instance(3)["branch_of"], 0);
    for (const json& branch : {same, other, moon})
        for (std::size_t i = 0; i < 9; ++i)
            EXPECT_NEAR(viewer_->poses_[branch["instance"]][i], viewer_->poses_[0][i], 1e-12);
    send({{"command", "step"}, {"steps", 60}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(100); }));
    const double height = viewer_->poses_[0][7], onMoon = viewer_->poses_[moon["instance"]][7];
    EXPECT_GT(onMoon, height + 0.3) << "the ball falls more slowly";
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(viewer_->poses_[same["instance"]][i], viewer_->poses_[0][i], 1e-4);
    send({{"command", "back"}, {"steps", 80}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->instance(0)["step"] == 20; }));
    EXPECT_TRUE(viewer_->until([&] { return viewer_->instance(3)["step"] == 40; })) << "not before its start";
    EXPECT_THROW(send({{"command", "branch"}, {"instance", 0}, {"options", {{"solver", "hope"}}}}),
                 CommandError);
    EXPECT_THROW(send({{"command", "branch"}, {"instance", 0}, {"set", {"bodies.unknown.mass=1"}}}),
                 CommandError);
    viewer_->look();
    EXPECT_EQ(viewer_->state_["instances"].size(), 4u) << "what could not be loaded is no instance";
    send({{"command", "remove"}, {"lane", moon["instance"]}});  // the name of version 0.1
    viewer_->look();
    EXPECT_EQ(viewer_->state_["instances"].size(), 3u);
}

TEST_F(Sessions, ABranchIsTakenFromAnInstanceThatPlays) {
    open("rigor");
    send({{"command", "play"}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->instance(0)["step"] > 10; }));
    send({{"command", "branch"}, {"instance", 0}, {"options", {{"solver", "tgs_soft"}}}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->state_["instances"].size() == 2; }));
    const int start = viewer_->instance(1)["start_step"];
    EXPECT_GT(start, 10);
    ASSERT_TRUE(viewer_->until([&] { return viewer_->instance(1)["step"] > start + 30; }));
    send({{"command", "pause"}});
    viewer_->look();
    const std::size_t step = viewer_->state_["step"];
    EXPECT_TRUE(viewer_->until([&] { return viewer_->allAt(step); })) << "both at one clock";
}

TEST_F(Sessions, ADragMovesTheBodyInEveryInstance) {
    open("rigor,double_free_flight");
    send({{"command", "drag"}, {"body", 2}, {"point", {0, 0, 0}}, {"target", {3, 5, 2}}});
    send({{"command", "step"}, {"steps", 240}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(240); }));
    for (const int instance : {0, 1}) {
        EXPECT_NEAR(viewer_->poses_[instance][6], 3.0, 0.05);
        EXPECT_EQ(viewer_->frames_[instance]["drag"]["body"], 2);
    }
    send({{"command", "release"}});
    EXPECT_TRUE(viewer_->until([&] { return !viewer_->frames_[0].contains("drag"); }));
    EXPECT_THROW(send({{"command", "drag"}, {"body", 2}, {"point", {0}}, {"target", {3, 5, 2}}}),
                 CommandError);
}

TEST_F(Sessions, WhatIsSavedCanBeLoadedAndRunsAlike) {
    open("rigor:solver=tgs_soft,substeps=2");
    send({{"command", "step"}, {"steps", 30}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(30); }));
    const json saved = send({{"command", "save"}, {"instance", 0}, {"write", true}});
    EXPECT_EQ(saved["name"], "slide_at_0.25s.json");
    const auto loaded = scenario::loadScenario(saved["file"].get<std::string>());
    EXPECT_EQ(loaded.text, saved["text"].get<std::string>());
    EXPECT_EQ(loaded.scenario.bodies[1].pose.position.x, viewer_->poses_[0][3]);
    EXPECT_FALSE(loaded.scenario.reference.has_value());
    EXPECT_THAT(loaded.scenario.description, testing::HasSubstr("tgs_soft"));
    EXPECT_THAT(loaded.text, testing::HasSubstr("\"substeps\": 2"));
    EXPECT_THROW(send({{"command", "save"}, {"instance", 0}, {"write", true}}), CommandError)
        << "a file that is there stays";
}

/// A client that polls rarely gets the newest frame and nothing else: what is kept and what is sent do not
/// grow with what was missed.
TEST_F(Sessions, ASlowViewerSkipsFrames) {
    open("rigor,double_free_flight");
    send({{"command", "speed"}, {"factor", 20}});
    send({{"command", "play"}});
    viewer_->until([&] { return viewer_->instance(1)["step"] > 50; });
    const std::size_t kept = session_->keptBytes();
    std::size_t least = 1 << 30, most = 0;
    for (int i = 0; i < 4; ++i) {
        const double before = viewer_->instance(0)["frames"];
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        viewer_->look();
        EXPECT_GT(viewer_->instance(0)["frames"].get<double>(), before + 3) << "frames were made meanwhile";
        EXPECT_EQ(viewer_->frames_.size(), 2u);
        least = std::min(least, viewer_->bytes_);
        most = std::max(most, viewer_->bytes_);
    }
    EXPECT_LT(most, 2 * least);
    EXPECT_LT(session_->keptBytes(), 2 * kept);
    EXPECT_GT(viewer_->instance(1)["step"].get<double>(), 1000) << "and the simulation was not held up";
}

TEST_F(Sessions, NonsenseIsRefused) {
    open("double_free_flight");
    for (const json& request :
         {json(nullptr), json::array(), json{{"command", "fly"}}, json{{"command", "step"}, {"steps", "x"}},
          json{{"command", "step"}, {"steps", 0}}, json{{"command", "step"}, {"steps", 1e12}},
          json{{"command", "speed"}, {"factor", -1}}, json{{"command", "speed"}, {"factor", "fast"}},
          json{{"command", "remove"}, {"instance", 77}}, json{{"command", "save"}, {"instance", 77}},
          json{{"command", "branch"}}, json{{"command", "stage"}}, json{{"command", "add"}, {"spec", ":::"}}})
        EXPECT_THROW(send(request), CommandError) << request;
    EXPECT_EQ(session_->scene(77), nullptr);
    EXPECT_EQ(session_->scene(0)["scenario"]["bodies"].size(), 3u);
}

TEST_F(Sessions, AnotherScenarioIsOpenedForTheSameEngines) {
    open("rigor,double_free_flight");
    send({{"command", "step"}, {"steps", 9}});
    ASSERT_TRUE(viewer_->until([&] { return viewer_->allAt(9); }));
    send({{"command", "branch"}, {"instance", 0}});
    session_->open(scenario::loadScenario(scenario::findScenario("free_flight_2d")).text);
    ASSERT_TRUE(
        viewer_->until([&] { return viewer_->state_["instances"].size() == 2 && viewer_->allReady(); }));
    EXPECT_EQ(viewer_->state_["scenario"], "free_flight_2d");
    EXPECT_EQ(viewer_->state_["step"], 0);
    EXPECT_EQ(viewer_->instance(0)["spec"], "rigor");
    EXPECT_TRUE(viewer_->allAt(0));
}

TEST_F(Sessions, NoMoreThanEightInstances) {
    open("double_free_flight");
    for (std::size_t i = 1; i < Session::kMaxInstances; ++i)
        send({{"command", "add"}, {"spec", "double_free_flight"}});
    EXPECT_THROW(send({{"command", "add"}, {"spec", "double_free_flight"}}), CommandError);
}

}  // namespace
}  // namespace rigor::validation
