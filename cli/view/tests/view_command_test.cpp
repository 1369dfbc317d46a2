// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor view` as a user starts it: link, page, commands, Ctrl-C.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>

#include "cli/tests/program.hpp"
#include "cli/view/tests/http.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::view {
namespace {

using cli_test::rigor;
using nlohmann::json;
using test::Browser;
using validation::Packet;

/// A program that runs until it gets a signal.
class Program {
  public:
    explicit Program(std::vector<std::string> arguments) {
        int ends[2];
        EXPECT_EQ(pipe(ends), 0);
        pid_ = fork();
        if (pid_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            close(ends[0]);
            close(ends[1]);
            std::vector<char*> argv;
            arguments.insert(arguments.begin(), RIGOR_BINARY_DIR "/bin/rigor");
            for (auto& a : arguments) argv.push_back(a.data());
            argv.push_back(nullptr);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(ends[1]);
        out_ = fdopen(ends[0], "r");
        url_ = nextUrl();
    }
    ~Program() {
        fclose(out_);
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }
    const std::string& url() const { return url_; }
    /// Waits for the next link that it prints.
    std::string nextUrl() {
        char line[512];
        return fgets(line, sizeof line, out_) != nullptr ? json::parse(line).at("url").get<std::string>()
                                                         : "";
    }
    pid_t pid() const { return pid_; }
    /// Sends the signal and waits; the exit code.
    int end(int signal) {
        kill(pid_, signal);
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t pid_ = -1;
    FILE* out_ = nullptr;
    std::string url_;
};

/// Processes whose parent is this one.
std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> all;
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(parent) + "/task")) {
        std::ifstream in(task.path() / "children");
        for (pid_t pid = 0; in >> pid;) all.push_back(pid);
    }
    return all;
}

class View : public testing::Test {
  protected:
    /// Looks until every instance is at `step`.
    static Packet instancesAt(Browser& browser, std::size_t step) {
        std::uint64_t after = 0;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::chrono::steady_clock::now() < end) {
            const Packet packet = browser.frames(after, 1.0);
            bool there = true;
            for (const json& instance : packet.header["session"]["instances"])
                there = there && instance["state"] == "ready" && instance["step"] == step;
            if (there) return browser.frames(0, 0);
            after = packet.header["sequence"];
        }
        ADD_FAILURE() << "the instances did not come to step " << step;
        return {};
    }
    validation::ScratchFolder scratch_;
};

TEST_F(View, LiveFromTheLinkToCtrlC) {
    Program program({"view", "slide_and_stop", "--engines", "rigor,rigor:solver=xpbd", "--json", "--save-to",
                     scratch_.path().string()});
    Browser browser(program.url());
    ASSERT_EQ(browser.status(), 303);
    EXPECT_THAT(browser.get("/")->body, testing::HasSubstr("/live.js"));
    EXPECT_EQ(browser.get("/live.js")->status, 200);
    EXPECT_EQ(browser.get("/live.css")->get_header_value("Content-Type"), "text/css; charset=utf-8");
    EXPECT_EQ(browser.get("/results.sqlite")->status, 404);
    EXPECT_EQ(browser.get("/../../etc/passwd")->status, 404);
    const json engines = json::parse(browser.get("/api/engines")->body);
    ASSERT_FALSE(engines.empty());
    EXPECT_TRUE(
        std::any_of(engines.begin(), engines.end(), [](const json& e) { return e["name"] == "rigor"; }));
    for (const json& engine : engines) {
        ASSERT_GE(engine["presets"].size(), 2u) << engine["name"];
        for (const json& option : engine["options"])
            EXPECT_EQ(option["presets"].size(), engine["presets"].size()) << engine["name"] << option["key"];
    }
    EXPECT_GT(json::parse(browser.get("/api/scenarios")->body).size(), 10u);
    const json scene = json::parse(browser.get("/api/scene?instance=0")->body);
    EXPECT_EQ(scene["scenario"]["name"], "slide_and_stop");
    EXPECT_EQ(browser.get("/api/scene?instance=99")->status, 404);
    EXPECT_EQ(browser.get("/api/scene?lane=99")->status, 404) << "the name of version 0.1";
    EXPECT_EQ(browser.get("/api/scene?lane=0")->body, browser.get("/api/scene?instance=0")->body);
    EXPECT_EQ(browser.get("/api/frames?after=x")->status, 400);
    EXPECT_EQ(browser.post("/api/command", "[1]")->status, 400);
    EXPECT_EQ(browser.post("/api/command", R"({"command": "fly"})")->status, 422);
    EXPECT_EQ(browser.post("/api/command", R"({"command": "open", "scenario": "/etc/passwd"})")->status, 422);

    instancesAt(browser, 0);
    browser.command({{"command", "step"}, {"steps", 12}});
    const Packet frames = instancesAt(browser, 12);
    EXPECT_EQ(frames.header["frames"].size(), 2u);
    EXPECT_GT(frames.arrays.doubles("0/position")[3], 0.0);
    const auto instances = childrenOf(program.pid());
    EXPECT_EQ(instances.size(), 2u);
    EXPECT_EQ(program.end(SIGINT), 0);
    for (const pid_t pid : instances) EXPECT_NE(kill(pid, 0), 0) << "an instance outlived the program";
}

