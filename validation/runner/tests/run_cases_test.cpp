// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Whole runs with engines of known faults: each costs its own row and nothing else; a run that was killed is
// finished by another process with the same results.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/comparison/recorded.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/tests/fixtures.hpp"
#include "validation/runner/tests/same_runs.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using fixtures::buildFolder;
using fixtures::expectSameMotion;
using fixtures::plan;
using fixtures::thrownBall;
using fixtures::timeless;
using results::Outcome;
using results::Verdict;
using testing::HasSubstr;

using RunCases = fixtures::RunnerTest;

const results::CaseRow& rowOf(const results::Run& run, const std::string& engine) {
    for (const auto& row : run.cases)
        if (row.engine == engine) return row;
    throw std::runtime_error("no row of " + engine);
}

TEST_F(RunCases, AGoodCaseHasEverything) {
    const auto run =
        RunCases::run(plan({thrownBall("ball")}, "double_free_flight:preset=matched"), options());
    ASSERT_EQ(run.cases.size(), 1u);
    const auto& c = run.cases[0];
    EXPECT_EQ(c.outcome, Outcome::Completed);
    EXPECT_EQ(c.verdict, Verdict::Pass) << c.reason;
    EXPECT_EQ(c.spec, "double_free_flight:preset=matched");
    EXPECT_EQ(c.preset, "matched");
    EXPECT_EQ(c.steps, 64);
    EXPECT_EQ(c.settings.at("pause_us"), "0");
    EXPECT_GT(c.peakMemoryKiB, 1000);
    EXPECT_GT(c.wallSeconds, 0.0);
    EXPECT_EQ(c.command, "./rigor run " + (options().directory / "scenarios/ball.json").string() +
                             " --engine double_free_flight:preset=matched --dt 0.0078125");
    EXPECT_TRUE(std::filesystem::exists(options().directory / "scenarios/ball.json"));
    EXPECT_THAT(c.readBack, testing::SizeIs(testing::Gt(8u)));
    // Symplectic Euler is off by g t h / 2 at the end: |g| = 3.7914 m/s^2.
    const double gravity = std::sqrt(0.25 + 3.75 * 3.75 + 0.0625);
    ASSERT_FALSE(c.metrics.empty());
    EXPECT_EQ(c.metrics[0].name, "position_final") << "what matters to the scenario comes first";
    EXPECT_EQ(c.metrics[0].subject, "");
    EXPECT_NEAR(c.metrics[0].value, 0.5 * gravity * 0.5 * 0.0078125, 1e-12);
    EXPECT_FALSE(run.finished.empty());
    EXPECT_EQ(run.plannedCases, 1);
    for (const char* key : {"cpu", "cores", "memory", "kernel", "system", "compiler", "build_type", "flags",
                            "libraries", "governor", "load", "rigor", "engine_double_free_flight"})
        EXPECT_FALSE(run.environment.at(key).empty()) << key;
}

TEST_F(RunCases, TheTrajectoryFileHoldsRunAndReference) {
    const auto run =
        RunCases::run(plan({thrownBall("ball")}, "double_free_flight:preset=default"), options());
    const auto file = results::readTrajectory(options().directory / run.cases[0].trajectoryFile);
    ASSERT_EQ(file.times.size(), 65u);
    ASSERT_EQ(file.bodies.size(), 2u);
    EXPECT_EQ(file.bodies[1].name, "ball");
    ASSERT_EQ(file.reference.size(), 1u);
    EXPECT_EQ(file.reference[0].name, "ball");
    const double h = 0.0078125;
    const scenario::Vec3 g{0.5, -3.75, 0.25};
    for (std::size_t n = 0; n < 65; ++n) {
        const double t = n * h;
        const double error =
            file.bodies[1].position.values[3 * n + 1] - file.reference[0].position.values[3 * n + 1];
        EXPECT_NEAR(error, 0.5 * g.y * t * h, 1e-12) << n;
    }
    EXPECT_FALSE(file.series.empty());
    for (const auto& s : file.series) EXPECT_EQ(s.channel.values.size(), 65u) << s.name;
}

