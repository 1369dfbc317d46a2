// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "validation/comparison/refinements.hpp"
#include "validation/comparison/regression.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/environment.hpp"
#include "validation/runner/header.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/orders.hpp"
#include "validation/runner/pieces.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/refusal.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
using results::CaseRow;
using results::Outcome;
using results::Verdict;

/// The end of what a child printed, fit for a line of a report: printable, short.
std::string readable(const std::string& output) {
    constexpr std::size_t kMost = 600;
    std::string text;
    for (const char c : output.substr(output.size() > kMost ? output.size() - kMost : 0)) {
        const auto code = static_cast<unsigned char>(c);
        text += code >= 0x20 && code < 0x7f ? c : (c == '\n' ? '\n' : '?');
    }
    const auto begin = text.find_first_not_of(" \n");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \n") - begin + 1);
}

CaseRow plannedRow(const CasePlan& plan, std::int64_t position) {
    CaseRow row = rowWithout(plan.scenario.name, plan.spec, plan.dt);
    row.id = plan.id;
    row.position = position;
    return row;
}

/// The row of a case whose child gave no result.
CaseRow failedRow(const CasePlan& plan, std::int64_t position, const ProcessResult& result) {
    CaseRow row = plannedRow(plan, position);
    if (result.timedOut) {
        row.outcome = Outcome::Timeout;
        row.reason = "no end within " + std::to_string(static_cast<int>(plan.scenario.timeLimit)) + " s";
    } else if (result.exitedWith(kExitOutOfMemory)) {
        row.outcome = Outcome::OutOfMemory;
        row.reason = "the memory limit was reached";
    } else if (WIFSIGNALED(result.status) && WTERMSIG(result.status) == SIGKILL) {
        row.outcome = Outcome::OutOfMemory;
        row.reason = "the system ran out of memory in each of " + std::to_string(kMostStarts) +
                     " attempts; the last one held " + std::to_string(result.peakMemoryKiB / 1024) + " MiB";
    } else {
        row.outcome = Outcome::Crashed;
        row.reason = result.ending();
        if (!WIFSIGNALED(result.status)) row.reason += " without a result";
    }
    if (const std::string said = readable(result.outputTail); !said.empty())
        row.reason += "; it said: " + said;
    judgeCase(row, plan.scenario);
    return row;
}

/// Removes what a killed child may have left half-written of a file.
void removePart(fs::path file) {
    std::error_code ignored;
    fs::remove(file += ".part", ignored);
}

/// The same of every file of a run.
void removeParts(const fs::path& run) {
    std::error_code ignored;
    for (const fs::path& folder : {run, run / "trajectories", run / "scenarios"})
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".part") fs::remove(entry.path(), ignored);
}

class RunInProgress {
  public:
    RunInProgress(const std::vector<CasePlan>& plan, const RunOptions& options,
                  const std::function<void(const Progress&)>& onProgress)
        : plan_(plan),
          options_(options),
          onProgress_(onProgress),
          directory_(fs::absolute(options.directory)),
          writer_(directory_, options.resume),
          pool_(options.jobs) {
        pool_.keepGuests(options.memoryLimitMiB);
    }

    results::Run run(const std::atomic<bool>& interrupted) {
        const bool complete = prepare(interrupted) && runTasks(interrupted);
        audits_.reset();
        if (!complete) return {};
        if (!disturbances_.empty()) throw results::EnvironmentError(disturbanceText());
        auto stored = results::readRun(directory_);
        finish(stored);
        stored.directory = options_.directory.string();
        return stored;
    }

  private:
    bool runTasks(const std::atomic<bool>& interrupted) {
        try {
            return pool_.run(interrupted, [&](const std::string& name) {
                progress_.current = name;
                report(nullptr);
            });
        } catch (const results::EnvironmentError&) {
            removeParts(directory_);
            throw;
        }
    }

    std::string disturbanceText() const {
        std::string text = disturbances_.front();
        if (disturbances_.size() > 1)
            text += "; " + std::to_string(disturbances_.size() - 1) + " more children likewise";
        return text + ". Their results are missing";
    }

    /// Adds the results of all cases together, then the mark of the end.
    void finish(results::Run& run) {
        run.orders = observedOrders(run);
        run.fairness = fairComparisons(run);
        writer_.writeAnalysis(run);
        run.finished = isoTime();
        writer_.finish(run.finished);
    }

