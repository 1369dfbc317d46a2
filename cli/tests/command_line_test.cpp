// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program from the user's side: exit codes, messages, JSON, CSV.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/tests/program.hpp"

namespace {

using rigor::cli_test::Result;
using rigor::cli_test::rigor;

nlohmann::json rigorJson(const std::string& arguments) {
    const Result result = rigor(arguments, false);
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.out;
    return nlohmann::json::parse(result.out);
}

/// A projectile in a tilted, weak gravity: the closed form is computed here, from these numbers.
std::filesystem::path writeProjectile() {
    const auto file = std::filesystem::path(testing::TempDir()) / "projectile.json";
    std::ofstream(file) << R"({"rigor": 1, "name": "projectile", "title": "A thrown ball", "dimension": 3,
        "isolates": ["integrator"], "source": "Galilei 1638", "gravity": [0.5, -3.7, 0.25], "duration": 1.0, "dt": [0.01],
        "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
        "bodies": [{"name": "ball", "mass": 2.0, "position": [1, 2, 3], "velocity": [4, 5, -6],
                    "shapes": [{"sphere": {"radius": 0.1}, "material": "steel"}]}],
        "observe": ["ball"], "reference": {"free_flight": {"body": "ball"}}, "metrics": ["position_final"],
        "accept": {"*": {"position_final": 0.1}}})";
    return file;
}

TEST(CommandLine, ListsEnginesWithVersionAndPrecision) {
    const auto engines = rigorJson("list engines --json");
    std::set<std::string> names;
    for (const auto& engine : engines) {
        // A guest whose library is not there has a line of its own.
        if (!engine.at("problem").get<std::string>().empty()) continue;
        if (!engine.at("clock").get<std::string>().empty()) continue;
        names.insert(engine.at("name").get<std::string>());
        EXPECT_FALSE(engine.at("version").get<std::string>().empty()) << engine.at("name");
        EXPECT_TRUE(engine.at("precision") == "f32" || engine.at("precision") == "f64") << engine.at("name");
    }
    for (const char* optional : {"chipmunk", "dart", "mujoco", "simbody", "siconos"}) names.erase(optional);
    EXPECT_EQ(names, (std::set<std::string>{"box2d", "bullet", "fcl", "ode", "rigor"}));
}

TEST(CommandLine, AMisspeltWordNamesTheNearest) {
    for (const auto& [arguments, meant] : {std::pair{"vaildate smoke", "validate"},
                                           {"validate smok", "smoke"},
                                           {"validate box_stak", "box_stack"},
                                           {"run box_stak", "box_stack"},
                                           {"study iteratons", "iterations"},
                                           {"collide analitic", "analytic"},
                                           {"validate smoke --engin rigor", "--engines"},
                                           {"bench --quite", "--quiet"},
                                           {"--vershion", "--version"},
                                           {"list engine", "engines"}}) {
        const Result result = rigor(arguments);
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_NE(result.out.find(std::string("did you mean '") + meant + "'"), std::string::npos)
            << result.out;
    }
}

TEST(CommandLine, AnEmptyListOfEnginesIsAnError) {
    for (const char* arguments : {"validate smoke --engines ''", "collide analytic --engines ' '",
                                  "bench bench_bridge --any-build --engines ''"}) {
        const Result result = rigor(arguments);
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_NE(result.out.find("expected engine specs"), std::string::npos) << result.out;
    }
}

/// Two runs that begin in the same second have a folder each.
TEST(CommandLine, RunsHaveFoldersOfTheirOwn) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "two_runs";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const std::string program = std::string(RIGOR_BINARY_DIR) +
                                "/bin/rigor validate free_flight --engines rigor "
                                "--dt 1/60 --no-audit -q > /dev/null";
    const std::string both =
        "cd '" + folder.string() + "' && { " + program + " & " + program + " ; wait $!; }";
    ASSERT_EQ(std::system(both.c_str()), 0);
    int stores = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "runs"))
        stores += !entry.is_symlink() && std::filesystem::exists(entry.path() / "results.sqlite") ? 1 : 0;
    EXPECT_EQ(stores, 2);
    EXPECT_TRUE(std::filesystem::exists(folder / "runs" / "latest" / "results.sqlite"));
}

