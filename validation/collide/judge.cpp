// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Truth and judgement of collision results.
//
//   overlap   wrong where sd < -touch is called apart or sd > touch is called overlapping
//   depth     |found - sd| <= max(touch, relative |sd|) (+ the accuracy of a value that comes from the file)
//   normal    angle to the nearest minimiser <= angle, or excess sd - sep(n) <= the tolerance of the depth
//   An engine of single precision: touch and angle are at least its rounding, over the size of the scene.
//
// sep(n) is the gap between the supporting planes along n [CameronCulley1986]: at most sd, and equal to it
// for the minimising directions only. It judges ties and continua of directions without listing them.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "validation/collide/collide.hpp"
#include "validation/metrics/mechanics.hpp"
#include "validation/metrics/metric_parts.hpp"
#include "validation/oracle/oracle.hpp"
#include "validation/runner/judge.hpp"
#include "validation/statistics/quantile.hpp"

namespace rigor::validation {
namespace {

using scenario::CollisionCase;
using scenario::Vec3;

double allowedLength(const CollideTruth& truth, const CollideTolerance& tolerance) {
    return std::max(tolerance.touch, tolerance.relative * std::abs(truth.signedDistance)) + truth.accuracy;
}

/// Largest coordinate or size: rounding of the files' own numbers.
double roundingOf(const CollisionCase& c) {
    return 1e-14 * std::max({1.0, norm(c.a.pose.position), norm(c.b.pose.position)});
}

/// Bound on the coordinates of the bounded shapes [m].
double sizeOf(const CollisionCase& c) {
    scenario::Body a, b;
    a.shapes = {c.a};
    b.shapes = {c.b};
    return std::max(reachOf(a), reachOf(b));
}

/// The gap along one direction is a lower bound of the signed distance that can be checked by itself.
std::string conflictWith(double stated, const OracleAnswer& exact) {
    char text[200];
    const Vec3 n = exact.normals.front();
    if (stated < exact.signedDistance)
        std::snprintf(text, sizeof text,
                      "the file says %.10g m; along (%.6g, %.6g, %.6g) the signed distance is %.10g m",
                      stated, n.x, n.y, n.z, exact.signedDistance);
    else
        std::snprintf(text, sizeof text, "the file says %.10g m, the oracle %.10g m", stated,
                      exact.signedDistance);
    return text;
}

bool normalIsRight(const CollideTruth& truth, const CollideTolerance& tolerance,
                   const CollideAnswer& answer) {
    if (answer.normalAngle && *answer.normalAngle <= tolerance.angle + truth.normalTolerance) return true;
    return answer.normalExcess && *answer.normalExcess <= allowedLength(truth, tolerance);
}

CollideVerdict verdictOf(const CollideTruth& truth, const CollideTolerance& tolerance,
                         const CollideAnswer& answer) {
    if (truth.source == "none") return CollideVerdict::Undecided;
    const double sd = truth.signedDistance, touch = tolerance.touch + truth.accuracy;
    if ((sd < -touch && !answer.overlap) || (sd > touch && answer.overlap))
        return CollideVerdict::WrongOverlap;
    if (answer.distanceError && *answer.distanceError > allowedLength(truth, tolerance))
        return CollideVerdict::WrongDepth;
    if (sd >= -touch) return CollideVerdict::Ok;  // a normal is required of overlaps only
    if (!answer.normal) return CollideVerdict::NoNormal;
    const bool judged = answer.normalAngle || answer.normalExcess;
    return !judged || normalIsRight(truth, tolerance, answer) ? CollideVerdict::Ok
                                                              : CollideVerdict::WrongNormal;
}

/// Largest and middle value of what was measured.
struct Spread {
    std::vector<double> values;
    void add(const std::optional<double>& value) {
        if (value) values.push_back(*value);
    }
    std::optional<double> max() const {
        return values.empty() ? std::nullopt : std::optional(*std::max_element(values.begin(), values.end()));
    }
    std::optional<double> median() const {
        return values.empty() ? std::nullopt : std::optional(validation::median(values));
    }
};

}  // namespace

const char* collideVerdictName(CollideVerdict verdict) {
    constexpr const char* kNames[] = {"ok",        "wrong overlap", "wrong depth", "wrong normal",
                                      "no normal", "undecided",     "unsupported", "error",
                                      "crashed",   "timeout"};
    return kNames[static_cast<std::size_t>(verdict)];
}

bool isFailure(CollideVerdict verdict) {
    return verdict != CollideVerdict::Ok && verdict != CollideVerdict::Undecided &&
           verdict != CollideVerdict::Unsupported;
}

CollideTruth truthOf(const CollisionCase& c, const CollideTolerance& tolerance) {
    CollideTruth truth;
    truth.source = "none";
    const auto& expected = c.expected;
    if (const auto exact = exactContact(c.a.geometry, c.a.pose, c.b.geometry, c.b.pose, c.dimension)) {
        truth.source = "oracle";
        truth.signedDistance = exact->signedDistance;
        truth.normals = exact->normals;
        truth.continuum = exact->continuum;
        truth.witnessA = exact->witnessA;
        truth.witnessB = exact->witnessB;
        if (expected.signedDistance) {
            const double off = std::abs(*expected.signedDistance - exact->signedDistance);
            if (off > std::max(tolerance.touch, tolerance.relative * std::abs(exact->signedDistance)) +
                          expected.accuracy + roundingOf(c))
                truth.conflict = conflictWith(*expected.signedDistance, *exact);
        }
    } else if (expected.signedDistance) {
        truth.source = "file";
        truth.signedDistance = *expected.signedDistance;
        truth.normals = expected.normals;
        truth.accuracy = expected.accuracy;
        truth.normalTolerance = expected.normalTolerance;
    }
    return truth;
}

CollideTolerance singleTolerance(const CollisionCase& c, const CollideTolerance& tolerance) {
    CollideTolerance single = tolerance;
    single.touch = std::max(tolerance.touch, kSingleRounding * sizeOf(c));
    single.angle = std::max(tolerance.angle, kSingleRounding);
    return single;
}

namespace {

/// Distance of a point from the surface of a shape.
std::optional<double> offSurface(const scenario::Shape& shape, Vec3 point, int dimension) {
    const auto exact =
        exactContact(shape.geometry, shape.pose, scenario::Sphere{0.0}, {point, {}}, dimension);
    return exact ? std::optional(std::abs(exact->signedDistance)) : std::nullopt;
}

std::optional<double> pointErrorOf(const CollisionCase& c, const CollideTruth& truth,
                                   const CollideAnswer& answer) {
    if (truth.source != "oracle" || !answer.witnessA || !answer.witnessB || !answer.normal)
        return std::nullopt;
    const Vec3 gap = *answer.witnessB - *answer.witnessA;
    double worst = norm(gap - truth.signedDistance * *answer.normal);
    if (!std::isfinite(worst)) return std::nullopt;
    const auto a = offSurface(c.a, *answer.witnessA, c.dimension),
               b = offSurface(c.b, *answer.witnessB, c.dimension);
    if (!a || !b) return std::nullopt;
    return std::max({worst, *a, *b});
}

}  // namespace

void judgeAnswer(const CollisionCase& c, const CollideTruth& truth, const CollideTolerance& tolerance,
                 CollideAnswer& answer) {
    if (!answer.answered) return;  // its verdict says why
    if (truth.source != "none") {
        if (answer.signedDistance)
            answer.distanceError = std::abs(*answer.signedDistance - truth.signedDistance);
        if (answer.normal && !truth.normals.empty())
            answer.normalAngle = nearestAngle(*answer.normal, truth.normals);
    }
    if (truth.source == "oracle" && answer.normal) {
        const auto along =
            separationAlong(c.a.geometry, c.a.pose, c.b.geometry, c.b.pose, c.dimension, *answer.normal);
        if (along) answer.normalExcess = std::max(0.0, truth.signedDistance - *along);
        if (truth.continuum && along && *answer.normalExcess <= allowedLength(truth, tolerance))
            answer.normalAngle.reset();
    }
    answer.pointError = pointErrorOf(c, truth, answer);
    answer.verdict = verdictOf(truth, tolerance, answer);
}

std::vector<CollideKind> countKinds(const CollideRun& run) {
    std::vector<CollideKind> kinds;
    for (const CollideCase& c : run.cases) {
        if (c.query.tags.empty()) continue;
        const std::string& tag = c.query.tags.front();
        auto kind =
            std::find_if(kinds.begin(), kinds.end(), [&](const CollideKind& k) { return k.kind == tag; });
        if (kind == kinds.end()) {
            const std::vector<int> zeros(run.specs.size());
            kind = kinds.insert(kinds.end(), {tag, 0, zeros, zeros});
        }
        ++kind->queried;
        for (std::size_t i = 0; i < run.specs.size(); ++i) {
            kind->answered[i] += c.answers[i].answered ? 1 : 0;
            kind->wrong[i] += isFailure(c.answers[i].verdict) ? 1 : 0;
        }
    }
    return kinds;
}

CollideSummary summarise(const CollideRun& run, std::size_t spec) {
    CollideSummary s;
    s.spec = run.specs[spec].text();
    Spread depth, relative, distance, angle, excess, points, time;
    for (const CollideCase& c : run.cases) {
        const CollideAnswer& answer = c.answers[spec];
        ++s.queried;
        if (answer.verdict == CollideVerdict::Unsupported) ++s.unsupported;
        if (!answer.answered) {
            s.failed += isFailure(answer.verdict) ? 1 : 0;
            continue;
        }
        ++s.answered;
        time.add(answer.seconds);
        if (answer.verdict == CollideVerdict::Undecided) ++s.undecided;
        if (answer.verdict == CollideVerdict::WrongOverlap) ++(answer.overlap ? s.spurious : s.missed);
        if (answer.verdict == CollideVerdict::WrongDepth) ++s.wrongDepth;
        if (answer.verdict == CollideVerdict::WrongNormal || answer.verdict == CollideVerdict::NoNormal)
            ++s.wrongNormal;
        const double sd = c.truth.signedDistance;
        // Errors of a case with a wrong verdict would repeat the verdict and hide those of the other cases.
        if (c.truth.source == "none" || answer.verdict == CollideVerdict::WrongOverlap) continue;
        if (sd < -run.tolerance.touch) {
            depth.add(answer.distanceError);
            if (answer.distanceError) relative.add(*answer.distanceError / -sd);
            angle.add(answer.normalAngle);
            excess.add(answer.normalExcess);
            points.add(answer.pointError);
        } else {
            distance.add(answer.distanceError);
        }
    }
    s.depthErrorMax = depth.max();
    s.depthErrorMedian = depth.median();
    s.depthRelativeMax = relative.max();
    s.distanceErrorMax = distance.max();
    s.normalAngleMax = angle.max();
    s.normalExcessMax = excess.max();
    s.pointErrorMax = points.max();
    s.pointErrorMedian = points.median();
    s.microsecondsMedian = 1e6 * time.median().value_or(0.0);
    return s;
}

/// The tolerances are those of double precision.
static bool judgesRun(const adapter::EngineSpec& spec) {
    const auto precision = spec.options.find("precision");
    return spec.engine == kInHouseEngine && (precision == spec.options.end() || precision->second != "f32");
}

bool collideIsGreen(const CollideRun& run) {
    for (const CollideCase& c : run.cases) {
        if (!c.truth.conflict.empty()) return false;
        for (std::size_t i = 0; i < run.specs.size(); ++i)
            if (judgesRun(run.specs[i]) && isFailure(c.answers[i].verdict)) return false;
    }
    return true;
}

}  // namespace rigor::validation