    /// False if it was interrupted.
    bool prepare(const std::atomic<bool>& interrupted) {
        const auto engines = describeInvolved();
        references_ = plannedReferences(plan_, options_);
        auto header = runHeader(plan_, options_, engines, references_);
        std::map<std::string, CaseRow> present;
        if (options_.resume) {
            auto stored = storedRun(interrupted);
            if (!stored) return false;
            if (!stored->started.empty()) header.started = stored->started;
            for (CaseRow& row : stored->cases) present[row.id] = std::move(row);
            if (isOfAnotherMachine(*stored, header)) dropBegunScenarios(present);
        }
        writer_.writeHeader(header);
        writeScenarioFiles(plan_, directory_);
        fromLibrary_ = inLibrary(header.scenarios);
        for (const auto& s : header.scenarios) scenarios_[s.name] = s;
        if (!options_.records.empty()) record_ = Record(options_.records, header.engines);

        std::map<std::string, EngineDescription> described;
        for (const auto& d : engines) described[d.info.name] = d;
        progress_.total = plan_.size();
        for (const CasePlan& c : plan_) ++open_[c.scenario.name];
        for (std::size_t i = 0; i < plan_.size(); ++i)
            if (const auto it = present.find(plan_[i].id); it != present.end() && hasOrders(i, it->second))
                keep(i, it->second);
            else if (const auto refusal = declaredRefusal(plan_[i], described.at(plan_[i].spec.engine)))
                pool_.add(refusedTask(i, *refusal));
            else
                pool_.add(taskOf(i));
        started_ = std::chrono::steady_clock::now();
        return true;
    }

    /// Rows that an earlier part of the run has stored, but for cases that have to be run again. Empty if it was
    /// interrupted.
    std::optional<results::Run> storedRun(const std::atomic<bool>& interrupted) {
        removeParts(directory_);
        std::vector<std::string> ids;
        for (const CasePlan& c : plan_) ids.push_back(c.id);
        writer_.keepOnly(ids);
        try {
            auto stored = results::readRun(directory_, &interrupted);
            std::erase_if(stored.cases, [&](const CaseRow& row) { return !interrupted && !isWhole(row); });
            if (!interrupted) return stored;
        } catch (const results::ReadingInterrupted&) {
        }
        return std::nullopt;
    }

    /// The plan's engines and, for the audit, every engine with collision queries.
    std::vector<EngineDescription> describeInvolved() {
        std::set<std::string> names;
        for (const auto& name : adapter::availableEngines()) names.insert(name);
        for (const CasePlan& c : plan_) names.insert(c.spec.engine);
        const auto engines = describeEngines({names.begin(), names.end()}, options_.binary, options_.jobs);
        std::vector<std::string> auditors;
        for (const auto& d : engines)
            if (d.problem.empty() && d.capabilities.collision) auditors.push_back(d.info.name);
        if (options_.audit)
            audits_ = std::make_unique<AuditQueue>(
                pool_, AuditQueue::Files{options_.binary, directory_, scratch_.path()}, auditors,
                [this](const std::string& id, std::vector<results::AuditRow> rows) {
                    audited(id, std::move(rows));
                },
                [this](const std::string& reason) { disturbances_.push_back(reason); });
        return engines;
    }

    /// Notes an earlier machine in the new header.
    static bool isOfAnotherMachine(const results::Run& stored, results::Run& header) {
        const auto valueOf = [&](const char* key) {
            const auto it = stored.environment.find(key);
            return it == stored.environment.end() ? std::string() : it->second;
        };
        std::string earlier = valueOf(kEarlierMachinesKey);
        const std::string last = valueOf(kMachineKey);
        const bool isOther = !last.empty() && last != header.environment[kMachineKey];
        if (isOther) earlier += (earlier.empty() ? "" : "; ") + last + " (" + valueOf("cpu") + ")";
        if (!earlier.empty()) header.environment[kEarlierMachinesKey] = earlier;
        return isOther;
    }

    /// Timings of two machines never meet in one comparison: a scenario is run on one of them as a whole.
    void dropBegunScenarios(std::map<std::string, CaseRow>& present) const {
        std::set<std::string> begun;
        for (const CasePlan& c : plan_)
            if (!present.contains(c.id)) begun.insert(c.scenario.name);
        std::erase_if(present, [&](const auto& entry) { return begun.contains(entry.second.scenario); });
    }