TEST(CommandLine, EveryListIsAnArrayOfNamedObjects) {
    for (const char* what :
         {"engines", "scenarios", "suites", "studies", "algorithms", "metrics", "references"}) {
        const auto list = rigorJson(std::string("list ") + what + " --json");
        ASSERT_TRUE(list.is_array()) << what;
        EXPECT_FALSE(list.empty()) << what;
        for (const auto& entry : list) EXPECT_TRUE(entry.at("name").is_string()) << what;
    }
    EXPECT_GE(rigorJson("list scenarios --json").size(), 20u);
}

TEST(CommandLine, ExitCodes) {
    EXPECT_EQ(rigor("--help").code, 0);
    EXPECT_EQ(rigor("--version").code, 0);
    EXPECT_EQ(rigor("").code, 2);
    const Result unknown = rigor("frobnicate");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.out.find("'frobnicate'"), std::string::npos) << unknown.out;
    EXPECT_EQ(rigor("run no_such_scenario").code, 2);
    EXPECT_EQ(rigor("validate smoke --engines no_such_engine").code, 2);
    const auto file = writeProjectile().string();
    EXPECT_EQ(rigor("check " + file).code, 0);
    EXPECT_EQ(rigor("run " + file + " --engine rigor").code, 0);
    EXPECT_EQ(rigor("run " + file + " --engine rigor --dt -1").code, 2);
    EXPECT_EQ(rigor("run " + file + " --engine rigor:no_such_key=1").code, 2);
    EXPECT_EQ(rigor("run " + file + " --engine box2d").code, 4) << "3D in a 2D engine";
    EXPECT_EQ(rigor("run " + file + " --set bodies.ball.mass=0").code, 2);
}

TEST(CommandLine, MessagesNameFileAndPointer) {
    const auto file = std::filesystem::path(testing::TempDir()) / "broken.json";
    std::ofstream(file) << "{\"rigor\": 1, \"dimension\": 3,\n \"name\": 7}";
    const Result result = rigor("check " + file.string());
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.out.find("broken.json:2"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("/name"), std::string::npos) << result.out;
}

/// Every engine's CSV, against the closed form of its scheme (all five use symplectic Euler: x_n = x0 + v0 t
/// + g t (t + h) / 2).
TEST(CommandLine, CsvHoldsTheTrajectory) {
    const auto file = writeProjectile().string();
    struct Case {
        std::string engine;
        double late;  ///< the exact way, and that of this time [s] more of gravity in the mean
    };
    for (const auto& [engine, late] : {Case{"rigor", 0}, Case{"rigor:integrator=symplectic_euler", 0.02},
                                       Case{"bullet", 0.02}, Case{"ode", 0.02}}) {
        const Result result = rigor("run " + file + " --engine " + engine + " --dt 0.02 --csv -", false);
        ASSERT_EQ(result.code, 0) << engine;
        std::istringstream lines(result.out);
        std::string line, last;
        std::getline(lines, line);
        EXPECT_EQ(line, "t,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
        int rows = 0;
        while (std::getline(lines, line)) {
            last = line;
            ++rows;
        }
        EXPECT_EQ(rows, 51) << engine << ": the initial state and 50 steps";
        std::vector<std::string> cells;
        std::istringstream row(last);
        while (std::getline(row, line, ',')) cells.push_back(line);
        ASSERT_EQ(cells.size(), 15u);
        const double t = 1.0, x0[3] = {1, 2, 3}, v0[3] = {4, 5, -6}, g[3] = {0.5, -3.7, 0.25};
        EXPECT_NEAR(std::stod(cells[0]), t, 1e-12);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(std::stod(cells[2 + i]), x0[i] + v0[i] * t + 0.5 * g[i] * t * (t + late), 1e-10)
                << engine << " axis " << i;
            EXPECT_NEAR(std::stod(cells[9 + i]), v0[i] + g[i] * t, 1e-10) << engine << " axis " << i;
        }
    }
}

