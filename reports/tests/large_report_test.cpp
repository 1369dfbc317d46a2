// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of a run that is large beside its limits: the same texts, compressed.
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/gzip_text.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/curves.hpp"
#include "reports/replay/data.hpp"
#include "reports/report.hpp"
#include "reports/tables/csv.hpp"
#include "reports/tables/table.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"

namespace rigor::report {
namespace {

namespace fs = std::filesystem;

std::string uncompressed(const std::string& bytes) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = bytes.size();
    std::string out;
    int result = Z_OK;
    while (result == Z_OK) {
        char buffer[1 << 14];
        stream.next_out = reinterpret_cast<Bytef*>(buffer);
        stream.avail_out = sizeof buffer;
        result = inflate(&stream, Z_NO_FLUSH);
        out.append(buffer, sizeof buffer - stream.avail_out);
    }
    inflateEnd(&stream);
    EXPECT_EQ(result, Z_STREAM_END);
    EXPECT_EQ(stream.avail_in, 0u);
    return out;
}

TEST(GzipText, IsTheSumOfItsPieces) {
    std::string whole;
    GzipText text;
    for (int i = 0; i < 30000; ++i) {
        const std::string piece = std::to_string(i * i) + "\n";
        text.add(piece);
        whole += piece;
    }
    const std::string compressed = text.finish();
    EXPECT_LT(compressed.size(), whole.size() / 2);
    EXPECT_EQ(uncompressed(compressed), whole);
    EXPECT_EQ(uncompressed(GzipText().finish()), "");
    EXPECT_EQ(uncompressed(gzip(whole)), whole);
}

std::string bytesOfBase64(std::string_view text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.find('='))) {
        bits = bits << 6 | static_cast<unsigned>(kDigits.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xFF);
    }
    return bytes;
}

/// The files that the data of a scenario name: rigorData("scenario-0","BASE64");
std::vector<std::string> filesOfScenario(const std::string& script) {
    const std::size_t end = script.rfind('"'), begin = script.rfind('"', end - 1) + 1;
    const std::string data = uncompressed(bytesOfBase64(std::string_view(script).substr(begin, end - begin)));
    return nlohmann::json::parse(data).at("files");
}

class LargeReport : public testing::Test {
  protected:
    LargeReport() {
        fs::remove_all(folder_);
        results::RunWriter writer(folder_, false);
        writer.writeHeader(run_);
        for (const auto& row : run_.cases) writer.writeCase(row);
    }
    ~LargeReport() override { fs::remove_all(folder_); }
    bool has(const char* file) const { return fs::exists(folder_ / file); }
    std::string textOf(const char* file) const { return results::readFile(folder_ / file); }

    const fs::path folder_ = fs::path(testing::TempDir()) / "rigor-large-report";
    const results::Run run_ = synthetic::makeRun(1);
};

TEST_F(LargeReport, HoldsTheSameTextsCompressed) {
    writeReports(folder_);
    const std::string csv = textOf("results.csv"), timing = textOf("tables/timing.csv");
    EXPECT_EQ(csv, csvReport(results::readRun(folder_)));
    EXPECT_FALSE(has("results.csv.gz"));
    EXPECT_TRUE(has("tables/timing.md"));

    writeReports(folder_, nullptr, {.cases = run_.cases.size() - 1, .tableRows = 5});
    EXPECT_EQ(uncompressed(textOf("results.csv.gz")), csv);
    EXPECT_EQ(uncompressed(textOf("tables/timing.csv.gz")), timing);
    for (const char* gone : {"results.csv", "tables/timing.csv", "tables/timing.md", "tables/timing.tex"})
        EXPECT_FALSE(has(gone)) << gone << " is of the report before";
    EXPECT_TRUE(has("tables/scoreboard.md")) << "it has one row";
    EXPECT_FALSE(has("tables/scoreboard.csv.gz"));

    writeReports(folder_, nullptr, {.cases = run_.cases.size() - 1});
    const std::string scenario = "tables/scenarios/" + run_.scenarios.front().name;
    EXPECT_TRUE(has((scenario + ".csv").c_str()));
    EXPECT_FALSE(has((scenario + ".md").c_str()));
    EXPECT_TRUE(has("tables/timing.md"));

    writeReports(folder_, nullptr, {.cases = run_.cases.size(), .tableRows = 5});
    EXPECT_EQ(textOf("results.csv"), csv);
    EXPECT_FALSE(has("results.csv.gz"));
}