    /// The trajectory that a stored case names is there and undamaged.
    bool isWhole(const CaseRow& row) const {
        return row.trajectoryFile.empty() ||
               results::trajectoryProblem(directory_ / row.trajectoryFile).empty();
    }

    /// A case that an earlier part of the run has stored.
    void keep(std::size_t index, const CaseRow& stored) {
        CaseRow row = stored;
        row.position = index;
        compareWithRecord(record_, scenarios_.at(row.scenario), row);
        if (row.position != stored.position || row.regression != stored.regression) writer_.writeCase(row);
        ++progress_.skipped;
        count(row);
        closed(plan_[index], row);
    }

    /// A stored case was run in as many orders as are requested; without `--orders` any number does.
    bool hasOrders(std::size_t index, const CaseRow& stored) const {
        if (options_.orders < 2 || !isRunInOrders(stored)) return true;
        const int others = otherOrders(plan_[index].scenario, options_.orders);
        return others == 0 ? !stored.orders.note.empty() : stored.orders.run == others + 1;
    }

    /// Number of runs of the scenario that a case takes: short pieces are one of each length, and a finer
    /// one.
    double runsOfCase() const {
        if (options_.pieces.empty()) return 1.0;
        return 1 + kConvergedSteps + 2 * options_.pieces.size();
    }

    /// Check of the reference that a case is measured against.
    const ReferenceCheck& referenceOf(std::size_t index) const {
        const auto known = brokenReferences_.find(index);
        return known == brokenReferences_.end() ? references_.at(plan_[index].scenario.name) : known->second;
    }

    /// Request to every child of a case. `name`: the stem of its files in the scratch folder.
    nlohmann::json requestOf(std::size_t index, const std::string& name) const {
        const CasePlan& c = plan_[index];
        const ReferenceCheck& reference = referenceOf(index);
        nlohmann::json requested{{"id", c.id},
                                 {"scenario", c.scenario.name},
                                 {"text", c.scenarioText},
                                 {"spec", c.spec.text()},
                                 {"dt", numberToJson(c.dt)},
                                 {"simulated", simulatedMark(name).string()},
                                 {"reference_seconds", numberToJson(referenceLimitsOf(c).seconds)},
                                 {"answer", answerOf(name).string()}};
        if (!reference.problem.empty())
            requested["without_reference"] = {{"outcome", referenceOutcomeName(reference.outcome)},
                                              {"problem", reference.problem}};
        return requested;
    }
    fs::path answerOf(const std::string& name) const { return scratch_.path() / (name + ".answer.json"); }

    /// A case that needs no child. Its row is stored in its turn.
    ProcessTask refusedTask(std::size_t index, const adapter::Unsupported& refusal) {
        ProcessTask task;
        task.done = [this, index, refusal](const ProcessResult&) {
            const CasePlan& c = plan_[index];
            CaseRow row = refusedRow(c.scenario.name, c.spec, c.dt, refusal);
            judgeCase(row, c.scenario);
            row.id = c.id;
            row.position = index;
            row.command = reproduceCommand(c, options_.directory, fromLibrary_[c.scenario.name]);
            store(index, row);
        };
        return task;
    }

    fs::path requestFileOf(const std::string& name) const { return scratch_.path() / (name + ".json"); }

    /// The child of a case. Its request is a file only while it runs: a plan may have many cases.
    ProcessTask taskOf(std::size_t index) {
        const CasePlan& c = plan_[index];
        ProcessTask task{{options_.binary.string(), "__case", requestFileOf(c.id).string()},
                         {c.scenario.timeLimit * runsOfCase(), options_.memoryLimitMiB},
                         c.scenario.name + ", " + c.spec.text(),
                         [this, index](const ProcessResult& result) { ended(index, result); },
                         true};
        task.begin = [this, index] {
            const CasePlan& begun = plan_[index];
            nlohmann::json requested = requestOf(index, begun.id);
            requested["trajectory"] = (directory_ / trajectoryName(begun.id)).string();
            requested["pieces"] = options_.pieces;
            writeJsonFile(requestFileOf(begun.id), requested);
        };
        task.guest = c.spec.engine;
        task.module = servedModule(c.spec);
        return task;
    }

