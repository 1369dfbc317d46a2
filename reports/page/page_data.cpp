// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page's data. Numbers keep all their digits; non-finite ones, which JSON lacks, are the strings "nan",
// "inf" and "-inf"; what is absent is null.
#include "reports/page/page_data.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/encoding/json.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/audit_json.hpp"
#include "reports/plots/curves.hpp"
#include "reports/tables/bench.hpp"
#include "reports/tables/insertion_orders.hpp"
#include "reports/tables/refinements.hpp"
#include "validation/results/insertion_orders.hpp"
#include "validation/results/judgement.hpp"
#include "validation/results/spec_labels.hpp"
#include "validation/results/values.hpp"

namespace rigor::report {
namespace {

using results::CaseRow;

constexpr std::size_t kMostBodies = 6;      // curves of more bodies would drown the page
constexpr std::size_t kMostSubjects = 6;    // most subjects per series
constexpr std::size_t kMostReadBack = 200;  // rows per case that differ
constexpr std::size_t kMostRedCases = 6;    // named on the first page
constexpr std::size_t kCasesOfFile = 500;   // about 2 MB of JSON, 0.2 MB compressed

std::string text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json metricsJson(const CaseRow& row) {
    Json list = Json::array();
    for (const auto& m : row.metrics)
        list.push_back({{"name", m.name},
                        {"subject", m.subject},
                        {"unit", m.unit},
                        {"kind", m.kind},
                        {"value", number(m.value)},
                        {"at", number(m.at)},
                        {"bound", number(m.bound)},
                        {"boundMin", number(m.boundMin)},
                        {"expectation", number(m.expectation)},
                        {"verdict", results::verdictName(m.verdict)},
                        {"note", m.note},
                        {"scale", number(m.scale)},
                        {"relative", number(m.relative)},
                        {"ideal", number(m.ideal)},
                        {"recorded", number(m.recorded)},
                        {"orderMin", number(m.orderMin)},
                        {"orderMax", number(m.orderMax)},
                        {"orderCount", m.orderCount ? Json(*m.orderCount) : Json(nullptr)},
                        {"dependsOnOrder", results::dependsOnOrder(m)},
                        {"grade", m.relative ? results::gradeName(results::gradeOf(*m.relative)) : ""}});
    return list;
}

Json quantitiesJson(const CaseRow& row) {
    Json list = Json::array();
    for (const auto& q : row.quantities)
        list.push_back({{"name", q.name},
                        {"unit", q.unit},
                        {"exact", number(q.exact)},
                        {"schemeExact", number(q.schemeExact)},
                        {"measured", number(q.measured)}});
    return list;
}

Json ledgerJson(const CaseRow& row) {
    Json list = Json::array();
    for (const auto& l : row.ledger)
        list.push_back({{"topic", l.topic},
                        {"requested", l.requested},
                        {"resolved", l.resolved},
                        {"realisation", l.realisation},
                        {"reason", l.reason}});
    return list;
}

/// Everything was compared; the page shows what differs.
Json readBackJson(const CaseRow& row) {
    Json differing = Json::array();
    std::size_t bad = 0;
    for (const auto& r : row.readBack) {
        if (r.ok) continue;
        if (++bad > kMostReadBack) continue;
        differing.push_back({{"quantity", r.quantity},
                             {"subject", r.subject},
                             {"expected", number(r.expected)},
                             {"found", number(r.found)},
                             {"error", number(r.error)}});
    }
    return {{"compared", row.readBack.size()}, {"bad", bad}, {"differing", differing}};
}

Json timingsJson(const CaseRow& row) {
    Json list = Json::array();
    for (const auto& t : row.timings)
        list.push_back({{"phase", t.phase},
                        {"median", number(t.median)},
                        {"p10", number(t.p10)},
                        {"p90", number(t.p90)},
                        {"total", number(t.total)},
                        {"samples", t.samples},
                        {"meanContacts", number(t.meanContacts)},
                        {"low", number(t.low)},
                        {"high", number(t.high)},
                        {"bodies", t.bodies},
                        {"first", number(t.first)},
                        {"mean", number(t.mean)},
                        {"p95", number(t.p95)},
                        {"p99", number(t.p99)},
                        {"worst", number(t.worst)},
                        {"realTimeFactor", number(t.realTimeFactor)}});
    return list;
}

/// Cost of a step, with the medians of the stages that the engine reports.
Json stepJson(const CaseRow& row, const results::TimingRow& step) {
    Json phases = Json::object();
    for (const auto& t : row.timings)
        if (t.phase != step.phase && t.phase != "build") phases[t.phase] = number(t.median);
    return {{"median", number(step.median)},
            {"low", number(step.low)},
            {"high", number(step.high)},
            {"p10", number(step.p10)},
            {"p90", number(step.p90)},
            {"samples", step.samples},
            {"first", number(step.first)},
            {"mean", number(step.mean)},
            {"p95", number(step.p95)},
            {"p99", number(step.p99)},
            {"worst", number(step.worst)},
            {"realTimeFactor", number(step.realTimeFactor)},
            {"contacts", number(step.meanContacts)},
            {"bodies", step.bodies},
            {"phases", phases}};
}

/// The metric that is furthest outside its bound; null where none is.
Json worstMiss(const CaseRow& row) {
    const auto times = [](const results::MetricRow& m) {
        return excessOf(m.value, m.bound.value_or(0.0), m.boundMin);
    };
    const results::MetricRow* worst = nullptr;
    for (const auto& m : row.metrics)
        if (m.bound && m.verdict != results::Verdict::Pass && (!worst || times(m) > times(*worst)))
            worst = &m;
    if (!worst) return nullptr;
    return {{"name", worst->name},           {"subject", worst->subject},
            {"unit", worst->unit},           {"value", number(worst->value)},
            {"bound", number(worst->bound)}, {"boundMin", number(worst->boundMin)},
            {"at", number(worst->at)}};
}

/// Dependence on the order of insertion; null if it was run in one order.
Json ordersOfCaseJson(const CaseRow& row) {
    if (!row.orders.run) return nullptr;
    return {{"run", *row.orders.run},
            {"completed", row.orders.completed.value_or(0)},
            {"best", results::gradeName(row.orders.best)},
            {"worst", results::gradeName(row.orders.worst)},
            {"depends", results::orderDependenceName(results::orderDependence(row))},
            {"mark", orderMark(row)},
            {"says", orderSentence(row)}};
}

/// Grade of a case and its change against the record.
Json judgementJson(const ViewModel& view, const CaseRow& row) {
    const auto& a = row.accuracy;
    const Ratios& ratios = view.ratios(row);
    return {{"grade", results::gradeName(a.grade)},
            {"by", a.metric},
            {"of", worstSubject(row, a.metric)},
            {"relative", number(a.relative)},
            {"ideal", number(a.ideal)},
            {"beside", results::againstSchemeName(results::againstScheme(a.relative, a.ideal))},
            {"toBest", number(ratios.toBest)},
            {"toOurs", number(ratios.toOurs)},
            {"regression", results::regressionName(row.regression)},
            {"red", results::isRed(row)},
            {"says", accuracySentence(row)},
            {"change", regressionSentence(row)},
            {"orders", ordersOfCaseJson(row)}};
}

/// One line of the scoreboard and of the timing table.
Json briefCase(const ViewModel& view, std::size_t scenario, const CaseRow& row) {
    Json brief{{"id", row.id},
               {"spec", row.spec},
               {"dt", number(row.dt)},
               {"outcome", results::outcomeName(row.outcome)},
               {"verdict", results::verdictName(row.verdict)},
               {"shown", shownText(shownOf(row)).key},
               {"reason", row.reason},
               {"refusal", row.refusal}};
    const auto* main = findMetric(row, view.mainMetric(scenario).name);
    brief["value"] = main ? number(main->value) : Json(nullptr);
    brief["subject"] = main ? worstSubject(row, main->name) : std::string();
    brief["bound"] = main ? number(main->bound) : Json(nullptr);
    brief["range"] = main && results::dependsOnOrder(*main) ? Json(orderRangeText(*main)) : Json(nullptr);
    const auto* timing = stepTiming(row);
    brief["step"] = timing ? stepJson(row, *timing) : Json(nullptr);
    brief["inRun"] = inRunJson(row);
    brief["miss"] = worstMiss(row);
    brief["judged"] = judgementJson(view, row);
    return brief;
}

Json briefCases(const ViewModel& view, std::size_t scenario) {
    Json cases = Json::array();
    for (std::size_t c = 0; c < view.columns().size(); ++c)
        for (const auto* row : view.cell(scenario, c).cases) cases.push_back(briefCase(view, scenario, *row));
    return cases;
}

std::size_t countCases(const ViewModel& view, std::size_t scenario) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < view.columns().size(); ++c) count += view.cell(scenario, c).cases.size();
    return count;
}