/// The faulty engines and the good one: one red row each, the good rows as if they had been alone.
TEST_F(RunCases, EveryFaultCostsOneRow) {
    std::string text = thrownBall("ball", R"(, "time_limit": 4)");
    auto o = options();
    o.memoryLimitMiB = 256;
    const std::string faults =
        "double_abort,double_segfault,double_hang,double_nan,double_exit,double_throw,double_heavy,double_"
        "out_of_memory";
    std::string specs;
    for (const auto& spec : adapter::parseSpecList(faults)) specs += spec.engine + ":preset=default,";
    const auto cases = plan({text}, specs + "double_free_flight:preset=default");
    const auto run = RunCases::run(cases, o);
    ASSERT_EQ(run.cases.size(), 9u);

    struct Expected {
        const char* engine;
        Outcome outcome;
        Verdict verdict;
        const char* reason;
    };
    for (const Expected& e :
         {Expected{"double_abort", Outcome::Crashed, Verdict::Crashed, "SIGABRT"},
          Expected{"double_abort", Outcome::Crashed, Verdict::Crashed, "assertion failed: mass > 0"},
          Expected{"double_hang", Outcome::Timeout, Verdict::Timeout, "no end within 4 s"},
          Expected{"double_nan", Outcome::NonFinite, Verdict::NonFinite, "ball is not finite"},
          Expected{"double_exit", Outcome::Crashed, Verdict::Crashed, "exit code 0 without a result"},
          Expected{"double_throw", Outcome::Error, Verdict::Fail, "the library is unhappy"},
          Expected{"double_heavy", Outcome::Completed, Verdict::Fail, "mass of ball: found 4, expected 2"},
          Expected{"double_free_flight", Outcome::Completed, Verdict::Pass, ""}}) {
        const auto& row = rowOf(run, e.engine);
        EXPECT_STREQ(results::outcomeName(row.outcome), results::outcomeName(e.outcome)) << e.engine;
        EXPECT_STREQ(results::verdictName(row.verdict), results::verdictName(e.verdict)) << e.engine;
        EXPECT_THAT(row.reason, HasSubstr(e.reason)) << e.engine;
    }
    EXPECT_EQ(rowOf(run, "double_segfault").verdict, Verdict::Crashed);
    if (timeLimitFactor() == 1.0) {  // sanitizer builds have no memory limit
        EXPECT_EQ(rowOf(run, "double_out_of_memory").outcome, Outcome::OutOfMemory)
            << rowOf(run, "double_out_of_memory").reason;
        EXPECT_EQ(rowOf(run, "double_out_of_memory").verdict, Verdict::Crashed);
    }
    EXPECT_FALSE(runIsGreen(run));
    EXPECT_FALSE(run.finished.empty()) << "the run went to its end";
    EXPECT_TRUE(rowOf(run, "double_abort").trajectoryFile.empty());
    EXPECT_FALSE(rowOf(run, "double_nan").trajectoryFile.empty())
        << "up to the fault there is something to see";

    const auto alone = RunCases::run(plan({text}, "double_free_flight:preset=default"), options("alone"));
    EXPECT_EQ(rowOf(run, "double_free_flight").stateHash, alone.cases[0].stateHash);
}

TEST_F(RunCases, UnknownEnginesAndKeysAreRowsToo) {
    const auto run =
        RunCases::run(plan({thrownBall("ball")},
                           "no_such_engine:preset=default,double_free_flight:no_such_key=1,preset=default"),
                      options());
    ASSERT_EQ(run.cases.size(), 2u);
    EXPECT_EQ(run.cases[0].outcome, Outcome::Error);
    EXPECT_THAT(run.cases[0].reason, HasSubstr("not installed"));
    EXPECT_EQ(run.cases[1].outcome, Outcome::Error);
    EXPECT_THAT(run.cases[1].reason, HasSubstr("unknown key 'no_such_key'"));
    for (const auto& e : run.engines)
        EXPECT_EQ(e.problem.empty(), e.name != "no_such_engine") << e.name << ": " << e.problem;
}

TEST_F(RunCases, BoundsDecideTheVerdict) {
    const auto judged = [&](const std::string& folder, const std::string& bound) {
        const std::string accept = R"(, "accept": {"*": {"position_final": )" + bound + "}}";
        return RunCases::run(plan({thrownBall("ball", accept)},
                                  "double_free_flight:preset=default,double_drifting:preset=default"),
                             options(folder));
    };
    const auto wide = judged("wide", "0.01");  // the scheme's own error is 0.0074 m
    EXPECT_EQ(rowOf(wide, "double_free_flight").verdict, Verdict::Pass);
    EXPECT_EQ(rowOf(wide, "double_drifting").verdict, Verdict::Fail) << "a metre off";
    EXPECT_THAT(rowOf(wide, "double_drifting").reason, HasSubstr("position_final"));
    const auto narrow = judged("narrow", "0.005");
    EXPECT_EQ(rowOf(narrow, "double_free_flight").verdict, Verdict::Fail);
}

