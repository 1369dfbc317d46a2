// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/guarded.hpp"
#include "cli/numbers.hpp"
#include "reports/model/view_model.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/results/files.hpp"
#include "validation/results/values.hpp"
#include "validation/runner/event_log.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/line_file.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/runner.hpp"
#include "validation/runner/scenario_settings.hpp"
#include "validation/symmetry/listing.hpp"

namespace rigor::cli {
namespace {

struct RunArguments {
    std::string scenario, engine = validation::kInHouseEngine, timeStep, csv, log;
    std::vector<std::string> overrides;
    validation::ReferenceLimits referenceLimits;
    int order = 1;
    bool json = false;
};

void writeCsvRows(std::ostream& out, double time, std::span<const validation::BodyState> states,
                  const scenario::Scenario& s) {
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto& b = states[i];
        out << results::exactText(time) << ',' << s.bodies[i].name;
        for (double v : {b.position.x, b.position.y, b.position.z, b.orientation.w, b.orientation.x,
                         b.orientation.y, b.orientation.z, b.velocity.x, b.velocity.y, b.velocity.z,
                         b.angularVelocity.x, b.angularVelocity.y, b.angularVelocity.z})
            out << ',' << results::finiteText(v);
        out << '\n';
    }
}

/// Content of the log that `--log` requests.
validation::LogWhat logWhat(const std::string& name) {
    if (name == "contacts") return validation::LogWhat::Contacts;
    return name == "events" ? validation::LogWhat::Events : validation::LogWhat::All;
}

/// Writes to standard error, whole steps at a time, so that a reader at the other end of a pipe follows the
/// run.
void writeLog(const std::string& lines) {
    if (lines.empty()) return;
    std::fwrite(lines.data(), 1, lines.size(), stderr);
    std::fflush(stderr);
}

nlohmann::ordered_json accuracyJson(const results::CaseRow& row) {
    const auto number = [](const std::optional<double>& v) {
        return v ? nlohmann::ordered_json(*v) : nlohmann::ordered_json(nullptr);
    };
    return {{"grade", results::gradeName(row.accuracy.grade)},
            {"metric", row.accuracy.metric},
            {"relative", number(row.accuracy.relative)},
            {"ideal", number(row.accuracy.ideal)},
            {"note", row.accuracy.note}};
}

nlohmann::ordered_json metricJson(const results::MetricRow& m) {
    nlohmann::ordered_json out{
        {"name", m.name}, {"subject", m.subject}, {"kind", m.kind}, {"value", m.value}, {"unit", m.unit}};
    if (m.bound) out["bound"] = *m.bound;
    if (m.boundMin) out["bound_min"] = *m.boundMin;
    out["verdict"] = results::verdictName(m.verdict);
    if (!m.note.empty()) out["note"] = m.note;
    return out;
}

nlohmann::ordered_json stepJson(const results::TimingRow& t) {
    nlohmann::ordered_json out{{"median", t.median}, {"p10", t.p10}, {"p90", t.p90}, {"samples", t.samples}};
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value) out[name] = *value;
    };
    add("first", t.first);
    add("mean", t.mean);
    add("p95", t.p95);
    add("p99", t.p99);
    add("worst", t.worst);
    add("real_time_factor", t.realTimeFactor);
    return out;
}

/// "step: median 12.3 us, mean 14.1 us, ..."; wall times of World::step alone.
void printStep(const results::TimingRow& t) {
    std::printf("  a step takes: median %.4g us", 1e6 * t.median);
    if (t.mean)
        std::printf(", mean %.4g us, p95 %.4g us, p99 %.4g us, worst %.4g us; the first apart %.4g us",
                    1e6 * *t.mean, 1e6 * t.p95.value_or(0.0), 1e6 * t.p99.value_or(0.0),
                    1e6 * t.worst.value_or(0.0), 1e6 * t.first.value_or(0.0));
    if (t.realTimeFactor) std::printf("; %.4g times real time", *t.realTimeFactor);
    std::printf("\n");
}

