// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Replay files: the requested data are in them, within the budget, and reads back within half a quantum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/encoding/data_files.hpp"
#include "reports/model/view_model.hpp"
#include "reports/replay/codec.hpp"
#include "reports/replay/data.hpp"
#include "reports/replay/events.hpp"
#include "reports/replay/frames.hpp"
#include "reports/tests/replay_reader.hpp"

namespace rigor::report {
namespace {

using nlohmann::json;
using replay_reader::Bundle;
using replay_reader::Codes;
using results::CaseRow;
using results::TrajectoryFile;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// ---- a run with two engines ----

/// `bodies` swinging bodies above a floor; contacts with the floor every tenth frame.
TrajectoryFile makeFile(const CaseRow& row, std::size_t bodies, std::size_t frames, double shift = 0.0) {
    TrajectoryFile f;
    f.scenario = row.scenario;
    f.spec = row.spec;
    f.caseId = row.id;
    f.dt = row.dt;
    f.contactStride = 2;
    f.bodies.resize(bodies + 1);
    f.bodies[0].name = "floor";
    for (std::size_t b = 1; b <= bodies; ++b) f.bodies[b].name = "b" + std::to_string(b);
    for (std::size_t i = 0; i < frames; ++i) {
        const double t = static_cast<double>(i) * row.dt;
        f.times.push_back(t);
        for (std::size_t b = 0; b <= bodies; ++b) {
            const double phase = static_cast<double>(b), s = b == 0 ? 0.0 : 1.0;
            const double turned = s * std::sin(t + phase) / 2.0;
            const auto add = [](results::Channel& c, std::initializer_list<double> v) {
                c.columns = static_cast<int>(v.size());
                c.values.insert(c.values.end(), v);
            };
            add(f.bodies[b].position,
                {s * (std::cos(3 * t + phase) + shift * t), s * std::sin(2 * t * phase), s * t});
            add(f.bodies[b].orientation, {std::cos(turned), 0, std::sin(turned), 0});
            add(f.bodies[b].velocity, {-3 * s * std::sin(3 * t), s, s});
            add(f.bodies[b].angularVelocity, {0, s * std::cos(t), 0});
        }
        if (i % 20 != 10) continue;
        for (int b = 1; b <= static_cast<int>(bodies); ++b) {
            results::ContactSample c;
            c.time = t;
            c.bodyA = 0;
            c.bodyB = b;
            c.depth = 1e-4 * std::sin(t + b);
            c.normal[1] = 1.0;
            c.pointA[0] = std::cos(t + b);
            c.pointB[0] = c.pointA[0];
            c.pointB[1] = -c.depth;
            c.normalImpulse = b % 2 ? kNaN : 0.02 * b;
            c.frictionImpulse[2] = 1e-3;
            f.contacts.push_back(c);
        }
    }
    return f;
}

class ReplayFiles : public testing::Test {
  protected:
    ReplayFiles() {
        run_.scenarios.push_back({});
        run_.scenarios[0].name = "swing";
        run_.scenarios[0].timeSteps = {0.01};
        for (const char* spec : {"rigor:preset=matched", "ode:preset=matched"}) {
            CaseRow row;
            row.id = std::string("id_") + spec;
            row.scenario = "swing";
            row.spec = spec;
            row.dt = 0.01;
            row.engine = std::string(spec).substr(0, std::string(spec).find(':'));
            row.preset = "matched";
            run_.cases.push_back(row);
            files_.emplace_back(makeFile(row, 3, 401));
        }
    }
    Bundle write() {
        const ViewModel view(run_);
        return Bundle(replayBundle(view, 0, 0, loader(), budget_));
    }
    FullTrajectoryLoader loader() {
        return [this](const CaseRow& row) -> std::optional<TrajectoryFile> {
            for (std::size_t i = 0; i < run_.cases.size(); ++i)
                if (run_.cases[i].id == row.id) return files_[i];
            return std::nullopt;
        };
    }
    std::size_t caseOf(const Bundle& bundle, const std::string& spec) {
        for (std::size_t i = 0; i < bundle.meta["cases"].size(); ++i)
            if (bundle.meta["cases"][i]["spec"] == spec) return i;
        ADD_FAILURE() << spec;
        return 0;
    }
    static bool has(const std::vector<double>& steps, double step) {
        return std::find(steps.begin(), steps.end(), step) != steps.end();
    }