/// The ball flies 4 m and more; symplectic Euler is 0.0074 m off, a thousandth: grade C, as its scheme has
/// it. The one that drifts is a metre off.
TEST_F(RunCases, AccuracyIsGradedAndChangesAreSeenAgainstTheRecord) {
    const std::string engines = "double_free_flight:preset=default,double_drifting:preset=default";
    const auto cases = plan({thrownBall("ball")}, engines);
    const auto first = RunCases::run(cases, options("first"));
    const auto &honest = rowOf(first, "double_free_flight"), &drifting = rowOf(first, "double_drifting");
    EXPECT_EQ(honest.accuracy.grade, results::Grade::C) << *honest.accuracy.relative;
    EXPECT_EQ(honest.accuracy.metric, "position_final");
    EXPECT_EQ(results::againstScheme(honest.accuracy.relative, honest.accuracy.ideal),
              results::AgainstScheme::Same);
    EXPECT_EQ(drifting.accuracy.grade, results::Grade::E) << *drifting.accuracy.relative;
    EXPECT_EQ(results::againstScheme(drifting.accuracy.relative, drifting.accuracy.ideal),
              results::AgainstScheme::Farther);
    EXPECT_EQ(honest.regression, results::Regression::NoRecord);
    EXPECT_TRUE(runIsGreen(first)) << "a metre off, and nothing that was better before";

    auto again = options("again");
    again.records = options("record").directory;
    (void)writeRecorded(first, again.records);
    const auto second = RunCases::run(cases, again);
    for (const auto& c : second.cases)
        EXPECT_EQ(c.regression, results::Regression::Unchanged) << c.regressionReason;

    auto better = first;  // record of another day
    for (auto& c : better.cases)
        for (auto& m : c.metrics) m.value *= 0.01;
    (void)writeRecorded(better, again.records);
    again.directory = options("third").directory;
    const auto third = RunCases::run(cases, again);
    for (const auto& c : third.cases) EXPECT_EQ(c.regression, results::Regression::Worse);
    EXPECT_FALSE(runIsGreen(third)) << "they lost a grade";
}

/// The reference's assumption (no contact) is broken by the scenario itself: the case runs, the reason is
/// reported, and nothing is compared with an exact solution that does not hold.
TEST_F(RunCases, AReferenceThatDoesNotHoldIsSaidAndNotUsed) {
    const auto wrong = fixtures::load(thrownBall("ball", R"(, "accept": {"*": {"position_final": 0.01}})"));
    auto cases = planCases({wrong}, adapter::parseSpecList("double_free_flight:preset=default"), {});
    std::string text = wrong.second;
    const auto at = text.find("free_flight");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string("free_flight").size(), "no_such_reference");
    cases[0].scenarioText = text;
    cases[0].scenario.reference->name = "no_such_reference";
    const auto run = RunCases::run(cases, options());
    EXPECT_FALSE(run.scenarios[0].referenceProblem.empty());
    EXPECT_EQ(run.cases[0].outcome, Outcome::Completed) << run.cases[0].reason;
    for (const auto& m : run.cases[0].metrics) EXPECT_NE(m.kind, "exact") << m.name;
}

TEST_F(RunCases, TwoAtATimeGiveTheResultsOfOne) {
    const auto cases = plan({thrownBall("a"), thrownBall("b"), thrownBall("c")},
                            "double_free_flight,double_drifting,double_nan");
    auto serial = options("serial"), parallel = options("parallel");
    parallel.jobs = 3;
    const std::string one = timeless(RunCases::run(cases, serial));
    EXPECT_EQ(one, timeless(RunCases::run(cases, parallel)));
    EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 18);
}

TEST_F(RunCases, ProgressCountsUpAndNamesWhatEnded) {
    const auto cases = plan({thrownBall("a")}, "double_free_flight,double_abort");
    std::vector<std::string> ended;
    Progress last;
    const std::atomic<bool> never{false};
    runCases(
        cases, options(),
        [&](const Progress& p) {
            if (p.finished != nullptr) ended.push_back(p.finished->engine);
            EXPECT_GE(p.done, last.done);
            last = p;
        },
        never);
    EXPECT_THAT(ended, testing::ElementsAre("double_free_flight", "double_free_flight", "double_abort",
                                            "double_abort"));
    EXPECT_EQ(last.done, 4);
    EXPECT_EQ(last.total, 4);
    EXPECT_EQ(last.crashed, 2);
}

