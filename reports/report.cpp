// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/report.hpp"

#include <deque>
#include <exception>
#include <fstream>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "reports/encoding/data_files.hpp"
#include "reports/encoding/gzip_text.hpp"
#include "reports/encoding/text.hpp"
#include "reports/model/derived_runs.hpp"
#include "reports/model/trajectory_loader.hpp"
#include "reports/model/view_model.hpp"
#include "reports/page/html.hpp"
#include "reports/page/page_data.hpp"
#include "reports/plots/line_plot.hpp"
#include "reports/plots/study.hpp"
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

/// The trajectories of a run. May be used by several threads; the library of the files by one at a time.
class Trajectories {
  public:
    Trajectories(const results::Run& run, fs::path folder)
        : folder_(std::move(folder)), problems_(run.damage.begin(), run.damage.end()) {
        for (const auto& row : run.cases)
            if (!row.trajectoryFile.empty()) unread_[row.id] = row.trajectoryFile;
    }

    fs::path pathOf(const results::CaseRow& row) const { return folder_ / row.trajectoryFile; }
    /// A lost or damaged file costs its curves, not the report; the reason is one of problems().
    std::optional<results::TrajectoryFile> read(const results::CaseRow& row, bool withContacts) {
        const std::lock_guard lock(mutex_);
        unread_.erase(row.id);
        try {
            return results::readTrajectory(pathOf(row), withContacts);
        } catch (const std::exception& problem) {
            problems_.insert(problem.what());
            return std::nullopt;
        }
    }
    /// Trajectories of which no format needs the content (of derived runs, say) are checked all the same.
    void checkOthers() {
        for (const auto& [id, file] : unread_)
            if (const auto problem = results::trajectoryProblem(folder_ / file); !problem.empty())
                problems_.insert(problem);
    }
    const std::set<std::string>& problems() const { return problems_; }

  private:
    fs::path folder_;
    std::mutex mutex_;  ///< lock of what follows, and of the library of the files
    std::set<std::string> problems_;
    std::map<std::string, std::string> unread_;  ///< files by case
};

/// The trajectories of one scenario, which are needed several times and are slow to open: small ones are read once, with
/// all they have, and kept.
class TrajectoriesOfScenario {
  public:
    explicit TrajectoriesOfScenario(Trajectories& all) : all_(all) {}

    std::optional<results::TrajectoryFile> load(const results::CaseRow& row, bool withContacts) {
        if (row.trajectoryFile.empty()) return std::nullopt;
        const std::lock_guard lock(mutex_);
        if (const auto it = kept_.find(row.id); it != kept_.end()) return it->second;
        std::error_code error;
        const bool isSmall = fs::file_size(all_.pathOf(row), error) <= kSmallFile && !error;
        auto file = all_.read(row, withContacts || isSmall);
        if (isSmall && file) keep(row.id, *file);
        return file;
    }

  private:
    static constexpr std::size_t kSmallFile = 1 << 20;   // [bytes]
    static constexpr std::size_t kMostBytes = 64 << 20;  // [bytes] of all kept files

    void keep(const std::string& id, const results::TrajectoryFile& file) {
        const std::size_t bytes = bytesOf(file);
        if (bytes_ + bytes > kMostBytes) return;
        bytes_ += bytes;
        kept_.emplace(id, file);
    }

    Trajectories& all_;
    std::mutex mutex_;
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
        for (const char* name : {"results.csv", "fairness.csv"})
            remove(name + std::string(isLarge(run) ? "" : ".gz"));
        if (!isLarge(run)) {
            write("results.csv", csvReport(run));
            if (!run.fairness.empty()) write("fairness.csv", fairnessCsv(run));
            return;
        }
        GzipText compressed;
        csvReport(run, [&](std::string_view lines) { compressed.add(lines); });
        write("results.csv.gz", compressed.finish());
        if (!run.fairness.empty()) write("fairness.csv.gz", gzip(fairnessCsv(run)));
    }
    void writeData(const std::string& name, const std::string& content) {
        write(fs::path("data") / (name + ".js"), dataFile(name, content));
    }
    /// The names of the files.
    std::vector<std::string> writePlot(const NamedPlot& plot, bool withPdf) {
        const std::string name = (fs::path("plots") / plot.name).string();
        remove(name + ".pdf");
        write(name + ".svg", svgOf(plot.drawing));
        if (withPdf) write(name + ".pdf", pdfOf(plot.drawing));
        write(name + ".csv", plot.csv);
        if (!withPdf) return {name + ".svg", name + ".csv"};
        return {name + ".svg", name + ".pdf", name + ".csv"};
    }
    /// A large run has its plots in SVG alone, and the tables of its scenarios in CSV alone, neither in Markdown nor in
    /// LaTeX.
    bool isLarge(const results::Run& run) const { return run.cases.size() > limits_.cases; }
    /// The names of the files.
    std::vector<std::string> writeTable(const Table& table, bool csvAlone) {
        const std::string name = (fs::path("tables") / table.name).string();
        for (const char* ending : {".csv", ".md", ".tex", ".csv.gz"}) remove(name + ending);
        if (table.rows.size() > limits_.tableRows) {
            write(name + ".csv.gz", gzip(tableCsv(table)));
            return {name + ".csv.gz"};
        }
        write(name + ".csv", tableCsv(table));
        if (csvAlone) return {name + ".csv"};
        write(name + ".md", tableMarkdown(table));
        write(name + ".tex", tableLatex(table));
        return {name + ".csv", name + ".md", name + ".tex"};
    }

    /// The same folder, into which nothing has been written.
    ReportFolder withoutFiles() const { return {folder_, limits_}; }
    /// Notes what was written through the other.
    void add(const ReportFolder& other) {
        written.insert(written.end(), other.written.begin(), other.written.end());
    }

    std::vector<fs::path> written;

  private:
    fs::path folder_;
    ReportLimits limits_;
};

