// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reports of runs that went badly, made from a folder as they are in earnest: crashed, timed-out, non-finite
// and out-of-memory cases, damaged and missing trajectories, an unfinished run, a run without a case.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "reports/encoding/text.hpp"
#include "reports/report.hpp"
#include "reports/summaries/terminal.hpp"
#include "reports/tests/csv_reader.hpp"
#include "reports/tests/synthetic_run.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::report {
namespace {

namespace fs = std::filesystem;

std::string readText(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A run folder as the runner leaves it when it is stopped: the store, and trajectories whole, cut off,
/// empty, no HDF5 at all, or gone.
fs::path writeFolder(const std::string& name, const results::Run& run) {
    const fs::path folder = fs::path(testing::TempDir()) / name;
    fs::remove_all(folder);
    results::RunWriter writer(folder, false);
    writer.writeHeader(run);
    const auto load = synthetic::makeLoader(run);
    int number = 0;
    for (const auto& row : run.cases) {
        writer.writeCase(row);
        const auto trajectory = row.trajectoryFile.empty() ? std::nullopt : load(row);
        if (!trajectory) continue;
        const fs::path file = folder / row.trajectoryFile;
        switch (number++ % 8) {
            case 0:
                break;
            case 1:
                std::ofstream(file) << "no HDF5";
                break;
            case 2:
                std::ofstream(file).flush();
                break;
            default:
                results::writeTrajectory(file, *trajectory);
                if (number % 8 == 4) fs::resize_file(file, fs::file_size(file) / 2);
        }
    }
    return folder;
}

/// Each file that the report wrote, looked at by its kind.
void expectSound(const std::vector<fs::path>& written, const fs::path& folder) {
    for (const auto& file : written) {
        const std::string text = readText(file);
        EXPECT_FALSE(text.empty()) << file;
        if (file.extension() == ".csv") {
            const auto rows = parseCsv(text);
            for (const auto& row : rows) {
                ASSERT_EQ(row.size(), rows[0].size()) << file;
                for (const auto& field : row)
                    for (const char* bad : {"nan", "-nan", "inf", "-inf"})
                        ASSERT_NE(field, bad) << file << ": makes a column of numbers text";
            }
        }
        if (file.extension() == ".svg") {
            EXPECT_EQ(text.find("nan"), std::string::npos) << file;
            EXPECT_EQ(text.find("inf"), std::string::npos) << file;
        }
        if (file.extension() == ".svg") {
            EXPECT_TRUE(fs::exists(fs::path(file).replace_extension(".pdf"))) << file;
        }
        if (file.extension() == ".pdf") {
            EXPECT_TRUE(text.starts_with("%PDF-")) << file;
        }
        if (file.extension() == ".md" || file.extension() == ".html" || file.extension() == ".xml") {
            EXPECT_EQ(text.find("[31m<script>"), std::string::npos) << file;  // CSV and LaTeX know no markup
        }
        EXPECT_FALSE(fs::exists(file.string() + ".part"));
    }
    for (const char* name : {"index.html", "results.csv", "summary.md", "junit.xml", "tables/scoreboard.csv",
                             "tables/trust.md", "tables/timing.tex", "tables/ledger.csv"})
        EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(Robustness, AReportIsMadeOfARunThatWentBadly) {
    const auto run = synthetic::makeHardRun();
    const fs::path folder = writeFolder("rigor-hard-run", run);
    const auto written = writeReports(folder);
    expectSound(written, folder);

    const std::string summary = readText(folder / "summary.md");
    EXPECT_NE(summary.find("(**unfinished**)"), std::string::npos);
    for (const char* word : {"crashed", "timeout", "non-finite", "unsupported", "fail"})
        EXPECT_NE(summary.find(word), std::string::npos) << word;
    EXPECT_EQ(summary.find("<script>"), std::string::npos);

    const auto rows = parseCsv(readText(folder / "results.csv"));
    std::set<std::string> outcomes;
    for (const auto& row : rows) outcomes.insert(row[6]);
    for (const char* outcome :
         {"completed", "crashed", "timeout", "out_of_memory", "non_finite", "error", "unsupported"})
        EXPECT_TRUE(outcomes.contains(outcome)) << outcome;

    // The page shows the store as it was written: the same cases with the same endings.
    const auto read = results::readRun(folder);
    ASSERT_EQ(read.cases.size(), run.cases.size());
    for (const int width : {60, 120})
        for (const bool colour : {false, true}) {
            const std::string text = terminalSummary(read, 40, width, colour);
            EXPECT_LE(std::count(text.begin(), text.end(), '\n') + 1, 40);
            EXPECT_NE(text.find("unfinished"), std::string::npos);
            EXPECT_EQ(text.find("\x1b[31m<"), std::string::npos) << "escapes of a reason stay out";
        }
    // A second time over the first: the same files, the same bytes.
    EXPECT_EQ(writeReports(folder), written);
    EXPECT_EQ(readText(folder / "summary.md"), summary);
    fs::remove_all(folder);
}

/// A PDF of an earlier report does not stay beside newer plots.
TEST(Robustness, ALargeRunHasNoPdf) {
    const auto run = synthetic::makeRun(1);
    const fs::path folder = writeFolder("rigor-no-pdf", run);
    const auto pdfs = [&] {
        const fs::directory_iterator files(folder / "plots");
        return std::count_if(begin(files), end(files),
                             [](const auto& f) { return f.path().extension() == ".pdf"; });
    };
    writeReports(folder);
    EXPECT_GT(pdfs(), 0);
    writeReports(folder, nullptr, {.cases = run.cases.size() - 1});
    EXPECT_EQ(pdfs(), 0);
    fs::remove_all(folder);
}

/// Curves are lost with their file; those of the other cases are there.
TEST(Robustness, ALostTrajectoryCostsItsCurvesAlone) {
    auto run = synthetic::makeRun(1);
    const fs::path folder = writeFolder("rigor-lost-curves", run);
    writeReports(folder);
    bool any = false;
    for (const auto& entry : fs::directory_iterator(folder / "plots")) {
        if (entry.path().extension() != ".csv") continue;
        any = true;
        std::set<std::string> lines;
        for (const auto& row : parseCsv(readText(entry.path()))) lines.insert(row[0]);
        EXPECT_GT(lines.size(), 2u) << entry.path();
    }
    EXPECT_TRUE(any);
    fs::remove_all(folder);
}

TEST(Robustness, AReportIsMadeOfARunWithoutACase) {
    auto run = synthetic::makeRun(3);
    run.cases.clear();
    run.finished.clear();
    const fs::path folder = writeFolder("rigor-no-case", run);
    expectSound(writeReports(folder), folder);
    EXPECT_NE(terminalSummary(run, 40, 80, false).find("0 done"), std::string::npos);
    run.scenarios.clear();
    run.engines.clear();
    const fs::path empty = writeFolder("rigor-nothing", run);
    expectSound(writeReports(empty), empty);
    fs::remove_all(folder);
    fs::remove_all(empty);
}

TEST(Robustness, ADamagedStoreIsNamed) {
    const fs::path folder = writeFolder("rigor-damaged", synthetic::makeRun(1));
    fs::resize_file(folder / "results.sqlite", fs::file_size(folder / "results.sqlite") / 2);
    try {
        writeReports(folder);
        ADD_FAILURE() << "a damaged store was reported";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("results.sqlite"), std::string::npos) << error.what();
    }
    fs::remove_all(folder);
}

}  // namespace
}  // namespace rigor::report