    /// A case that a kept guest did not bring to its end is run once more with one of its own: neither its
    /// earlier cases nor the run that keeps it can be the reason then.
    bool repeatedWithOwnGuest(std::size_t index, const ProcessResult& result, const CaseRow& row) {
        if (!result.hadLentGuest || row.outcome == Outcome::Completed || row.outcome == Outcome::Unsupported)
            return false;
        ProcessTask task = taskOf(index);
        task.guest.clear();
        pool_.addNext(std::move(task));
        return true;
    }

    static std::string orderName(const CasePlan& c, int number) {
        return c.id + ".order" + std::to_string(number);
    }

    /// The child that runs a case in its `number`-th other order of insertion.
    ProcessTask orderTaskOf(std::size_t index, int number, int others) {
        const CasePlan& c = plan_[index];
        const std::string name = orderName(c, number);
        ProcessTask task{
            {options_.binary.string(), "__case", requestFileOf(name).string()},
            {c.scenario.timeLimit, options_.memoryLimitMiB},
            c.scenario.name + ", " + c.spec.text() + ", order " + std::to_string(number + 1) + " of " +
                std::to_string(others + 1),
            [this, index, number](const ProcessResult& result) { orderEnded(index, number, result); },
            true};
        task.begin = [this, index, number, name] {
            nlohmann::json requested = requestOf(index, name);
            requested["order"] = number;
            writeJsonFile(requestFileOf(name), requested);
        };
        task.module = servedModule(c.spec);
        return task;
    }

    /// Limits of a reference within a case, which computes all metrics in that time and memory as well.
    ReferenceLimits referenceLimitsOf(const CasePlan& c) const {
        return {options_.referenceLimits.seconds + 0.5 * c.scenario.timeLimit, options_.memoryLimitMiB};
    }

    /// A file that a case's child makes when the engine is done and the evaluation of the reference begins.
    fs::path simulatedMark(const std::string& name) const { return scratch_.path() / (name + ".simulated"); }

    /// The engine was done, and the process ended over the reference.
    bool endedOverReference(const std::string& name, const ProcessResult& result) const {
        const fs::path mark = simulatedMark(name);
        if (!fs::exists(mark)) return false;
        std::error_code ignored;
        fs::remove(mark, ignored);
        return !result.exitedWith(0);
    }

    /// A child that died over the reference is run once more without one: the engine is not to blame.
    bool repeatedWithoutReference(std::size_t index, const ProcessResult& result) {
        if (!endedOverReference(plan_[index].id, result)) return false;
        removePart(directory_ / trajectoryName(plan_[index].id));
        const auto limits = referenceLimitsOf(plan_[index]);
        brokenReferences_[index] = referenceFailure(result.timedOut, result.status, limits);
        pool_.addNext(taskOf(index));
        return true;
    }

    static std::string trajectoryName(const std::string& id) { return "trajectories/" + id + ".h5"; }

    /// Row of a child's result, or of the reason why there is none; the result file is removed.
    CaseRow rowOf(std::size_t index, const std::string& name, const ProcessResult& result) {
        const CasePlan& c = plan_[index];
        const auto reply = result.exitedWith(0) ? readJsonFile(answerOf(name)) : std::nullopt;
        CaseRow row = reply ? caseFromJson(*reply) : failedRow(c, index, result);
        row.id = c.id;
        row.position = index;
        row.wallSeconds = result.wallSeconds;
        row.cpuSeconds = result.cpuSeconds;
        if (!reply) row.peakMemoryKiB = result.peakMemoryKiB;
        std::error_code ignored;
        if (reply && fs::exists(directory_ / trajectoryName(c.id), ignored))
            row.trajectoryFile = trajectoryName(c.id);
        fs::remove(answerOf(name), ignored);
        return row;
    }

    void removeRequest(const std::string& name) const {
        std::error_code ignored;
        fs::remove(requestFileOf(name), ignored);
    }

    void ended(std::size_t index, const ProcessResult& result) {
        const CasePlan& c = plan_[index];
        removeRequest(c.id);
        if (!result.disturbance.empty()) return disturbances_.push_back(result.disturbance);
        if (repeatedWithoutReference(index, result)) return;
        CaseRow row = rowOf(index, c.id, result);
        row.command = reproduceCommand(c, options_.directory, fromLibrary_[c.scenario.name]);
        removePart(directory_ / trajectoryName(c.id));
        if (repeatedWithOwnGuest(index, result, row)) return;
        if (options_.orders < 2 || !isRunInOrders(row)) return store(index, row);
        const int others = otherOrders(c.scenario, options_.orders);
        if (others == 0) {
            addNoOrders(row);
            return store(index, row);
        }
        openOrders_.open(index, std::move(row), others);
        for (int number = others; number >= 1; --number) pool_.addNext(orderTaskOf(index, number, others));
    }