TEST(CommandLine, OverridesChangeSimulationAndReferenceAlike) {
    const auto file = writeProjectile().string();
    const auto json = rigorJson("run " + file +
                                " --engine rigor:integrator=symplectic_euler --dt 0.01"
                                " --set bodies.ball.velocity=[1,0,0] --set gravity=[0,-2,0] --json");
    double error = -1.0;
    for (const auto& metric : json.at("metrics"))
        if (metric.at("name") == "position_final" && metric.at("subject") == "")
            error = metric.at("value").get<double>();
    EXPECT_NEAR(error, 0.5 * 2.0 * 0.01 * 1.0, 1e-9) << "symplectic Euler is off by g h t / 2";
}

TEST(CommandLine, BoundsUnderOverridesAreExplainedAndCanBeGiven) {
    const std::string run =
        "run " + writeProjectile().string() + " --engine rigor:integrator=symplectic_euler";
    const std::string heavier = run + " --set gravity=[0,-37,0]";  // symplectic Euler is off by g h t / 2
    const auto red = rigor(heavier);
    EXPECT_EQ(red.code, 1);
    EXPECT_NE(red.out.find("bounds were set at the file's own values"), std::string::npos) << red.out;
    const auto redJson = nlohmann::json::parse(rigor(heavier + " --json", false).out);
    EXPECT_NE(redJson.at("note").get<std::string>().find("bounds were set at the file's own values"),
              std::string::npos);
    const auto green = rigor(heavier + " --set 'accept.*.position_final=0.186'");
    EXPECT_EQ(green.code, 0) << green.out;
    EXPECT_EQ(green.out.find("note:"), std::string::npos);
    // a bound alone: the values are the file's own, nothing to explain
    const auto tight = rigor(run + " --set 'accept.*.position_final=1e-9'");
    EXPECT_EQ(tight.code, 1);
    EXPECT_EQ(tight.out.find("note:"), std::string::npos) << tight.out;
}

TEST(CommandLine, ABoundThatIsMissedSaysWhy) {
    const std::string balls =
        std::string("run ") + RIGOR_SOURCE_DIR + "/reports/handbook/exercises/three_balls.json";
    const auto low = rigor(balls + " --set bodies.ball.position=[0,1.01]");
    EXPECT_EQ(low.code, 1);
    EXPECT_NE(low.out.find("rest_motion misses its bound: no value: body 'left' stands in the way"),
              std::string::npos)
        << low.out;
    EXPECT_EQ(low.out.find("nan"), std::string::npos) << low.out;
    EXPECT_EQ(low.out.find("note:"), std::string::npos) << "rest holds for any values: " << low.out;
    const auto joint =
        rigor(balls + " --set bodies.ball.position=[0,1.02915] --set 'accept.*.joint_drift=1'");
    EXPECT_EQ(joint.code, 1);
    EXPECT_NE(joint.out.find("no value: no joint of the scene allows it"), std::string::npos) << joint.out;
    const auto uncounted = rigor(balls + " --engine ode --set bodies.ball.position=[0,1.02915]" +
                                 " --set 'accept.*.mean_pair_tests=9' --set 'accept.*.rest_motion=9'");
    EXPECT_EQ(uncounted.code, 1);
    EXPECT_NE(uncounted.out.find("no value: the engine does not count this"), std::string::npos)
        << uncounted.out;
    const auto least = rigor(balls + R"( --set bodies.ball.position=[0,1.02915])" +
                             R"( --set 'accept.*.mean_contacts={"min":3,"max":9}')");
    EXPECT_EQ(least.code, 1);
    EXPECT_NE(least.out.find("mean_contacts misses its bound: less than its lower bound 3"),
              std::string::npos)
        << least.out;
    EXPECT_NE(least.out.find("bounds 3 to 9  fail"), std::string::npos) << least.out;
    const auto json =
        nlohmann::json::parse(rigor(balls + R"( --set bodies.ball.position=[0,1.02915] --json)" +
                                        R"( --set 'accept.*.mean_contacts={"min":3,"max":9}')",
                                    false)
                                  .out);
    EXPECT_EQ(json.at("note"), "");
    EXPECT_EQ(json.at("accuracy").at("note"), "") << "it is graded";
    const auto ungraded =
        rigorJson(std::string("run ") + RIGOR_SOURCE_DIR + "/reports/handbook/exercises/spring.json --json");
    EXPECT_EQ(ungraded.at("accuracy").at("note"), "no exact solution");
    const auto& metrics = json.at("metrics");
    const auto bounded = std::find_if(metrics.begin(), metrics.end(),
                                      [](const auto& m) { return m.at("name") == "mean_contacts"; });
    ASSERT_NE(bounded, metrics.end());
    EXPECT_EQ(bounded->at("bound"), 9.0);
    EXPECT_EQ(bounded->at("bound_min"), 3.0);
    EXPECT_EQ(bounded->at("note"), "less than its lower bound 3");
}

