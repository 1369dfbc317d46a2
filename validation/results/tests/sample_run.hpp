// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A run with every field set, among them doubles that a conversion easily changes.
#pragma once

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "validation/results/types.hpp"

namespace rigor::results::sample {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kNanValue = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kDenormal = 5e-324;

inline bool sameBits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// A folder of its own that goes away with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "rigor-test-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline CaseRow caseRow(const std::string& id, std::int64_t position) {
    CaseRow c;
    c.id = id;
    c.position = position;
    c.scenario = "slide";
    c.spec = "ode:preset=matched";
    c.engine = "ode";
    c.preset = "matched";
    c.dt = 1.0 / 240.0;
    c.outcome = Outcome::Completed;
    c.verdict = Verdict::KnownDeviation;
    c.reason = "quote ' and \"line\nbreak\" and \xc3\xa9";
    c.refusal = "library";
    c.wallSeconds = 0.1;
    c.cpuSeconds = 1.0 / 3.0;
    c.steps = 1ll << 40;
    c.peakMemoryKiB = 12345;
    c.stateHash = "00ff";
    c.trajectoryFile = "trajectories/x.h5";
    c.command = "./rigor run slide";
    c.settings = {{"iterations", "20"}, {"solver", "quickstep"}};
    c.metrics = {{"position_final", "", "m", "exact", 0.1 + 0.2, 1.5, 0.02, 0.5, Verdict::KnownDeviation,
                  "skin", 1.0 / 3.0, kInf, kDenormal, -0.0},
                 {"energy_drift", "block", "1", "invariant", kNanValue, -1.0, {}, {}, Verdict::Pass, ""},
                 {"sink", "", "m", "rest", kInf, -0.0, -kInf, kDenormal, Verdict::Fail, ""}};
    c.metrics[0].orderMin = 0.1;
    c.metrics[0].orderMax = kInf;
    c.metrics[0].orderCount = 5;
    c.metrics[0].boundMin = 0.1 + 0.2;
    c.orders = {5,
                4,
                Grade::C,
                Grade::E,
                "order 3: crashed (SIGSEGV)",
                1,
                "pass 4, crashed 1",
                OrderDependence::Verdict};
    c.quantities = {{"stop_distance", "m", 1.63, 1.64, {}}, {"t", "s", 1.0, {}, kNanValue}};
    c.ledger = {{"friction_law", "cone", "pyramid", "approximate", "the library has no other"}};
    c.readBack = {{"mass", "block", 2.0, std::nextafter(2.0, 3.0), 4.4e-16, true},
                  {"inertia", "block", 1.0, 2.0, 1.0, false}};
    c.audit = {{"bullet",
                "completed",
                20,
                40,
                10,
                1,
                2,
                3,
                1e-3,
                {},
                kDenormal,
                -0.0,
                {},
                "block|floor",
                "note",
                "[]"}};
    c.timings = {{"step", 1e-6, 5e-7, 2e-6, 0.5, 360, 4.0, 0.1 + 0.2, kDenormal, 7, 4e-4, 1.1e-6, kDenormal,
                  2e-6, kInf, 1e4},
                 {"build", 1e-6, 5e-7, 2e-6, 0.5, 1, 4.0}};
    c.accuracy = {Grade::D, "position_final", 0.1 / 3.0, {}, "why not"};
    c.regression = Regression::Worse;
    c.regressionReason = "position_final 0.2 -> 0.3 m";
    return c;
}

inline Run header() {
    Run run;
    run.suite = "smoke";
    run.command = "rigor validate smoke";
    run.started = "2026-01-01T00:00:00Z";
    run.environment = {{"cpu", "some cpu"}, {"kernel", "6.1"}};
    run.engines = {
        {"rigor", "Rigor", "0.1", "f64", "flags", "", R"({"capabilities":{"planar":true}})", "0.1.1"},
        {"gone", "", "", "", "", "not installed"}};
    ScenarioRow s;
    s.name = "slide";
    s.title = "A block";
    s.description = "d";
    s.source = "Coulomb 1785";
    s.isolates = {"friction"};
    s.tags = {"a", "b"};
    s.observed = {"block"};
    s.metrics = {"position_final"};
    s.dimension = 2;
    s.duration = 1.5;
    s.timeSteps = {1.0 / 60.0, 1.0 / 240.0};
    s.reference = "sliding_stop";
    s.referenceTitle = "rt";
    s.referenceFormula = "x = v0 t - mu g t^2 / 2";
    s.referenceTex = "x = v_0 t - \\tfrac12 \\mu g t^2";
    s.referenceSource = "rs";
    s.referenceProblem = "";
    s.text = "{\"rigor\": 1}";
    s.referenceOutcome = "holds";
    run.scenarios = {s};
    run.plannedCases = 3;
    return run;
}

}  // namespace rigor::results::sample
