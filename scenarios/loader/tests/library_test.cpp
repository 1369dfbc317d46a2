// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario library: every file loads, is what its place says, and starts without overlap.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {
namespace {

namespace fs = std::filesystem;

class Library : public testing::TestWithParam<LibraryEntry> {};

TEST_P(Library, LoadsAndIsComplete) {
    const LoadedScenario loaded = loadScenario(GetParam().file);
    const Scenario& s = loaded.scenario;
    EXPECT_EQ(s.name, GetParam().file.stem().string()) << "the file is called by its name";
    EXPECT_EQ(s.dimension == 2 ? "2d" : "3d", GetParam().file.parent_path().filename().string());
    EXPECT_GT(s.title.size(), 10u);
    EXPECT_GT(s.description.size(), 40u) << "says what it isolates and why";
    EXPECT_FALSE(s.isolates.empty());
    EXPECT_GT(s.source.size(), 10u);
    EXPECT_FALSE(s.metrics.empty());
    EXPECT_FALSE(s.observed.empty());
    EXPECT_GE(s.timeSteps.size(), 2u);
    for (const double dt : s.timeSteps)
        EXPECT_NEAR(s.duration / dt, std::round(s.duration / dt), 1e-9) << "whole steps";
}

TEST_P(Library, BodiesAreProper) {
    const Scenario s = loadScenario(GetParam().file).scenario;
    std::set<std::string> names;
    for (const Body& body : s.bodies) {
        EXPECT_TRUE(names.insert(body.name).second) << body.name;
        EXPECT_NEAR(norm(body.pose.orientation), 1.0, 1e-12);
        if (body.type == BodyType::Dynamic) {
            EXPECT_GT(body.massProperties.mass, 0.0);
            EXPECT_GT(body.massProperties.inertia(2, 2), 0.0);
        } else {
            EXPECT_EQ(body.massProperties.mass, 0.0);
        }
        if (s.dimension == 2) {
            EXPECT_EQ(body.pose.position.z, 0.0);
            EXPECT_EQ(body.pose.orientation.x, 0.0);
            EXPECT_EQ(body.pose.orientation.y, 0.0);
        }
    }
}

/// The text of a loaded scenario is the scenario: loading it again gives equal bodies to the last bit.
TEST_P(Library, RoundTrip) {
    for (const std::vector<std::string>& overrides : {std::vector<std::string>{}, {"title=again"}}) {
        const LoadedScenario first = loadScenario(GetParam().file, overrides);
        const LoadedScenario second = loadScenarioText(first.text, "again.json");
        ASSERT_EQ(first.scenario.bodies.size(), second.scenario.bodies.size());
        for (std::size_t i = 0; i < first.scenario.bodies.size(); ++i) {
            const Body &a = first.scenario.bodies[i], &b = second.scenario.bodies[i];
            EXPECT_EQ(a.name, b.name);
            EXPECT_EQ(a.pose, b.pose);
            EXPECT_EQ(a.velocity, b.velocity);
            EXPECT_EQ(a.angularVelocity, b.angularVelocity);
            EXPECT_EQ(a.massProperties.inertia, b.massProperties.inertia);
        }
        ASSERT_EQ(first.scenario.joints.size(), second.scenario.joints.size());
        EXPECT_EQ(first.scenario.timeSteps, second.scenario.timeSteps);
        EXPECT_EQ(first.scenario.gravity, second.scenario.gravity);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, Library, testing::ValuesIn(listScenarios()),
                         [](const auto& each) { return each.param.name; });

TEST(LibraryFolder, HoldsEveryJsonFile) {
    std::size_t files = 0;
    for (const char* folder : {"2d", "3d"})
        for (const auto& entry : fs::directory_iterator(libraryFolder() / folder))
            files += entry.path().extension() == ".json" ? 1u : 0u;
    EXPECT_EQ(listScenarios().size(), files) << "unreadable files would be left out of the list";
    EXPECT_GE(files, 24u);
}

TEST(Suites, NameScenariosOfTheLibrary) {
    const auto suites = listSuites();
    std::vector<std::string> names;
    for (const LibraryEntry& entry : suites) {
        names.push_back(entry.name);
        const Suite suite = loadSuite(entry.file);
        EXPECT_EQ(suite.name, entry.file.stem().string());
        EXPECT_FALSE(suite.scenarios.empty());
        for (const std::string& scenario : suite.scenarios)
            EXPECT_NO_THROW((void)loadScenario(findScenario(scenario))) << suite.name << ": " << scenario;
    }
    EXPECT_THAT(names, testing::IsSupersetOf({"smoke", "standard", "full"}));
    EXPECT_EQ(loadSuite(findSuite("full")).scenarios.size(), listScenarios().size());
}

TEST(FindScenario, ByNameByPathAndWithAHint) {
    const fs::path byName = findScenario("box_stack");
    EXPECT_EQ(findScenario(byName.string()), byName);
    try {
        (void)findScenario("box_stak");
        FAIL() << "found";
    } catch (const LoadError& error) {
        EXPECT_EQ(error.problems()[0].id, "scenario.not_found");
        EXPECT_STREQ(error.what(),
                     "box_stak: found no scenario or file of this name, expected a file, or a name of the "
                     "library; did you mean 'box_stack'? [scenario.not_found]");
    }
}

/// A name is the one that a file gives itself, wherever it stands and whatever it is called.
TEST(FindScenario, GoesByTheNameWithinTheFile) {
    const fs::path folder = fs::path(testing::TempDir()) / ("library-" + std::to_string(getpid()));
    const auto write = [&](const char* file, const char* name) {
        fs::create_directories((folder / file).parent_path());
        std::ofstream(folder / file) << R"({"name": ")" << name << R"(", "title": "a title"})";
    };
    write("2d/first.json", "second");
    write("3d/second.json", "first");
    write("3d/third.json", "third");
    write("bench/fourth.json", "fourth");
    const char* before = getenv("RIGOR_SCENARIOS");
    const std::string kept = before != nullptr ? before : "";
    setenv("RIGOR_SCENARIOS", folder.c_str(), 1);
    EXPECT_EQ(findScenario("first"), folder / "3d/second.json");
    EXPECT_EQ(findScenario("second"), folder / "2d/first.json");
    EXPECT_EQ(findScenario("third"), folder / "3d/third.json");
    EXPECT_EQ(findScenario("fourth"), folder / "bench/fourth.json");
    EXPECT_THROW((void)findScenario("fifth"), LoadError);
    if (before != nullptr)
        setenv("RIGOR_SCENARIOS", kept.c_str(), 1);
    else
        unsetenv("RIGOR_SCENARIOS");
    fs::remove_all(folder);
}

}  // namespace
}  // namespace rigor::scenario
