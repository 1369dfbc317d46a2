// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plans and verdicts of studies, on stored cases whose values are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "validation/studies/columns.hpp"
#include "validation/studies/print.hpp"

namespace rigor::validation {
namespace {

const char* kStudy = R"({"rigor_study": 1, "name": "test", "parts": [
 {"name": "grid", "scenarios": ["slide_and_stop"], "parameters": {"bodies.block.mass": [1, 2, 3]},
  "variants": [{"name": "few", "engine": "rigor:velocity_iterations=1"}, "rigor"], "dt": [0.01, 0.02],
  "options": {"warm_starting": ["on", "off"]}, "metrics": ["rest_sink"]},
 {"name": "sick", "scenarios": ["slide_and_stop"], "dt": [0.01],
  "variants": [{"name": "bad", "engine": "rigor:velocity_iterations=1"}, {"name": "good", "engine": "rigor"}],
  "metrics": ["energy_gain"],
  "symptom": {"fault": "bad", "cure": "good", "metric": "rest_jitter", "fault_at_least": 1, "cure_at_most": 0.1}}]})";

scenario::Study studyOf(const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / "study_under_test.json";
    std::ofstream(file) << text;
    return scenario::loadStudy(file);
}

StudyPlan planOf(const scenario::Study& study) {
    setenv("RIGOR_ADAPTER_PATH", (std::string(RIGOR_BINARY_DIR) + "/bin/adapters").c_str(), 1);
    return planStudy(study, [](const std::string& name, const std::vector<std::string>& overrides) {
        return scenario::loadScenario(scenario::findScenario(name), overrides);
    });
}

TEST(StudyPlan, IsTheWholeGridOnce) {
    const StudyPlan plan = planOf(studyOf(kStudy));
    EXPECT_EQ(plan.rows.size(), 3u * 2u * 2u * 2u + 2u);
    std::set<std::string> ids;
    for (const CasePlan& c : plan.cases) EXPECT_TRUE(ids.insert(c.id).second) << "each case once";
    EXPECT_EQ(plan.cases.size(), plan.rows.size());
    std::map<std::string, std::set<double>> masses;
    for (const CasePlan& c : plan.cases) {
        EXPECT_EQ(c.spec.preset(), "default");
        masses[c.scenario.name].insert(
            c.scenario.bodies[scenario::findBody(c.scenario, "block")].massProperties.mass);
    }
    EXPECT_EQ(masses.size(), 4u) << "a name for each mass, and the scenario as it is";
    for (const auto& [name, values] : masses) EXPECT_EQ(values.size(), 1u) << name;
    EXPECT_TRUE(masses.contains("slide_and_stop.grid-2"));
}

TEST(StudyPlan, LeavesOutWhatIsNotInstalledWhereTheStudySaysSo) {
    const std::string parts = R"("parts": [
 {"name": "both", "scenarios": ["slide_and_stop"], "variants": ["rigor", "no_such_engine:preset=matched"],
  "metrics": ["rest_sink", "energy_gain"],
  "symptom": {"fault": "no_such_engine:preset=matched", "cure": "rigor", "metric": "energy_gain", "fault_at_least": 1,
              "cure_at_most": 0},
  "findings": [{"statement": "x", "variant": "rigor", "metric": "rest_sink", "at_most": 1},
               {"statement": "y", "variant": "no_such_engine:preset=matched", "metric": "rest_sink", "at_most": 1}]},
 {"name": "none", "scenarios": ["slide_and_stop"], "variants": ["no_such_engine"], "metrics": ["rest_sink"]}]})";
    scenario::Study study = studyOf(R"({"rigor_study": 1, "name": "t", "leave_out_absent": true, )" + parts);
    const auto lines = leaveOutAbsent(study);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "no_such_engine is left out: engine 'no_such_engine' is not installed");
    ASSERT_EQ(study.parts.size(), 1u);
    EXPECT_EQ(study.parts[0].findings.size(), 1u);
    EXPECT_FALSE(study.parts[0].symptom.has_value());
    EXPECT_EQ(planOf(study).rows.size(), 1u);

    scenario::Study strict = studyOf(R"({"rigor_study": 1, "name": "t", )" + parts);
    EXPECT_TRUE(leaveOutAbsent(strict).empty());
    EXPECT_THROW(planOf(strict), adapter::BadInput);
}

