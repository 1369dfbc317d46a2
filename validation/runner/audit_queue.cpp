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
constexpr ProcessLimits kAskLimits{30.0, 4096};

AuditRow failedRow(const std::string& auditor, const ProcessResult& result) {
    AuditRow row;
    row.auditor = auditor;
    row.outcome = result.timedOut ? "timeout" : "crashed";
    row.note = result.timedOut ? "no answer within the time limit" : result.ending();
    return row;
}
}  // namespace

/// The audit of the cases of one scenario under way.
struct AuditQueue::Batch {
    std::string scenario, text;
    std::map<std::string, std::string> cases;  ///< id to trajectory
    std::filesystem::path questions;
    std::map<std::string, std::map<std::string, AuditRow>> rows;  ///< by case, by auditor
    int pending = 0;
};

AuditQueue::AuditQueue(ProcessPool& pool, Files files, std::vector<std::string> auditors, Deliver deliver)
    : pool_(pool), files_(std::move(files)), auditors_(std::move(auditors)), deliver_(std::move(deliver)) {}
AuditQueue::~AuditQueue() = default;

void AuditQueue::add(const std::string& scenario, const std::string& scenarioText,
                     const std::map<std::string, std::string>& cases) {
    if (cases.empty()) return;
    auto batch = std::make_shared<Batch>();
    batch->scenario = scenario, batch->text = scenarioText, batch->cases = cases;
    const std::string stem = "audit-" + std::to_string(next_++);
    batch->questions = files_.scratch / (stem + ".questions.json");
    json absolute = json::object();
    for (const auto& [id, file] : cases) absolute[id] = (files_.run / file).string();
    const auto request = files_.scratch / (stem + ".json");
    writeJsonFile(request, {{"scenario", scenario},
                            {"text", scenarioText},
                            {"cases", absolute},
                            {"answer", batch->questions.string()}});
    pool_.addNext({{files_.binary.string(), "__audit", request.string()},
                   kPrepareLimits,
                   "contact audit: " + scenario,
                   [this, batch](const ProcessResult& result) {
                       const auto questions = readJsonFile(batch->questions);
                       if (!result.exitedWith(0) || !questions) {
                           for (const auto& [id, file] : batch->cases)
                               deliver_(id, {failedRow("oracle", result)});
                           return;
                       }
                       for (const json& entry : questions->at("cases"))
                           for (const char* row : {"oracle", kInRun})
                               batch->rows[entry.at("id")][row] = auditFromJson(entry.at(row));
                       batch->pending = 1;
                       for (const auto& auditor : auditors_) ask(batch, auditor, "");
                       finishOne(batch);
                   }});
}

void AuditQueue::ask(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                     const std::string& onlyCase) {
    const std::string stem = "audit-" + std::to_string(next_++);
    const auto request = files_.scratch / (stem + ".json");
    const auto answer = files_.scratch / (stem + ".answer.json");
    writeJsonFile(request, {{"scenario", batch->scenario},
                            {"text", batch->text},
                            {"questions", batch->questions.string()},
                            {"auditor", auditor},
                            {"only", onlyCase},
                            {"answer", answer.string()}});
    ++batch->pending;
    pool_.addNext({{files_.binary.string(), "__audit", request.string()},
                   kAskLimits,
                   "contact audit: " + batch->scenario + ", " + auditor,
                   [this, batch, auditor, onlyCase, answer](const ProcessResult& result) {
                       answered(batch, auditor, onlyCase, result, answer);
                   }});
}

void AuditQueue::answered(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                          const std::string& onlyCase, const ProcessResult& result,
                          const std::filesystem::path& answer) {
    const auto rows = readJsonFile(answer);
    if (result.exitedWith(0) && rows) {
        for (const auto& [id, row] : rows->items()) batch->rows[id][auditor] = auditFromJson(row);
    } else if (onlyCase.empty() && batch->cases.size() > 1 && !result.timedOut) {
        // One question killed it: the others deserve their answers. (After a hang they would cost too much.)
        for (const auto& [id, file] : batch->cases) ask(batch, auditor, id);
    } else {
        for (const auto& [id, file] : batch->cases)
            if (onlyCase.empty() || id == onlyCase) batch->rows[id][auditor] = failedRow(auditor, result);
    }
    finishOne(batch);
}

void AuditQueue::finishOne(const std::shared_ptr<Batch>& batch) {
    if (--batch->pending > 0) return;
    for (auto& [id, byAuditor] : batch->rows) {
        std::vector<AuditRow> rows{byAuditor["oracle"], byAuditor[kInRun]};
        for (const auto& auditor : auditors_)
            if (const auto it = byAuditor.find(auditor); it != byAuditor.end()) rows.push_back(it->second);
        deliver_(id, std::move(rows));
    }
    std::error_code ignored;
    std::filesystem::remove(batch->questions, ignored);
}

}  // namespace rigor::validation
