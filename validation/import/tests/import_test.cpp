// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Imported tosses: synthetic flights of closed form come back with their state; what is wrong with a folder is
// said with file and line; with RIGOR_DATA the real tosses, held against their own description.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <numeric>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/overrides.hpp"
#include "validation/import/importer.hpp"
#include "validation/import/recording.hpp"
#include "validation/import/tests/toss_folder.hpp"
#include "validation/metrics/metric.hpp"

namespace rigor::validation::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;

Imported importTosses(const fs::path& folder, const std::map<std::string, std::string>& options = {},
                      const std::string& select = "all", const std::string& train = "") {
    const ImporterEntry& importer = findImporter("cube-toss");
    return importer.read({folder, select, train, resolveChoices(importer, options)});
}

Scenario loaded(const ImportedScenario& s) {
    return loadScenarioText(s.text, s.name).scenario;
}

const Body& cubeOf(const Scenario& s) {
    return s.bodies[findBody(s, "cube")];
}

double angleBetween(Quat a, Quat b) {
    return norm(turnBetween(a, b));
}

// ---------------------------------------- initial state
TEST(Start, BothRulesFindTheStateOfAFlightOfClosedForm) {
    const Flight flight;
    const auto folder = freshFolder("flight");
    writeText(folder / "toss_007.csv", tossText(flight.lines(30)));
    writeText(folder / "toss_009.csv", tossText([] {
                  Flight other;
                  other.p0.x = 0.5;
                  other.p0.z = 0.16;
                  return other.lines(30);
              }()));
    for (const char* start : {"rule", "flight"}) {
        const Imported imported = importTosses(folder, {{"start", start}});
        ASSERT_EQ(imported.scenarios.size(), 2U);
        const Scenario s = loaded(imported.scenarios[0]);
        // The centre falls to 0.0512 sqrt(3) = 0.0887 m at frame 19: 0.15 + 0.1 t - 4.807 t^2.
        constexpr std::size_t kStart = 16;
        const TossLine truth = flight.at(kStart / 148.0);
        const Body& cube = cubeOf(s);
        EXPECT_LT(norm(cube.pose.position - truth.p), 1e-9) << start;
        EXPECT_LT(angleBetween(cube.pose.orientation, truth.q), 1e-9) << start;
        EXPECT_LT(norm(cube.angularVelocity - rotate(truth.q, truth.wBody)), 1e-6) << start;
        EXPECT_LT(std::hypot(cube.velocity.x - 0.8, cube.velocity.y - 0.3), 1e-8) << start;
        // The rule takes the vertical speed one frame before its pose.
        const double late = std::string(start) == "rule" ? 9.614 / 148 : 0.0;
        EXPECT_NEAR(cube.velocity.z, truth.v.z + late, 1e-8) << start;
        EXPECT_EQ(s.gravity, (Vec3{0, 0, -9.614}));
        EXPECT_NEAR(s.duration, 13 / 148.0, 1e-12);
    }
}

TEST(Start, TheRecordingIsTheReferenceBitForBit) {
    const auto folder = freshFolder("reference");
    const Flight flight;
    writeText(folder / "toss_001.csv", tossText(flight.lines(30)));
    const Scenario s = loaded(importTosses(folder).scenarios[0]);
    const auto reference = makeReference(s);
    for (int k = 0; k < 14; ++k) {
        const TossLine truth = flight.at((k + 16) / 148.0);
        const auto state = *reference->measured(findBody(s, "cube"), k / 148.0);
        EXPECT_LT(norm(*state.position - truth.p), 1e-11);  // twelve digits in the file
        EXPECT_LT(angleBetween(*state.orientation, truth.q), 1e-11);
    }
}