/// Facts about the cases that the page shows before it has loaded them: the first red ones, and whether any case has
/// times or audited contacts.
void addCaseFacts(const ViewModel& view, Json& overview) {
    Json red = Json::array();
    bool timed = false, touching = false;
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s)
        for (std::size_t c = 0; c < view.columns().size(); ++c)
            for (const auto* row : view.cell(s, c).cases) {
                timed = timed || stepTiming(*row) != nullptr;
                for (const auto& a : row->audit)
                    touching = touching || (a.auditor == "in_run" && a.queries > 0 && a.overlapping > 0);
                if (results::isRed(*row) && red.size() < kMostRedCases)
                    red.push_back(
                        {{"scenario", row->scenario}, {"spec", row->spec}, {"dt", number(row->dt)}});
            }
    overview["redCases"] = std::move(red);
    overview["timed"] = timed;
    overview["touching"] = touching;
}

Json scenariosJson(const ViewModel& view, CasesOfPage where) {
    Json list = Json::array();
    const auto& run = view.run();
    for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
        const auto& s = run.scenarios[i];
        const auto& metric = view.mainMetric(i);
        Json cases = where == CasesOfPage::Inside ? briefCases(view, i) : Json::array();
        Json steps = Json::array();
        for (const double dt : s.timeSteps) steps.push_back(number(dt));
        list.push_back({{"name", s.name},
                        {"title", s.title},
                        {"description", s.description},
                        {"source", s.source},
                        {"isolates", s.isolates},
                        {"tags", s.tags},
                        {"observed", s.observed},
                        {"metrics", s.metrics},
                        {"dimension", s.dimension},
                        {"duration", number(s.duration)},
                        {"timeSteps", steps},
                        {"reference", s.reference},
                        {"referenceTitle", s.referenceTitle},
                        {"referenceFormula", s.referenceFormula},
                        {"referenceTex", s.referenceTex},
                        {"referenceSource", s.referenceSource},
                        {"referenceProblem", s.referenceProblem},
                        {"main", {{"name", metric.name}, {"unit", metric.unit}, {"kind", metric.kind}}},
                        {"cases", cases}});
    }
    return list;
}