/// Lines of `text` that hold `what`.
int countLines(const std::string& text, const std::string& what) {
    int count = 0;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) count += line.find(what) != std::string::npos;
    return count;
}

/// The same words for every engine, and as many bounces.
TEST(CommandLine, EventLogsOfEnginesAgree) {
    for (const char* engine : {"rigor", "bullet:preset=matched", "ode:preset=matched"}) {
        const auto result = rigor(std::string("run bouncing_ball --log all --dt 0.002 --engine ") + engine);
        const int begins = countLines(result.out, " begin contact a=floor b=ball n=(");
        EXPECT_GE(begins, 3) << engine << result.out.substr(0, 2000);
        EXPECT_EQ(countLines(result.out, " impact a=floor b=ball n=("), begins) << engine;
        EXPECT_GE(countLines(result.out, " end contact a=floor b=ball"), begins - 1) << engine;
    }
    const auto contacts = rigor("run bouncing_ball --log contacts");
    EXPECT_EQ(contacts.code, 0);
    EXPECT_EQ(countLines(contacts.out, " impact "), 0);
    EXPECT_GT(countLines(contacts.out, " a_id=0 b_id=1 a_shape=0:half_space b_shape=0:sphere"), 3);
    EXPECT_EQ(rigor("run bouncing_ball --log motions").code, 2);
}

TEST(CommandLine, EventLogReportsSleepAndJointsIfTheEngineDoes) {
    EXPECT_EQ(countLines(rigor("run fixed_break --log events").out, " break joint="), 1);
    const auto sleeper = rigor("run box_stack --log events --set duration=3 --engine bullet:preset=default");
    EXPECT_GE(countLines(sleeper.out, " sleep body="), 1) << sleeper.out.substr(0, 3000);
}

/// The log can be followed: lines are there long before the run has ended, and a reader that has seen enough
/// may go.
TEST(CommandLine, EventLogFlowsThroughAPipe) {
    const auto few =
        rigor("run box_stack --log contacts --set duration=2 2>&1 >/dev/null | head -n 3; true", false);
    EXPECT_EQ(countLines(few.out, " begin contact a="), 3) << few.out;
    EXPECT_EQ(few.out.find("crashed"), std::string::npos);
}

/// The example of cli/README.md, word for word.
TEST(CommandLine, EventLogExampleOfTheReadme) {
    std::ifstream in(std::filesystem::path(RIGOR_SOURCE_DIR) / "cli/README.md");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string start = "```sh\n$ ./rigor ";
    const auto command = text.find(start);
    ASSERT_NE(command, std::string::npos);
    const auto lineEnd = text.find('\n', command + start.size()), end = text.find("```", lineEnd);
    const auto result = rigor(text.substr(command + start.size(), lineEnd - command - start.size()), false);
    EXPECT_EQ(result.out, text.substr(lineEnd + 1, end - lineEnd - 1));
}

