// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Collision queries passed to every collision engine and to the exact oracle, and the judgement of the
// results.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/interface/registry.hpp"
#include "scenarios/loader/collision_cases.hpp"

namespace rigor::validation {

/// Tolerances of a correct result.
struct CollideTolerance {
    double touch = 1e-9;  ///< shapes nearer to touching than this may be called either way [m]
    double relative =
        1e-6;             ///< tolerance of depth and distance, relative to their size; `touch` is allowed in
                          ///< any case
    double angle = 1e-6;  ///< angle of the normal from the nearest minimiser [rad]
};

/// Eight units in the last place of single precision: rounding of a few operations, as lengths over the size of a scene,
/// and as angles.
inline constexpr double kSingleRounding = 8.0 / (1 << 23);

/// Judgement of one result. Order: the first that applies.
enum class CollideVerdict {
    Ok,
    WrongOverlap,  ///< says apart where they overlap, or the reverse
    WrongDepth,    ///< depth or distance off by more than the tolerance
    WrongNormal,   ///< the normal is not among the minimising directions
    NoNormal,      ///< an overlap without any contact
    Undecided,     ///< the truth of this pair is unknown
    Unsupported,   ///< the engine does not have the pair of shapes
    Error,         ///< an exception
    Crashed,
    Timeout
};
const char* collideVerdictName(CollideVerdict verdict);  ///< "ok", "wrong overlap", ...
/// The result of the engine is wrong, or missing where there should be one.
bool isFailure(CollideVerdict verdict);

/// Exact results of a case, known before any engine is queried.
struct CollideTruth {
    std::string source;  ///< "oracle", "file" (the oracle lacks the shapes), "none"
    double signedDistance = 0.0;
    std::vector<scenario::Vec3> normals;  ///< equally good, A to B; may be empty
    bool continuum = false;               ///< infinitely many; `normals` holds samples
    std::optional<scenario::Vec3> witnessA, witnessB;
    double accuracy = 0.0, normalTolerance = 0.0;  ///< accuracy of the file's own value
    std::string conflict;  ///< message if file and oracle disagree beyond the file's accuracy; "" if they
                           ///< agree
};

/// One engine's result for one case.
struct CollideAnswer {
    CollideVerdict verdict = CollideVerdict::Undecided;
    bool answered = false;
    bool overlap = false;
    std::optional<double> signedDistance;  ///< [m]; minus the depth where they overlap
    std::optional<scenario::Vec3> normal;  ///< A to B: of the deepest contact, or between the witnesses
    std::optional<scenario::Vec3> witnessA, witnessB;  ///< points of the deepest contact or the closest
                                                       ///< points
    int contacts = 0;
    double seconds = 0.0;  ///< wall time of the call
    std::string message;   ///< reason why there is no result

    std::optional<double> distanceError;  ///< |signedDistance - truth| [m]
    /// Angle to the nearest minimiser [rad]. Of a continuum `CollideTruth` has samples alone: no value for a normal that
    /// its excess shows to be right, an upper bound for another one.
    std::optional<double> normalAngle;
    /// Excess of the overlap along the result's normal over the least overlap (or lack of distance) [m]: 0
    /// for every minimiser, even where they are a continuum.
    std::optional<double> normalExcess;
    /// Error of the witness points [m]: the largest of their distances from the surfaces and of |pointB -
    /// pointA - signed distance * normal|.
    std::optional<double> pointError;
};

struct CollideCase {
    scenario::CollisionCase query;
    std::string file;
    CollideTruth truth;
    std::vector<CollideAnswer> answers;  ///< results by spec
};

struct CollideSummary {
    std::string spec;
    int queried = 0, answered = 0, unsupported = 0, undecided = 0,
        failed = 0;                                         ///< failed: error, crash, timeout
    int missed = 0, spurious = 0;                           ///< wrong overlap verdicts, by kind
    int wrongDepth = 0, wrongNormal = 0;                    ///< cases; a case counts at its first error
    std::optional<double> depthErrorMax, depthErrorMedian;  ///< errors over the overlapping pairs [m]
    std::optional<double> depthRelativeMax;                 ///< error / max(depth, touch)
    std::optional<double> distanceErrorMax;                 ///< error over the separated pairs [m]
    std::optional<double> normalAngleMax, normalExcessMax;
    std::optional<double> pointErrorMax, pointErrorMedian;  ///< errors over the overlapping pairs [m]
    double microsecondsMedian = 0.0;
};

/// The cases of one kind (first tag) and one spec.
struct CollideKind {
    std::string kind;
    int queried = 0;
    std::vector<int> answered, wrong;  ///< numbers by spec; wrong: every failure, crashes included
};

struct CollideRun {
    std::vector<adapter::EngineSpec> specs;
    std::vector<bool> isSingle;  ///< true for a spec of single precision
    CollideTolerance tolerance;
    std::vector<CollideCase> cases;
    std::vector<CollideSummary> summaries;  ///< summaries by spec
    bool complete = true;                   ///< false: interrupted
};

struct CollideOptions {
    std::filesystem::path binary;  ///< this program, run again as `rigor __collide ...`
    int jobs = 1;
    CollideTolerance tolerance;
    double secondsPerQuery = 5.0;  ///< a query that takes longer is killed
};

/// Every installed engine with collision queries, one spec for each of its algorithms.
std::vector<adapter::EngineSpec> allCollisionSpecs(const std::filesystem::path& binary, int jobs);

/// Throws BadInput for an engine that is not installed, has no collision queries, or not the keys and values
/// of the spec.
void checkCollisionSpec(const adapter::EngineSpec& spec, const std::filesystem::path& binary);

/// Queries all specs and the oracle. `onProgress` gets (finished, total) from time to time.
CollideRun runCollide(const std::vector<scenario::CollisionFile>& files,
                      const std::vector<adapter::EngineSpec>& specs, const CollideOptions& options,
                      const std::function<void(std::int64_t, std::int64_t)>& onProgress,
                      const std::atomic<bool>& interrupted);

/// The truth of one case: the oracle's where it has the shapes, else the file's.
CollideTruth truthOf(const scenario::CollisionCase& c, const CollideTolerance& tolerance);
/// The tolerance for an engine of single precision: no less than the rounding of the shapes' own coordinates.
CollideTolerance singleTolerance(const scenario::CollisionCase& c, const CollideTolerance& tolerance);
/// Sets errors and verdict of a result from the truth.
void judgeAnswer(const scenario::CollisionCase& c, const CollideTruth& truth,
                 const CollideTolerance& tolerance, CollideAnswer& answer);
/// Counts the results of one spec.
CollideSummary summarise(const CollideRun& run, std::size_t spec);

/// Counts by first tag, in the order of their first occurrence; cases without a tag do not count.
std::vector<CollideKind> countKinds(const CollideRun& run);

/// 0 failures of the in-house engine in double precision; see the README for what counts.
bool collideIsGreen(const CollideRun& run);

}  // namespace rigor::validation
