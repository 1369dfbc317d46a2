// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "adapters/interface/input_check.hpp"
#include "validation/oracle/oracle.hpp"
#include "validation/runner/audit.hpp"

namespace rigor::validation {
namespace {

using adapter::CollisionAnswer;
using adapter::ContactPoint;
using scenario::Geometry;
using scenario::Pose;
using scenario::Scenario;
using scenario::Vec3;

const Geometry& geometryOf(const Scenario& s, int body, int shape) {
    return s.bodies[static_cast<std::size_t>(body)].shapes[static_cast<std::size_t>(shape)].geometry;
}

/// Angle to the nearest of the equally good normals [rad]; atan2 keeps small angles exact.
double normalError(Vec3 normal, const std::vector<Vec3>& minimising) {
    double best = std::numbers::pi;
    for (const Vec3& n : minimising)
        best = std::min(best, std::atan2(norm(cross(normal, n)), dot(normal, n)));
    return best;
}

/// Distance of a point from the surface of a convex shape [m], by the oracle: a ball of radius r around the
/// point has the signed distance of its centre minus r, outside and inside alike.
double surfaceDistance(Vec3 point, const Geometry& geometry, const Pose& pose, int dimension) {
    constexpr double kRadius = 1e-3;
    const auto answer = exactContact(scenario::Sphere{kRadius}, Pose{point, {}}, geometry, pose, dimension);
    return answer ? std::abs(answer->signedDistance + kRadius) : 0.0;
}

/// The largest value and the median of what was measured.
class Spread {
  public:
    bool add(double value) {
        values_.push_back(value);
        if (!(value <= largest_)) {
            largest_ = value;
            return true;
        }
        return false;
    }
    std::optional<double> max() const { return values_.empty() ? std::nullopt : std::optional(largest_); }
    std::optional<double> median() {
        if (values_.empty()) return std::nullopt;
        const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
        std::nth_element(values_.begin(), middle, values_.end());
        return *middle;
    }

  private:
    std::vector<double> values_;
    double largest_ = -1.0;
};

class Comparison {
  public:
    Comparison(const Scenario& scenario, results::AuditRow& row) : scenario_(scenario), row_(row) {}

    void add(const AuditQuery& q, const CollisionAnswer& answer) {
        row_.overlapping += answer.overlap ? 1 : 0;
        if (!q.decided) {
            ++row_.undecided;
            return;
        }
        const bool overlaps = q.signedDistance<-kTouchTolerance, apart = q.signedDistance> kTouchTolerance;
        if (overlaps && !answer.overlap) {
            ++row_.missed;
            name(q, "missed", 3);
        }
        if (apart && answer.overlap) {
            ++row_.spurious;
            name(q, "spurious", 2);
        }
        if (overlaps && answer.overlap && !answer.contacts.empty()) compareContacts(q, answer);
    }

    /// A contact that claims an overlap of shapes that nobody needed to ask about.
    void addStray(const ContactPoint& contact) {
        ++row_.spurious;
        AuditQuery q;
        q.bodyA = contact.bodyA, q.bodyB = contact.bodyB;
        name(q, "spurious, far apart", 2);
    }

    void finish() {
        row_.normalErrorMax = normal_.max(), row_.normalErrorMedian = normal_.median();
        row_.depthErrorMax = depth_.max(), row_.depthErrorMedian = depth_.median();
        row_.pointErrorMax = point_.max();
    }

  private:
    void compareContacts(const AuditQuery& q, const CollisionAnswer& answer) {
        const ContactPoint& deepest =
            *std::max_element(answer.contacts.begin(), answer.contacts.end(),
                              [](const ContactPoint& x, const ContactPoint& y) { return x.depth < y.depth; });
        depth_.add(std::abs(deepest.depth + q.signedDistance));
        if (normal_.add(normalError(deepest.normal, q.normals))) name(q, "normal", 1);
        const int dimension = scenario_.dimension;
        point_.add(
            surfaceDistance(deepest.pointA, geometryOf(scenario_, q.bodyA, q.shapeA), q.poseA, dimension));
        point_.add(
            surfaceDistance(deepest.pointB, geometryOf(scenario_, q.bodyB, q.shapeB), q.poseB, dimension));
    }

    /// The worst question so far: a missed overlap before a false one before a wrong normal.
    void name(const AuditQuery& q, const char* what, int rank) {
        if (rank < worstRank_ || (rank == worstRank_ && rank > 1)) return;
        worstRank_ = rank;
        char time[32];
        std::snprintf(time, sizeof time, "%.6g", q.time);
        const auto& bodies = scenario_.bodies;
        row_.worst = bodies[static_cast<std::size_t>(q.bodyA)].name + "|" +
                     bodies[static_cast<std::size_t>(q.bodyB)].name + " at t=" + time + " (" + what + ")";
    }

    const Scenario& scenario_;
    results::AuditRow& row_;
    Spread normal_, depth_, point_;
    int worstRank_ = 0;
};

}  // namespace

results::AuditRow askAuditor(const Scenario& scenario, const AuditCase& questions,
                             const adapter::CollisionEngine& engine, const std::string& auditor) {
    results::AuditRow row;
    row.auditor = auditor, row.outcome = "completed", row.frames = questions.frames;
    Comparison comparison(scenario, row);
    std::string refusal;
    std::int64_t refused = 0;
    for (const AuditQuery& q : questions.queries) {
        adapter::CollisionQuery query;
        query.a = {&geometryOf(scenario, q.bodyA, q.shapeA), q.poseA};
        query.b = {&geometryOf(scenario, q.bodyB, q.shapeB), q.poseB};
        query.dimension = scenario.dimension;
        try {
            adapter::checkQueryInput(query);
            comparison.add(q, engine.collide(query));
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
        row.note = std::to_string(refused) + " of " + std::to_string(questions.queries.size()) +
                   " questions not answered: " + refusal;
    if (refused > 0 && row.queries == 0) row.outcome = "unsupported";
    return row;
}

results::AuditRow inRunRow(const Scenario& scenario, const AuditCase& questions) {
    results::AuditRow row;
    row.auditor = kInRun, row.outcome = "completed";
    Comparison comparison(scenario, row);
    double last = -1.0;
    for (const AuditQuery& q : questions.queries) {
        if (!q.actedUpon) continue;
        ++row.queries;
        if (q.time != last) ++row.frames, last = q.time;
        CollisionAnswer answer;
        answer.contacts = q.own;
        const bool overlaps = q.decided && q.signedDistance < -kTouchTolerance;
        answer.overlap = std::any_of(q.own.begin(), q.own.end(), [&](const ContactPoint& c) {
            return overlaps || c.depth > kTouchTolerance;
        });
        comparison.add(q, answer);
    }
    for (const ContactPoint& contact : questions.stray) comparison.addStray(contact);
    comparison.finish();
    if (row.queries == 0) row.note = "no two recorded frames are one step apart";
    return row;
}

}  // namespace rigor::validation
