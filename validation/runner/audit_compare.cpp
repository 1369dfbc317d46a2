// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "adapters/interface/checked_world.hpp"
#include "adapters/interface/input_check.hpp"
#include "validation/metrics/closed_forms.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/oracle/oracle.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/audit_findings.hpp"
#include "validation/runner/audit_spread.hpp"

namespace rigor::validation {
namespace {

using adapter::CollisionAnswer;
using adapter::ContactPoint;
using scenario::Geometry;
using scenario::Pose;
using scenario::Scenario;
using scenario::Vec3;

constexpr double kNoticeableAngle = 1e-6;  ///< [rad] normals nearer than this are right
constexpr double kNoticeableDepth = 1e-9;  ///< [m]

const Geometry& geometryOf(const Scenario& s, int body, int shape) {
    return s.bodies[body].shapes[shape].geometry;
}

/// Distance of a point from the surface of a convex shape [m], by the oracle: a ball of radius r around the
/// point has the signed distance of its centre minus r, outside and inside alike.
double surfaceDistance(Vec3 point, const Geometry& geometry, const Pose& pose, int dimension) {
    constexpr double kRadius = 1e-3;
    const auto answer = exactContact(scenario::Sphere{kRadius}, Pose{point, {}}, geometry, pose, dimension);
    return answer ? std::abs(answer->signedDistance + kRadius) : 0.0;
}

const ContactPoint& deepestOf(const std::vector<ContactPoint>& contacts) {
    return *std::max_element(contacts.begin(), contacts.end(),
                             [](const ContactPoint& x, const ContactPoint& y) { return x.depth < y.depth; });
}

AuditAnswer brief(const AuditQuery& q, const CollisionAnswer& answer) {
    constexpr double kSame = 1e-6;  // [rad]
    AuditAnswer said;
    said.answered = true;
    said.overlap = answer.overlap;
    said.hasContact = !answer.contacts.empty();
    if (!said.hasContact) return said;
    const ContactPoint& deepest = deepestOf(answer.contacts);
    said.depth = deepest.depth;
    said.normal = deepest.normal;
    said.minimising = q.decided && nearestAngle(deepest.normal, q.normals) < kSame;
    return said;
}

class Comparison {
  public:
    Comparison(const Scenario& scenario, results::AuditRow& row) : scenario_(scenario), row_(row) {}

    /// `places`: index of each contact of the result, among all of its frame; empty where no run acted upon
    /// them.
    void add(const AuditQuery& q, const CollisionAnswer& answer, const std::vector<int>& places = {}) {
        row_.overlapping += answer.overlap ? 1 : 0;
        if (!q.decided) {
            ++row_.undecided;
            return;
        }
        const bool overlaps = q.signedDistance<-kTouchTolerance, apart = q.signedDistance> kTouchTolerance;
        if (overlaps && !answer.overlap) {
            ++row_.missed;
            name(q, "missed", 3, -q.signedDistance);
            findings_.add("missed", -q.signedDistance, q, nullptr, -1);
        }
        if (apart && answer.overlap) {
            ++row_.spurious;
            name(q, "spurious", 2, q.signedDistance);
            addSpurious(q, answer, places);
        }
        if (overlaps && answer.overlap && !answer.contacts.empty()) compareContacts(q, answer, places);
    }

    /// The normals of all points of a contact that a run acted upon, where the metric normal_error judges them, too: it
    /// knows closed forms alone. The other kinds look at the deepest point.
    void addPoints(const AuditQuery& q) {
        const bool isJudged =
            closedFormPair(geometryOf(scenario_, q.bodyA, q.shapeA), q.poseA,
                           geometryOf(scenario_, q.bodyB, q.shapeB), q.poseB, scenario_.dimension)
                .has_value();
        if (!isJudged || !q.decided || q.normals.empty()) return;
        for (std::size_t i = 0; i < q.own.size(); ++i) {
            const double error = nearestAngle(q.own[i].normal, q.normals);
            if (error > kNoticeableAngle) findings_.add("point_normal", error, q, &q.own[i], q.ownPlaces[i]);
        }
    }

    /// A contact that claims an overlap of shapes that no query was needed for.
    void addStray(const ContactPoint& contact) {
        ++row_.spurious;
        AuditQuery q;
        q.bodyA = contact.bodyA;
        q.bodyB = contact.bodyB;
        name(q, "spurious, far apart", 2, contact.depth);
    }

    void finish() {
        row_.normalErrorMax = normal_.max();
        row_.normalErrorMedian = normal_.median();
        row_.depthErrorMax = depth_.max();
        row_.depthErrorMedian = depth_.median();
        row_.pointErrorMax = point_.max();
        row_.findings = findings_.text(scenario_);
    }

  private:
    void compareContacts(const AuditQuery& q, const CollisionAnswer& answer, const std::vector<int>& places) {
        const ContactPoint& deepest = deepestOf(answer.contacts);
        const int place = placeOf(deepest, answer, places);
        const double depthError = std::abs(deepest.depth + q.signedDistance);
        const double normalError = nearestAngle(deepest.normal, q.normals);
        depth_.add(depthError);
        if (depthError > kNoticeableDepth) findings_.add("depth", depthError, q, &deepest, place);
        if (normalError > kNoticeableAngle) findings_.add("normal", normalError, q, &deepest, place);
        if (normal_.add(normalError)) name(q, "normal", 1, normalError, place);
        const int dimension = scenario_.dimension;
        point_.add(
            surfaceDistance(deepest.pointA, geometryOf(scenario_, q.bodyA, q.shapeA), q.poseA, dimension));
        point_.add(
            surfaceDistance(deepest.pointB, geometryOf(scenario_, q.bodyB, q.shapeB), q.poseB, dimension));
    }