Json rankingJson(const Ranking& s) {
    return {{"scenarios", s.scenarios},
            {"lost", s.lost},
            {"grades", s.grades},
            {"within", s.within()},
            {"ungraded", s.ungraded},
            {"known", s.known},
            {"farther", s.farther},
            {"red", s.red},
            {"toBest", number(s.toBest)},
            {"toOurs", number(s.toOurs)},
            {"cost", number(s.cost)},
            {"costRatio", number(s.costRatio)},
            {"timed", s.timed}};
}

/// Costs by column, as the page's columns.
Json costsJson(const ViewModel& view) {
    Json list = Json::array();
    for (const StepCost& c : stepCosts(view))
        list.push_back({{"scenarios", c.scenarios},
                        {"median", number(c.median)},
                        {"mean", number(c.mean)},
                        {"first", number(c.first)},
                        {"p95", number(c.p95)},
                        {"p99", number(c.p99)},
                        {"worst", number(c.worst)},
                        {"realTimeFactor", number(c.realTimeFactor)},
                        {"medianRatio", number(c.medianRatio)},
                        {"meanRatio", number(c.meanRatio)}});
    return list;
}

Json mechanismJson(const Mechanism& m) {
    Json rankings = Json::array();
    for (const auto& s : m.rankings) rankings.push_back(rankingJson(s));
    return {{"name", m.name},   {"title", m.title},     {"about", m.about}, {"scenarios", m.scenarios},
            {"order", m.order}, {"engines", m.engines}, {"best", m.best},   {"rankings", rankings}};
}