TEST_F(RunCases, AnInterruptedRunIsResumed) {
    const auto cases = plan({thrownBall("a"), thrownBall("b")}, "double_free_flight,double_abort");
    std::atomic<bool> interrupted{false};
    runCases(
        cases, options(), [&](const Progress& p) { interrupted = p.done >= 3; }, interrupted);
    const auto partial = results::readRun(options().directory);
    EXPECT_EQ(partial.cases.size(), 3u);
    EXPECT_EQ(partial.finished, "");
    auto o = options();
    o.resume = true;
    std::int64_t skipped = 0;
    const std::atomic<bool> never{false};
    const auto resumed = runCases(
        cases, o, [&](const Progress& p) { skipped = p.skipped; }, never);
    EXPECT_EQ(skipped, 3);
    EXPECT_FALSE(resumed.finished.empty());
    EXPECT_EQ(timeless(resumed), timeless(RunCases::run(cases, options("whole"))));
}

TEST_F(RunCases, AResumedRunIsInterruptedWhileItReadsWhatIsStored) {
    const auto cases = plan({thrownBall("a"), thrownBall("b")}, "double_free_flight");
    const auto whole = RunCases::run(cases, options());
    fs::remove(options().directory / whole.cases.front().trajectoryFile);
    auto o = options();
    o.resume = true;
    o.command = "resumed";
    const std::atomic<bool> interrupted{true};
    const auto nothing = [](const Progress&) { FAIL() << "a case was begun"; };
    EXPECT_TRUE(runCases(cases, o, nothing, interrupted).cases.empty());
    const auto stored = results::readRun(o.directory);
    EXPECT_EQ(timeless(stored), timeless(whole));
    EXPECT_EQ(stored.command, whole.command) << "it has begun to write";
    EXPECT_EQ(timeless(RunCases::run(cases, o)), timeless(whole));
}

/// A plan may have a hundred thousand cases: their requests are not all on the disk at once.
TEST_F(RunCases, ARequestIsAFileOnlyWhileItsCaseRuns) {
    const fs::path temporary = scratch_.path() / "tmp";
    fs::create_directories(temporary);
    setenv("TMPDIR", temporary.c_str(), 1);
    const auto cases = plan({thrownBall("a"), thrownBall("b"), thrownBall("c")}, "double_free_flight");
    std::size_t most = 0;
    const auto countRequests = [&](const Progress&) {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(temporary))
            if (const fs::path& file = entry.path(); file.extension() == ".json")
                count += file.stem().extension() == ".answer" ? 0 : 1;
        most = std::max(most, count);
    };
    const std::atomic<bool> never{false};
    auto o = options();
    o.jobs = 2;
    const auto run = runCases(cases, o, countRequests, never);
    unsetenv("TMPDIR");
    EXPECT_EQ(run.cases.size(), 6u);
    EXPECT_GE(most, 1u);
    EXPECT_LE(most, 2u);
}