/// `note`: on the whole case; may be empty.
void printCase(const results::CaseRow& row, const std::string& note, bool json) {
    if (json) {
        nlohmann::ordered_json out{{"name", row.scenario},
                                   {"spec", row.spec},
                                   {"dt", row.dt},
                                   {"outcome", results::outcomeName(row.outcome)},
                                   {"verdict", results::verdictName(row.verdict)},
                                   {"reason", row.reason},
                                   {"note", note},
                                   {"steps", row.steps},
                                   {"state_hash", row.stateHash},
                                   {"accuracy", accuracyJson(row)},
                                   {"metrics", nlohmann::json::array()},
                                   {"quantities", nlohmann::json::array()}};
        if (const auto* step = report::stepTiming(row)) out["step"] = stepJson(*step);
        for (const auto& m : row.metrics) out["metrics"].push_back(metricJson(m));
        for (const auto& q : row.quantities) {
            out["quantities"].push_back({{"name", q.name}, {"unit", q.unit}, {"exact", q.exact}});
            if (q.schemeExact) out["quantities"].back()["scheme_exact"] = *q.schemeExact;
            if (q.measured) out["quantities"].back()["measured"] = *q.measured;
        }
        std::printf("%s\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        return;
    }
    std::printf("%s  %s  dt=%s  %lld steps  %s%s%s\n", row.scenario.c_str(), row.spec.c_str(),
                results::exactText(row.dt).c_str(), static_cast<long long>(row.steps),
                report::shownText(report::shownOf(row)).word, row.reason.empty() ? "" : ": ",
                row.reason.c_str());
    std::printf("  %s\n", report::accuracySentence(row).c_str());
    for (const auto& m : row.metrics) {
        if (!m.subject.empty()) continue;
        if (std::isnan(m.value))
            std::printf("  %-26s %-13s %14s %-8s", m.name.c_str(), m.kind.c_str(), "-", m.unit.c_str());
        else
            std::printf("  %-26s %-13s %14.6g %-8s", m.name.c_str(), m.kind.c_str(), m.value, m.unit.c_str());
        if (m.bound && m.boundMin)
            std::printf("  bounds %.4g to %.4g  %s", *m.boundMin, *m.bound, results::verdictName(m.verdict));
        if (m.bound && !m.boundMin)
            std::printf("  bound %.4g  %s", *m.bound, results::verdictName(m.verdict));
        if (m.verdict == results::Verdict::Fail && !m.note.empty()) std::printf(" (%s)", m.note.c_str());
        std::printf("\n");
    }
    for (const auto& q : row.quantities) {
        std::printf("  %-26s exact %.10g %s", q.name.c_str(), q.exact, q.unit.c_str());
        if (q.measured)
            std::printf(", measured %.10g", *q.measured);
        else
            std::printf(", did not happen");
        std::printf("\n");
    }
    if (const auto* step = report::stepTiming(row)) printStep(*step);
}

/// An exception of a library is a failure of its engine: a red row, as in `validate`.
validation::LiveCase runEngine(const scenario::Scenario& s, const adapter::EngineSpec& spec, double dt,
                               const validation::LiveOptions& options) {
    (void)adapter::moduleFor(spec);
    try {
        return validation::runInProcess(s, spec, dt, options);
    } catch (const adapter::BadInput&) {
        throw;
    } catch (const adapter::Unsupported&) {
        throw;
    } catch (const std::exception& error) {
        validation::LiveCase failed;
        failed.row.scenario = s.name;
        failed.row.spec = spec.text();
        failed.row.dt = dt;
        failed.row.outcome = results::Outcome::Error;
        failed.row.verdict = results::Verdict::Fail;
        failed.row.reason = error.what();
        return failed;
    }
}

/// The scenario in one of the orders that `rigor validate --orders` runs; 1 is the one as written.
validation::Transformed otherOrder(const scenario::Scenario& s, int order) {
    const auto others = static_cast<std::size_t>(order - 1);
    const auto listings = validation::otherListings(s, others);
    if (listings.size() < others)
        throw std::invalid_argument("--order: found " + std::to_string(order) + ", expected at most " +
                                    std::to_string(listings.size() + 1) + ": so many orders '" + s.name +
                                    "' has");
    return validation::listed(s, listings.back());
}

int runHere(const RunArguments& a) {
    validation::ReferenceCheck reference;
    const auto loaded = loadWithReference(a.scenario, a.overrides, a.referenceLimits, false, &reference);
    const auto& s = loaded.scenario;
    limitTime(1.5 * s.timeLimit + a.referenceLimits.seconds);  // engine, metrics and reference together
    const double dt = a.timeStep.empty() ? s.timeSteps.front() : parseTimeStep(a.timeStep);
    std::ofstream csvFile;
    std::ostream* csv = nullptr;
    if (a.csv == "-")
        csv = &std::cout;
    else if (!a.csv.empty()) {
        csvFile.open(a.csv);
        if (!csvFile)
            throw std::invalid_argument("--csv: cannot write '" + a.csv + "': " + std::strerror(errno));
        csv = &csvFile;
    }
    if (csv != nullptr) *csv << "t,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
    validation::LiveOptions options;
    if (!reference.problem.empty()) options.withoutReference = reference;
    options.onSimulated = [&] {
        validation::setAlarm((a.referenceLimits.seconds + 0.5 * s.timeLimit) * validation::timeLimitFactor());
    };
    if (a.order > 1) options.given = otherOrder(s, a.order);
    const scenario::Scenario& given = options.given ? options.given->scenario : s;
    validation::EventLog log(given, dt, logWhat(a.log));
    validation::EventLog::EngineReports reports;
    if (!a.log.empty())
        options.onWorld = [&](const adapter::World& world) {
            reports = {[&](int body) { return world.isAsleep(body); },
                       [&](int joint) { return world.jointHolds(joint); }, world.contactInstant()};
        };
    options.onStep = [&](double time, std::span<const validation::BodyState> states,
                         const std::vector<validation::ContactPoint>& contacts) {
        if (csv != nullptr) writeCsvRows(*csv, time, states, given);
        if (!a.log.empty()) writeLog(log.step(time, states, contacts, reports));
    };
    const auto live = runEngine(
        s, validation::withScenarioSettings(adapter::parseSpec(a.engine), loaded.text), dt, options);
    validation::setAlarm(0.0);
    if (csv != nullptr && !csv->flush()) throw results::EnvironmentError(a.csv, "cannot be written", errno);
    const std::string note = missesByOtherValues(live.row, a.overrides) ? kBoundsNote : "";
    if (a.csv != "-") printCase(live.row, note, a.json);
    if (!note.empty()) std::fprintf(stderr, "note: %s\n", note.c_str());
    switch (live.row.verdict) {
        case results::Verdict::Pass:
        case results::Verdict::KnownDeviation:
            return kOk;
        case results::Verdict::Unsupported:
            return kUnsupported;
        case results::Verdict::NoReference:
            return kNoReference;
        default:
            return kRed;
    }
}

}  // namespace

