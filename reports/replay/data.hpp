// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data of the replay beside a report: the thinned frames of all cases of one scenario at one time step, as
// one ArrayBundle (FORMATS.md, "Replay files"). web/src/replay/replay_file.ts reads it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/model/view_model.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::report {

/// Bytes that a case may take once it is compressed, on average over a run.
inline constexpr double kReplayBytesPerCase = 24e3;
/// Bytes of all cases of a run: those of a large run get less each.
inline constexpr double kReplayBytesOfRun = 240e6;
/// Most bytes of one case, if others left theirs.
inline constexpr double kReplayBytesAtMost = 240e3;
/// More frames than this are not stored, however small.
inline constexpr std::size_t kMostReplayFrames = 300;

/// Trajectory of a case with its contacts; empty when there is none or it can not be read.
using FullTrajectoryLoader =
    std::function<std::optional<results::TrajectoryFile>(const results::CaseRow& row)>;

/// Rest of the run's budget: a case that needs less than its fraction leaves the rest to those after it.
class ReplayBudget {
  public:
    /// `cases`: number of cases of the run that have a trajectory.
    explicit ReplayBudget(std::size_t cases = 0);
    /// Allowance of the next case [bytes].
    double allowance() const;
    void spend(double bytes) { saved_ += perCase_ - bytes; }
    /// Spends bytes that belong to no case: a reference.
    void spendBeside(double bytes) { saved_ -= bytes; }

  private:
    double perCase_, saved_ = 0.0;
};

ReplayBudget replayBudget(const ViewModel& view);

/// Time steps that cases of a scenario were run at [s], coarsest first: the order of its replay files.
std::vector<double> replaySteps(const ViewModel& view, std::size_t scenario);

/// Bundle of the scenario at replaySteps()[step]; empty when no case of it has a trajectory. Every case has
/// its first and last frame and the frames of its events, whatever they cost.
std::string replayBundle(const ViewModel& view, std::size_t scenario, std::size_t step,
                         const FullTrajectoryLoader& load, ReplayBudget& budget);

/// Name of the data file of a scenario at replaySteps()[step]: "replay-<scenario>-<step>".
std::string replayName(std::size_t scenario, std::size_t step);

/// Bundles of a scenario at all its time steps, one after the other, with the names of their data files.
void replayFiles(const ViewModel& view, std::size_t scenario, const FullTrajectoryLoader& load,
                 ReplayBudget& budget,
                 const std::function<void(const std::string& name, const std::string& bundle)>& write);

}  // namespace rigor::report