/// The page of a scenario names the files that its table and its plot have, whatever the limits make of them.
TEST_F(LargeReport, NamesTheFilesOfATableThatAreThere) {
    const std::string table = "tables/" + scenarioTableName(run_.scenarios.front());
    const auto named = [&](const ReportLimits& limits) {
        writeReports(folder_, nullptr, limits);
        std::vector<std::string> files;
        for (const std::string& file : filesOfScenario(textOf("data/scenario-0.js"))) {
            EXPECT_TRUE(has(file.c_str())) << file;
            if (file.starts_with("tables/")) files.push_back(file);
        }
        return files;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(named({}), (Names{table + ".csv", table + ".md", table + ".tex"}));
    EXPECT_EQ(named({.cases = run_.cases.size() - 1}), Names{table + ".csv"});
    EXPECT_EQ(named({.tableRows = 1}), Names{table + ".csv.gz"});
}

TEST_F(LargeReport, HasItsCasesBesideThePage) {
    writeReports(folder_, nullptr, {.casesInPage = 1});
    EXPECT_TRUE(has("data/cases-0.js"));
    EXPECT_TRUE(has("data/lists.js"));
    const std::size_t small = textOf("index.html").size();
    writeReports(folder_);
    EXPECT_FALSE(has("data/cases-0.js"));
    EXPECT_FALSE(has("data/lists.js"));
    EXPECT_GT(textOf("index.html").size(), small + 1000 * run_.cases.size());
}

TEST(LargeRuns, HaveTheSameCasesInFiles) {
    using nlohmann::json;
    const auto run = synthetic::makeRun(60);
    const ViewModel view(run);
    const auto whole = json::parse(overviewJson(view)),
               part = json::parse(overviewJson(view, CasesOfPage::Beside));
    const auto files = caseFiles(view);
    EXPECT_TRUE(whole.at("caseFiles").is_null());
    EXPECT_EQ(part.at("caseFiles"), files);
    ASSERT_GE(files.size(), 2u);
    std::size_t scenario = 0;
    for (std::size_t file = 0; file < files.size(); ++file) {
        ASSERT_EQ(files[file], scenario);
        for (const json& cases : json::parse(casesJson(view, file))) {
            EXPECT_EQ(cases, whole.at("scenarios").at(scenario).at("cases"));
            EXPECT_FALSE(cases.empty());
            EXPECT_TRUE(part.at("scenarios").at(scenario).at("cases").empty());
            ++scenario;
        }
    }
    EXPECT_EQ(scenario, run.scenarios.size());
    for (const char* fact : {"redCases", "timed", "touching", "red", "grades"})
        EXPECT_EQ(part.at(fact), whole.at(fact)) << fact;
    const json lists = json::parse(listsJson(view));
    for (const char* list : {"audit", "ledger"}) {
        EXPECT_EQ(lists.at(list), whole.at(list)) << list;
        EXPECT_TRUE(part.at(list).empty()) << list;
    }
    EXPECT_FALSE(whole.at("ledger").empty());
    EXPECT_EQ(part.at("audited"), whole.at("audited"));
    EXPECT_EQ(whole.at("audited"), !whole.at("audit").empty());
    EXPECT_EQ(whole.at("redCases").size(), 6u);
    EXPECT_TRUE(whole.at("timed"));
}

/// The curves of a run have a budget together, and no curve is left without an outline.
TEST(LargeRuns, HaveFewerPointsOfEachCurve) {
    EXPECT_EQ(curvePoints(0), kCurvePoints);
    EXPECT_EQ(curvePoints(kCasesOfWholeCurves), kCurvePoints);
    EXPECT_EQ(curvePoints(2 * kCasesOfWholeCurves), kCurvePoints / 2);
    EXPECT_EQ(curvePoints(10000000), kFewestCurvePoints);
}

/// All replays of a run have a budget together.
TEST(LargeRuns, HaveSmallerReplays) {
    EXPECT_DOUBLE_EQ(ReplayBudget(10).allowance(), kReplayBytesPerCase);
    EXPECT_DOUBLE_EQ(ReplayBudget(100000).allowance(), kReplayBytesOfRun / 100000);
    ReplayBudget budget(100000);
    double spent = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double bytes = budget.allowance();
        budget.spend(bytes);
        spent += bytes;
    }
    EXPECT_NEAR(spent, kReplayBytesOfRun, 1e-3 * kReplayBytesOfRun);
}

}  // namespace
}  // namespace rigor::report