/// Lines of the debug drawing come with the frames of every engine: arrows of the velocities, normals and impulses that
/// the frame has, at the middle of the contact's points.
TEST_F(View, FramesComeWithTheirLines) {
    Program program({"view", "box_stack_2d", "--engines", "rigor,box2d", "--json", "--save-to",
                     scratch_.path().string()});
    Browser browser(program.url());
    instancesAt(browser, 0);
    browser.command({{"command", "step"}, {"steps", 12}});
    instancesAt(browser, 12);
    EXPECT_EQ(browser.get("/api/frames?after=0&lines=contact,normals")->status, 400);
    const auto answer = browser.get("/api/frames?after=0&lines=contact,normal,velocity,impulse,box,island");
    ASSERT_EQ(answer->status, 200);
    const Packet frames = Packet::decode(answer->body);
    const std::vector<std::string> kinds = frames.header["line_kinds"];
    const auto has = [&](const std::string& name) { return frames.arrays.doubles(name); };
    for (const std::string of : {"0/", "1/"}) {
        const auto ends = has(of + "lines/ends"), a = has(of + "contacts/carried_a"),
                   b = has(of + "contacts/carried_b"), normal = has(of + "contacts/normal"),
                   impulse = has(of + "contacts/normal_impulse"),
                   friction = has(of + "contacts/friction_impulse"), velocity = has(of + "velocity"),
                   position = has(of + "position");
        const auto names = frames.arrays.integers(of + "lines/names");
        ASSERT_FALSE(normal.empty());
        ASSERT_EQ(names.size(), ends.size() / 3);
        std::map<std::string, std::size_t> count;
        for (std::size_t i = 0; 2 * i < names.size(); ++i) {
            const std::string kind = kinds[static_cast<std::size_t>(names[2 * i])];
            const std::size_t k = count[kind]++, body = static_cast<std::size_t>(names[2 * i + 1]);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const double from = ends[6 * i + axis], way = ends[6 * i + 3 + axis] - from;
                const std::size_t c = 3 * k + axis;
                if (kind == "normal") {
                    EXPECT_NEAR(from, 0.5 * (a[c] + b[c]), 1e-12);
                    EXPECT_NEAR(way, normal[c], 1e-12);
                } else if (kind == "velocity") {
                    EXPECT_NEAR(from, position[3 * body + axis], 1e-12);
                    EXPECT_NEAR(way, velocity[3 * body + axis], 1e-12);
                }
            }
            if (kind != "impulse") continue;
            const std::size_t c = 3 * (count["normal"] - 1);  // index of the normal before
            for (std::size_t axis = 0; axis < 2; ++axis)
                EXPECT_NEAR(ends[6 * i + 3 + axis] - ends[6 * i + axis],
                            impulse[c / 3] * normal[c + axis] + friction[c + axis], 1e-9);
        }
        EXPECT_EQ(count["normal"], normal.size() / 3) << of;
        EXPECT_GT(count["impulse"], 0u) << of;
        EXPECT_EQ(frames.arrays.doubles(of + "points/at").size(), normal.size());
        EXPECT_GE(count["box"], 40u) << "ten boxes of four edges";
        EXPECT_EQ(count["island"], 10u) << "all boxes to the centre of the stack";
        EXPECT_EQ(count["outline"] + count["joint"], 0u);
    }
    EXPECT_EQ(program.end(SIGINT), 0);
}