    void orderEnded(std::size_t index, int number, const ProcessResult& result) {
        const CasePlan& c = plan_[index];
        const std::string name = orderName(c, number);
        removeRequest(name);
        if (!result.disturbance.empty()) {
            openOrders_.abandon(index);
            return disturbances_.push_back(result.disturbance);
        }
        OrderEnd end{number, {}, ""};
        if (endedOverReference(name, result))
            end.reference = referenceFailure(result.timedOut, result.status, referenceLimitsOf(c)).text();
        else
            end.row = rowOf(index, name, result);
        if (auto row = openOrders_.ended(index, std::move(end))) store(index, *row);
    }

    void store(std::size_t index, CaseRow& row) {
        compareWithRecord(record_, scenarios_.at(row.scenario), row);
        writer_.writeCase(row);
        count(row);
        report(&row);
        closed(plan_[index], row);
    }

    /// Begins the audit of a scenario after its last case, before the next scenario's cases.
    void closed(const CasePlan& c, const CaseRow& row) {
        if (!row.trajectoryFile.empty() && row.audit.empty()) unaudited_[c.scenario.name][row.id] = row;
        if (--open_[c.scenario.name] > 0 || !audits_ || !hasAuditablePairs(c.scenario)) return;
        std::map<std::string, std::string> cases;
        for (const auto& [id, waiting] : unaudited_[c.scenario.name]) cases[id] = waiting.trajectoryFile;
        audits_->add(c.scenario.name, c.scenarioText, cases);
    }

    void audited(const std::string& id, std::vector<results::AuditRow> rows) {
        for (auto& [scenario, cases] : unaudited_)
            if (const auto it = cases.find(id); it != cases.end()) {
                it->second.audit = std::move(rows);
                writer_.writeCase(it->second);
                cases.erase(it);
                return;
            }
    }

    void count(const CaseRow& row) {
        ++progress_.done;
        const bool broke = row.verdict == Verdict::Crashed || row.verdict == Verdict::Timeout ||
                           row.verdict == Verdict::NonFinite;
        progress_.crashed += broke ? 1 : 0;
        progress_.failed += row.verdict == Verdict::Fail ? 1 : 0;
    }

    void report(const CaseRow* finished) {
        const auto ran = progress_.done - progress_.skipped;
        if (ran > 0) {
            const double elapsed =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
            progress_.etaSeconds = elapsed / ran * (progress_.total - progress_.done);
        }
        progress_.finished = finished;
        if (onProgress_) onProgress_(progress_);
        progress_.finished = nullptr;
    }

    const std::vector<CasePlan>& plan_;
    const RunOptions& options_;
    const std::function<void(const Progress&)>& onProgress_;
    fs::path directory_;
    results::RunWriter writer_;
    ScratchFolder scratch_;
    ProcessPool pool_;
    std::unique_ptr<AuditQueue> audits_;
    Progress progress_;
    std::chrono::steady_clock::time_point started_;
    std::map<std::string, bool> fromLibrary_;
    std::map<std::string, results::ScenarioRow> scenarios_;
    Record record_;
    std::map<std::string, ReferenceCheck> references_;  ///< checks by scenario
    /// Checks of cases whose child died in a reference that had passed its check, by place in the plan.
    std::map<std::size_t, ReferenceCheck> brokenReferences_;
    OpenOrders openOrders_;
    std::vector<std::string>
        disturbances_;                 ///< reasons why results are missing that no engine has to do with
    std::map<std::string, int> open_;  ///< cases of a scenario still to come
    std::map<std::string, std::map<std::string, CaseRow>> unaudited_;
};

}  // namespace

results::Run runCases(const std::vector<CasePlan>& plan, const RunOptions& options,
                      const std::function<void(const Progress&)>& onProgress,
                      const std::atomic<bool>& interrupted) {
    return RunInProgress(plan, options, onProgress).run(interrupted);
}

}  // namespace rigor::validation