TEST(StudyColumns, TheDivergenceTimeHasItsOldNameToo) {
    for (const char* name : {"divergence_time", "onset"}) {
        const Column own = columnOf(name), other = columnOf(std::string(name) + ":bullet");
        EXPECT_EQ(own.kind, Column::Kind::Divergence) << name;
        EXPECT_EQ(own.name, "divergence_time");
        EXPECT_EQ(other.name, "divergence_time");
        EXPECT_EQ(other.variant, "bullet");
        const Column symmetry = columnOf("symmetry.mirror." + std::string(name));
        EXPECT_EQ(symmetry.kind, Column::Kind::Symmetry);
        EXPECT_EQ(symmetry.name, "mirror");
        EXPECT_EQ(symmetry.aspect, "divergence_time");
    }
}

TEST(StudyPlan, RefusesWhatCannotBeFilled) {
    auto study = studyOf(kStudy);
    study.parts[0].metrics = {"beauty"};
    EXPECT_THROW((void)planOf(study), std::invalid_argument);
    study.parts[0].metrics = {"mean_pair_tests", "time.step", "rest_sink:block"};
    EXPECT_NO_THROW((void)planOf(study));
    study.parts[0].variants = {{"x", "no_engine"}};
    EXPECT_THROW((void)planOf(study), adapter::BadInput);
}

TEST(StudyFile, MessagesNameThePlace) {
    const auto problem = [](std::string text, const std::string& what, const std::string& with) {
        text.replace(text.find(what), what.size(), with);
        try {
            (void)studyOf(text);
        } catch (const scenario::LoadError& error) {
            return error.problems().front();
        }
        ADD_FAILURE() << "accepted: " << with;
        return scenario::Problem{};
    };
    EXPECT_EQ(problem(kStudy, "\"fault\": \"bad\"", "\"fault\": \"ugly\"").pointer, "/parts/1/symptom/fault");
    EXPECT_EQ(problem(kStudy, "\"fault_at_least\": 1", "\"fault_at_least\": 0.01").id, "study.symptom");
    EXPECT_EQ(problem(kStudy, "\"dt\": [0.01],", "\"dt\": [7],").line, 5);
    EXPECT_EQ(problem(kStudy, "\"name\": \"sick\"", "\"name\": \"grid\"").id, "study.duplicate");
    EXPECT_EQ(problem(kStudy, "\"scenarios\"", "\"scenes\"").id, "schema.unknown_key");
    const auto finding = [&](const std::string& text) {
        return problem(kStudy, "\"metrics\": [\"energy_gain\"],",
                       "\"metrics\": [\"energy_gain\"], \"findings\": [" + text + "],");
    };
    EXPECT_EQ(finding(R"({"statement": "s", "variant": "ugly", "metric": "m", "at_most": 1})").pointer,
              "/parts/1/findings/0/variant");
    EXPECT_EQ(finding(R"({"statement": "s", "variant": "bad", "metric": "m"})").id, "study.finding");
    EXPECT_EQ(
        finding(R"({"statement": "s", "variant": "bad", "metric": "m", "at_least": 2, "at_most": 1})").id,
        "study.finding");
    EXPECT_EQ(
        finding(R"({"statement": "s", "variant": "bad", "metric": "m", "at_most": 1, "where": {"mood": 1}})")
            .id,
        "study.unknown_key");
}

/// A run of the plan with given values.
results::Run runOf(const StudyPlan& plan, const std::map<std::string, double>& jitterOfSpec) {
    results::Run run;
    for (const CasePlan& c : plan.cases) {
        results::CaseRow row;
        row.id = c.id;
        row.scenario = c.scenario.name;
        row.spec = c.spec.text();
        row.engine = "rigor";
        row.settings = {{"solver", "pgs"}, {"velocity_iterations", "8"}};
        for (const auto& [key, value] : c.spec.options) row.settings[key] = value;
        results::MetricRow metric;
        metric.name = "rest_jitter";
        metric.unit = "m/s";
        metric.value = jitterOfSpec.at(c.spec.text());
        row.metrics.push_back(metric);
        run.cases.push_back(row);
    }
    return run;
}

scenario::Study symptomOnly() {
    auto study = studyOf(kStudy);
    study.parts.erase(study.parts.begin());
    return study;
}
const std::string kBad = "rigor:preset=default,velocity_iterations=1", kGood = "rigor:preset=default";

TEST(Symptoms, ShownAndCured) {
    const StudyPlan plan = planOf(symptomOnly());
    const auto result = evaluateStudy(plan, runOf(plan, {{kBad, 3.0}, {kGood, 0.05}}));
    ASSERT_EQ(result.symptoms.size(), 1u);
    EXPECT_TRUE(result.symptoms[0].shown);
    EXPECT_TRUE(result.symptoms[0].cured);
    EXPECT_EQ(result.symptoms[0].switched, (std::vector<std::string>{"velocity_iterations: 1 -> 8"}));
    EXPECT_TRUE(studyIsGreen(result));
    EXPECT_NE(studyText(result).find("shown, cured"), std::string::npos);
}