/// A saved scenario is valid for every other command, and its run continues like the live run.
TEST_F(View, WhatIsSavedIsCheckedAndRuns) {
    Program program({"view", "slide_and_stop", "--engines", "rigor", "--json", "--dt", "1/240", "--save-to",
                     scratch_.path().string()});
    Browser browser(program.url());
    instancesAt(browser, 0);
    browser.command({{"command", "step"}, {"steps", 60}});
    instancesAt(browser, 60);
    const std::string file = browser.command({{"command", "save"}, {"instance", 0}, {"write", true}})["file"];
    browser.command({{"command", "step"}, {"steps", 60}});
    const auto expected = instancesAt(browser, 120).arrays.doubles("0/position");
    EXPECT_EQ(program.end(SIGTERM), 0);

    EXPECT_EQ(rigor("check '" + file + "'").code, 0);
    const auto run = rigor("run '" + file + "' --engine rigor --csv -", false);
    EXPECT_EQ(run.code, 0);
    std::istringstream lines(run.out);
    double x = 0.0, y = 0.0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::string t, body, px, py;
        std::getline(fields, t, ',');
        std::getline(fields, body, ',');
        std::getline(fields, px, ',');
        std::getline(fields, py, ',');
        if (body == "block" && std::abs(std::strtod(t.c_str(), nullptr) - 0.25) < 1e-9) {
            x = std::stod(px);
            y = std::stod(py);
        }
    }
    EXPECT_NEAR(x, expected[3], 1e-6);
    EXPECT_NEAR(y, expected[4], 1e-6);
}

TEST_F(View, ARecordedRunIsServedWithItsTrajectories) {
    const std::string folder = (scratch_.path() / "run").string();
    ASSERT_EQ(
        rigor("validate free_flight --engines rigor:preset=default --dt 1/60 -q --out '" + folder + "'").code,
        0);
    Program program({"view", folder, "--json"});
    Browser browser(program.url());
    EXPECT_THAT(browser.get("/")->body, testing::HasSubstr("<html"));
    EXPECT_EQ(browser.get("/results.csv")->status, 200);
    EXPECT_EQ(browser.get("/results.sqlite")->status, 404);
    EXPECT_EQ(browser.get("/%2e%2e/secret.csv")->status, 404);
    const auto file = *std::filesystem::directory_iterator(folder + "/trajectories");
    const Packet frames =
        Packet::decode(browser.get("/trajectory/" + file.path().stem().string() + "?from=3&count=2")->body);
    EXPECT_EQ(frames.header["scenario"], "free_flight");
    EXPECT_EQ(frames.arrays.doubles("time").size(), 2u);
    EXPECT_EQ(program.end(SIGINT), 0);
}

TEST_F(View, ASignalRenewsTheLink) {
    Program program({"view", "slide_and_stop", "--engines", "rigor", "--json"});
    Browser first(program.url());
    EXPECT_EQ(first.status(), 303);
    EXPECT_EQ(Browser(program.url()).status(), 403) << "used";
    kill(program.pid(), SIGUSR1);
    const std::string renewed = program.nextUrl();
    EXPECT_NE(renewed, program.url());
    EXPECT_EQ(Browser(renewed).status(), 303);
    EXPECT_EQ(first.get("/")->status, 403);
    EXPECT_EQ(program.end(SIGINT), 0);
}

TEST_F(View, MistakesAreSaidAtOnce) {
    EXPECT_EQ(rigor("view no_such_scenario").code, 2);
    EXPECT_EQ(rigor("view '" + scratch_.path().string() + "'").code, 2);
    EXPECT_EQ(rigor("view free_flight --engines no_engine").code, 2);
    EXPECT_EQ(rigor("view free_flight --dt 0").code, 2);
    EXPECT_EQ(rigor("view").code, 2);
    EXPECT_THAT(rigor("view --help").out, testing::HasSubstr("127.0.0.1"));
}

}  // namespace
}  // namespace rigor::view
