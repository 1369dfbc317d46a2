// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs cases (scenario x engine spec x time step), each in its own child process, and stores what became of
// them.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/interface/presets.hpp"
#include "adapters/interface/registry.hpp"
#include "scenarios/model/scenario.hpp"
#include "validation/results/types.hpp"
#include "validation/runner/reference_guard.hpp"
#include "validation/runner/shard.hpp"
#include "validation/symmetry/symmetry.hpp"
#include "validation/trajectory.hpp"

namespace rigor::validation {

/// One case to run.
struct CasePlan {
    std::string id;
    std::string scenarioText;  ///< JSON, overrides applied: what the child loads
    scenario::Scenario scenario;
    adapter::EngineSpec spec;  ///< spec with its preset
    double dt = 0.0;
};

struct RunOptions {
    std::filesystem::path directory;
    std::filesystem::path binary;  ///< the `rigor` program itself, run again as `rigor __case ...`
    int jobs = 1;
    bool resume = false;
    bool audit = true;
    std::size_t memoryLimitMiB = 4096;  ///< memory limit per child
    std::filesystem::path records;      ///< folder of what engine versions gave; "": nothing is on record
    std::string suite, command;
    std::vector<int> pieces;     ///< lengths in steps of short piecesthat are measured as well (pieces.hpp)
    int orders = 1;              ///< orders of insertion, the one as written included (orders.hpp)
    std::optional<Shard> shard;  ///< the plan is this part of a larger one
    ReferenceLimits referenceLimits;
    /// References that have been checked already, by scenario; the others are when the run begins.
    std::map<std::string, ReferenceCheck> references;
};

/// Data of the progress line.
struct Progress {
    std::int64_t done = 0, total = 0, failed = 0, crashed = 0, skipped = 0;
    double etaSeconds = -1.0;
    std::string current;
    const results::CaseRow* finished = nullptr;  ///< the case that has just ended, or null
};

/// Expands specs without a preset into both, and scenarios into their time steps (or `timeSteps` when not
/// empty). Only engines that could take part in a scenario's dimension are planned; others appear as
/// `unsupported` rows.
std::vector<CasePlan> planCases(
    const std::vector<std::pair<scenario::Scenario, std::string>>& scenariosAndTexts,
    const std::vector<adapter::EngineSpec>& specs, const std::vector<double>& timeSteps);

/// Runs all cases; returns when all are stored or `interrupted` became true (the run can be resumed then, and an empty
/// one is returned).
results::Run runCases(const std::vector<CasePlan>& plan, const RunOptions& options,
                      const std::function<void(const Progress&)>& onProgress,
                      const std::atomic<bool>& interrupted);

/// Functions of a child by name, each for a request file; they return its exit code.
using ChildEntries = std::map<std::string, std::function<int(const std::filesystem::path&)>>;

/// Entry point of the child: `rigor __case <request.json>`; writes its result to the file named in the
/// request. `more`: entries beside the runner's own, by their first argument ("__collide"). `make`: how
/// references are made; empty, but in tests: makeReference.
int childMain(const std::vector<std::string>& arguments, const ChildEntries& more = {},
              const ReferenceMaker& make = {});

/// Describes an engine by loading its module in a child process (`rigor __describe ENGINE`), as JSON with
/// info, capabilities and options; `problem` in EngineDescription when that failed.
struct EngineDescription {
    adapter::EngineInfo info;
    adapter::Capabilities capabilities;
    std::vector<adapter::Option> options;
    std::vector<adapter::Preset> presets;  ///< presets in addition to the usual ones
    std::vector<std::string> precisions;
    std::string problem;
};
EngineDescription describeEngine(const std::string& engine, const std::filesystem::path& binary);

/// Runs one case inside this process, without a store: for `rigor run` and tests. Throws Unsupported and
/// BadInput.
struct LiveCase {
    Trajectory trajectory;
    results::CaseRow row;
};
struct LiveOptions {
    int stride = 0;  ///< 0: chosen from size and duration
    std::function<void(double time, std::span<const BodyState>, const std::vector<ContactPoint>&)>
        onStep;  ///< called after each step; may be empty
    /// Called before each onStep with the world, for data that only the engine has; may be empty.
    std::function<void(const adapter::World&)> onWorld;
    /// Called when the engine is done and the reference is about to be made and evaluated; may be empty.
    std::function<void()> onSimulated;
    /// Reason, found before, why the reference is not made. Empty: it is made.
    std::optional<ReferenceCheck> withoutReference;
    ReferenceMaker makeReference;  ///< empty: validation::makeReference
    /// Scenario that the engine gets in place of the original. Its run is transformed back and measured as
    /// one of the original; `onStep` gets it untransformed.
    std::optional<Transformed> given;
};
LiveCase runInProcess(const scenario::Scenario& scenario, const adapter::EngineSpec& spec, double dt,
                      const LiveOptions& options);

/// No case is red (validation/results/judgement.hpp), and no reference broke down.
bool runIsGreen(const results::Run& run);
/// True if the run is not green for no other reason than references that could not be computed.
bool lacksReferencesAlone(const results::Run& run);
/// True if the run has cases, all of them unsupported: it shows nothing, good or bad.
bool judgesNothing(const results::Run& run);

}  // namespace rigor::validation
