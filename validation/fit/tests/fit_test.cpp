// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The whole way: tosses whose friction and restitution are known are written as a folder of recordings,
// imported, fitted and scored, each engine in children of its own; what an engine does to its process stays
// an outcome; a fit goes on where it was interrupted. If RIGOR_DATA is set, the real tosses are used.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "scenarios/loader/overrides.hpp"
#include "validation/fit/baselines.hpp"
#include "validation/fit/fit.hpp"
#include "validation/import/importer.hpp"
#include "validation/import/tests/toss_folder.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/store.hpp"

namespace rigor::validation::testing {
namespace {

namespace fs = std::filesystem;
using namespace scenario;
using ::testing::HasSubstr;

const std::atomic<bool> kGoOn{false};

fs::path program() {
    return fs::path(RIGOR_BINARY_DIR) / "bin" / "rigor";
}

/// Sets the folders of the engines and the test doubles.
const bool kPathIsSet = [] {
    const std::string build = RIGOR_BINARY_DIR;
    return setenv("RIGOR_ADAPTER_PATH", (build + "/bin/adapters:" + build + "/tests/doubles").c_str(), 1) ==
           0;
}();

fs::path importFolder(const fs::path& from, const std::string& name, const std::string& select = "all",
                      const std::map<std::string, std::string>& options = {}) {
    const ImporterEntry& importer = findImporter("cube-toss");
    const fs::path out = freshFolder(name) / "scenarios";
    writeImported(importer.read({from, select, "", resolveChoices(importer, options)}), "made_up", out);
    return out;
}

constexpr double kHalf = 0.0512, kGravity = 9.614, kFriction = 0.31, kRestitution = 0.42;

/// A cube that does not turn falls on its face, bounces and slides: closed form, no engine. Friction acts
/// with the whole impulse at every bounce and with the weight once the bounces are over (they end at a finite
/// time).
struct FlatToss {
    Vec3 p0, v0;
    std::vector<TossLine> lines(std::size_t frames) const {
        std::vector<TossLine> all;
        double x = p0.x, y = p0.y, z = p0.z, vx = v0.x, vy = v0.y, vz = v0.z, now = 0.0;
        bool resting = false;
        const auto slow = [&](double by) {
            const double speed = std::hypot(vx, vy), left = std::max(0.0, speed - by);
            if (speed > 0.0) {
                vx *= left / speed;
                vy *= left / speed;
            }
        };
        for (std::size_t k = 0; k < frames; ++k) {
            const double t = static_cast<double>(k) / 148;
            while (now < t) {
                double step = t - now;
                if (!resting) {
                    const double landing =
                        (vz + std::sqrt(vz * vz + 2 * kGravity * std::max(0.0, z - kHalf))) / kGravity;
                    const bool lands = landing <= step;
                    step = std::min(step, landing);
                    x += vx * step;
                    y += vy * step;
                    z += vz * step - 0.5 * kGravity * step * step;
                    vz -= kGravity * step;
                    if (lands) {
                        z = kHalf;
                        slow(kFriction * (1 + kRestitution) * -vz);
                        vz *= -kRestitution;
                        resting = vz < 1e-4;
                        if (resting) vz = 0;
                    }
                } else {
                    const double speed = std::hypot(vx, vy),
                                 u = std::min(step, speed / (kFriction * kGravity));
                    const double way = speed * u - 0.5 * kFriction * kGravity * u * u;
                    if (speed > 0.0) {
                        x += way * vx / speed;
                        y += way * vy / speed;
                    }
                    slow(kFriction * kGravity * step);
                }
                now += step;
            }
            all.push_back({{x, y, z}, {1, 0, 0, 0}, {vx, vy, vz}, {}});
        }
        return all;
    }
};

/// Recordings of flat tosses in many directions; the data set's own format.
fs::path flatTosses(const std::string& name, int count) {
    const fs::path folder = freshFolder(name) / "data";
    for (int k = 0; k < count; ++k) {
        const double angle = 2.39996 * k, speed = 0.6 + 0.05 * (k % 7);
        const FlatToss toss{{0.1, 0.01 * k, 0.13 + 0.004 * (k % 5)},
                            {speed * std::cos(angle), speed * std::sin(angle), 0.2 - 0.05 * (k % 4)}};
        writeText(folder / ("toss_" + std::to_string(k) + ".csv"), tossText(toss.lines(90)));
    }
    return folder;
}

FitTask smallTask(const fs::path& scenarios, const std::vector<std::string>& engines, int budget) {
    std::vector<adapter::EngineSpec> specs;
    for (const std::string& text : engines) specs.push_back(adapter::parseSpec(text));
    FitTask task = loadFit(scenarios / "fit.json", specs);
    task.budget = budget;
    return task;
}

FitOptions optionsFor(const fs::path& folder, bool runs) {
    FitOptions options;
    options.directory = folder;
    options.binary = program();
    options.jobs = 2;
    options.runs = runs;
    return options;
}

const FitScore& scoreOf(const std::vector<FitScore>& scores, const std::string& part,
                        const std::string& point, const std::string& metric) {
    for (const FitScore& s : scores)
        if (s.part == part && s.point == point && s.metric == metric) return s;
    throw std::invalid_argument("no such score");
}

TEST(Fit, RecoversFrictionAndRestitutionOfTossesOfClosedForm) {
    const fs::path scenarios = importFolder(flatTosses("flat", 16), "flat-in", "all", {{"start", "flight"}});
    const FitTask task =
        smallTask(scenarios, {"rigor:preset=default", "bullet:preset=matched", "ode:preset=matched"}, 90);
    ASSERT_TRUE(kPathIsSet);
    ASSERT_EQ(task.train.size(), 8U);
    const fs::path folder = freshFolder("flat-out") / "fit";
    const FitOutcome outcome = runFit(task, optionsFor(folder, true), {}, kGoOn);
    ASSERT_TRUE(outcome.complete);
    ASSERT_EQ(outcome.result.engines.size(), 3U);
    for (const EngineFit& e : outcome.result.engines) {
        SCOPED_TRACE(e.spec);
        EXPECT_LE(e.parameters[0].interval.low, kFriction);
        EXPECT_GE(e.parameters[0].interval.high, kFriction);
        EXPECT_LE(e.parameters[1].interval.low, kRestitution);
        EXPECT_GE(e.parameters[1].interval.high, kRestitution);
        EXPECT_NEAR(e.parameters[0].value, kFriction, 0.02);
        EXPECT_NEAR(e.parameters[1].value, kRestitution, 0.05);
        const auto& before = scoreOf(e.scores, "test", "unfitted", "measured_loss").score;
        const auto& after = scoreOf(e.scores, "test", "fitted", "measured_loss").score;
        EXPECT_LT(after.mean, 0.1 * before.mean);
        EXPECT_LT(e.changeInterval.high, 0.0);
        EXPECT_EQ(after.broken, 0);
    }
    // The run folder is an ordinary one and says the same as the score.
    const EngineFit& first = outcome.result.engines[0];
    const results::Run run = results::readRun(folder / first.run);
    ASSERT_EQ(run.cases.size(), task.test.size());
    double sum = 0.0;
    for (const auto& row : run.cases)
        for (const auto& m : row.metrics)
            if (m.name == "measured_loss" && m.subject.empty()) {
                EXPECT_EQ(m.kind, "measured");
                sum += m.value;
            }
    EXPECT_NEAR(sum / run.cases.size(), scoreOf(first.scores, "test", "fitted", "measured_loss").score.mean,
                1e-12);
    EXPECT_THAT(readTextFile(folder / "fit.md"), HasSubstr("rigor:preset=default"));
    EXPECT_THAT(readTextFile(folder / "fit.csv"),
                HasSubstr("\"rigor:preset=default\",test,fitted,measured_loss,8,0,"));
}

/// Flies without turning, lands without losing speed along the board and slides to rest at 0.18.
std::vector<TossLine> glidingToss() {
    std::vector<TossLine> all;
    const double landing = std::sqrt(2 * (0.15 - kHalf) / kGravity), stop = 0.7 / (0.18 * kGravity);
    for (int k = 0; k < 110; ++k) {
        const double t = k / 148.0, u = std::clamp(t - landing, 0.0, stop);
        const double way = 0.7 * (std::min(t, landing) + u) - 0.09 * kGravity * u * u;
        const double z = t < landing ? 0.15 - 0.5 * kGravity * t * t : kHalf;
        all.push_back({{0.1, way, z}, {1, 0, 0, 0}, {0, 0.7, -kGravity * t}, {}});
    }
    return all;
}

TEST(Fit, BaselinesAreWhatTheySay) {
    const fs::path folder = freshFolder("baselines") / "data";
    writeText(folder / "toss_0.csv", tossText(FlatToss{{0, 0, 0.14}, {0.5, 0, 0}}.lines(60)));
    writeText(folder / "toss_1.csv", tossText(glidingToss()));
    const fs::path scenarios = importFolder(folder, "baselines-in", "all", {{"start", "flight"}});
    FitTask task = smallTask(scenarios, {"rigor"}, 90);
    ASSERT_EQ(task.train[0].scenario.name, "toss_001");
    const auto found = baselines(task);
    ASSERT_EQ(found.size(), 3U);
    const double frozen = found[0].scores.at(0).score.mean, slide = found[1].scores.at(0).score.mean;
    EXPECT_EQ(found[0].name, "frozen");
    // Left: between samples the recording is a polygon, g dt^2/8 = 55 um off in flight, more where it lands.
    EXPECT_LT(slide, 1e-4 * frozen);
    EXPECT_NEAR(found[2].scores.at(0).score.mean, slide, 1e-9) << "it never turned";
    // Frozen: the mean square distance from the start over the half width, by hand.
    const Scenario& s = task.train[0].scenario;
    const auto reference = makeReference(s);
    double squares = 0.0;
    int count = 0;
    for (double t = 0.0; t < s.duration + 1e-9; t += 1.0 / 1480, ++count) {
        const Vec3 d = *reference->measured(1, t)->position - s.bodies[1].pose.position;
        squares += dot(d, d);
    }
    FitTask one = task;
    one.train.resize(1);
    EXPECT_NEAR(baselines(one)[0].scores.at(0).score.mean, squares / count / kHalf, 1e-9);
}

TEST(Fit, ACrashOfAnEngineCostsItsCaseAlone) {
    const fs::path scenarios = importFolder(flatTosses("crash", 4), "crash-in");
    for (const auto& [engine, says] : std::vector<std::pair<std::string, std::string>>{
             {"double_segfault", "crashed"}, {"double_nan", "non-finite"}}) {
        FitTask task = smallTask(scenarios, {engine + ":preset=default"}, 10);
        const fs::path folder = freshFolder("crash-out-" + engine) / "fit";
        const FitOutcome outcome = runFit(task, optionsFor(folder, false), {}, kGoOn);
        ASSERT_TRUE(outcome.complete);
        const auto& test = scoreOf(outcome.result.engines[0].scores, "test", "fitted", "measured_loss").score;
        EXPECT_EQ(test.broken, test.runs) << engine;
        EXPECT_TRUE(std::isinf(test.mean));
        // A sanitizer ends the process itself, and its last line is the reason.
        EXPECT_THAT(readTextFile(folder / "evaluations.jsonl"),
                    AnyOf(HasSubstr(says), HasSubstr("runtime error: store to null pointer")))
            << engine;
        EXPECT_THAT(fitCsv(outcome.result), HasSubstr(",mean is infinite;"));
    }
}

TEST(Fit, GoesOnWhereItWasInterrupted) {
    const fs::path scenarios = importFolder(flatTosses("resume", 4), "resume-in");
    const FitTask task = smallTask(scenarios, {"rigor:preset=default"}, 40);
    const fs::path folder = freshFolder("resume-out") / "fit", whole = freshFolder("resume-whole") / "fit";
    std::atomic<bool> stop{false};
    const FitOutcome broken = runFit(
        task, optionsFor(folder, false), [&](const FitProgress& p) { stop = p.done > 40; }, stop);
    EXPECT_FALSE(broken.complete);
    EXPECT_FALSE(fs::exists(folder / "fit.json"));
    const auto linesOf = [](const fs::path& file) {
        const std::string text = readTextFile(file);
        return std::count(text.begin(), text.end(), '\n');
    };
    const auto kept = linesOf(folder / "evaluations.jsonl");
    EXPECT_GT(kept, 0);
    FitOptions again = optionsFor(folder, false);
    again.resume = true;
    std::int64_t ran = 0;
    const FitOutcome resumed = runFit(
        task, again, [&](const FitProgress&) { ++ran; }, kGoOn);
    const FitOutcome atOnce = runFit(task, optionsFor(whole, false), {}, kGoOn);
    ASSERT_TRUE(resumed.complete && atOnce.complete);
    EXPECT_EQ(fitToJson(resumed.result).dump(), fitToJson(atOnce.result).dump()) << "byte-equal";
    EXPECT_EQ(linesOf(folder / "evaluations.jsonl"), linesOf(whole / "evaluations.jsonl"));
    EXPECT_GT(ran, 0);
}

// ---------------------------------------- fit files
std::string refusal(const std::function<void(nlohmann::json&)>& edit) {
    static const fs::path scenarios = importFolder(flatTosses("files", 2), "files-in");
    nlohmann::json fit = nlohmann::json::parse(readTextFile(scenarios / "fit.json"));
    edit(fit);
    writeText(scenarios / "mine.json", fit.dump(1));
    try {
        loadFit(scenarios / "mine.json");
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

TEST(FitFile, WhatIsWrongIsSaid) {
    EXPECT_EQ(refusal([](auto&) {}), "");
    EXPECT_THAT(refusal([](auto& f) { f["test"] = f["train"]; }), HasSubstr("a second time"));
    EXPECT_THAT(refusal([](auto& f) { f["metric"] = "beauty"; }),
                HasSubstr("/metric: found string \"beauty\""));
    EXPECT_THAT(refusal([](auto& f) { f["summary"] = "best"; }), HasSubstr("expected mean or median"));
    EXPECT_THAT(refusal([](auto& f) { f["parameters"][0]["key"] = "pairs.0.frictoin"; }),
                HasSubstr("frictoin"));
    EXPECT_THAT(refusal([](auto& f) {
                    f["parameters"][1]["range"] = {0, 7};
                }),
                HasSubstr("pairs.0.restitution"));
    EXPECT_THAT(refusal([](auto& f) {
                    f["parameters"][0]["range"] = {0.5, 0.1};
                }),
                HasSubstr("a lower and a higher"));
    EXPECT_THAT(refusal([](auto& f) { f["parameters"][0]["start"] = 9; }), HasSubstr("/parameters/0/start"));
    EXPECT_THAT(refusal([](auto& f) { f["colour"] = 1; }), HasSubstr("colour"));
    EXPECT_THAT(refusal([](auto& f) { f["budget"] = 9; }), HasSubstr("/budget"));
    EXPECT_THAT(refusal([](auto& f) { f["train"] = {"gone.json"}; }), HasSubstr("gone.json"));
    EXPECT_THAT(refusal([](auto& f) { f["engines"] = {"no_such_engine"}; }), HasSubstr("no_such_engine"));
    EXPECT_THAT(refusal([](auto& f) { f["parameters"].clear(); }), HasSubstr("one to three parameters"));
}

// ---------------------------------------- the real tosses
TEST(RealTosses, EveryEngineIsBetterThanACubeThatStaysWhereItIs) {
    const char* data = std::getenv("RIGOR_DATA");
    if (data == nullptr || !fs::exists(fs::path(data) / "cube-toss"))
        GTEST_SKIP() << "RIGOR_DATA names no folder with cube-toss/ in it: the measured tosses are not part "
                        "of the repo";
    const fs::path from = fs::path(data) / "cube-toss";
    const fs::path scenarios = importFolder(from, "real-in", (from / "selected.csv").string());
    FitTask task = smallTask(scenarios,
                             {"rigor:preset=default", "rigor:preset=default,friction=pyramid",
                              "bullet:preset=default", "ode:preset=default"},
                             10);
    const FitOutcome outcome = runFit(task, optionsFor(freshFolder("real-out") / "fit", false), {}, kGoOn);
    ASSERT_TRUE(outcome.complete);
    const auto& stays = outcome.result.baselines.at(0).scores;
    std::vector<double> apart;
    for (const EngineFit& e : outcome.result.engines) {
        SCOPED_TRACE(e.spec);
        for (const char* point : {"unfitted", "fitted"}) {
            const auto& score = scoreOf(e.scores, "test", point, "measured_orientation_mean").score;
            EXPECT_EQ(score.broken, 0);
            EXPECT_LT(score.mean, scoreOf(stays, "test", "unfitted", "measured_orientation_mean").score.mean)
                << point;
            EXPECT_GT(score.mean, 0.0) << "no model is perfect";
        }
        apart.push_back(scoreOf(e.scores, "test", "unfitted", "measured_position_mean").score.mean);
        EXPECT_LT(scoreOf(e.scores, "test", "unfitted", "measured_loss").score.meanInterval.high,
                  0.7 * scoreOf(stays, "test", "unfitted", "measured_loss").score.mean);
    }
    // Mean errors over 134 tosses: 0.137 widths with the cone, 0.297 with a pyramid, 0.265 with ODE's.
    EXPECT_LT(apart[0], 0.8 * apart[1]);
    EXPECT_LT(apart[0], 0.8 * apart[3]);
}

/// A run that broke counts as infinite: no number of the tables, but reported.
TEST(FitFiles, HaveNoTextAmongNumbers) {
    const double inf = std::numeric_limits<double>::infinity();
    FitResult result;
    result.metric = "loss";
    result.metrics = {"loss"};
    result.units = {"1"};
    EngineFit fit;
    fit.spec = "ode:preset=matched";
    fit.scores = {{"test", "fitted", "loss", {}}};
    fit.scores[0].score.mean = inf;
    fit.scores[0].score.median = 0.25;
    result.engines.push_back(fit);
    const std::string csv = fitCsv(result);
    EXPECT_NE(csv.find(",loss,0,0,,0,0,0.25,0,0,mean is infinite\n"), std::string::npos) << csv;
    const auto stored = fitToJson(result);
    EXPECT_EQ(stored.dump().find("\"inf\""), std::string::npos);
    EXPECT_TRUE(stored.at("engines").at(0).at("scores").at(0).at("mean").is_null());
    EXPECT_EQ(stored.at("engines").at(0).at("scores").at(0).at("median"), 0.25);
}

}  // namespace
}  // namespace rigor::validation::testing
