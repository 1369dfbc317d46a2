// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The metrics of one engine over many scenarios at many points: children compute some hundred cases each, so
// that starting a process costs little; one that ends early costs the case that ended it.
#pragma once

#include <map>
#include <memory>

#include "validation/fit/fit.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/line_file.hpp"
#include "validation/runner/process_pool.hpp"

namespace rigor::validation {

/// Values of a scenario at a point: one per metric, or the reason why there is none.
struct CaseValues {
    std::vector<double> values;  ///< infinite where the run broke
    std::string problem;         ///< "" when it did not
};
/// Values of all scenarios of a set, in their order.
using PointValues = std::vector<CaseValues>;

/// Every evaluation of a fit, on the disk the moment it is whole.
class EvaluationLog {
  public:
    EvaluationLog(const std::filesystem::path& file, bool resume);
    const PointValues* find(const std::string& spec, const std::string& part, const FitPoint& point) const;
    const PointValues& add(const std::string& spec, const std::string& part, const FitPoint& point,
                           PointValues values);

  private:
    static std::string keyOf(const std::string& spec, const std::string& part, const FitPoint& point);
    std::map<std::string, PointValues> known_;
    std::unique_ptr<LineWriter> out_;
};

class Objective {
  public:
    /// `progress` is called with the number of cases that have ended since the last call.
    Objective(const FitTask& task, const FitOptions& options, EvaluationLog& log,
              std::function<void(int)> progress, const std::atomic<bool>& interrupted);

    /// The values at each point; points that are known are not run again. False when interrupted.
    bool evaluate(const adapter::EngineSpec& spec, bool train, const std::vector<FitPoint>& points,
                  std::vector<const PointValues*>& results);

  private:
    const FitTask& task_;
    const FitOptions& options_;
    EvaluationLog& log_;
    std::function<void(int)> progress_;
    const std::atomic<bool>& interrupted_;
    ScratchFolder scratch_;
    int next_ = 0;
};

/// KEY=VALUE for every parameter, with all digits.
std::vector<std::string> overridesAt(const FitTask& task, const FitPoint& point);

}  // namespace rigor::validation