void addRun(CLI::App& app, Action& action) {
    auto a = std::make_shared<RunArguments>();
    auto* command = app.add_subcommand("run", "Run one case and print its metrics");
    offerNames(command->add_option("SCENARIO", a->scenario, "Name or file")->required(), kScenarioNames);
    offerNames(command->add_option("-e,--engine", a->engine, "Engine spec (default: rigor)"), kEngineNames);
    command->add_option("--dt", a->timeStep,
                        "Time step in seconds (0.004 or 1/240); default: the scenario's first");
    command
        ->add_option("--set", a->overrides,
                     "Override a scenario value: KEY=VALUE, e.g. bodies.block.velocity=[3.1,0,0.2]")
        ->allow_extra_args(false);
    command->add_option("--csv", a->csv,
                        "Write every step of every body (t,body,px,...,wz); '-' for standard output");
    command
        ->add_option(
            "--log", a->log,
            "Follow the run on standard error, a line for each event: contacts (begin, persist, end), "
            "events (begin, end, impact, break, sleep, wake), all")
        ->check(CLI::IsMember({"contacts", "events", "all"}));
    command
        ->add_option("--order", a->order,
                     "In the K-th order of insertion, as of `rigor validate --orders`; 1: as written")
        ->check(between(1, 1000));
    addReferenceLimit(*command, a->referenceLimits);
    command->add_flag("--json", a->json, "Print the result as JSON");
    command->callback([a, &action] {
        action = [a] {
            return runGuarded(a->engine, a->scenario, a->referenceLimits, [a] { return runHere(*a); });
        };
    });
}

}  // namespace rigor::cli