using TableFiles = std::map<std::string, std::vector<std::string>>;  ///< names of files by table

TableFiles writeTables(const ViewModel& view, ReportFolder& folder) {
    TableFiles files;
    for (const auto& entry : tableEntries())
        for (const auto& table : entry.make(view))
            files[table.name] = folder.writeTable(table, table.ofScenario && folder.isLarge(view.run()));
    return files;
}

/// Details and curves of a scenario, and its plot over time. `files`: those of its table.
ReportFolder writeScenario(const ViewModel& view, std::size_t scenario, TrajectoriesOfScenario& trajectories,
                           std::vector<std::string> files, ReportFolder folder) {
    const TrajectoryLoader load = [&](const results::CaseRow& row) { return trajectories.load(row, false); };
    if (const auto plot = scenarioPlot(view, scenario, load))
        for (auto& file : folder.writePlot(*plot, !folder.isLarge(view.run())))
            files.push_back(std::move(file));
    folder.writeData("scenario-" + std::to_string(scenario), scenarioJson(view, scenario, load, files));
    return folder;
}

/// Writes what trajectories give: details, curves and plots of scenarios, beside the replays, which have a budget
/// together and are made in order.
void writeScenarios(const ViewModel& view, TableFiles tables, Trajectories& trajectories,
                    ReportFolder& folder) {
    constexpr std::size_t kMostInWork = 4;
    const ReportFolder empty = folder.withoutFiles();
    std::deque<std::future<ReportFolder>> inWork;
    const auto finishOldest = [&] {
        std::future<ReportFolder> oldest = std::move(inWork.front());
        inWork.pop_front();
        folder.add(oldest.get());
    };
    ReplayBudget budget = replayBudget(view);
    for (std::size_t i = 0; i < view.run().scenarios.size(); ++i) {
        if (inWork.size() == kMostInWork) finishOldest();
        const auto own = std::make_shared<TrajectoriesOfScenario>(trajectories);
        inWork.push_back(
            std::async(std::launch::async,
                       [&view, &empty, own, i, files = tables[scenarioTableName(view.run().scenarios[i])]] {
                           return writeScenario(view, i, *own, files, empty);
                       }));
        replayFiles(
            view, i, [&](const results::CaseRow& row) { return own->load(row, true); }, budget,
            [&](const std::string& name, const std::string& content) { folder.writeData(name, content); });
    }
    while (!inWork.empty()) finishOldest();
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
    const results::Run shown = withoutDerivedRuns(std::move(run));
    const ViewModel view(shown);
    const bool areBeside = shown.cases.size() > limits.casesInPage;
    folder.write("index.html", htmlReport(view, study ? studyPageJson(*study) : "",
                                          areBeside ? CasesOfPage::Beside : CasesOfPage::Inside));
    clearDataFolder(runDirectory / "data");
    if (areBeside)
        for (std::size_t i = 0; i < caseFiles(view).size(); ++i)
            folder.writeData("cases-" + std::to_string(i), casesJson(view, i));
    if (areBeside) folder.writeData("lists", listsJson(view));
    fs::create_directories(runDirectory / "plots");
    fs::create_directories(runDirectory / "tables" / "scenarios");
    writeScenarios(view, writeTables(view, folder), trajectories, folder);
    trajectories.checkOthers();
    folder.write("summary.md", markdownSummary(view) + problemsMarkdown(trajectories.problems()));
    for (const auto& plot : refinementPlots(view)) folder.writePlot(plot, !folder.isLarge(shown));
    if (study)
        for (const auto& plot : studyPlots(*study)) folder.writePlot(plot, !folder.isLarge(shown));
    if (fs::is_empty(runDirectory / "plots")) fs::remove(runDirectory / "plots");
    if (problems != nullptr) problems->assign(trajectories.problems().begin(), trajectories.problems().end());
    return folder.written;
}

}  // namespace rigor::report
