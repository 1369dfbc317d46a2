// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/report.hpp"

#include <exception>
#include <fstream>
#include <map>
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

/// Numbers of a trajectory in memory, in bytes.
std::size_t bytesOf(const results::TrajectoryFile& file) {
    std::size_t values = file.times.size();
    for (const auto* bodies : {&file.bodies, &file.reference})
        for (const auto& body : *bodies)
            for (const auto* channel :
                 {&body.position, &body.orientation, &body.velocity, &body.angularVelocity})
                values += channel->values.size();
    for (const auto& series : file.series) values += series.channel.values.size();
    return values * sizeof(double) + file.contacts.size() * sizeof(results::ContactSample);
}

/// The trajectories of a run. The files of one scenario are needed several times and are slow to open: small ones are
/// read once, with all they have, and kept until the next scenario begins.
class Trajectories {
  public:
    Trajectories(const results::Run& run, fs::path folder)
        : folder_(std::move(folder)), problems_(run.damage.begin(), run.damage.end()) {
        for (const auto& row : run.cases)
            if (!row.trajectoryFile.empty()) unread_[row.id] = row.trajectoryFile;
    }

    /// A lost or damaged file costs its curves, not the report; the reason is one of problems().
    std::optional<results::TrajectoryFile> load(const results::CaseRow& row, bool withContacts) {
        if (row.trajectoryFile.empty()) return std::nullopt;
        if (const auto it = kept_.find(row.id); it != kept_.end()) return it->second;
        unread_.erase(row.id);
        const fs::path path = folder_ / row.trajectoryFile;
        std::error_code error;
        const bool isSmall = fs::file_size(path, error) <= kSmallFile && !error;
        try {
            auto file = results::readTrajectory(path, withContacts || isSmall);
            if (isSmall) keep(row.id, file);
            return file;
        } catch (const std::exception& problem) {
            problems_.insert(problem.what());
            return std::nullopt;
        }
    }
    void beginScenario() {
        kept_.clear();
        bytes_ = 0;
    }
    /// Trajectories of which no format needs the content (of derived runs, say) are checked all the same.
    void checkOthers() {
        for (const auto& [id, file] : unread_)
            if (const auto problem = results::trajectoryProblem(folder_ / file); !problem.empty())
                problems_.insert(problem);
    }
    const std::set<std::string>& problems() const { return problems_; }

  private:
    static constexpr std::size_t kSmallFile = 1 << 20;   // [bytes]
    static constexpr std::size_t kMostBytes = 64 << 20;  // [bytes] of all kept files

    void keep(const std::string& id, const results::TrajectoryFile& file) {
        const std::size_t bytes = bytesOf(file);
        if (bytes_ + bytes > kMostBytes) return;
        bytes_ += bytes;
        kept_.emplace(id, file);
    }

    fs::path folder_;
    std::set<std::string> problems_;
    std::map<std::string, std::string> unread_;  ///< files by case
    std::map<std::string, results::TrajectoryFile> kept_;
    std::size_t bytes_ = 0;
};

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
    void writeData(const std::string& name, const std::string& content) {
        write(fs::path("data") / (name + ".js"), dataFile(name, content));
    }
    void writePlot(const NamedPlot& plot) {
        write(fs::path("plots") / (plot.name + ".svg"), plot.svg);
        write(fs::path("plots") / (plot.name + ".csv"), plot.csv);
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

/// Writes what trajectories give: details and curves, the plot over time, the replays.
void writeScenarios(const ViewModel& view, Trajectories& trajectories, ReportFolder& folder) {
    const TrajectoryLoader load = [&](const results::CaseRow& row) { return trajectories.load(row, false); };
    const FullTrajectoryLoader loadAll = [&](const results::CaseRow& row) {
        return trajectories.load(row, true);
    };
    const auto writeData = [&](const std::string& name, const std::string& content) {
        folder.writeData(name, content);
    };
    ReplayBudget budget = replayBudget(view);
    for (std::size_t i = 0; i < view.run().scenarios.size(); ++i) {
        trajectories.beginScenario();
        writeData("scenario-" + std::to_string(i), scenarioJson(view, i, load));
        if (const auto plot = scenarioPlot(view, i, load)) folder.writePlot(*plot);
        replayFiles(view, i, loadAll, budget, writeData);
    }
}

}  // namespace

std::vector<fs::path> writeReports(const fs::path& runDirectory, std::vector<std::string>* problems,
                                   const ReportLimits& limits) {
    results::Run run = results::readRun(runDirectory);
    const auto study = readStudy(runDirectory / "study.json");
    Trajectories trajectories(run, runDirectory);
    ReportFolder folder(runDirectory, limits);
    folder.writeCsv(run);
    folder.write("junit.xml", junitReport(run));
    if (!run.orders.empty()) folder.write("orders.csv", ordersCsv(run));
    if (!run.fairness.empty()) folder.write("fairness.csv", fairnessCsv(run));
    const results::Run shown = withoutDerivedRuns(std::move(run));
    const ViewModel view(shown);
    const bool isLarge = shown.cases.size() > limits.casesInPage;
    folder.write("index.html", htmlReport(view, study ? studyPageJson(*study) : "",
                                          isLarge ? CasesOfPage::Beside : CasesOfPage::Inside));
    clearDataFolder(runDirectory / "data");
    if (isLarge)
        for (std::size_t i = 0; i < caseFiles(view).size(); ++i)
            folder.writeData("cases-" + std::to_string(i), casesJson(view, i));
    fs::create_directories(runDirectory / "plots");
    writeScenarios(view, trajectories, folder);
    trajectories.checkOthers();
    folder.write("summary.md", markdownSummary(view) + problemsMarkdown(trajectories.problems()));
    for (const auto& plot : refinementPlots(view)) folder.writePlot(plot);
    if (study)
        for (const auto& plot : studyPlots(*study)) folder.writePlot(plot);
    if (fs::is_empty(runDirectory / "plots")) fs::remove(runDirectory / "plots");
    fs::create_directories(runDirectory / "tables" / "scenarios");
    for (const auto& entry : tableEntries())
        for (const auto& table : entry.make(view)) folder.writeTable(table);
    if (problems != nullptr) problems->assign(trajectories.problems().begin(), trajectories.problems().end());
    return folder.written;
}

}  // namespace rigor::report