    void addSpurious(const AuditQuery& q, const CollisionAnswer& answer, const std::vector<int>& places) {
        if (answer.contacts.empty()) {
            findings_.add("spurious", q.signedDistance, q, nullptr, -1);
            return;
        }
        const ContactPoint& deepest = deepestOf(answer.contacts);
        findings_.add("spurious", q.signedDistance, q, &deepest, placeOf(deepest, answer, places));
    }

    static int placeOf(const ContactPoint& contact, const CollisionAnswer& answer,
                       const std::vector<int>& places) {
        const auto index = static_cast<std::size_t>(&contact - answer.contacts.data());
        return index < places.size() ? places[index] : -1;
    }

    /// The worst query so far: a missed overlap before a false one before a wrong normal, of a kind the one
    /// with the largest error. `contact`: its place among the stored contacts of the frame, -1 where it is
    /// none of them.
    void name(const AuditQuery& q, const char* what, int rank, double error, int contact = -1) {
        if (rank < worstRank_ || (rank == worstRank_ && error <= worstError_)) return;
        worstRank_ = rank;
        worstError_ = error;
        char place[64];
        std::snprintf(place, sizeof place, " at t=%.6g, step %lld", q.time, static_cast<long long>(q.step));
        const std::string which = contact < 0 ? "" : ", contact " + std::to_string(contact);
        const auto& bodies = scenario_.bodies;
        row_.worst = bodies[q.bodyA].name + "|" + bodies[q.bodyB].name + place + which + " (" + what + ")";
    }

    const Scenario& scenario_;
    results::AuditRow& row_;
    Spread normal_, depth_, point_;
    AuditFindings findings_;
    int worstRank_ = 0;
    double worstError_ = 0.0;
};

}  // namespace

AuditAnswers queryAuditor(const Scenario& scenario, const AuditCase& audited,
                          const adapter::CollisionEngine& engine, const std::string& auditor) {
    AuditAnswers said;
    results::AuditRow& row = said.row;
    row.auditor = auditor;
    row.outcome = "completed";
    row.frames = audited.frames;
    Comparison comparison(scenario, row);
    std::string refusal;
    std::int64_t refused = 0;
    for (const AuditQuery& q : audited.queries) {
        adapter::CollisionQuery query;
        query.a = {&geometryOf(scenario, q.bodyA, q.shapeA), q.poseA};
        query.b = {&geometryOf(scenario, q.bodyB, q.shapeB), q.poseB};
        query.dimension = scenario.dimension;
        said.answers.emplace_back();
        try {
            adapter::checkQueryInput(query);
            const CollisionAnswer answer = adapter::collideChecked(engine, query);
            comparison.add(q, answer);
            said.answers.back() = brief(q, answer);
            ++row.queries;
        } catch (const adapter::Unsupported& error) {
            refusal = error.what();
            ++refused;
        } catch (const adapter::BadInput& error) {
            refusal = error.what();
            ++refused;
        }
    }
    comparison.finish();
    if (refused > 0)
        row.note = std::to_string(refused) + " of " + std::to_string(audited.queries.size()) +
                   " queries without a result: " + refusal;
    if (refused > 0 && row.queries == 0) row.outcome = "unsupported";
    return said;
}

results::AuditRow inRunRow(const Scenario& scenario, const AuditCase& audited) {
    results::AuditRow row;
    row.auditor = kInRun;
    row.outcome = "completed";
    Comparison comparison(scenario, row);
    double last = -1.0;
    for (const AuditQuery& q : audited.queries) {
        if (!q.actedUpon) continue;
        ++row.queries;
        if (q.time != last) {
            ++row.frames;
            last = q.time;
        }
        CollisionAnswer answer;
        answer.contacts = q.own;
        const bool overlaps = q.decided && q.signedDistance < -kTouchTolerance;
        answer.overlap = std::any_of(q.own.begin(), q.own.end(), [&](const ContactPoint& c) {
            return overlaps || c.depth > kTouchTolerance;
        });
        comparison.add(q, answer, q.ownPlaces);
        comparison.addPoints(q);
    }
    for (const ContactPoint& contact : audited.stray) comparison.addStray(contact);
    comparison.finish();
    if (row.queries == 0) row.note = "no contacts are stored with the poses that they belong to";
    return row;
}

std::vector<std::pair<double, double>> normalErrors(const AuditCase& audited) {
    std::vector<std::pair<double, double>> errors;
    for (const AuditQuery& q : audited.queries) {
        if (!q.actedUpon || !q.decided || q.own.empty() || !(q.signedDistance < -kTouchTolerance)) continue;
        const double angle = nearestAngle(deepestOf(q.own).normal, q.normals);
        if (errors.empty() || errors.back().first != q.time)
            errors.emplace_back(q.time, angle);
        else
            errors.back().second = std::max(errors.back().second, angle);
    }
    return errors;
}

}  // namespace rigor::validation
