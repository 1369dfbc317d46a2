// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/run_site.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "validation/live/packet.hpp"
#include "validation/runner/describe.hpp"

namespace rigor::view {
namespace {

namespace fs = std::filesystem;
using validation::Packet;

results::TrajectoryFile trajectory() {
    results::TrajectoryFile t;
    t.scenario = "drop";
    t.spec = "ode";
    t.caseId = "c0ffee";
    t.dt = 0.1;
    for (int i = 0; i < 50; ++i) t.times.push_back(0.1 * i);
    for (const char* name : {"floor", "ball"}) {
        results::BodyChannels body;
        body.name = name;
        body.position = {"m", 3, {}};
        body.orientation = {"1", 4, {}};
        body.velocity = {"m/s", 3, {}};
        body.angularVelocity = {"rad/s", 3, {}};
        for (int i = 0; i < 50; ++i) {
            for (int k = 0; k < 3; ++k)
                body.position.values.push_back(i + 0.25 * k + (name[0] == 'b' ? 100 : 0));
            for (int k = 0; k < 4; ++k) body.orientation.values.push_back(k == 0 ? 1 : 0);
            for (int k = 0; k < 3; ++k) {
                body.velocity.values.push_back(-i);
                body.angularVelocity.values.push_back(i);
            }
        }
        t.bodies.push_back(body);
    }
    for (const int frame : {0, 7, 7, 20}) {
        results::ContactSample c;
        c.time = 0.1 * frame;
        c.bodyA = 0;
        c.bodyB = 1;
        c.normal[1] = 1;
        c.depth = 1e-3 * frame;
        c.normalImpulse = std::nan("");
        t.contacts.push_back(c);
    }
    return t;
}

class RunSites : public testing::Test {
  protected:
    void SetUp() override {
        run_ = scratch_.path() / "run";
        fs::create_directories(run_ / "plots");
        fs::create_directories(run_ / "trajectories");
        write(run_ / "index.html", "<p>report");
        write(run_ / "plots/a.svg", "<svg/>");
        write(run_ / "plots/a.pdf", "%PDF-");
        write(run_ / "results.sqlite", "store");
        write(run_ / ".hidden.csv", "hidden");
        write(scratch_.path() / "secret.csv", "secret");
        fs::create_symlink(scratch_.path() / "secret.csv", run_ / "leak.csv");
        results::writeTrajectory(run_ / "trajectories/c0ffee.h5", trajectory());
        site_ = std::make_unique<RunSite>(run_);
    }
    static void write(const fs::path& file, const char* text) { std::ofstream(file) << text; }
    Reply get(const std::string& path, std::map<std::string, std::string> query = {}) {
        return site_->answer({"GET", path, std::move(query), ""});
    }

    validation::ScratchFolder scratch_;
    fs::path run_;
    std::unique_ptr<RunSite> site_;
};

TEST_F(RunSites, FilesOfTheReportAreServed) {
    EXPECT_EQ(get("/").body, "<p>report");
    EXPECT_EQ(get("/index.html").type, "text/html; charset=utf-8");
    EXPECT_EQ(get("/plots/a.svg").body, "<svg/>");
    EXPECT_EQ(get("/plots/a.svg").type, "image/svg+xml");
    EXPECT_EQ(get("/plots/a.pdf").type, "application/pdf");
}

TEST_F(RunSites, NothingElseIs) {
    for (const char* path :
         {"/../secret.csv", "/plots/../../secret.csv", "/..", "//etc/passwd", "/etc/passwd", "/leak.csv",
          "/.hidden.csv", "/plots", "/plots/", "/results.sqlite", "/trajectories/c0ffee.h5", "/nothing.html",
          "/..\\secret.csv", "/plots/./a.svg/../../../secret.csv"})
        EXPECT_EQ(get(path).status, 404) << path;
    EXPECT_EQ(get(std::string("/index.html\0.svg", 16)).status, 404);
    EXPECT_EQ(site_->answer({"POST", "/", {}, "{}"}).status, 405);
}

TEST_F(RunSites, TrajectoriesComeInFullAndByRange) {
    const Packet all = Packet::decode(get("/trajectory/c0ffee").body);
    EXPECT_EQ(all.header["frames"], 50);
    EXPECT_EQ(all.header["count"], 50);
    EXPECT_EQ(all.header["bodies"][1], "ball");
    EXPECT_EQ(all.header["dt"], 0.1);
    const auto position = all.arrays.doubles("position");
    ASSERT_EQ(position.size(), 50u * 2 * 3);
    EXPECT_EQ(position[6 * 7], 7.0);
    EXPECT_EQ(position[6 * 7 + 4], 107.25) << "frame 7, ball, y";
    EXPECT_EQ(all.arrays.integers("contacts/frame"), (std::vector<std::int32_t>{0, 7, 7, 20}));
    EXPECT_TRUE(std::isnan(all.arrays.doubles("contacts/normal_impulse")[0]));
    EXPECT_EQ(all.header["contact_instants"], true);

    const Packet part = Packet::decode(get("/trajectory/c0ffee", {{"from", "7"}, {"count", "3"}}).body);
    EXPECT_EQ(part.header["from"], 7);
    EXPECT_EQ(part.arrays.doubles("time"), (std::vector<double>{0.1 * 7, 0.1 * 8, 0.1 * 9}));
    EXPECT_EQ(part.arrays.doubles("position").size(), 18u);
    EXPECT_EQ(part.arrays.doubles("position")[0], 7.0);
    EXPECT_EQ(part.arrays.integers("contacts/frame"), (std::vector<std::int32_t>{7, 7}));
    EXPECT_EQ(Packet::decode(get("/trajectory/c0ffee", {{"from", "99"}}).body).header["count"], 0);
}

TEST_F(RunSites, OnlyCasesOfTheRun) {
    for (const char* id : {"", "nothing", "../run/trajectories/c0ffee", "..", "c0ffee.h5", "c0ffee/"})
        EXPECT_EQ(get(std::string("/trajectory/") + id).status, 404) << id;
    EXPECT_THROW(get("/trajectory/c0ffee", {{"from", "-1"}}), std::invalid_argument);
    EXPECT_THROW(get("/trajectory/c0ffee", {{"count", "x"}}), std::invalid_argument);
    write(run_ / "trajectories/broken.h5", "no HDF5");
    EXPECT_THROW(get("/trajectory/broken"), std::runtime_error);
    EXPECT_EQ(get("/trajectory/c0ffee").status, 200);
}

TEST_F(RunSites, AFolderWithoutAReportIsNone) {
    EXPECT_THROW(RunSite(scratch_.path()), std::invalid_argument);
    EXPECT_THROW(RunSite("/nowhere/at/all"), std::invalid_argument);
}

}  // namespace
}  // namespace rigor::view