Json mechanismsJson(const std::vector<Mechanism>& mechanisms) {
    Json list = Json::array();
    for (const auto& m : mechanisms) list.push_back(mechanismJson(m));
    return list;
}

Json gradesJson(const ViewModel& view) {
    Json list = Json::array();
    const auto add = [&](results::Grade grade) {
        const auto found = view.totals().grades.find(grade);
        list.push_back({{"name", results::gradeName(grade)},
                        {"meaning", results::gradeMeaning(grade)},
                        {"count", found == view.totals().grades.end() ? 0 : found->second}});
    };
    for (const results::Grade grade : results::kGrades) add(grade);
    add(results::Grade::None);
    return list;
}

Json regressionsJson(const ViewModel& view) {
    Json counts = Json::object();
    for (const auto r : {results::Regression::Unchanged, results::Regression::Better,
                         results::Regression::Worse, results::Regression::NoRecord}) {
        const auto found = view.totals().regressions.find(r);
        counts[results::regressionName(r)] = found == view.totals().regressions.end() ? 0 : found->second;
    }
    return counts;
}

Json gatheredLedger(const ViewModel& view) {
    Json list = Json::array();
    for (const auto& l : view.ledger())
        list.push_back({{"engine", l.engine},
                        {"preset", l.preset},
                        {"topic", l.row.topic},
                        {"requested", l.row.requested},
                        {"resolved", l.row.resolved},
                        {"realisation", l.row.realisation},
                        {"reason", l.row.reason},
                        {"scenarios", l.scenarios}});
    return list;
}

bool isAudited(const results::Run& run) {
    return std::any_of(run.cases.begin(), run.cases.end(),
                       [](const auto& row) { return !row.audit.empty(); });
}

Json lists(const ViewModel& view) {
    return {{"audit", gatheredAudit(view.run())}, {"ledger", gatheredLedger(view)}};
}

// ---- curves ----

Json packed(const std::vector<double>& values, const std::vector<std::size_t>& at) {
    std::vector<double> chosen;
    chosen.reserve(at.size());
    for (const std::size_t i : at) chosen.push_back(values[i]);
    return packSingles(chosen);
}

/// Component `k` of the rows of a channel; empty when the channel does not have it for every time.
std::vector<double> column(const results::Channel& channel, int k, std::size_t rows) {
    if (k >= channel.columns || channel.values.size() < rows * channel.columns) return {};
    std::vector<double> out(rows);
    for (std::size_t i = 0; i < rows; ++i) out[i] = channel.values[i * channel.columns + k];
    return out;
}

bool anyFinite(const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::vector<std::string> shownBodies(const results::ScenarioRow& scenario,
                                     const results::TrajectoryFile& file) {
    std::vector<std::string> names;
    for (const auto& name : scenario.observed)
        if (names.size() < kMostBodies) names.push_back(name);
    if (names.empty())
        for (const auto& body : file.bodies)
            if (names.size() < kMostBodies) names.push_back(body.name);
    return names;
}

/// Positions of the shown bodies, all at the same thinned times.
Json bodiesJson(const std::vector<results::BodyChannels>& bodies, const std::vector<std::string>& names,
                int dimension, std::size_t rows, const std::vector<std::size_t>& at) {
    Json list = Json::array();
    for (const auto& name : names)
        for (const auto& body : bodies) {
            if (body.name != name) continue;
            Json components = Json::array();
            for (int k = 0; k < dimension; ++k) {
                const auto values = column(body.position, k, rows);
                components.push_back(anyFinite(values) ? packed(values, at) : Json(nullptr));
            }
            list.push_back({{"name", name}, {"position", components}});
        }
    return list;
}

/// The finite ones, where what lies between them is not known rather than not there: a curve of some frames
/// alone.
std::vector<std::size_t> sampledIndices(const std::vector<double>& values) {
    std::vector<std::size_t> finite;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i])) finite.push_back(i);
    return finite;
}