TEST(Start, UnitsChangeWhatTheyPromise) {
    const auto folder = freshFolder("units");
    writeText(folder / "toss_001.csv", tossText(Flight{}.lines(30)));
    const auto box = [](const Scenario& s) {
        return std::get<Box>(cubeOf(s).shapes[0].geometry).halfExtents.x;
    };
    const Scenario own = loaded(importTosses(folder).scenarios[0]);
    const Scenario scaled = loaded(importTosses(folder, {{"units", "rescaled"}}).scenarios[0]);
    const Scenario published = loaded(importTosses(folder, {{"units", "published"}}).scenarios[0]);
    EXPECT_EQ(box(own), 0.0512);
    EXPECT_EQ(box(scaled), 0.0524);
    EXPECT_EQ(box(published), 0.0524);
    EXPECT_EQ(published.gravity.z, -9.81);
    const double factor = 0.0524 / 0.0512;
    EXPECT_LT(norm(cubeOf(scaled).pose.position - factor * cubeOf(own).pose.position), 1e-12);
    // The same cube: moment of inertia in units of m (half width)^2.
    const auto ratio = [&](const Scenario& s) {
        return cubeOf(s).massProperties.inertia(0, 0) / (box(s) * box(s));
    };
    EXPECT_NEAR(ratio(own), ratio(published), 1e-12);
    for (const Scenario* s : {&own, &scaled, &published}) EXPECT_FALSE(s->description.empty());
}

// ---------------------------------------- parts
TEST(Selection, TrainAndTestAreSeparateAndListsAreChecked) {
    const auto folder = freshFolder("parts");
    for (int id : {0, 2, 4, 6, 8, 10}) {
        Flight flight;
        flight.p0.z += 0.001 * id;
        writeText(folder / "tosses" / ("toss_00" + std::to_string(id) + ".csv"), tossText(flight.lines(30)));
    }
    const auto count = [](const Imported& imported) {
        return std::count_if(imported.scenarios.begin(), imported.scenarios.end(),
                             [](const auto& s) { return s.train; });
    };
    EXPECT_EQ(count(importTosses(folder)), 3) << "half of them without a list";
    EXPECT_EQ(count(importTosses(folder, {}, "all", "0.34")), 2);
    writeText(folder / "selected.csv", "id,why\n2,spin\n10,slide\n");
    const Imported listed = importTosses(folder, {}, "all", (folder / "selected.csv").string());
    EXPECT_EQ(count(listed), 2);
    EXPECT_TRUE(listed.scenarios[1].train && listed.scenarios[5].train);
    EXPECT_EQ(importTosses(folder, {}, (folder / "selected.csv").string()).scenarios.size(), 2U);

    const auto out = freshFolder("parts-out") / "mine";
    writeImported(listed, "mine", out);
    EXPECT_EQ(loadSuite(out / "train.json").scenarios.size(), 2U);
    EXPECT_EQ(loadSuite(out / "test.json").scenarios.size(), 4U);
    EXPECT_TRUE(isSuiteFile(out / "test.json"));
    EXPECT_FALSE(isSuiteFile(out / "toss_002.json"));
    EXPECT_THAT(readTextFile(out / "fit.json"), HasSubstr("pairs.0.restitution"));
    EXPECT_THROW(writeImported(listed, "mine", out), std::invalid_argument) << "nothing is overwritten";

    const auto refused = [&](const std::string& list) {
        writeText(folder / "list.csv", list);
        try {
            importTosses(folder, {}, (folder / "list.csv").string());
            return std::string();
        } catch (const LoadError& error) {
            return std::string(error.what());
        }
    };
    EXPECT_THAT(refused("id\n2\n3\n"),
                HasSubstr("list.csv:3: (document): found recording 3, expected one of the 6"));
    EXPECT_THAT(refused("id\n2\n4\n2\n"),
                HasSubstr("list.csv:4: (document): found recording 2 a second time"));
    EXPECT_THAT(refused("name\n2\n"), HasSubstr("expected a column 'id'"));
    EXPECT_THAT(refused("id\n2.5\n"), HasSubstr("expected a whole number"));
}