std::filesystem::path freshFolder(const char* name) {
    const auto folder = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

std::string projectileText() {
    std::ifstream in(writeProjectile());
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A reference that names no body, or a parameter it does not have, is refused before anything runs.
TEST(CommandLine, BadReferencesAreRefusedEverywhere) {
    const auto folder = freshFolder("bad_reference");
    const auto file = (folder / "bad.json").string();
    std::ofstream(file) << replaced(projectileText(), R"({"body": "ball"})", R"({"bodq": "ball"})");
    for (const std::string& command :
         {"check " + file, "run " + file + " --engine rigor",
          "validate " + file + " --engines rigor --out " + folder.string() + "/run"}) {
        const Result result = rigor(command);
        EXPECT_EQ(result.code, 2) << command;
        EXPECT_NE(result.out.find("bad.json:6: /reference: found"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("'bodq'"), std::string::npos) << result.out;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "run")) << "nothing is written for a bad file";
}

/// Every command that takes specs refuses what an engine does not have before it runs or writes anything, and
/// names what was probably meant.
TEST(CommandLine, UnknownEnginesKeysAndValuesStopEverythingBeforeItBegins) {
    const auto folder = freshFolder("unknown_options");
    const auto file = writeProjectile().string(), out = " --out " + (folder / "run").string();
    std::ofstream(folder / "study.json") << R"({"rigor_study": 1, "name": "s", "parts": [{"name": "p",
        "scenarios": [")" + file + R"("], "dt": [0.01], "metrics": ["position_final"],
        "variants": ["rigor", "ode:stper=quickstep"]}]})";
    std::ofstream(folder / "names_solver.json")
        << replaced(projectileText(), R"("duration": 1.0)",
                    R"("duration": 1.0, "engines": {"ode": {"stepper": "quikstep"}})");
    const std::pair<std::string, const char*> cases[] = {
        {"validate " + file + " --engines bulet" + out, "bullet"},
        {"validate " + file + " --engines ode:preset=matchd" + out, "matched"},
        {"validate " + file + " --engines rigor,ode:itertions=20" + out, "iterations"},
        {"validate " + file + " --engines ode:stepper=quikstep" + out, "quickstep"},
        {"validate " + (folder / "names_solver.json").string() + " --engines ode" + out, "quickstep"},
        {"run " + file + " --engine ode:itertions=20", "iterations"},
        {"run " + file + " --engine bulet", "bullet"},
        {"bench " + file + " --any-build --engines ode:itertions=20" + out, "iterations"},
        {"study " + (folder / "study.json").string() + out, "stepper"},
        {"collide analytic --engines rigor:narow_phase=sat", "narrow_phase"},
        {"freeze " + file + " --engine ode:itertions=20" + out, "iterations"},
        {"view " + file + " --engines ode:itertions=20", "iterations"},
    };
    for (const auto& [command, meant] : cases) {
        const Result result = rigor(command);
        EXPECT_EQ(result.code, 2) << command << "\n" << result.out;
        EXPECT_NE(result.out.find("did you mean '" + std::string(meant) + "'?"), std::string::npos)
            << command << "\n"
            << result.out;
        EXPECT_FALSE(std::filesystem::exists(folder / "run")) << command;
    }
    const Result precision = rigor("validate " + file + " --engines ode:precision=f16" + out);
    EXPECT_EQ(precision.code, 2);
    EXPECT_NE(precision.out.find("key 'precision': found 'f16', expected one of f64"), std::string::npos)
        << precision.out;
}

/// A free body by symplectic Euler misses the parabola by g h^2 k / 2 after a piece of k steps, wherever it
/// begins.
TEST(CommandLine, ShortPiecesAreMeasuredAndStored) {
    const auto folder = freshFolder("pieces");
    const auto run = (folder / "run").string(), file = writeProjectile().string();
    const Result result = rigor("pieces " + file + " --every 1,10 --dt 0.01 -q --engines " +
                                "rigor:preset=matched,integrator=symplectic_euler,ode:preset=matched,"
                                "bullet:preset=matched --out " +
                                run);
    EXPECT_EQ(result.code, 0) << result.out;
    const double g = std::sqrt(0.25 + 3.7 * 3.7 + 0.0625), step = 0.5 * g * 1e-4;
    std::ifstream csv(run + "/results.csv");
    std::map<std::string, int> found;
    for (std::string line; std::getline(csv, line);) {
        const auto at = line.find(",piece_error,");
        if (at == std::string::npos) continue;
        const int k = line.find(",every 10 steps,") != std::string::npos ? 10 : 1;
        const auto value = line.find(",pieces,");
        ASSERT_NE(value, std::string::npos) << line;
        EXPECT_NEAR(std::stod(line.substr(value + 8)), k * step, 1e-6 * k * step) << line;
        ++found[k == 10 ? "ten" : "one"];
    }
    EXPECT_EQ(found["one"], 3);
    EXPECT_EQ(found["ten"], 3);
    EXPECT_EQ(rigor("pieces " + file + " --every 0").code, 2);
    EXPECT_EQ(rigor("pieces " + file + " --engines bulet").code, 2);
}

