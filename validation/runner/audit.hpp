// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact audit: at sampled frames of every run, the contacts that the run itself acted upon and the
// results of every collision engine at the same poses are compared with the exact oracle. Runs in child
// processes: one finds the queries, the oracle's results and the contacts of the run for all cases of a
// scenario, then one per auditor computes its results.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "validation/results/types.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {

/// Deeper than this is an overlap that must be found, farther apart one that must not [m].
inline constexpr double kTouchTolerance = 1e-6;

/// One query: two shapes of two bodies at one moment, and what the oracle says.
struct AuditQuery {
    double time = 0.0;      ///< [s] of a recorded frame
    std::int64_t step = 0;  ///< steps taken up to that frame
    int bodyA = 0, bodyB = 0, shapeA = 0, shapeB = 0;
    scenario::Pose poseA, poseB;  ///< poses of the shapes in the world
    bool decided = false;         ///< true if the oracle has an exact method for this pair
    double signedDistance = 0.0;
    std::vector<scenario::Vec3> normals;  ///< all minimising directions, A to B
    bool actedUpon = false;  ///< true if the contacts of the step that began at the frame are known
    std::vector<adapter::ContactPoint> own;  ///< the contacts of that step
    std::vector<int> ownPlaces;  ///< place of each of them among all stored contacts of the frame, from 0
};

/// The queries of one case, from its recorded trajectory.
struct AuditCase {
    std::string id;
    std::int64_t frames = 0;
    std::vector<AuditQuery> queries;
    std::vector<adapter::ContactPoint> stray;  ///< overlaps that the run claimed of shapes far apart
};
AuditCase findQueries(const scenario::Scenario& scenario, const std::string& caseId,
                      const std::filesystem::path& trajectory);

/// Result of one collision engine for one query.
struct AuditAnswer {
    bool answered = false;  ///< false: it does not have such shapes
    bool overlap = false;
    bool hasContact = false;  ///< the rest is of its deepest contact
    bool minimising = false;  ///< its normal is one of the exact ones
    double depth = 0.0;
    scenario::Vec3 normal;
};
struct AuditAnswers {
    results::AuditRow row;             ///< held against the oracle
    std::vector<AuditAnswer> answers;  ///< results by query
};
AuditAnswers queryAuditor(const scenario::Scenario& scenario, const AuditCase& audited,
                          const adapter::CollisionEngine& engine, const std::string& auditor);
/// Two engines held against each other, whether or not the oracle knows: a row named "a|b" in which `missed`
/// counts what b alone calls an overlap, `spurious` what a alone does, and the errors are between the two.
/// Normals that are both among the exact ones do not differ.
results::AuditRow pairRow(const std::string& a, const std::vector<AuditAnswer>& ofA, const std::string& b,
                          const std::vector<AuditAnswer>& ofB);
/// Name of the row of what the run itself acted upon.
inline constexpr const char* kInRun = "in_run";
/// The contacts that the run acted upon, held against the oracle at the poses where its step began. A contact
/// that the engine let act on an overlap counts as found whatever depth it gave it; one between shapes that
/// are apart is spurious when its depth claims an overlap. There are no queries if the file does not store
/// the poses.
results::AuditRow inRunRow(const scenario::Scenario& scenario, const AuditCase& audited);
/// Time [s] and worst angle [rad] between the normals of deepest contacts that the run acted upon and the
/// nearest exact ones, for each sampled frame with an overlap that it found; in time order.
std::vector<std::pair<double, double>> normalErrors(const AuditCase& audited);
/// The oracle's own row: the number of queries, and of those that it could decide.
results::AuditRow oracleRow(const AuditCase& audited);

/// True if any two bodies may ever touch.
bool hasAuditablePairs(const scenario::Scenario& scenario);

/// The parent's side: queues the children of the audits in a pool and returns the rows of each case.
class AuditQueue {
  public:
    using Deliver = std::function<void(const std::string& caseId, std::vector<results::AuditRow>)>;
    /// Called with the reason when a child was killed from outside: its cases stay without an audit.
    using Disturbed = std::function<void(const std::string& reason)>;
    struct Files {
        std::filesystem::path binary, run, scratch;
    };
    AuditQueue(ProcessPool& pool, Files files, std::vector<std::string> auditors, Deliver deliver,
               Disturbed disturbed);
    ~AuditQueue();

    /// Cases of one scenario: id to trajectory file (relative to the run).
    void add(const std::string& scenario, const std::string& scenarioText,
             const std::map<std::string, std::string>& cases);

  private:
    struct Batch;
    /// The queries of a batch are found, or its child failed.
    void prepared(const std::shared_ptr<Batch>& batch, const ProcessResult& result);
    void startQueries(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                      const std::string& onlyCase);
    void answered(const std::shared_ptr<Batch>& batch, const std::string& auditor,
                  const std::string& onlyCase, const ProcessResult& result,
                  const std::filesystem::path& answer);
    void finishOne(const std::shared_ptr<Batch>& batch);

    ProcessPool& pool_;
    Files files_;
    std::vector<std::string> auditors_;
    Deliver deliver_;
    Disturbed disturbed_;
    int next_ = 0;
};

/// The child's side: `__audit <request.json>`.
int auditChild(const std::filesystem::path& request);

}  // namespace rigor::validation