TEST(Symptoms, NeitherIsTakenForGranted) {
    const StudyPlan plan = planOf(symptomOnly());
    const auto harmless = evaluateStudy(plan, runOf(plan, {{kBad, 0.5}, {kGood, 0.05}}));
    EXPECT_FALSE(harmless.symptoms[0].shown);
    EXPECT_FALSE(studyIsGreen(harmless));
    const auto useless = evaluateStudy(plan, runOf(plan, {{kBad, 3.0}, {kGood, 0.5}}));
    EXPECT_FALSE(useless.symptoms[0].cured);
    EXPECT_FALSE(studyIsGreen(useless));
    EXPECT_NE(studyText(useless).find("NOT cured"), std::string::npos);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto empty = evaluateStudy(plan, runOf(plan, {{kBad, nan}, {kGood, nan}}));
    EXPECT_FALSE(empty.symptoms[0].shown) << "a value that is missing shows nothing";
    EXPECT_FALSE(empty.symptoms[0].cured) << "and cures nothing";
}

/// A fault may break the run; a cure may not.
TEST(Symptoms, RunsThatBreak) {
    const StudyPlan plan = planOf(symptomOnly());
    auto run = runOf(plan, {{kBad, 0.0}, {kGood, 0.05}});
    run.cases[0].outcome = results::Outcome::NonFinite;
    run.cases[0].metrics.clear();
    const auto broken = evaluateStudy(plan, run);
    EXPECT_TRUE(broken.symptoms[0].shown);
    EXPECT_TRUE(studyIsGreen(broken));
    run.cases[1].outcome = results::Outcome::Crashed;
    EXPECT_FALSE(studyIsGreen(evaluateStudy(plan, run)));
}

/// The exponent of exact powers is found.
TEST(Symptoms, GrowthIsAnExponent) {
    StudyPlan plan;
    scenario::StudyPart part;
    part.name = "growth";
    part.metrics = {"mean_pairs"};
    part.variants = {{"square", "rigor"}, {"line", "rigor"}};
    part.symptom = {"square", "line", "mean_pairs", true, 1.8, 1.2};
    plan.study.parts = {part};
    results::Run run;
    for (const int n : {10, 40, 160})
        for (const bool square : {true, false}) {
            StudyRow row;
            row.variant = square ? "square" : "line";
            row.bodies = n;
            row.caseId = row.variant + std::to_string(n);
            plan.rows.push_back(row);
            results::CaseRow c;
            c.id = row.caseId;
            results::MetricRow metric;
            metric.name = "mean_pairs";
            metric.value = square ? 0.5 * n * n : 3.0 * n;
            c.metrics.push_back(metric);
            run.cases.push_back(c);
        }
    const auto result = evaluateStudy(plan, run);
    EXPECT_NEAR(result.symptoms[0].fault, 2.0, 1e-12);
    EXPECT_NEAR(result.symptoms[0].cure, 1.0, 1e-12);
    EXPECT_TRUE(studyIsGreen(result));
}

TEST(StudyFiles, CsvHasEveryValueWithAllDigits) {
    const StudyPlan plan = planOf(symptomOnly());
    const auto result = evaluateStudy(plan, runOf(plan, {{kBad, 1.0 / 3.0}, {kGood, 0.05}}));
    const auto folder = std::filesystem::path(testing::TempDir());
    writeStudyFiles(result, folder, "command");
    std::ifstream in(folder / "study.csv");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(text.find("rest_jitter,0.3333333333333333,m/s"), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 2 * 2);
    const auto stored = nlohmann::json::parse(std::ifstream(folder / "study.json"), nullptr, false);
    EXPECT_EQ(stored.at("symptoms").size(), 1u);
}

/// A value that is not finite is named in its own column and leaves its field empty.
TEST(StudyFiles, HaveNoTextAmongNumbers) {
    const double inf = std::numeric_limits<double>::infinity();
    const StudyPlan plan = planOf(symptomOnly());
    const auto result = evaluateStudy(plan, runOf(plan, {{kBad, inf}, {kGood, 0.05}}));
    const auto folder = std::filesystem::path(testing::TempDir());
    writeStudyFiles(result, folder, "command");
    std::ifstream in(folder / "study.csv");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NE(text.find("rest_jitter,,m/s,,,value is infinite"), std::string::npos) << text;
    const auto stored = nlohmann::json::parse(std::ifstream(folder / "study.json"));
    EXPECT_TRUE(stored.at("symptoms").at(0).at("fault_value").is_null()) << stored.at("symptoms");
    EXPECT_EQ(stored.dump().find("\"inf\""), std::string::npos);
}

}  // namespace
}  // namespace rigor::validation