/// The first of three balls that do not collide is followed.
std::filesystem::path writeThreeBalls() {
    const auto file = std::filesystem::path(testing::TempDir()) / "three_balls.json";
    std::ofstream out(file);
    out << R"({"rigor": 1, "name": "three_balls", "title": "Three balls", "dimension": 3, "isolates": ["integrator"],
        "source": "Galilei 1638", "gravity": [0, -3.7, 0], "duration": 0.5, "dt": [0.01],
        "materials": {"steel": {"friction": 0.1, "restitution": 0.5}}, "bodies": [)";
    for (const int k : {1, 2, 3})
        out << (k > 1 ? "," : "") << R"({"name": "ball_)" << k << R"(", "mass": 1, "position": [)" << 5 * k
            << R"(, 0, 0], "shapes": [{"sphere": {"radius": 0.1}, "material": "steel"}]})";
    out << R"(], "observe": ["ball_1"], "reference": {"free_flight": {"body": "ball_1"}}, "metrics": ["position_final"]})";
    return file;
}

/// The engine moves the body of index i by i mm.
TEST(CommandLine, OrdersOfInsertionAreRunAndReported) {
    const auto folder = freshFolder("orders");
    const auto run = (folder / "run").string(), file = writeProjectile().string();
    const std::string doubles = "RIGOR_ADAPTER_PATH=" + std::string(RIGOR_BINARY_DIR) + "/tests/doubles";
    const std::string balls = writeThreeBalls().string();
    const Result result = rigor("validate " + balls + " " + file +
                                    " --orders 3 --no-audit -q --json --dt 1/100 --engines "
                                    "double_order_dependent:preset=default --out " +
                                    run,
                                false, doubles);
    const auto cases = nlohmann::json::parse(result.out).at("cases");
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].at("orders").at("run"), 3);
    EXPECT_EQ(cases[0].at("orders").at("completed"), 3);
    const auto& metric = cases[0].at("metrics").at(0);
    const double value = metric.at("value"), min = metric.at("orders").at("min"),
                 max = metric.at("orders").at("max");
    EXPECT_LT(min, max);
    EXPECT_LE(min, value);
    EXPECT_GE(max, value);
    EXPECT_TRUE(cases[1].at("orders").is_null()) << "one body";
    EXPECT_FALSE(cases[1].at("metrics").at(0).contains("orders"));

    const auto valueOf = [&](const std::string& order) {
        const Result one = rigor("run " + balls +
                                     " --json --dt 1/100 --engine "
                                     "double_order_dependent:preset=default --order " +
                                     order,
                                 false, doubles);
        return nlohmann::json::parse(one.out).at("metrics").at(0).at("value").get<double>();
    };
    EXPECT_EQ(valueOf("1"), value);
    const double second = valueOf("2"), third = valueOf("3");
    EXPECT_EQ(std::min({value, second, third}), min) << "what a range is made of can be run alone";
    EXPECT_EQ(std::max({value, second, third}), max);

    EXPECT_EQ(rigor("validate " + file + " --orders 0 --engines rigor").code, 2);
    EXPECT_EQ(rigor("validate " + file + " --orders -3 --engines rigor").code, 2);
    const Result beyond = rigor("run " + file + " --order 2");
    EXPECT_EQ(beyond.code, 2);
    EXPECT_NE(beyond.out.find("--order: found 2, expected at most 1"), std::string::npos) << beyond.out;
}

TEST(CommandLine, SuitesSayInHowManyOrdersTheyAreRun) {
    const auto folder = freshFolder("orders-suite");
    std::ofstream(folder / "suite.json")
        << R"({"rigor_suite": 1, "name": "ordered", "scenarios": ["elastic_collision"],
        "engines": ["rigor:preset=matched"], "max_time_steps": 1, "orders": 2})";
    const std::string suite = (folder / "suite.json").string() + " --no-audit -q --json --out ";
    const auto ordersOf = [&](const std::string& arguments) {
        const Result result = rigor("validate " + arguments, false);
        return nlohmann::json::parse(result.out).at("cases").at(0).at("orders");
    };
    EXPECT_EQ(ordersOf(suite + (folder / "a").string()).at("run"), 2);
    EXPECT_TRUE(ordersOf(suite + (folder / "b").string() + " --orders 1").is_null());
}

