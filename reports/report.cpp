// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/report.hpp"

#include <exception>
#include <fstream>
#include <set>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/gzip_text.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/derived_runs.hpp"
#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/html.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/study.hpp"
#include "reports/plots/svg_plot.hpp"
#include "reports/replay/data.hpp"
#include "reports/summaries/junit.hpp"
#include "reports/summaries/summary.hpp"
#include "reports/tables/csv.hpp"
#include "reports/tables/refinements.hpp"
#include "reports/tables/table.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::report {
namespace fs = std::filesystem;
namespace {

constexpr int kTableCompression = 6;

/// Result of `rigor study` beside the run, if it was one.
std::optional<nlohmann::ordered_json> readStudy(const fs::path& file) {
    std::ifstream in(file);
    if (!in) return std::nullopt;
    try {
        return nlohmann::ordered_json::parse(in);
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(file.string() + ": cannot be read as a study: " + error.what());
    }
}

/// A lost or damaged file costs its curves, not the report; the reason goes into `problems`.
std::optional<results::TrajectoryFile> loadTrajectory(const fs::path& runDirectory,
                                                      const results::CaseRow& row, bool withContacts,
                                                      std::set<std::string>& problems) {
    if (row.trajectoryFile.empty()) return std::nullopt;
    try {
        return results::readTrajectory(runDirectory / row.trajectoryFile, withContacts);
    } catch (const std::exception& error) {
        problems.insert(error.what());
        return std::nullopt;
    }
}

/// Trajectories of which no format needs the content (of derived runs, say) are checked all the same.
std::set<std::string> problemsOf(const results::Run& run, const fs::path& runDirectory) {
    std::set<std::string> problems(run.damage.begin(), run.damage.end());
    for (const results::CaseRow& row : run.cases)
        if (!row.trajectoryFile.empty())
            if (const auto problem = results::trajectoryProblem(runDirectory / row.trajectoryFile);
                !problem.empty())
                problems.insert(problem);
    return problems;
}

std::string problemsMarkdown(const std::set<std::string>& problems) {
    if (problems.empty()) return "";
    std::string text = "\n## Damaged or missing\n\n";
    for (const std::string& problem : problems) text += "- " + markdownCell(problem) + "\n";
    return text;
}

/// An empty folder: what an earlier report left there belongs to other scenarios.
void clearDataFolder(const fs::path& folder) {
    fs::create_directories(folder);
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".js") fs::remove(entry.path());
}

/// Writes into the folder of the run, and notes what was written.
class ReportFolder {
  public:
    ReportFolder(fs::path folder, const ReportLimits& limits) : folder_(std::move(folder)), limits_(limits) {}

    void write(const fs::path& name, const std::string& content) {
        writeFile(folder_ / name, content);
        written.push_back(folder_ / name);
    }
    /// A file that an earlier report, of more or of fewer cases, wrote in place of others.
    void remove(const fs::path& name) const {
        std::error_code ignored;
        fs::remove(folder_ / name, ignored);
    }
    void writeCsv(const results::Run& run) {
        const bool isLarge = run.cases.size() > limits_.cases;
        remove(isLarge ? "results.csv" : "results.csv.gz");
        if (!isLarge) return write("results.csv", csvReport(run));
        GzipText compressed;
        csvReport(run, [&](std::string_view lines) { compressed.add(lines); });
        write("results.csv.gz", compressed.finish());
    }
    void writeTable(const Table& table) {
        const std::string name = (fs::path("tables") / table.name).string();
        const bool isLarge = table.rows.size() > limits_.tableRows;
        for (const char* ending : {".csv", ".md", ".tex", ".csv.gz"})
            if (isLarge != (ending == std::string(".csv.gz"))) remove(name + ending);
        if (isLarge) return write(name + ".csv.gz", gzip(tableCsv(table), kTableCompression));
        write(name + ".csv", tableCsv(table));
        write(name + ".md", tableMarkdown(table));
        write(name + ".tex", tableLatex(table));
    }

    std::vector<fs::path> written;

  private:
    fs::path folder_;
    ReportLimits limits_;
};

}  // namespace

std::vector<fs::path> writeReports(const fs::path& runDirectory, std::vector<std::string>* problems,
                                   const ReportLimits& limits) {
    const results::Run run = results::readRun(runDirectory);
    std::set<std::string> found = problemsOf(run, runDirectory);
    const results::Run shown = withoutDerivedRuns(run);
    const ViewModel view(shown);
    const auto study = readStudy(runDirectory / "study.json");
    const TrajectoryLoader load = [&](const results::CaseRow& row) {
        return loadTrajectory(runDirectory, row, false, found);
    };
    ReportFolder folder(runDirectory, limits);
    const auto write = [&](const fs::path& name, const std::string& content) { folder.write(name, content); };
    const auto writeData = [&](const std::string& name, const std::string& content) {
        write(fs::path("data") / (name + ".js"), dataFile(name, content));
    };
    const bool isLarge = shown.cases.size() > limits.casesInPage;
    write("index.html", htmlReport(view, study ? studyPageJson(*study) : "",
                                   isLarge ? CasesOfPage::Beside : CasesOfPage::Inside));
    clearDataFolder(runDirectory / "data");
    if (isLarge)
        for (std::size_t i = 0; i < caseFiles(view).size(); ++i)
            writeData("cases-" + std::to_string(i), casesJson(view, i));
    for (std::size_t i = 0; i < shown.scenarios.size(); ++i)
        writeData("scenario-" + std::to_string(i), scenarioJson(view, i, load));
    folder.writeCsv(run);
    write("summary.md", markdownSummary(view) + problemsMarkdown(found));
    write("junit.xml", junitReport(run));
    if (!run.orders.empty()) write("orders.csv", ordersCsv(run));
    if (!run.fairness.empty()) write("fairness.csv", fairnessCsv(run));
    auto plots = scenarioPlots(view, load);
    for (auto& plot : refinementPlots(view)) plots.push_back(std::move(plot));
    if (study)
        for (auto& plot : studyPlots(*study)) plots.push_back(std::move(plot));
    if (!plots.empty()) fs::create_directories(runDirectory / "plots");
    for (const auto& plot : plots) {
        write(fs::path("plots") / (plot.name + ".svg"), plot.svg);
        write(fs::path("plots") / (plot.name + ".csv"), plot.csv);
    }
    fs::create_directories(runDirectory / "tables" / "scenarios");
    for (const auto& entry : tableEntries())
        for (const auto& table : entry.make(view)) folder.writeTable(table);
    const FullTrajectoryLoader loadAll = [&](const results::CaseRow& row) {
        return loadTrajectory(runDirectory, row, true, found);
    };
    replayFiles(view, loadAll, writeData);
    if (problems != nullptr) problems->assign(found.begin(), found.end());
    return folder.written;
}

}  // namespace rigor::report