Json seriesJson(const results::TrajectoryFile& file, std::size_t points) {
    Json list = Json::array();
    std::map<std::string, std::size_t> subjects;
    for (const auto& series : file.series) {
        const auto values = column(series.channel, 0, file.times.size());
        if (!anyFinite(values) || subjects[series.name]++ >= kMostSubjects) continue;
        const auto at =
            series.name == "normal_error" ? sampledIndices(values) : outlineIndices(values, points);
        Json entry{{"name", series.name}, {"subject", series.subject}, {"unit", series.channel.unit}};
        if (at.size() < file.times.size()) entry["t"] = packed(file.times, at);
        entry["y"] = packed(values, at);
        list.push_back(entry);
    }
    return list;
}

Json curvesJson(const results::ScenarioRow& scenario, const results::TrajectoryFile& file, bool withReference,
                std::size_t points) {
    const std::size_t rows = file.times.size();
    const auto at = evenIndices(rows, points);
    const auto names = shownBodies(scenario, file);
    Json out{{"samples", rows}, {"t", packed(file.times, at)}};
    if (rows <= points) out["all"] = true;
    out["bodies"] = bodiesJson(file.bodies, names, scenario.dimension, rows, at);
    if (withReference) out["reference"] = bodiesJson(file.reference, names, scenario.dimension, rows, at);
    out["series"] = seriesJson(file, points);
    return out;
}

/// Older runs have an option's values in two presets alone, under the presets' names.
void readOlderPresets(Json& described) {
    static const char* const kNames[] = {results::kDefaultPreset, results::kMatchedPreset};
    described["presets"] = kNames;
    for (Json& option : described["options"])
        for (const char* name : kNames) option["presets"][name] = option.value(name, "");
}

/// Declared features of an engine; null if they were not stored, or not as JSON.
Json described(const results::EngineRow& engine) {
    Json found = Json::parse(engine.capabilities, nullptr, false);
    if (!found.is_object()) return nullptr;
    if (!found["options"].is_array()) found["options"] = Json::array();
    const bool isOlder = std::any_of(found["options"].begin(), found["options"].end(),
                                     [](const Json& option) { return !option.contains("presets"); });
    if (isOlder || !found["presets"].is_array()) readOlderPresets(found);
    return found;
}

}  // namespace

std::vector<std::size_t> caseFiles(const ViewModel& view) {
    std::vector<std::size_t> first;
    std::size_t held = kCasesOfFile;
    for (std::size_t s = 0; s < view.run().scenarios.size(); ++s) {
        if (held >= kCasesOfFile) {
            first.push_back(s);
            held = 0;
        }
        held += countCases(view, s);
    }
    return first;
}

std::string casesJson(const ViewModel& view, std::size_t file) {
    const auto first = caseFiles(view);
    const std::size_t end = file + 1 < first.size() ? first[file + 1] : view.run().scenarios.size();
    Json scenarios = Json::array();
    for (std::size_t s = first.at(file); s < end; ++s) scenarios.push_back(briefCases(view, s));
    return text(scenarios);
}