// ---------------------------------------- broken folders
std::string refusalOfEdit(const std::function<void(std::string&)>& edit) {
    const auto folder = freshFolder("broken");
    std::string text = tossText(Flight{}.lines(30));
    edit(text);
    writeText(folder / "toss_003.csv", text);
    try {
        importTosses(folder);
        return "";
    } catch (const LoadError& error) {
        return error.what();
    }
}

/// Replaces field `column` of line `line` (1 is the header).
auto put(int line, int column, const std::string& value) {
    return [=](std::string& text) {
        std::size_t at = 0;
        for (int k = 1; k < line; ++k) at = text.find('\n', at) + 1;
        for (int k = 0; k < column; ++k) at = text.find(',', at) + 1;
        text.replace(at, text.find_first_of(",\n", at) - at, value);
    };
}

TEST(Broken, FilesAreRefusedWithFileLineFoundAndExpected) {
    EXPECT_EQ(refusalOfEdit([](std::string&) {}), "");
    EXPECT_THAT(refusalOfEdit(put(5, 2, "nan")),
                HasSubstr("toss_003.csv:5: (document): found 'nan' in column py, expected a finite number"));
    EXPECT_THAT(refusalOfEdit(put(6, 9, "fast")), HasSubstr("toss_003.csv:6"));
    EXPECT_THAT(refusalOfEdit(put(6, 9, "")), HasSubstr("found '' in column vy"));
    EXPECT_THAT(refusalOfEdit(put(1, 4, "w")), HasSubstr("expected a column 'qw'"));
    EXPECT_THAT(refusalOfEdit(put(1, 4, "px")), HasSubstr("expected one column 'px'"));
    EXPECT_THAT(refusalOfEdit(put(9, 4, "1.2")),
                HasSubstr("toss_003.csv:9: (document): found a quaternion of length"));
    EXPECT_THAT(refusalOfEdit(put(9, 13, "1,2")), HasSubstr("found 15 values, expected 14"));
    EXPECT_THAT(refusalOfEdit(put(12, 0, "0.0608")),
                HasSubstr("toss_003.csv:12: (document): found t = 0.0608"));
    EXPECT_THAT(refusalOfEdit([](std::string& text) { text = kTossHeader; }),
                HasSubstr("expected a header and values"));
    EXPECT_THAT(refusalOfEdit([](std::string& text) { text = tossText(Flight{}.lines(9)); }),
                HasSubstr("found 9 frames"));
    EXPECT_THAT(refusalOfEdit([](std::string& text) { text = tossText(Flight{}.lines(12)); }),
                HasSubstr("a cube that stays above the board"));
}

TEST(Broken, FoldersAreRefused) {
    const auto message = [](const fs::path& folder) {
        try {
            importTosses(folder);
            return std::string();
        } catch (const LoadError& error) {
            return std::string(error.what());
        }
    };
    EXPECT_THAT(message("no/such/folder"), HasSubstr("found no folder"));
    EXPECT_THAT(message(freshFolder("empty")), HasSubstr("found no toss_NNN.csv"));
    const auto folder = freshFolder("copies");
    // Turned about z by a quarter: the same toss.
    std::vector<TossLine> lines = Flight{}.lines(30), turned = lines;
    const Quat quarter = fromAxisAngle({0, 0, 1}, 1.5707963267948966);
    for (TossLine& x : turned) {
        x.p = {-x.p.y, x.p.x, x.p.z};
        x.q = quarter * x.q;
        x.v = {-x.v.y, x.v.x, x.v.z};
    }
    writeText(folder / "toss_001.csv", tossText(lines));
    writeText(folder / "toss_005.csv", tossText(turned));
    EXPECT_THAT(message(folder), HasSubstr("toss_005.csv: found the same recording as toss_001.csv"));
    const auto names = freshFolder("names");
    writeText(names / "toss_1.csv", tossText(lines));
    writeText(names / "toss_01.csv", tossText(turned));
    EXPECT_THAT(message(names), HasSubstr("toss 1 a second time"));
    EXPECT_THROW(importTosses(folder, {{"units", "inches"}}), std::invalid_argument);
    EXPECT_THROW(importTosses(folder, {{"colour", "red"}}), std::invalid_argument);
    EXPECT_THROW((void)findImporter("teapot"), std::invalid_argument);
}