    results::Run run_;
    std::vector<std::optional<TrajectoryFile>> files_;
    ReplayBudget budget_;
};

TEST(ReplayCodec, ReadsBackWithinHalfAQuantumAndKeepsWhatIsNotFinite) {
    const std::vector<double> values{0.1,   kNaN, 1e3, -2.5, std::numeric_limits<double>::infinity(),
                                     1e300, 0.25};
    for (const double quantum : {0x1.0p-20, 0x1.0p-3}) {
        Bytes bytes;
        appendSeries(bytes, values, 1, quantum);
        const auto back = Codes({bytes.begin(), bytes.end()}).series(values.size(), quantum);
        const std::vector<std::int64_t> links{-1, 0, 1, 0, 2, 3, 5};
        Bytes linkedBytes;
        appendLinked(linkedBytes, values, links, quantum);
        const auto linked = Codes({linkedBytes.begin(), linkedBytes.end()}).linked(links, quantum);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::abs(values[i] / quantum) <= kMostQuanta) {
                EXPECT_NEAR(back[i], values[i], quantum / 2) << i;
                EXPECT_NEAR(linked[i], values[i], quantum / 2) << i;
            } else {
                EXPECT_TRUE(std::isnan(back[i]) && std::isnan(linked[i])) << i;
            }
        }
    }
}

TEST(ReplayCodec, StraightLinesCostOneByteAValue) {
    std::vector<double> values;
    for (int i = 0; i < 500; ++i) {
        values.push_back(0.125 * i);
        values.push_back(7.0 - 3.0 * i);
    }
    Bytes bytes;
    appendSeries(bytes, values, 2, 0x1.0p-20);
    EXPECT_LT(bytes.size(), 1020u);
}

TEST(ReplayCodec, QuantumIsAPowerOfTwo) {
    EXPECT_EQ(quantumOf(3.0, 10, 1e-12), 0x1.0p-9);
    EXPECT_EQ(quantumOf(kNaN, 10, 1e-12), 1e-12);
    EXPECT_EQ(quantumOf(0.0, 10, 1e-12), 1e-12);
}

TEST(ReplayFrames, KeepsFirstLastMarkedAndMultiples) {
    const auto kept = keptFrames(1000, 50, 4, {333, 500, 2000});
    EXPECT_EQ(kept.front(), 0u);
    EXPECT_EQ(kept.back(), 999u);
    EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 333u));
    EXPECT_LE(kept.size(), 53u);
    EXPECT_GE(kept.size(), 30u);
    for (const auto f : kept) EXPECT_TRUE(f % 4 == 0 || f == 333 || f == 999) << f;
    EXPECT_EQ(keptFrames(1, 50, 1, {}), std::vector<std::size_t>{0});
    EXPECT_TRUE(keptFrames(0, 50, 1, {}).empty());
    EXPECT_EQ(keptFrames(5, 300, 1, {}).size(), 5u);
}

TEST_F(ReplayFiles, PositionsReadBackWithinTheQuantum) {
    Bundle bundle = write();
    EXPECT_EQ(bundle.meta["bodies"], json({"floor", "b1", "b2", "b3"}));
    const auto& head = bundle.meta["cases"][0];
    EXPECT_EQ(head["moving"], json({1, 2, 3}));
    EXPECT_EQ(head["stored"], 401);
    const auto steps = bundle.steps(0);
    Codes codes(bundle.arrays.at("0.position"));
    const double quantum = head["quantum"]["position"];
    EXPECT_LT(quantum, 1e-5);
    for (int b = 1; b <= 3; ++b)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto column = codes.series(steps.size(), quantum);
            for (std::size_t i = 0; i < steps.size(); ++i) {
                const auto f = static_cast<std::size_t>(steps[i]);
                EXPECT_NEAR(column[i], files_[0]->bodies[b].position.values[3 * f + k], 0.51 * quantum);
            }
        }
}