std::string overviewJson(const ViewModel& view, CasesOfPage cases) {
    const auto& run = view.run();
    Json columns = Json::array(), engines = Json::array(), symbols = Json::object();
    for (const auto& c : view.columns())
        columns.push_back({{"spec", c.spec},
                           {"engine", c.engine},
                           {"preset", c.preset},
                           {"options", c.options},
                           {"label", c.label},
                           {"clock", c.clock},
                           {"dash", c.dash}});
    for (const auto& e : run.engines)
        engines.push_back({{"name", e.name},
                           {"title", e.title},
                           {"version", results::versionText(e)},
                           {"precision", e.precision},
                           {"buildNotes", e.buildNotes},
                           {"problem", e.problem},
                           {"described", described(e)}});
    for (int i = 0; i <= static_cast<int>(Shown::Unsupported); ++i) {
        const auto shown = static_cast<Shown>(i);
        const auto found = view.totals().cases.find(shown);
        symbols[shownText(shown).key] = {{"symbol", shownText(shown).symbol},
                                         {"word", shownText(shown).word},
                                         {"detail", detailOf(view.totals(), shown)},
                                         {"count", found == view.totals().cases.end() ? 0 : found->second}};
    }
    Json overview{{"suite", run.suite},
                  {"title", run.suite.empty() ? "" : runTitle(run)},
                  {"command", run.command},
                  {"started", run.started},
                  {"finished", run.finished},
                  {"planned", run.plannedCases},
                  {"total", view.totals().total},
                  {"environment", run.environment},
                  {"bench", benchJson(run)},
                  {"symbols", symbols},
                  {"columns", columns},
                  {"engines", engines},
                  {"scenarios", scenariosJson(view, cases)},
                  {"caseFiles", cases == CasesOfPage::Beside ? Json(caseFiles(view)) : Json(nullptr)},
                  {"grades", gradesJson(view)},
                  {"regressions", regressionsJson(view)},
                  {"red", view.totals().red},
                  {"inHouse", results::kInHouseEngine},
                  {"likeForLike", results::kMatchedPreset},
                  {"mechanisms", mechanismsJson(view.mechanisms())},
                  {"tasks", mechanismsJson(view.tasks())},
                  {"overall", mechanismJson(view.overall())},
                  {"costs", costsJson(view)},
                  {"insertionOrders", insertionOrdersJson(view)},
                  {"audited", isAudited(run)}};
    overview.update(cases == CasesOfPage::Beside ? Json{{"audit", Json::array()}, {"ledger", Json::array()}}
                                                 : lists(view));
    addCaseFacts(view, overview);
    return text(overview);
}

std::string listsJson(const ViewModel& view) {
    return text(lists(view));
}

std::string scenarioJson(const ViewModel& view, std::size_t index, const TrajectoryLoader& load,
                         const std::vector<std::string>& files) {
    const auto& scenario = view.run().scenarios[index];
    const std::size_t points = curvePoints(view.run().cases.size());
    Json cases = Json::array();
    std::vector<double> withReference;  // the exact states are the same for every engine at one time step
    for (std::size_t c = 0; c < view.columns().size(); ++c)
        for (const auto* row : view.cell(index, c).cases) {
            Json entry{{"id", row->id},
                       {"spec", row->spec},
                       {"dt", number(row->dt)},
                       {"outcome", results::outcomeName(row->outcome)},
                       {"verdict", results::verdictName(row->verdict)},
                       {"shown", shownText(shownOf(*row)).key},
                       {"reason", row->reason},
                       {"wallSeconds", number(row->wallSeconds)},
                       {"cpuSeconds", number(row->cpuSeconds)},
                       {"steps", row->steps},
                       {"peakMemoryKiB", row->peakMemoryKiB},
                       {"stateHash", row->stateHash},
                       {"trajectoryFile", row->trajectoryFile},
                       {"command", row->command},
                       {"settings", row->settings},
                       {"metrics", metricsJson(*row)},
                       {"quantities", quantitiesJson(*row)},
                       {"ledger", ledgerJson(*row)},
                       {"readBack", readBackJson(*row)},
                       {"audit", auditJson(*row)},
                       {"timings", timingsJson(*row)},
                       {"judged", judgementJson(view, *row)},
                       {"curves", nullptr}};
            if (const auto file = load(*row); file && !file->times.empty()) {
                const bool first =
                    std::find(withReference.begin(), withReference.end(), row->dt) == withReference.end();
                const bool reference =
                    first && !file->reference.empty() && row->outcome == results::Outcome::Completed;
                if (reference) withReference.push_back(row->dt);
                entry["curves"] = curvesJson(scenario, *file, reference, points);
            }
            cases.push_back(std::move(entry));
        }
    return text({{"name", scenario.name},
                 {"text", scenario.text},
                 {"files", files},
                 {"cases", cases},
                 {"orders", ordersJson(view.run(), scenario.name)},
                 {"fairness", fairnessJson(view.run(), scenario.name)}});
}

}  // namespace rigor::report
