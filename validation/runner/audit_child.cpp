// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "adapters/interface/registry.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/audit.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
constexpr const char* kNormalErrorSeries = "normal_error";
using scenario::Pose;
using scenario::Vec3;

json vectorToJson(Vec3 v) {
    return {v.x, v.y, v.z};
}
Vec3 vectorFromJson(const json& j) {
    return {j.at(0), j.at(1), j.at(2)};
}
json poseToJson(const Pose& pose) {
    const auto& [p, q] = pose;
    return {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
}
Pose poseFromJson(const json& j) {
    return {{j.at(0), j.at(1), j.at(2)}, {j.at(3), j.at(4), j.at(5), j.at(6)}};
}

json queryToJson(const AuditQuery& q) {
    json normals = json::array();
    for (const Vec3& n : q.normals) normals.push_back(vectorToJson(n));
    return {q.time,
            {q.bodyA, q.bodyB, q.shapeA, q.shapeB},
            poseToJson(q.poseA),
            poseToJson(q.poseB),
            q.decided,
            numberToJson(q.signedDistance),
            normals,
            q.step};
}

AuditQuery queryFromJson(const json& j) {
    AuditQuery q;
    q.time = j.at(0);
    const json& ids = j.at(1);
    q.bodyA = ids.at(0);
    q.bodyB = ids.at(1);
    q.shapeA = ids.at(2);
    q.shapeB = ids.at(3);
    q.poseA = poseFromJson(j.at(2));
    q.poseB = poseFromJson(j.at(3));
    q.decided = j.at(4);
    q.signedDistance = numberFromJson(j.at(5));
    for (const json& n : j.at(6)) q.normals.push_back(vectorFromJson(n));
    q.step = j.at(7);
    return q;
}

json auditAnswerToJson(const AuditAnswer& a) {
    return {a.answered, a.overlap, a.hasContact, a.minimising, numberToJson(a.depth), vectorToJson(a.normal)};
}

scenario::Scenario scenarioOf(const json& request) {
    return scenario::loadScenarioText(request.at("text").get<std::string>(),
                                      request.at("scenario").get<std::string>())
        .scenario;
}

/// Puts the curve of normal errors beside the other curves of a case, which had no oracle.
void recordNormalErrors(const AuditCase& found, const std::filesystem::path& trajectory) {
    const auto errors = normalErrors(found);
    if (errors.empty()) return;
    results::TrajectoryFile file = results::readTrajectory(trajectory);
    results::SeriesChannel series{kNormalErrorSeries, "", {"rad", 1, {}}};
    series.channel.values.assign(file.times.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& [time, angle] : errors) {
        const auto frame = std::lower_bound(file.times.begin(), file.times.end(), time);
        if (frame != file.times.end()) series.channel.values[frame - file.times.begin()] = angle;
    }
    std::erase_if(file.series, [](const auto& s) { return s.name == kNormalErrorSeries; });
    file.series.push_back(std::move(series));
    results::writeTrajectory(trajectory, file);
}

/// Finds the queries of all cases and the oracle's results.
json prepare(const json& request) {
    const scenario::Scenario s = scenarioOf(request);
    json cases = json::array();
    for (const auto& [id, trajectory] : request.at("cases").items()) {
        const AuditCase found = findQueries(s, id, trajectory.get<std::string>());
        recordNormalErrors(found, trajectory.get<std::string>());
        json queries = json::array();
        for (const AuditQuery& q : found.queries) queries.push_back(queryToJson(q));
        cases.push_back({{"id", id},
                         {"frames", found.frames},
                         {"queries", std::move(queries)},
                         {"oracle", auditToJson(oracleRow(found))},
                         {kInRun, auditToJson(inRunRow(s, found))}});
    }
    return {{"cases", std::move(cases)}};
}

/// One engine's results for the queries of all cases, or of one.
json runQueries(const json& request) {
    const scenario::Scenario s = scenarioOf(request);
    const auto queries = readJsonFile(request.at("questions").get<std::string>());
    if (!queries) throw std::runtime_error("the questions of the audit can not be read");
    const auto auditor = request.at("auditor").get<std::string>();
    const auto only = request.at("only").get<std::string>();
    const adapter::LoadedEngine engine = adapter::loadEngine(adapter::parseSpec(auditor));
    if (engine->collision() == nullptr)
        throw std::runtime_error("'" + auditor + "' has no collision queries");
    json rows = json::object();
    for (const json& entry : queries->at("cases")) {
        AuditCase requested;
        requested.id = entry.at("id");
        requested.frames = entry.at("frames");
        if (!only.empty() && requested.id != only) continue;
        for (const json& q : entry.at("queries")) requested.queries.push_back(queryFromJson(q));
        const AuditAnswers said = queryAuditor(s, requested, *engine->collision(), auditor);
        json answers = json::array();
        for (const AuditAnswer& a : said.answers) answers.push_back(auditAnswerToJson(a));
        rows[requested.id] = {{"row", auditToJson(said.row)}, {"answers", std::move(answers)}};
    }
    return rows;
}

}  // namespace

int auditChild(const std::filesystem::path& requestFile) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    const json answer = request->contains("auditor") ? runQueries(*request) : prepare(*request);
    writeJsonFile(request->at("answer").get<std::string>(), answer);
    return 0;
}

}  // namespace rigor::validation