TEST_F(RunCases, ResumingAChangedPlanDropsCasesNoLongerRequested) {
    RunCases::run(plan({thrownBall("a"), thrownBall("b")}, "double_free_flight"), options());
    auto o = options();
    o.resume = true;
    const auto cases = plan({thrownBall("c"), thrownBall("b")}, "double_free_flight");
    const auto run = RunCases::run(cases, o);
    ASSERT_EQ(run.cases.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(run.cases[i].id, cases[i].id);
}

/// kill -9 in the middle of a run of slow cases, some of them faulty, with the audit on.
TEST_F(RunCases, AKilledRunIsResumedToTheSameResults) {
    const auto cases = plan({thrownBall("a"), fixtures::crossingBalls(), thrownBall("c")},
                            "double_free_flight:pause_us=500,double_abort,double_nan");
    auto o = options();
    o.audit = true;
    const pid_t parent = fork();
    if (parent == 0) {
        RunCases::run(cases, o);
        _exit(0);
    }
    std::size_t stored = 0;
    for (int i = 0; i < 3000 && stored < 7; ++i) {
        usleep(10000);
        try {
            stored = results::readRun(o.directory).cases.size();
        } catch (const std::runtime_error&) {  // the file is not there yet
        }
    }
    kill(parent, SIGKILL);
    int status = 0;
    waitpid(parent, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was to be killed before its end";
    const auto partial = results::readRun(o.directory);
    ASSERT_GE(partial.cases.size(), 7u);
    ASSERT_LT(partial.cases.size(), cases.size());

    o.resume = true;
    const auto resumed = RunCases::run(cases, o);
    auto whole = options("whole");
    whole.audit = true;
    const auto uninterrupted = RunCases::run(cases, whole);
    EXPECT_EQ(timeless(resumed), timeless(uninterrupted));
    for (const auto& row : uninterrupted.cases) {
        if (row.trajectoryFile.empty()) continue;
        expectSameMotion(results::readTrajectory(o.directory / row.trajectoryFile),
                         results::readTrajectory(whole.directory / row.trajectoryFile));
    }
}

TEST_F(RunCases, ARefusalKeepsWhoLacksWhat) {
    const auto refused = [&](const std::string& preset) {
        return RunCases::run(plan({thrownBall("ball")}, "double_refusing:preset=" + preset), options(preset))
            .cases.at(0);
    };
    const auto adapters = refused("matched"), librarys = refused("default");
    EXPECT_EQ(adapters.verdict, Verdict::Unsupported);
    EXPECT_EQ(adapters.refusal, "adapter");
    EXPECT_EQ(adapters.reason, "refusing: not in the adapter yet: balls for 'ball'");
    ASSERT_EQ(adapters.ledger.size(), 1u);
    EXPECT_EQ(adapters.ledger[0].requested, "balls");
    EXPECT_EQ(adapters.ledger[0].resolved, "not in the adapter yet");
    EXPECT_EQ(librarys.verdict, Verdict::Unsupported);
    EXPECT_EQ(librarys.refusal, "library");
    ASSERT_EQ(librarys.ledger.size(), 1u);
    EXPECT_EQ(librarys.ledger[0].resolved, "not in the library");
    EXPECT_EQ(librarys.ledger[0].realisation, "unsupported");
    EXPECT_THAT(librarys.ledger[0].reason, HasSubstr("refusing.h, shapes"));
}

TEST_F(RunCases, DescribesEnginesAndWhatIsWrongWithThem) {
    const auto good = describeEngine("double_free_flight", options().binary);
    EXPECT_EQ(good.problem, "");
    EXPECT_EQ(good.info.name, "double_free_flight");
    EXPECT_EQ(good.info.version, "1");
    EXPECT_EQ(good.info.precision, "f64");
    EXPECT_TRUE(good.capabilities.dynamics);
    ASSERT_EQ(good.options.size(), 3u);
    EXPECT_EQ(good.options[0].key, "pause_us");
    EXPECT_EQ(good.options[1].key, "allocations");
    EXPECT_EQ(good.options[2].key, "asleep");
    EXPECT_THAT(good.precisions, testing::ElementsAre("f64"));
    EXPECT_THAT(describeEngine("no_such_engine", options().binary).problem, HasSubstr("not installed"));
}

TEST_F(RunCases, DescribesAModuleOnceUntilItsFileChanges) {
    const fs::path folder = scratch_.path(), log = folder / "starts", program = folder / "program";
    std::ofstream(program) << "#!/bin/sh\necho \"$1 $2\" >>'" << log.string() << "'\nexec '"
                           << options().binary.string() << "' \"$@\"\n";
    fs::permissions(program, fs::perms::owner_all);
    const auto starts = [&] {
        std::ifstream in(log);
        std::vector<std::string> lines;
        for (std::string line; std::getline(in, line);) lines.push_back(line);
        return lines;
    };
    const fs::path module = folder / "rigor_adapter_double_copied.so";
    fs::copy_file(buildFolder() / "tests/doubles/rigor_adapter_double_free_flight.so", module);
    setenv("RIGOR_ADAPTER_PATH", folder.c_str(), 1);

    const auto first = describeEngine("double_copied", program);
    EXPECT_EQ(first.problem, "");
    const auto again = describeEngines({"double_copied", "double_copied:pause_us=1"}, program, 1);
    EXPECT_THAT(starts(),
                testing::ElementsAre("__describe double_copied", "__describe double_copied:pause_us=1"));
    EXPECT_EQ(capabilitiesText(again[0]), capabilitiesText(first));
    EXPECT_EQ(again[0].precisions, first.precisions);

    fs::remove(module);
    fs::copy_file(buildFolder() / "tests/doubles/rigor_adapter_double_rigid.so", module);
    const auto replaced = describeEngine("double_copied", program);
    EXPECT_NE(capabilitiesText(replaced), capabilitiesText(first));
    EXPECT_THAT(starts(), testing::SizeIs(3));

    // A module that could not be described may have been mended since.
    for (const std::size_t expected : {4u, 5u}) {
        std::ofstream(folder / "rigor_adapter_double_broken.so") << "no module";
        EXPECT_NE(describeEngine("double_broken", program).problem, "");
        EXPECT_THAT(starts(), testing::SizeIs(expected));
    }
}

}  // namespace
}  // namespace rigor::validation