TEST_F(ReplayFiles, HasTheFramesOfAllEvents) {
    auto& row = run_.cases[0];
    row.metrics.push_back({"position_max", "b1", "m", "exact", 0.5, 1.2345, {}, {}, {}, ""});
    results::AuditRow audit;
    audit.auditor = "ode";
    audit.normalErrorMax = 0.7;
    audit.worst = "b1|floor at t=2.77 (normal)";
    row.audit.push_back(audit);
    files_[1] = makeFile(run_.cases[1], 3, 401, 0.05);  // drifts away from the first
    Bundle bundle = write();
    const auto c = caseOf(bundle, row.spec);
    const auto steps = bundle.steps(c);
    EXPECT_TRUE(has(steps, 0) && has(steps, 400) && has(steps, 123) && has(steps, 277));
    std::map<std::string, int> kinds;
    for (const auto& event : bundle.meta["cases"][c]["events"]) {
        ++kinds[event["kind"]];
        EXPECT_TRUE(has(steps, std::round(event["time"].get<double>() / 0.01))) << event;
        if (event["kind"] == "engine_divergence") {
            EXPECT_EQ(event["what"], "ode:preset=matched");
            EXPECT_GT(event["value"], event["threshold"]);
        }
    }
    EXPECT_EQ(kinds["largest"], 1);
    EXPECT_EQ(kinds["audit"], 1);
    EXPECT_EQ(kinds["engine_divergence"], 1);
    EXPECT_GT(kinds["contact_begin"], 0);
    EXPECT_GT(kinds["contact_end"], 0);
}

TEST_F(ReplayFiles, TheFirstContactEventsAreKept) {
    files_[0] = makeFile(run_.cases[0], 3, 801);
    Bundle bundle = write();
    std::size_t events = 0;
    for (const auto& event : bundle.meta["cases"][caseOf(bundle, run_.cases[0].spec)]["events"])
        events += event["kind"] == "contact_begin" || event["kind"] == "contact_end";
    EXPECT_EQ(events, kMostContactEvents);
}

/// A time of six digits ends before the frame: the step decides.
TEST_F(ReplayFiles, TheFrameOfAnAuditIsThatOfItsStep) {
    results::AuditRow audit;
    audit.auditor = "in_run";
    audit.normalErrorMax = 0.7;
    for (auto& row : run_.cases) row.dt = 1.0 / 60.0;
    run_.scenarios[0].timeSteps = {1.0 / 60.0};
    for (std::size_t i = 0; i < files_.size(); ++i) files_[i] = makeFile(run_.cases[i], 3, 401);
    audit.worst = "floor|b1 at t=2.61, step 157, contact 3 (normal)";  // a time with even fewer digits
    run_.cases[0].audit.push_back(audit);
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    std::size_t audits = 0;
    for (const auto& event : bundle.meta["cases"][c]["events"])
        if (event["kind"] == "audit") {
            EXPECT_DOUBLE_EQ(event["time"], 157 * (1.0 / 60.0));
            EXPECT_EQ(event["contact"], 3);
            ++audits;
        }
    EXPECT_EQ(audits, 1u);
    EXPECT_TRUE(has(bundle.steps(c), 157));
}

/// The place of a run's worst is that of a missed contact here; the wrong normal is marked at its own frame.
TEST_F(ReplayFiles, EveryFindingIsMarkedAtItsOwnFrame) {
    results::AuditRow own;
    own.auditor = "in_run";
    own.missed = 1;
    own.normalErrorMax = 0.25;
    own.worst = "floor|b1 at t=1.5, step 150 (missed)";
    own.findings =
        R"([{"what":"missed","error":0.002,"unit":"m","step":150,"names":["floor","b1"],"contact":-1},
            {"what":"normal","error":0.25,"unit":"rad","step":222,"names":["b0","b1"],"contact":2},
            {"what":"depth","error":0.003,"unit":"m","step":33,"names":["floor","b2"],"contact":0}])";
    results::AuditRow query = own;
    query.auditor = "ode";
    query.findings =
        R"([{"what":"normal","error":1e-9,"unit":"rad","step":10,"names":["b0","b1"],"contact":-1},
            {"what":"depth","error":0.003,"unit":"m","step":33,"names":["floor","b2"],"contact":-1}])";
    run_.cases[0].audit = {own, query};
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    std::map<std::string, nlohmann::json> marks;
    for (const auto& event : bundle.meta["cases"][c]["events"])
        if (event["kind"] == "audit") marks[event["text"]] = event;
    ASSERT_EQ(marks.size(), 3u) << "rounding and the depths of queries get no mark";
    const auto& normal = marks["normal"];
    EXPECT_DOUBLE_EQ(normal["time"], 2.22);
    EXPECT_DOUBLE_EQ(normal["value"], 0.25);
    EXPECT_EQ(normal["unit"], "rad");
    EXPECT_EQ(normal["subject"], "b0|b1");
    EXPECT_EQ(normal["contact"], 2);
    EXPECT_DOUBLE_EQ(marks["missed"]["time"], 1.5);
    EXPECT_DOUBLE_EQ(marks["depth"]["time"], 0.33);
}

