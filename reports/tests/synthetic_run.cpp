// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/tests/synthetic_run.hpp"
#include "reports/model/trajectory_loader.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace rigor::report::synthetic {
namespace {

using namespace results;

/// A small generator with the same numbers everywhere.
class Rng {
  public:
    explicit Rng(std::uint64_t seed) : state_(seed * 2862933555777941757ull + 3037000493ull) {}
    double operator()() {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 7;
        state_ ^= state_ << 17;
        return static_cast<double>(state_ >> 11) * 0x1.0p-53;
    }

  private:
    std::uint64_t state_;
};

struct Kind {
    const char *name, *title, *isolates, *reference, *formula, *metric, *unit;
    int dimension;
};
constexpr std::array<Kind, 8> kKinds{
    {{"free_flight", "A thrown ball", "integration", "free_flight", "p(t) = p0 + v0 t + g t²/2",
      "position_max", "m", 3},
     {"sliding_stop", "A block slides to rest", "friction", "sliding_stop",
      "v(t) = v0 − µ g t,  until t = v0 / (µ g)", "position_final", "m", 3},
     {"bounce", "A ball bounces", "restitution", "bouncing_ball", "h_n = e^(2n) h_0", "position_max", "m", 2},
     {"pendulum", "A physical pendulum", "joints", "physical_pendulum", "T = 4 sqrt(I/(m g l)) K(sin(θ0/2))",
      "position_max", "m", 2},
     {"top", "A torque-free asymmetric top", "rotation", "free_top", "I1 ω1' = (I2 − I3) ω2 ω3, cyclic",
      "orientation_max", "rad", 3},
     {"stack", "Ten boxes at rest", "stacking", "rest", "p(t) = p(0)", "position_max", "m", 3},
     {"cradle", "Newton's cradle", "impact", "cradle", "the last ball leaves with the first one's velocity",
      "velocity_final", "m/s", 2},
     {"pile", "A pile of a hundred bodies", "robustness", "", "", "penetration_max", "m", 3}}};

constexpr std::array<const char*, 9> kSpecs{
    "rigor:preset=default",  "rigor:preset=matched", "bullet:preset=default",
    "bullet:preset=matched", "box2d:preset=default", "box2d:preset=matched",
    "ode:preset=default",    "ode:preset=matched",   "ode:preset=matched,stepper=quickstep"};

void fillNumbers(CaseRow& c, const Kind& kind, double error, Rng& rng) {
    const bool hasReference = *kind.reference != '\0';
    const double bound = 2e-2 * c.dt * 60;
    const auto judge = [&](double v, std::optional<double> b) {
        return b && v > *b ? Verdict::Fail : Verdict::Pass;
    };
    const bool judged = hasReference && !(c.engine == "box2d" && c.preset == "default");
    const std::optional<double> limit = judged ? std::optional(bound) : std::nullopt;
    c.metrics.push_back({kind.metric,
                         "",
                         kind.unit,
                         hasReference ? "exact" : "contact",
                         error,
                         0.75,
                         limit,
                         {},
                         judge(error, limit),
                         ""});
    for (const char* body : {"block", "other"})
        c.metrics.push_back({kind.metric,
                             body,
                             kind.unit,
                             hasReference ? "exact" : "contact",
                             error * rng(),
                             0.5,
                             {},
                             {},
                             Verdict::Pass,
                             ""});
    if (hasReference)
        c.metrics.push_back({"scheme_position_max",
                             "",
                             "m",
                             "scheme_exact",
                             1e-13 * (1 + 9 * rng()),
                             1.0,
                             1e-9,
                             {},
                             Verdict::Pass,
                             ""});
    c.metrics.push_back({"energy_drift", "", "1", "invariant", error * 0.3, 1.5, 0.5, {}, Verdict::Pass, ""});
    c.metrics.push_back({"momentum_drift", "", "1", "invariant", 1e-16, -1.0, {}, {}, Verdict::Pass, ""});
    if (kind.metric != std::string_view("penetration_max"))
        c.metrics.push_back(
            {"penetration_max", "", "m", "contact", 4e-4 * rng(), 0.1, 5e-3, {}, Verdict::Pass, ""});
    if (c.engine == "bullet" && c.preset == "default" && c.metrics[0].verdict == Verdict::Fail) {
        c.metrics[0].expectation = error;
        c.metrics[0].verdict = Verdict::KnownDeviation;
        c.metrics[0].note = "a collision margin of 0.04 m on hulls";
    }
    if (!judged && hasReference)  // a column of which nothing is demanded
        for (auto& m : c.metrics) m.bound.reset();
    c.verdict = c.metrics[0].verdict;
    if (hasReference)
        c.quantities = {{"stop_distance", "m", 1.63098878695209, 1.6409887869520898, 1.6409887 + error},
                        {"stop_time", "s", 0.81549439347604, {}, 0.81666666666666665},
                        {"second_stop", "s", 2.5, 2.51, {}}};
}

void fillContext(CaseRow& c, Rng& rng) {
    c.ledger = {{"friction law", "Coulomb cone", "Coulomb cone", "exact", ""},
                {"sleeping", "off", "off", "exact", ""}};
    if (c.engine != "rigor")
        c.ledger.push_back({"friction law", "Coulomb cone", "pyramid, 2 directions", "approximate",
                            "the library solves two tangential directions one after the other"});
    if (c.engine == "box2d")
        c.ledger.push_back(
            {"precision", "f64", "f32", "unsupported", "the library is built in single precision"});
    c.readBack = {{"mass", "block", 2.0, 2.0, 0.0, true}, {"inertia", "block", 0.1, 0.1, 0.0, true}};
    if (c.spec == "ode:preset=default")
        c.readBack.push_back({"friction", "wood|floor", 0.5, 0.49, 0.01, false});
    for (const char* auditor : {"oracle", "in_run", "rigor", "bullet", "ode", "fcl", "bullet|ode"}) {
        AuditRow a{auditor, "completed",  20,   44,           31,   0,    0,
                   2,       1e-7 * rng(), 1e-9, 3e-6 * rng(), 1e-8, 1e-5, "block|floor at t=0.25",
                   ""};
        if (std::string(auditor) == "fcl" && rng() < 0.3) {
            a.missed = 2;
            a.normalErrorMax = 0.7;
        }
        if (std::string(auditor) == "ode" && rng() < 0.1) {
            a.outcome = "unsupported";
            a.queries = 0;
            a.normalErrorMax = {};
            a.note = "hull against hull";
        }
        c.audit.push_back(a);
    }
    const double step = 4e-6 * (1 + 20 * rng());
    c.timings = {{"step", step, 0.8 * step, 1.7 * step, step * 400, 400, 4.0, 0.98 * step, 1.03 * step, 2},
                 {"build", 1e-3, 1e-3, 1e-3, 1e-3, 1, 0.0}};
    if (c.engine == "rigor")
        for (const char* phase : {"broad_phase", "narrow_phase", "solve"})
            c.timings.push_back({phase, 0.3 * step, 0.2 * step, 0.5 * step, step * 120, 400, 4.0, 0.29 * step,
                                 0.31 * step, 2});
    c.settings = {{"iterations", "20"}, {"solver", "sequential impulses"}, {"sleeping", "off"}};
    c.steps = static_cast<std::int64_t>(2.0 / c.dt);
    c.peakMemoryKiB = 14336;
    c.wallSeconds = 0.12;
    c.cpuSeconds = 0.11;
    c.stateHash = "9f86d081884c7d65";
    c.trajectoryFile = "trajectories/" + c.id + ".h5";
}

/// Ends a case early: nothing but a reason is left.
void setOutcome(CaseRow& c, Outcome outcome, Verdict verdict, const char* reason) {
    c.outcome = outcome;
    c.verdict = verdict;
    c.reason = reason;
    c.metrics.clear();
    c.quantities.clear();
    c.audit.clear();
    c.timings.clear();
    c.trajectoryFile.clear();
}

void refuse(CaseRow& c, const char* refusal) {
    setOutcome(c, Outcome::Unsupported, Verdict::Unsupported, "dimension 3");
    c.refusal = refusal;
    c.ledger = {{"refused", "3D dynamics", "nothing", "unsupported", "its documentation: manual"}};
}

/// Accuracy by the first metric where it is exact, of a scale of 2; a few cases changed against their record.
void grade(CaseRow& c, double rng) {
    c.regression = rng < 0.03   ? Regression::Worse
                   : rng < 0.05 ? Regression::Better
                   : rng < 0.1  ? Regression::NoRecord
                                : Regression::Unchanged;
    if (rng < 0.05) c.regressionReason = "position_max 0.01 -> 0.02 m";
    if (c.outcome != Outcome::Completed || c.metrics.empty() || c.metrics[0].kind != "exact") {
        c.accuracy.note = "no exact solution";
        return;
    }
    for (MetricRow& m : c.metrics)
        if (m.kind == "exact") {
            m.scale = 2.0;
            m.relative = m.value / 2.0;
            m.recorded = 0.5 * m.value;
        }
    c.metrics[0].ideal = 0.3 * *c.metrics[0].relative;
    c.accuracy = {gradeOf(*c.metrics[0].relative), c.metrics[0].name, c.metrics[0].relative,
                  c.metrics[0].ideal, ""};
}

CaseRow makeCase(const ScenarioRow& s, const Kind& kind, const std::string& spec, double dt, int number) {
    Rng rng(static_cast<std::uint64_t>(number) + 17);
    CaseRow c;
    c.id = "case" + std::to_string(number);
    c.position = number;
    c.scenario = s.name;
    c.spec = spec;
    c.dt = dt;
    c.engine = spec.substr(0, spec.find(':'));
    c.preset = spec.find("=default") != std::string::npos ? "default" : "matched";
    c.command = "./rigor run " + s.name + " --engine " + spec + " --dt " + std::to_string(dt);
    const double error = std::pow(10.0, -6.0 + 5.2 * rng()) * (c.preset == "default" ? 3.0 : 1.0) * dt * 60;
    fillContext(c, rng);
    fillNumbers(c, kind, error, rng);
    const double fate = rng();
    if (c.engine == "box2d" && s.dimension == 3)
        refuse(c, number % 4 == 0 ? "adapter" : "library");
    else if (fate < 0.01)
        setOutcome(c, Outcome::Crashed, Verdict::Crashed, "SIGSEGV after 12 steps <at> 0x0 & more");
    else if (fate < 0.015)
        setOutcome(c, Outcome::Timeout, Verdict::Timeout, "no result within 60 s");
    else if (fate < 0.02)
        setOutcome(c, Outcome::OutOfMemory, Verdict::Crashed, "more than 4096 MiB");
    else if (fate < 0.03) {
        c.outcome = Outcome::NonFinite;
        c.verdict = Verdict::NonFinite;
        c.reason = "position of block at t=0.5";
        c.metrics[0].value = std::numeric_limits<double>::quiet_NaN();
        c.metrics[0].verdict = Verdict::Fail;
        c.metrics[1].value = std::numeric_limits<double>::infinity();
    }
    grade(c, rng());
    return c;
}

ScenarioRow makeScenario(int i) {
    const Kind& kind = kKinds[static_cast<std::size_t>(i) % kKinds.size()];
    ScenarioRow s;
    s.name = std::string(kind.name) + (i < 8 ? "" : "_" + std::to_string(i / 8 + 1));
    if (i == 24) s.name = kHostileName;
    s.title = kind.title;
    s.description =
        std::string("What the engine does with ") + kind.isolates + " alone, everything else at rest.";
    s.source = "Goldstein 2002, ch. 1";
    s.isolates = {kind.isolates};
    s.tags = {kind.dimension == 2 ? "planar" : "spatial", "catalogue"};
    s.observed = {"block", "other"};
    s.metrics = {kind.metric, "energy_drift"};
    s.dimension = kind.dimension;
    s.duration = 2.0;
    s.timeSteps = {1.0 / 60.0, 1.0 / 240.0};
    s.reference = kind.reference;
    s.referenceTitle = *kind.reference ? kind.title : "";
    s.referenceFormula = kind.formula;
    s.referenceTex = *kind.reference ? "\\begin{aligned} x &= \\tfrac12 g t^2 \\end{aligned}" : "";
    s.text = "{\"rigor\": 1, \"name\": \"<b>x</b>\"}";
    return s;
}

Channel oneColumn(const char* unit, std::size_t rows) {
    return {unit, 1, std::vector<double>(rows)};
}

TrajectoryFile makeTrajectory(const Run& run, const CaseRow& c) {
    TrajectoryFile f;
    f.scenario = c.scenario;
    f.spec = c.spec;
    f.caseId = c.id;
    f.dt = c.dt;
    const auto rows = static_cast<std::size_t>(c.steps) + 1;
    Rng rng(static_cast<std::uint64_t>(c.position) + 5);
    const double error = std::isfinite(c.metrics.at(0).value) ? c.metrics[0].value : 0.1, shift = rng();
    std::vector<BodyChannels> measured, exact;
    for (const auto& s : run.scenarios)
        if (s.name == c.scenario)
            for (const auto& name : s.observed) measured.push_back({name, {"m", 3, {}}, {}, {}, {}});
    exact = measured;
    auto errorSeries = oneColumn("m", rows), energy = oneColumn("J", rows), depth = oneColumn("m", rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const double t = static_cast<double>(i) * c.dt;
        f.times.push_back(t);
        for (std::size_t b = 0; b < measured.size(); ++b) {
            const double phase = b;
            const double p[3] = {std::cos(3 * t + phase) * std::exp(-0.3 * t), t * (2 - t),
                                 0.1 * std::sin(9 * t)};
            for (int k = 0; k < 3; ++k) {
                exact[b].position.values.push_back(p[k]);
                measured[b].position.values.push_back(p[k] + error * t * std::sin(5 * t + shift));
            }
        }
        errorSeries.values[i] = std::abs(error * t * std::sin(5 * t + shift));
        energy.values[i] = 10.0 - t + error * std::sin(20 * t);
        depth.values[i] = i % 97 == 50 ? 4e-4 : 1e-6 * rng();
    }
    f.bodies = measured;
    f.reference = exact;
    f.series = {{"position_error", "", errorSeries},
                {"energy", "", energy},
                {"penetration", "", depth},
                {"position_error", "block", errorSeries}};
    return f;
}

}  // namespace

