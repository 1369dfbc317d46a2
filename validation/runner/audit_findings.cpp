// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/audit_findings.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "validation/oracle/oracle.hpp"
#include "validation/runner/answer.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using scenario::Vec3;

/// More directions than this are samples of a continuum: the drawing needs no more of them.
constexpr std::size_t kMostNormals = 24;

json pointJson(Vec3 v) {
    return {numberToJson(v.x), numberToJson(v.y), numberToJson(v.z)};
}

/// The exact normals; of many, some evenly over the list.
json normalsOf(const std::vector<Vec3>& all) {
    const std::size_t count = std::min(all.size(), kMostNormals);
    json list = json::array();
    for (std::size_t k = 0; k < count; ++k) list.push_back(pointJson(all[k * all.size() / count]));
    return list;
}

json exactOf(const scenario::Scenario& s, const AuditQuery& q) {
    const auto& a = s.bodies[q.bodyA].shapes[q.shapeA].geometry;
    const auto& b = s.bodies[q.bodyB].shapes[q.shapeB].geometry;
    const auto exact = exactContact(a, q.poseA, b, q.poseB, s.dimension);
    if (!exact) return nullptr;
    return {{"distance", numberToJson(exact->signedDistance)},
            {"normals", normalsOf(exact->normals)},
            {"pointA", pointJson(exact->witnessA)},
            {"pointB", pointJson(exact->witnessB)}};
}

json contactToJson(const adapter::ContactPoint& c) {
    return {{"normal", pointJson(c.normal)},
            {"depth", numberToJson(c.depth)},
            {"pointA", pointJson(c.pointA)},
            {"pointB", pointJson(c.pointB)}};
}

}  // namespace

void AuditFindings::add(const std::string& what, double error, const AuditQuery& query,
                        const adapter::ContactPoint* contact, int place) {
    const auto known = worst_.find(what);
    if (known != worst_.end() && !(error > known->second.error)) return;
    Finding found;
    found.error = error;
    found.query = query;
    if (contact != nullptr) found.contact = *contact;
    found.place = place;
    worst_[what] = std::move(found);
}

std::string AuditFindings::text(const scenario::Scenario& scenario) const {
    json list = json::array();
    const auto normal = worst_.find("normal");
    for (const auto& [what, found] : worst_) {
        const bool isDeepest = normal != worst_.end() && !(found.error > normal->second.error);
        if (what == "point_normal" && isDeepest) continue;  // the deepest point is the worst one
        const AuditQuery& q = found.query;
        list.push_back({{"what", what},
                        {"error", numberToJson(found.error)},
                        {"unit", what.ends_with("normal") ? "rad" : "m"},
                        {"time", q.time},
                        {"step", q.step},
                        {"bodies", {q.bodyA, q.bodyB}},
                        {"names", {scenario.bodies[q.bodyA].name, scenario.bodies[q.bodyB].name}},
                        {"shapes", {q.shapeA, q.shapeB}},
                        {"contact", found.place},
                        {"said", found.contact ? contactToJson(*found.contact) : json(nullptr)},
                        {"exact", exactOf(scenario, q)}});
    }
    return list.empty() ? "" : list.dump();
}

}  // namespace rigor::validation
