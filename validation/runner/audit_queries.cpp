// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "scenarios/model/surfaces.hpp"
#include "validation/metrics/closed_forms.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/oracle/oracle.hpp"
#include "validation/results/trajectory_file.hpp"
#include "validation/runner/audit.hpp"

namespace rigor::validation {
namespace {

using scenario::Pose;
using scenario::Scenario;
using scenario::Vec3;

constexpr std::size_t kFrames = 20;
constexpr std::size_t kMostQueries = 400;  ///< most queries per case
constexpr double kSmallAngle = 1e-6;       ///< [rad] smaller errors of normals are rounding
constexpr double kNearby = 0.02;           ///< bounding spheres closer than this are queried [m]

/// Smallest sphere we know around a shape, shape frame; infinite radius for a half-space.
struct Ball {
    Vec3 center;
    double radius = 0.0;
};

struct BallVisitor {
    Ball operator()(const scenario::Sphere& s) const { return {{}, s.radius}; }
    Ball operator()(const scenario::Box& s) const { return {{}, norm(s.halfExtents)}; }
    Ball operator()(const scenario::Capsule& s) const { return {{}, s.radius + s.halfLength}; }
    Ball operator()(const scenario::Ellipsoid& s) const {
        return {{}, std::max({s.halfAxes.x, s.halfAxes.y, s.halfAxes.z})};
    }
    Ball operator()(const scenario::Cylinder& s) const { return {{}, std::hypot(s.radius, s.halfLength)}; }
    Ball operator()(const scenario::Cone& s) const { return {{}, std::hypot(s.radius, s.halfLength)}; }
    Ball operator()(const scenario::ConvexHull& s) const {
        Ball ball;
        for (const Vec3& v : s.vertices) ball.center += v / s.vertices.size();
        for (const Vec3& v : s.vertices) ball.radius = std::max(ball.radius, norm(v - ball.center));
        return ball;
    }
    Ball operator()(const scenario::HalfSpace&) const {
        return {{}, std::numeric_limits<double>::infinity()};
    }
    Ball operator()(const scenario::Segment& s) const { return {0.5 * (s.a + s.b), 0.5 * norm(s.b - s.a)}; }
    template <class Surface>
    Ball operator()(const Surface& s) const {
        Ball ball;
        for (const Vec3& v : scenario::surfaceVertices(s)) ball.radius = std::max(ball.radius, norm(v));
        return ball;
    }
};

Ball ballAround(const scenario::Geometry& geometry) {
    return std::visit(BallVisitor{}, geometry);
}

/// A pair of shapes that could ever touch.
struct Candidate {
    int bodyA, bodyB, shapeA, shapeB;
};

struct ShapeAt {
    const scenario::Geometry* geometry;
    Pose pose;
    Ball ball;  ///< world frame
};

const scenario::Shape& shapeOf(const Scenario& s, int body, int shape) {
    return s.bodies[body].shapes[shape];
}

bool hasShape(const Scenario& s, int body, int shape) {
    return body >= 0 && body < static_cast<int>(s.bodies.size()) && shape >= 0 &&
           shape < static_cast<int>(s.bodies[body].shapes.size());
}

ShapeAt place(const Scenario& s, int body, int shape, const Pose& bodyPose) {
    const scenario::Shape& local = shapeOf(s, body, shape);
    const Pose pose = bodyPose * local.pose;
    const Ball ball = ballAround(local.geometry);
    return {&local.geometry, pose, {pose * ball.center, ball.radius}};
}

/// Distance of the bounding spheres, or of a sphere from a half-space.
double gap(const ShapeAt& a, const ShapeAt& b) {
    const auto fromPlane = [](const ShapeAt& plane, const ShapeAt& other) {
        const auto& h = std::get<scenario::HalfSpace>(*plane.geometry);
        const Vec3 n = rotate(plane.pose.orientation, h.normal);
        return dot(n, other.ball.center - plane.pose.position) - h.offset - other.ball.radius;
    };
    if (std::holds_alternative<scenario::HalfSpace>(*a.geometry)) return fromPlane(a, b);
    if (std::holds_alternative<scenario::HalfSpace>(*b.geometry)) return fromPlane(b, a);
    return norm(a.ball.center - b.ball.center) - a.ball.radius - b.ball.radius;
}

std::vector<Candidate> candidates(const Scenario& s) {
    std::vector<Candidate> pairs;
    const int bodies = s.bodies.size();
    const auto shapes = [&](int body) { return static_cast<int>(s.bodies[body].shapes.size()); };
    for (int a = 0; a < bodies; ++a)
        for (int b = a + 1; b < bodies; ++b) {
            if (!mayCollide(s, a, b)) continue;
            for (int i = 0; i < shapes(a); ++i)
                for (int j = 0; j < shapes(b); ++j)
                    if (mayTouch(s.bodies[a].shapes[i], s.bodies[b].shapes[j])) pairs.push_back({a, b, i, j});
        }
    return pairs;
}

std::size_t frameAt(const results::TrajectoryFile& file, double time) {
    return std::lower_bound(file.times.begin(), file.times.end(), time) - file.times.begin();
}

Pose bodyPose(const results::TrajectoryFile& file, std::size_t frame, int body) {
    const auto& channels = file.bodies[body];
    const double* p = channels.position.values.data() + 3 * frame;
    const double* q = channels.orientation.values.data() + 4 * frame;
    return {{p[0], p[1], p[2]}, scenario::normalized({q[0], q[1], q[2], q[3]})};
}

/// Frame of the contact point that the run acted upon with the most wrong normal, as far as closed forms say (that of the
/// metric normal_error); none where they know of no wrong one.
std::optional<std::size_t> worstNormalFrame(const Scenario& s, const results::TrajectoryFile& file) {
    if (!file.contactInstantsKnown) return std::nullopt;
    double worst = kSmallAngle;
    std::optional<std::size_t> found;
    for (const auto& contact : file.contacts) {
        const std::size_t frame = frameAt(file, contact.time);
        if (frame >= file.times.size() || !hasShape(s, contact.bodyA, contact.shapeA) ||
            !hasShape(s, contact.bodyB, contact.shapeB))
            continue;
        const scenario::Shape &a = shapeOf(s, contact.bodyA, contact.shapeA),
                              &b = shapeOf(s, contact.bodyB, contact.shapeB);
        const auto exact =
            closedFormPair(a.geometry, bodyPose(file, frame, contact.bodyA) * a.pose, b.geometry,
                           bodyPose(file, frame, contact.bodyB) * b.pose, s.dimension);
        if (!exact) continue;
        const double angle =
            angleBetween({contact.normal[0], contact.normal[1], contact.normal[2]}, exact->normal);
        if (!(angle > worst)) continue;
        worst = angle;
        found = frame;
    }
    return found;
}

/// Half of the frames evenly over the run, half evenly over those at which a step with contacts began; and the one with
/// the worst normal.
std::vector<std::size_t> sampledFrames(const results::TrajectoryFile& file,
                                       std::optional<std::size_t> worst) {
    std::set<std::size_t> chosen;
    if (worst) chosen.insert(*worst);
    const auto spread = [&](const std::vector<std::size_t>& from, std::size_t count) {
        if (from.empty()) return;
        for (std::size_t k = 0; k < count; ++k)
            chosen.insert(from[k * (from.size() - 1) / std::max<std::size_t>(1, count - 1)]);
    };
    std::vector<std::size_t> all, touching;
    for (std::size_t f = 0; f < file.times.size(); ++f)
        if (file.contactStride == 1 || results::contactsStored(file, f)) all.push_back(f);
    for (const auto& contact : file.contacts) {
        const std::size_t frame = frameAt(file, contact.time);
        if (frame >= file.times.size()) continue;
        if (touching.empty() || touching.back() != frame) touching.push_back(frame);
    }
    spread(all, kFrames / 2);
    spread(touching, kFrames / 2);
    return {chosen.begin(), chosen.end()};
}

std::vector<AuditQuery> frameQueries(const Scenario& s, const std::vector<Candidate>& pairs,
                                     const results::TrajectoryFile& file, std::size_t frame) {
    std::vector<AuditQuery> queries;
    for (const Candidate& c : pairs) {
        const ShapeAt a = place(s, c.bodyA, c.shapeA, bodyPose(file, frame, c.bodyA));
        const ShapeAt b = place(s, c.bodyB, c.shapeB, bodyPose(file, frame, c.bodyB));
        if (!isFinite(a.pose.position) || !isFinite(b.pose.position) || gap(a, b) > kNearby) continue;
        AuditQuery q;
        q.time = file.times[frame];
        q.step = static_cast<std::int64_t>(frame) * file.stride;
        q.bodyA = c.bodyA;
        q.bodyB = c.bodyB;
        q.shapeA = c.shapeA;
        q.shapeB = c.shapeB;
        q.poseA = a.pose;
        q.poseB = b.pose;
        queries.push_back(std::move(q));
    }
    return queries;
}

adapter::ContactPoint contactOf(const results::ContactSample& c) {
    const auto vec = [](const double* v) { return Vec3{v[0], v[1], v[2]}; };
    adapter::ContactPoint out;
    out.bodyA = c.bodyA;
    out.bodyB = c.bodyB;
    out.shapeA = c.shapeA;
    out.shapeB = c.shapeB;
    out.pointA = vec(c.pointA);
    out.pointB = vec(c.pointB);
    out.normal = vec(c.normal);
    out.depth = c.depth;
    return out;
}

/// Gives the queries of a frame the contacts of the step that began there; what is left over is stray.
void addOwnContacts(const results::TrajectoryFile& file, std::size_t frame, std::vector<AuditQuery>& queries,
                    std::vector<adapter::ContactPoint>& stray) {
    if (!file.contactInstantsKnown || !results::contactsStored(file, frame)) return;
    for (AuditQuery& q : queries) q.actedUpon = true;
    const auto time = [](const results::ContactSample& c, double t) { return c.time < t; };
    auto it = std::lower_bound(file.contacts.begin(), file.contacts.end(), file.times[frame], time);
    for (int place = 0; it != file.contacts.end() && it->time == file.times[frame]; ++it, ++place) {
        const adapter::ContactPoint contact = contactOf(*it);
        const auto about = std::find_if(queries.begin(), queries.end(), [&](const AuditQuery& q) {
            return q.bodyA == contact.bodyA && q.bodyB == contact.bodyB && q.shapeA == contact.shapeA &&
                   q.shapeB == contact.shapeB;
        });
        if (about != queries.end()) {
            about->own.push_back(contact);
            about->ownPlaces.push_back(place);
        } else if (contact.depth > kTouchTolerance) {
            stray.push_back(contact);
        }
    }
}

/// Leaves kMostQueries, evenly spread, and those about the contacts that the run acted upon in one step.
void thinOut(std::vector<AuditQuery>& queries, std::optional<std::int64_t> step) {
    if (queries.size() <= kMostQueries) return;
    std::set<std::size_t> places;
    for (std::size_t k = 0; k < kMostQueries; ++k) places.insert(k * queries.size() / kMostQueries);
    for (std::size_t k = 0; k < queries.size(); ++k)
        if (step && queries[k].step == *step && !queries[k].own.empty()) places.insert(k);
    std::vector<AuditQuery> kept;
    for (const std::size_t k : places) kept.push_back(std::move(queries[k]));
    queries = std::move(kept);
}

}  // namespace

bool hasAuditablePairs(const Scenario& s) {
    for (int a = 0; a < static_cast<int>(s.bodies.size()); ++a)
        for (int b = a + 1; b < static_cast<int>(s.bodies.size()); ++b)
            if (mayCollide(s, a, b)) return true;
    return false;
}

AuditCase findQueries(const Scenario& s, const std::string& caseId, const std::filesystem::path& trajectory) {
    const results::TrajectoryFile file = results::readTrajectory(trajectory);
    results::requireStates(file);
    if (file.bodies.size() != s.bodies.size())
        throw std::runtime_error(trajectory.string() + ": found " + std::to_string(file.bodies.size()) +
                                 " bodies, expected " + std::to_string(s.bodies.size()));
    const std::vector<Candidate> pairs = candidates(s);
    AuditCase found;
    found.id = caseId;
    const auto worst = worstNormalFrame(s, file);
    for (const std::size_t frame : sampledFrames(file, worst)) {
        auto queries = frameQueries(s, pairs, file, frame);
        addOwnContacts(file, frame, queries, found.stray);
        found.queries.insert(found.queries.end(), queries.begin(), queries.end());
        ++found.frames;
    }
    thinOut(found.queries,
            worst ? std::optional(static_cast<std::int64_t>(*worst) * file.stride) : std::nullopt);
    for (AuditQuery& q : found.queries) {
        const auto answer = exactContact(shapeOf(s, q.bodyA, q.shapeA).geometry, q.poseA,
                                         shapeOf(s, q.bodyB, q.shapeB).geometry, q.poseB, s.dimension);
        q.decided = answer.has_value();
        if (!answer) continue;
        q.signedDistance = answer->signedDistance;
        q.normals = answer->normals;
    }
    return found;
}

results::AuditRow oracleRow(const AuditCase& audited) {
    results::AuditRow row;
    row.auditor = "oracle";
    row.outcome = "completed";
    row.frames = audited.frames;
    row.queries = static_cast<std::int64_t>(audited.queries.size());
    for (const AuditQuery& q : audited.queries) {
        row.undecided += q.decided ? 0 : 1;
        row.overlapping += q.decided && q.signedDistance < -kTouchTolerance ? 1 : 0;
    }
    return row;
}

}  // namespace rigor::validation