Run makeRun(int scenarios) {
    Run run;
    run.directory = "runs/standard-20260101-000000";
    run.schemaVersion = 1;
    run.suite = "standard";
    run.command = "./rigor validate standard";
    run.started = "2026-01-01T00:00:00Z";
    run.finished = "2026-01-01T00:04:31Z";
    run.environment = {{"cpu", "Some CPU at 3.0 GHz, 8 cores"},
                       {"kernel", "Linux 6.1"},
                       {"compiler", "g++ 12.2.0"},
                       {"flags", "-O3 -DNDEBUG -ffp-contract=off"}};
    run.engines = {{"rigor", "Rigor", "0.1.0", "f64", "-O3", ""},
                   {"bullet", "Bullet", "3.24", "f64", "double-precision build", ""},
                   {"box2d", "Box2D", "2.4.1", "f32", "asserts on", ""},
                   {"ode", "ODE", "0.16.2", "f64", "dDOUBLE", ""},
                   {"fcl", "FCL", "0.7.0", "f64", "collision only", ""},
                   {"other", "Another", "", "", "", "not installed"}};
    for (int i = 0; i < scenarios; ++i) run.scenarios.push_back(makeScenario(i));
    for (int i = 0; i < scenarios; ++i)
        for (const char* spec : kSpecs)
            for (const double dt : run.scenarios[i].timeSteps)
                run.cases.push_back(makeCase(run.scenarios[i],
                                             kKinds[static_cast<std::size_t>(i) % kKinds.size()], spec, dt,
                                             static_cast<int>(run.cases.size())));
    run.plannedCases = static_cast<std::int64_t>(run.cases.size());
    return run;
}