TEST_F(ReplayFiles, DivergenceFromTheReferenceIsTheFirstFrameBeyondTheThreshold) {
    auto& file = *files_[0];
    file.reference = {file.bodies[1]};
    auto& x = file.bodies[1].position.values;
    for (std::size_t f = 100; f < 401; ++f) x[3 * f] += 1.0;
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    json found;
    for (const auto& event : bundle.meta["cases"][c]["events"])
        if (event["kind"] == "divergence") found = event;
    ASSERT_FALSE(found.is_null());
    EXPECT_DOUBLE_EQ(found["time"], 1.0);
    EXPECT_NEAR(found["value"], 1.0, 1e-12);
    ASSERT_FALSE(bundle.meta["reference"].is_null());
    EXPECT_EQ(bundle.meta["reference"]["moving"], json({1}));
    EXPECT_TRUE(bundle.arrays.contains("reference.position"));
}

TEST_F(ReplayFiles, WhatIsNotFiniteStaysSo) {
    auto& values = files_[0]->bodies[2].position.values;
    for (std::size_t i = 3 * 200; i < values.size(); ++i) values[i] = kNaN;
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    const auto steps = bundle.steps(c);
    Codes codes(bundle.arrays.at(std::to_string(c) + ".position"));
    for (int column = 0; column < 3; ++column) codes.series(steps.size(), 1.0);  // b1
    const auto x = codes.series(steps.size(), 1.0);
    for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(std::isnan(x[i]), steps[i] >= 200) << steps[i];
    bool reported = false;
    for (const auto& event : bundle.meta["cases"][c]["events"])
        reported =
            reported || (event["kind"] == "nonfinite" && event["subject"] == "b2" && event["time"] == 2.0);
    EXPECT_TRUE(reported);
}

TEST_F(ReplayFiles, ContactsReadBack) {
    Bundle bundle = write();
    const auto& head = bundle.meta["cases"][0];
    const auto counts = Codes(bundle.arrays.at("0.contactCounts")).series(head["frames"], 1.0);
    const auto steps = bundle.steps(0);
    std::size_t total = 0;
    std::vector<std::size_t> source;  // contact of the file behind each one
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (counts[i] < 0) continue;
        EXPECT_EQ(counts[i], std::fmod(steps[i], 20) == 10 ? 3 : 0) << steps[i];
        for (int k = 0; k < counts[i]; ++k)
            source.push_back(3 * static_cast<std::size_t>((steps[i] - 10) / 20) +
                             static_cast<std::size_t>(k));
        total += static_cast<std::size_t>(counts[i]);
    }
    ASSERT_EQ(head["contacts"], total);
    ASSERT_GT(total, 30u);
    std::vector<std::int64_t> previous, chain;
    for (std::size_t i = 0; i < total; ++i) {
        previous.push_back(static_cast<std::int64_t>(i) - 3);
        chain.push_back(static_cast<std::int64_t>(i) - 1);
    }
    for (std::size_t i = 0; i < 3; ++i) previous[i] = -1;
    Codes ids(bundle.arrays.at("0.contactIds"));
    ids.linked(chain, 1.0);
    const auto bodyB = ids.linked(chain, 1.0);
    Codes numbers(bundle.arrays.at("0.contactNumbers"));
    const double q = head["contactQuantum"]["point"], dq = head["contactQuantum"]["depth"];
    const auto x = numbers.linked(previous, q);
    for (int skip = 0; skip < 8; ++skip) numbers.linked(previous, 1.0);
    const auto depth = numbers.linked(previous, dq), impulse = numbers.linked(previous, 1.0);
    for (std::size_t i = 0; i < total; ++i) {
        const auto& c = files_[0]->contacts[source[i]];
        EXPECT_EQ(bodyB[i], c.bodyB);
        EXPECT_NEAR(x[i], c.pointA[0], 0.51 * q);
        EXPECT_NEAR(depth[i], c.depth, 0.51 * dq);
        EXPECT_LT(dq, 1e-6);
        EXPECT_EQ(std::isnan(impulse[i]), c.bodyB % 2 == 1);
    }
}