// ---------------------------------------- the real tosses
/// A run in which the observed body stays where it starts.
double frozenLoss(const Scenario& s) {
    const auto reference = makeReference(s);
    Trajectory run;
    run.dt = 1 / 148.0;
    run.bodyCount = s.bodies.size();
    for (double t = 0.0; t < s.duration + 0.5 * run.dt; t = run.times.size() * run.dt) {
        run.times.push_back(t);
        run.contacts.emplace_back();
        for (const Body& body : s.bodies)
            run.states.push_back({body.pose.position, body.pose.orientation, {}, {}});
    }
    return findMetric("measured_loss")
        ->evaluate({s, run, reference.get(), adapter::Scheme::Unknown})
        .at(0)
        .value;
}

/// The folder of the data set, or one above it, with a slash behind or not; the error for another one lists
/// what is there.
TEST(DataFolder, IsFoundInTheFoldersAboveIt) {
    const fs::path data = fs::path(::testing::TempDir()) / "data-folders";
    fs::remove_all(data);
    const fs::path rod = data / "lab" / "compound-pendulum", cart = data / "lab" / "rolling-cart";
    fs::create_directories(rod);
    fs::create_directories(cart);
    for (const fs::path& given : {rod, rod / "", data / "lab", data, cart / ".." / "compound-pendulum"})
        EXPECT_TRUE(fs::equivalent(dataFolder("compound-pendulum", given), rod)) << given;
    const fs::path renamed = data / "mine";
    fs::create_directories(renamed);
    EXPECT_EQ(dataFolder("compound-pendulum", renamed), renamed) << "any other name is taken as it is";

    const auto refusalOfEdit = [](const fs::path& given) -> std::string {
        try {
            dataFolder("compound-pendulum", given);
            return "";
        } catch (const LoadError& error) {
            return error.what();
        }
    };
    EXPECT_THAT(refusalOfEdit(cart), HasSubstr("the folder of rolling-cart"));
    EXPECT_THAT(refusalOfEdit(data / "lab" / "compound"), HasSubstr("compound-pendulum, rolling-cart"));
    EXPECT_THAT(refusalOfEdit(data / "lab" / "compound"), HasSubstr("nothing; in "));
    std::ofstream(data / "a_file") << "x";
    EXPECT_THAT(refusalOfEdit(data / "a_file"), HasSubstr("a file"));
    fs::remove_all(data);
}

TEST(RealTosses, ComeOutAsTheirDescriptionSays) {
    const char* data = std::getenv("RIGOR_DATA");
    if (data == nullptr || !fs::exists(fs::path(data) / "cube-toss"))
        GTEST_SKIP() << "RIGOR_DATA names no folder with cube-toss/ in it: the measured tosses are not part "
                        "of the repo";
    const Imported imported = importTosses(fs::path(data) / "cube-toss", {{"units", "published"}});
    ASSERT_GT(imported.scenarios.size(), 100U);
    double frozen = 0.0, vertical = 0.0;
    for (const ImportedScenario& one : imported.scenarios) {
        const Scenario s = loaded(one);
        frozen += frozenLoss(s);
        vertical += cubeOf(s).velocity.z;
    }
    const auto count = static_cast<double>(imported.scenarios.size());
    // 1.97 over the 550 published tosses; these are others of the same recordings.
    EXPECT_NEAR(frozen / count, 1.97, 0.1);
    EXPECT_LT(vertical / count, -0.3) << "they fall";
}

}  // namespace
}  // namespace rigor::validation::testing