Run makeHardRun() {
    Run run = makeRun(10);
    run.finished.clear();
    // Cases that ended early, each kind at least once; then a scenario that no engine survives and one that
    // was not reached.
    const struct {
        Outcome outcome;
        Verdict verdict;
        const char* reason;
    } ends[] = {{Outcome::Crashed, Verdict::Crashed, "SIGSEGV after 12 steps\n\x1b[31m<script>\xff"},
                {Outcome::Timeout, Verdict::Timeout, "no result within 60 s"},
                {Outcome::OutOfMemory, Verdict::Crashed, "more than 4096 MiB"},
                {Outcome::Error, Verdict::Fail, "the module could not be loaded: | & % $ # _ { } ~ ^ \\"},
                {Outcome::Unsupported, Verdict::Unsupported, ""}};
    for (std::size_t i = 0; i < std::size(ends); ++i)
        setOutcome(run.cases[3 * i], ends[i].outcome, ends[i].verdict, ends[i].reason);
    for (auto& c : run.cases)
        if (c.scenario == run.scenarios[1].name) setOutcome(c, Outcome::Crashed, Verdict::Crashed, "SIGABRT");
    std::erase_if(run.cases, [&](const CaseRow& c) { return c.scenario == run.scenarios[9].name; });
    // Numbers gone wild where numbers are.
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInf = std::numeric_limits<double>::infinity();
    CaseRow& wild = run.cases.back();
    wild.outcome = Outcome::NonFinite;
    wild.verdict = Verdict::NonFinite;
    for (auto& m : wild.metrics) {
        m.value = kNan;
        m.bound = kInf;
        m.at = kNan;
    }
    for (auto& q : wild.quantities) {
        q.exact = -kInf;
        q.measured = kNan;
    }
    for (auto& t : wild.timings) {
        t.median = t.p10 = t.p90 = t.total = kNan;
        t.low = kNan;
        t.high = kInf;
    }
    for (auto& a : wild.audit) {
        a.normalErrorMax = kNan;
        a.depthErrorMax = kInf;
        a.worst = "";
    }
    return run;
}

TrajectoryLoader makeLoader(const Run& run) {
    return [&run](const CaseRow& c) -> std::optional<TrajectoryFile> {
        if (c.trajectoryFile.empty()) return std::nullopt;
        return makeTrajectory(run, c);
    };
}

}  // namespace rigor::report::synthetic
