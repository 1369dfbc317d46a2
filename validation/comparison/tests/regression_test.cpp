// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/comparison/regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "validation/results/judgement.hpp"

namespace rigor::validation {
namespace {

using results::CaseRow;
using results::Grade;
using results::Outcome;
using results::Regression;
using Stored = results::Run;

class AgainstRecord : public ::testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::remove_all(folder_);
        run_.engines = {{"ode", "ODE", "0.16", "f64", "", ""}};
        results::ScenarioRow& s = run_.scenarios.emplace_back();
        s.name = "slide";
        s.text = "{}";
        s.metrics = {"way", "turn"};
        s.reference = "sliding_stop";
        CaseRow& c = run_.cases.emplace_back();
        c.scenario = "slide";
        c.spec = "ode:preset=default";
        c.engine = "ode";
        c.dt = 0.01;
        for (const char* name : {"way", "turn", "unnamed"}) {
            results::MetricRow& m = c.metrics.emplace_back();
            m.name = name;
            m.unit = "m";
            m.value = 0.1;
            m.scale = 10.0;
        }
        c.settings["precision"] = "f64";
    }
    double& value(std::size_t metric) { return run_.cases[0].metrics[metric].value; }
    void record(bool add = false) { (void)writeRecorded(run_, folder_, add); }
    CaseRow compared() const {
        CaseRow row = run_.cases[0];
        compareWithRecord(Record(folder_, run_.engines), run_.scenarios[0], row);
        return row;
    }
    Regression state() const { return compared().regression; }

    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "against-record";
    Stored run_;
};

TEST_F(AgainstRecord, TheSameIsUnchangedAndNothingOnRecordIsSaid) {
    EXPECT_EQ(state(), Regression::NoRecord);
    EXPECT_NE(compared().regressionReason.find("not on record"), std::string::npos);
    record();
    EXPECT_EQ(state(), Regression::Unchanged);
    EXPECT_EQ(compared().metrics[0].recorded, 0.1);
    EXPECT_EQ(compared().metrics[2].recorded, std::nullopt) << "the scenario does not name it";
    run_.scenarios[0].text = R"({"gravity": 1})";
    EXPECT_EQ(state(), Regression::NoRecord);
    EXPECT_NE(compared().regressionReason.find("other physics"), std::string::npos);
}

TEST_F(AgainstRecord, OnePerCentEitherWayIsUnchanged) {
    record();
    value(0) = 0.1009;
    EXPECT_EQ(state(), Regression::Unchanged);
    value(0) = 0.102;
    EXPECT_EQ(state(), Regression::Worse);
    EXPECT_EQ(compared().regressionReason, "way 0.1 -> 0.102 m");
    value(0) = 0.098;
    EXPECT_EQ(state(), Regression::Better);
    value(1) = 0.2;
    EXPECT_EQ(state(), Regression::Worse) << "one worse outweighs one better";
    EXPECT_EQ(compared().regressionReason, "turn 0.1 -> 0.2 m");
}

TEST_F(AgainstRecord, RoundingOfThePrecisionIsUnchanged) {
    value(0) = 1e-15;
    value(1) = 0.0;
    record();
    value(0) = 9e-9;
    EXPECT_EQ(state(), Regression::Unchanged) << "1e-9 of ten metres";
    value(0) = 1.1e-8;
    EXPECT_EQ(state(), Regression::Worse);
    run_.cases[0].settings["precision"] = "f32";
    EXPECT_EQ(state(), Regression::Unchanged);
    value(0) = 1.1e-5;
    EXPECT_EQ(state(), Regression::Worse);
}

TEST_F(AgainstRecord, LostNumbersAreWorse) {
    record();
    value(0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(state(), Regression::Worse);
    run_.cases[0].metrics.erase(run_.cases[0].metrics.begin());
    EXPECT_EQ(compared().regressionReason, "way has no value any more");
}

TEST_F(AgainstRecord, AnotherEndingIsAChange) {
    record();
    run_.cases[0].outcome = Outcome::Crashed;
    EXPECT_EQ(state(), Regression::Worse);
    EXPECT_EQ(compared().regressionReason, "completed -> crashed");
    record();
    EXPECT_EQ(state(), Regression::Unchanged);
    run_.cases[0].outcome = Outcome::Unsupported;
    EXPECT_EQ(state(), Regression::Better);
}

TEST_F(AgainstRecord, WithoutItsReferenceACaseIsNotCompared) {
    record();
    run_.cases[0].verdict = results::Verdict::NoReference;
    run_.cases[0].metrics.clear();
    EXPECT_EQ(state(), Regression::NoRecord);
}

TEST_F(AgainstRecord, ChaoticScenesAreComparedByTheirEndingUntilTheirScatterIsKnown) {
    run_.scenarios[0].reference.clear();
    record();
    value(0) = 0.3;
    EXPECT_EQ(state(), Regression::Unchanged);
    EXPECT_NE(compared().regressionReason.find("how it ends"), std::string::npos);
    record(true);
    value(0) = 0.2;
    EXPECT_EQ(state(), Regression::Unchanged) << "between the two on record";
    value(0) = 0.31;
    EXPECT_EQ(state(), Regression::Worse);
    value(0) = 0.098;
    EXPECT_EQ(state(), Regression::Better);
}

TEST_F(AgainstRecord, RecordingReplacesThatCaseAlone) {
    record();
    const CaseRow first = run_.cases[0];
    run_.cases[0].dt = 0.02;
    value(0) = 0.5;
    record();
    value(0) = 0.4;
    record();
    EXPECT_EQ(state(), Regression::Unchanged);
    EXPECT_EQ(compared().metrics[0].recorded, 0.4);
    run_.cases[0] = first;
    EXPECT_EQ(state(), Regression::Unchanged) << "the other time step kept its record";
    record(true);
    EXPECT_EQ(
        Record(folder_, run_.engines).find("slide", "ode:preset=default", 0.01)->metrics[0].values.size(), 1u)
        << "the same number again is no scatter";
}

TEST_F(AgainstRecord, TheRecordedGradeIsTheWorstOfItsNumbers) {
    value(0) = 1e-6;
    record();
    EXPECT_EQ(results::recordedGrade(compared()), Grade::C) << "0.1 of 10";
    EXPECT_EQ(results::recordedGrade(run_.cases[0]), Grade::None);
}

}  // namespace
}  // namespace rigor::validation