TEST_F(ReplayFiles, ManyBodiesKeepTheBudgetOnAverage) {
    for (std::size_t i = 0; i < files_.size(); ++i) files_[i] = makeFile(run_.cases[i], 300, 301);
    const ViewModel view(run_);
    double bytes = 0.0;
    constexpr int kTimes = 3;
    for (int i = 0; i < kTimes; ++i)
        bytes += static_cast<double>(gzip(replayBundle(view, 0, 0, loader(), budget_)).size());
    const double cases = static_cast<double>(kTimes * run_.cases.size());
    // Names and first poses of 300 bodies are no case's: about 6 kB a file.
    EXPECT_LT(bytes / cases, 1.25 * kReplayBytesPerCase);
    EXPECT_GT(bytes / cases, 0.3 * kReplayBytesPerCase) << "the budget is not used";
}

TEST_F(ReplayFiles, SmallCasesLeaveTheirRestToLargeOnes) {
    EXPECT_DOUBLE_EQ(budget_.allowance(), kReplayBytesPerCase);
    budget_.spend(0.0);
    EXPECT_GT(budget_.allowance(), kReplayBytesPerCase);
    for (int i = 0; i < 1000; ++i) budget_.spend(0.0);
    EXPECT_DOUBLE_EQ(budget_.allowance(), kReplayBytesAtMost);
    for (int i = 0; i < 1000; ++i) budget_.spend(1e6);
    EXPECT_DOUBLE_EQ(budget_.allowance(), kReplayBytesPerCase / 4);
}

TEST_F(ReplayFiles, CasesWithoutFramesSayWhy) {
    files_[0].reset();
    run_.cases[0].outcome = results::Outcome::Crashed;
    run_.cases[0].reason = "SIGSEGV";
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    EXPECT_EQ(bundle.meta["cases"][c]["frames"], 0);
    EXPECT_EQ(bundle.meta["cases"][c]["outcome"], "crashed");
    EXPECT_EQ(bundle.meta["cases"][c]["reason"], "SIGSEGV");
    EXPECT_GT(bundle.meta["cases"][1 - c]["frames"], 100);
}

TEST_F(ReplayFiles, RunsThatEndEarlyKeepWhatTheyHave) {
    files_[0] = makeFile(run_.cases[0], 3, 37);
    run_.cases[0].outcome = results::Outcome::Crashed;
    Bundle bundle = write();
    const auto c = caseOf(bundle, run_.cases[0].spec);
    EXPECT_EQ(bundle.meta["cases"][c]["frames"], 37);
    EXPECT_EQ(bundle.steps(c).back(), 36);
}

TEST_F(ReplayFiles, TimeStepsAreThoseThatWereRun) {
    run_.scenarios[0].timeSteps = {1.0, 0.5};  // the file's; the command line requested others
    run_.cases[1].dt = 0.02;
    const ViewModel view(run_);
    EXPECT_EQ(replaySteps(view, 0), (std::vector<double>{0.02, 0.01}));
    std::vector<std::string> names;
    replayFiles(view, 0, loader(), budget_, [&](const std::string& name, const std::string& bundle) {
        names.push_back(name);
        EXPECT_EQ(Bundle(bundle).meta["dt"], names.size() == 1 ? 0.02 : 0.01);
    });
    EXPECT_EQ(names, (std::vector<std::string>{"replay-0-0", "replay-0-1"}));
}

TEST_F(ReplayFiles, NothingToShowIsNoFile) {
    files_[0].reset();
    files_[1].reset();
    const ViewModel view(run_);
    EXPECT_EQ(replayBundle(view, 0, 0, loader(), budget_), "");
    files_[0] = TrajectoryFile{};
    files_[1] = TrajectoryFile{};
    EXPECT_EQ(replayBundle(view, 0, 0, loader(), budget_), "");
}

TEST(ReplayEvents, NearestFrame) {
    EXPECT_EQ(nearestFrame({}, 1.0), 0u);
    EXPECT_EQ(nearestFrame({0.0, 1.0, 2.0}, 1.4), 1u);
    EXPECT_EQ(nearestFrame({0.0, 1.0, 2.0}, 1.6), 2u);
    EXPECT_EQ(nearestFrame({0.0, 1.0, 2.0}, 9.0), 2u);
    EXPECT_EQ(nearestFrame({0.0, 1.0, 2.0}, -9.0), 0u);
}

}  // namespace
}  // namespace rigor::report
