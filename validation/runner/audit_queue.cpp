// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <nlohmann/json.hpp>
#include <utility>

#include "validation/runner/answer.hpp"
#include "validation/runner/audit.hpp"

namespace rigor::validation {

using nlohmann::json;
using results::AuditRow;

namespace {
constexpr ProcessLimits kPrepareLimits{120.0, 4096};
constexpr ProcessLimits kQueryLimits{30.0, 4096};

AuditAnswer answerFromJson(const json& j) {
    AuditAnswer a;
    a.answered = j.at(0);
    a.overlap = j.at(1);
    a.hasContact = j.at(2);
    a.minimising = j.at(3);
    a.depth = numberFromJson(j.at(4));
    a.normal = {j.at(5).at(0), j.at(5).at(1), j.at(5).at(2)};
    return a;
}

AuditRow failedRow(const std::string& auditor, const ProcessResult& result) {
    AuditRow row;
    row.auditor = auditor;
    row.outcome = result.timedOut ? "timeout" : "crashed";
    row.note = result.timedOut ? "no result within the time limit" : result.ending();
    return row;
}
}  // namespace

/// The audit of the cases of one scenario under way.
struct AuditQueue::Batch {
    std::string scenario, text;
    std::map<std::string, std::string> cases;  ///< id to trajectory
    std::filesystem::path queries;
    std::map<std::string, std::map<std::string, AuditRow>> rows;  ///< rows by case and auditor
    std::map<std::string, std::map<std::string, std::vector<AuditAnswer>>> answers;
    int pending = 0;
    bool isDisturbed = false;  ///< a result is missing for reasons that are no auditor's
};

AuditQueue::AuditQueue(ProcessPool& pool, Files files, std::vector<std::string> auditors, Deliver deliver,
                       Disturbed disturbed)
    : pool_(pool),
      files_(std::move(files)),
      auditors_(std::move(auditors)),
      deliver_(std::move(deliver)),
      disturbed_(std::move(disturbed)) {}
AuditQueue::~AuditQueue() = default;

void AuditQueue::add(const std::string& scenario, const std::string& scenarioText,
                     const std::map<std::string, std::string>& cases) {
    if (cases.empty()) return;
    auto batch = std::make_shared<Batch>();
    batch->scenario = scenario;
    batch->text = scenarioText;
    batch->cases = cases;
    const std::string stem = "audit-" + std::to_string(next_++);
    batch->queries = files_.scratch / (stem + ".questions.json");
    json absolute = json::object();
    for (const auto& [id, file] : cases) absolute[id] = (files_.run / file).string();
    const auto request = files_.scratch / (stem + ".json");
    writeJsonFile(request, {{"scenario", scenario},
                            {"text", scenarioText},
                            {"cases", absolute},
                            {"answer", batch->queries.string()}});
    ProcessTask task{{files_.binary.string(), "__audit", request.string()},
                     kPrepareLimits,
                     "contact audit: " + scenario,
                     [this, batch](const ProcessResult& result) { prepared(batch, result); },
                     true};
    task.module = kNoModule;
    pool_.addNext(std::move(task));
}

void AuditQueue::prepared(const std::shared_ptr<Batch>& batch, const ProcessResult& result) {
    if (!result.disturbance.empty()) return disturbed_(result.disturbance);
    const auto queries = readJsonFile(batch->queries);
    if (!result.exitedWith(0) || !queries) {
        for (const auto& [id, file] : batch->cases) deliver_(id, {failedRow("oracle", result)});
        return;
    }
    for (const json& entry : queries->at("cases"))
        for (const char* row : {"oracle", kInRun})
            batch->rows[entry.at("id")][row] = auditFromJson(entry.at(row));
    batch->pending = 1;
    for (const auto& auditor : auditors_) startQueries(batch, auditor, "");
    finishOne(batch);
}

void AuditQueue::startQueries(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                              const std::string& onlyCase) {
    const std::string stem = "audit-" + std::to_string(next_++);
    const auto request = files_.scratch / (stem + ".json");
    const auto answer = files_.scratch / (stem + ".answer.json");
    writeJsonFile(request, {{"scenario", batch->scenario},
                            {"text", batch->text},
                            {"questions", batch->queries.string()},
                            {"auditor", auditor},
                            {"only", onlyCase},
                            {"answer", answer.string()}});
    ++batch->pending;
    ProcessTask task{{files_.binary.string(), "__audit", request.string()},
                     kQueryLimits,
                     "contact audit: " + batch->scenario + ", " + auditor,
                     [this, batch, auditor, onlyCase, answer](const ProcessResult& result) {
                         answered(batch, auditor, onlyCase, result, answer);
                     },
                     true};
    task.module = servedModule(adapter::parseSpec(auditor));
    pool_.addNext(std::move(task));
}

void AuditQueue::answered(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                          const std::string& onlyCase, const ProcessResult& result,
                          const std::filesystem::path& answer) {
    const auto rows = readJsonFile(answer);
    if (!result.disturbance.empty()) {
        batch->isDisturbed = true;
        disturbed_(result.disturbance);
    } else if (result.exitedWith(0) && rows) {
        for (const auto& [id, said] : rows->items()) {
            batch->rows[id][auditor] = auditFromJson(said.at("row"));
            for (const json& a : said.at("answers")) batch->answers[id][auditor].push_back(answerFromJson(a));
        }
    } else if (onlyCase.empty() && batch->cases.size() > 1 && !result.timedOut) {
        // One query killed it: the others get their results. (After a hang they would cost too much.)
        for (const auto& [id, file] : batch->cases) startQueries(batch, auditor, id);
    } else {
        for (const auto& [id, file] : batch->cases)
            if (onlyCase.empty() || id == onlyCase) batch->rows[id][auditor] = failedRow(auditor, result);
    }
    finishOne(batch);
}

void AuditQueue::finishOne(const std::shared_ptr<Batch>& batch) {
    if (--batch->pending > 0) return;
    std::error_code ignored;
    std::filesystem::remove(batch->queries, ignored);
    if (batch->isDisturbed) return;
    for (auto& [id, byAuditor] : batch->rows) {
        std::vector<AuditRow> rows{byAuditor["oracle"], byAuditor[kInRun]};
        for (const auto& auditor : auditors_)
            if (const auto it = byAuditor.find(auditor); it != byAuditor.end()) rows.push_back(it->second);
        const auto& answers = batch->answers[id];
        for (auto a = answers.begin(); a != answers.end(); ++a)
            for (auto b = std::next(a); b != answers.end(); ++b)
                if (auto row = pairRow(a->first, a->second, b->first, b->second); row.queries > 0)
                    rows.push_back(std::move(row));
        deliver_(id, std::move(rows));
    }
}

}  // namespace rigor::validation