/// A suite of first time steps alone does not shorten what is given by itself, before or behind it.
TEST(CommandLine, AScenarioThatIsGivenByItselfHasAllItsTimeSteps) {
    const auto folder = freshFolder("suite-and-scenario");
    const std::string suite = (folder / "suite.json").string();
    std::ofstream(suite)
        << R"({"rigor_suite": 1, "name": "short", "scenarios": ["elastic_collision", "free_flight"],
        "engines": ["rigor:preset=matched"], "max_time_steps": 1})";
    int runs = 0;
    const auto casesOf = [&](const std::string& arguments) {
        const Result result = rigor("validate " + arguments + " --no-audit -q --json --out " +
                                        (folder / std::to_string(++runs)).string(),
                                    false);
        const auto summary = nlohmann::json::parse(result.out);
        std::map<std::string, int> count;
        for (const auto& c : summary.at("cases")) ++count[c.at("name")];
        return count;
    };
    const auto alone = casesOf("free_flight --engines rigor:preset=matched");
    ASSERT_GT(alone.at("free_flight"), 1);
    for (const std::string& arguments : {suite + " free_flight", "free_flight " + suite}) {
        const auto both = casesOf(arguments);
        EXPECT_EQ(both.at("free_flight"), alone.at("free_flight")) << arguments;
        EXPECT_EQ(both.at("elastic_collision"), 1) << arguments;
    }
}

/// No reference can be computed in a tenth of a millisecond, which a process needs to begin.
TEST(CommandLine, AReferenceThatDoesNotFinishIsReportedByItsName) {
    const auto folder = freshFolder("slow_reference");
    const auto run = (folder / "run").string(), limit = std::string(" --reference-limit 1e-4");
    const std::string sentence = "the reference did not finish within 0.0001 s";
    const Result check = rigor("check bouncing_ball" + limit);
    EXPECT_EQ(check.code, 6) << check.out;
    EXPECT_NE(check.out.find(sentence), std::string::npos) << check.out;
    EXPECT_NE(check.out.find("reference.timeout"), std::string::npos) << check.out;
    const Result once = rigor("run bouncing_ball" + limit);
    EXPECT_EQ(once.code, 6) << once.out;
    EXPECT_NE(once.out.find("no reference: reference_timeout: " + sentence), std::string::npos) << once.out;
    const Result all =
        rigor("validate bouncing_ball --no-audit -q --dt 1/60 --engines rigor --out " + run + limit);
    EXPECT_EQ(all.code, 6) << all.out;
    EXPECT_NE(all.out.find("no reference: bouncing_ball: reference_timeout"), std::string::npos) << all.out;
    std::ifstream in(run + "/summary.md");
    const std::string summary{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(summary.find(sentence), std::string::npos);
    EXPECT_EQ(rigor("check bouncing_ball").code, 0);
    EXPECT_EQ(rigor("check bouncing_ball --reference-limit 0").code, 2);
    EXPECT_EQ(rigor("check bouncing_ball no_such_file" + limit).code, 2)
        << "what is wrong outranks what is slow";
}

TEST(CommandLine, TwoScenariosOfOneNameAreRefused) {
    const auto folder = freshFolder("same_name");
    const auto one = (folder / "one.json").string(), two = (folder / "two.json").string();
    std::ofstream(one) << projectileText();
    std::ofstream(two) << replaced(projectileText(), "[4, 5, -6]", "[1, 0, 0]");
    const Result result =
        rigor("validate " + one + " " + two + " --engines rigor --out " + (folder / "run").string());
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.out.find("'projectile'"), std::string::npos) << result.out;
}

/// Folders that can not be used are the caller's error, and are reported as such.
TEST(CommandLine, UnusableFoldersAreBadInput) {
    const auto folder = freshFolder("folders");
    const auto file = writeProjectile().string(), run = (folder / "run").string();
    const auto validate = [&](const std::string& rest) {
        const Result result = rigor("validate " + file + " --engines rigor -q " + rest);
        EXPECT_EQ(result.out.find("internal error"), std::string::npos) << result.out;
        return result.code;
    };
    EXPECT_EQ(validate("--resume --out " + run), 2) << "nothing to resume";
    EXPECT_EQ(validate("--out " + run), 0);
    EXPECT_EQ(validate("--out " + run), 2) << "holds a run already";
    EXPECT_EQ(validate("--out " + run + " --resume"), 0);
    EXPECT_EQ(rigor("validate " + file + " --engines ode -q --resume --out " + run).code, 2)
        << "would drop the finished cases of another engine";
    std::ofstream(folder / "file") << "x";
    EXPECT_EQ(validate("--out " + (folder / "file").string()), 2);
    EXPECT_EQ(rigor("report " + run).code, 0);
    EXPECT_EQ(rigor("report " + folder.string()).code, 2) << "no run in there";
    std::ofstream(folder / "run/results.sqlite") << "garbage";
    EXPECT_EQ(rigor("report " + run).code, 2);
}

/// A library that aborts, ends the process or throws must not look like a green run, nor like an error of
/// this program.
TEST(CommandLine, RunReportsLibrariesThatFail) {
    const std::string doubles = "RIGOR_ADAPTER_PATH=" + std::string(RIGOR_BINARY_DIR) + "/tests/doubles";
    const auto file = writeProjectile().string();
    const std::pair<const char*, int> expected[] = {{"double_abort", 5},
                                                    {"double_segfault", 5},
                                                    {"double_exit", 5},
                                                    {"double_throw", 1},
                                                    {"double_nan", 1}};
    for (const auto& [engine, code] : expected) {
        const Result result = rigor("run " + file + " --engine " + engine, true, doubles);
        EXPECT_EQ(result.code, code) << engine << "\n" << result.out;
        EXPECT_NE(result.out.find(engine), std::string::npos) << result.out;
        EXPECT_EQ(result.out.find("internal error"), std::string::npos) << result.out;
    }
}

/// Box2D has no 3D. What cannot be run is shown and no failure, but alone it is no success.
TEST(CommandLine, ARunThatJudgesNothingIsNoSuccess) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "judges-nothing";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const auto run = [&](const std::string& engines, const std::string& name, const std::string& more = "",
                         bool withErrors = true) {
        return rigor("validate slide_and_stop --dt 1/60 --no-audit -q --engines " + engines + " --out " +
                         (folder / name).string() + more,
                     withErrors);
    };
    const auto alone = run("box2d", "alone");
    EXPECT_EQ(alone.code, 4) << alone.out;
    EXPECT_NE(alone.out.find("nothing was judged: every case is unsupported"), std::string::npos)
        << alone.out;
    EXPECT_EQ(alone.out.find("no case is red"), std::string::npos) << alone.out;
    const auto json = run("box2d", "json", " --json", false);
    EXPECT_EQ(json.code, 4);
    EXPECT_EQ(nlohmann::json::parse(json.out).at("green"), false);
    const auto both = run("box2d,rigor:preset=default", "both");
    EXPECT_EQ(both.code, 0) << both.out;
    EXPECT_NE(both.out.find("note: no case of box2d was judged, all are unsupported: "), std::string::npos)
        << both.out;
    EXPECT_EQ(both.out.find("nothing was judged"), std::string::npos) << both.out;
    EXPECT_EQ(run("box2d", "shard", " --shard 1/1").code, 0) << "other shards may have more";
    EXPECT_EQ(rigor("merge " + (folder / "shard").string() + " --out " + (folder / "merged").string()).code,
              4);
}

TEST(CommandLine, ResumeKnowsItsRequest) {
    const auto run = (std::filesystem::path(testing::TempDir()) / "resumed-run").string();
    std::filesystem::remove_all(run);
    ASSERT_EQ(rigor("validate elastic_collision --engines rigor -q --out " + run).code, 0);
    const Result again = rigor("validate --resume --engines rigor -q --json --out " + run, false);
    EXPECT_EQ(again.code, 0);
    const auto cases = nlohmann::json::parse(again.out).at("cases");
    ASSERT_FALSE(cases.empty());
    for (const auto& c : cases) EXPECT_EQ(c.at("name"), "elastic_collision");
}

}  // namespace
