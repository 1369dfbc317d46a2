// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The record: what each version of each engine gave, as text files in the repository, one per engine and
// version. Runs are held against it in either direction.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

struct RecordedMetric {
    std::string name, unit;
    /// One for a run that came back the same whenever it was recorded, else each number that it gave.
    std::vector<double> values;
};
struct RecordedCase {
    std::string scenarioHash;  ///< hash of the scenario's physics (physicsOf() in compare.hpp)
    results::Outcome outcome = results::Outcome::Completed;
    results::Verdict verdict = results::Verdict::Pass;
    std::vector<RecordedMetric> metrics;  ///< metrics of the whole scene that the scenario names
};

class Record {
  public:
    /// The files of these engines' versions in `folder`. Throws std::runtime_error for a damaged file.
    Record(const std::filesystem::path& folder, const std::vector<results::EngineRow>& engines);
    Record() = default;

    /// Null where nothing is on record, whatever the scenario's physics were.
    const RecordedCase* find(const std::string& scenario, const std::string& spec, double dt) const;
    /// Engine versions without a file: "bullet 3.25".
    const std::vector<std::string>& missing() const { return missing_; }

    using Key = std::tuple<std::string, std::string, double>;  ///< scenario, spec, dt
    const std::map<Key, RecordedCase>& cases() const { return cases_; }

  private:
    std::map<Key, RecordedCase> cases_;
    std::vector<std::string> missing_;
};

/// The hash that a scenario has in a record.
std::string recordedHash(const std::string& scenarioText);

/// Puts the cases of a run on record, one file `<engine>-<version>.csv` for every engine that has cases in
/// it: whole-scene values of the metrics that each scenario names, outcome, verdict, and a hash of the
/// scenario's physics. Cases that are on record already are replaced, or with `add` get another number beside
/// those they have, where it differs and the scenario is the same; other cases stay. Returns the files.
std::vector<std::filesystem::path> writeRecorded(const results::Run& run, const std::filesystem::path& folder,
                                                 bool add = false);

/// The records of the engine versions that took part in `run`, as a run to compare it with; of several
/// numbers the first. Engines without a record are in `missing`. Throws std::runtime_error for a damaged
/// file.
results::Run readRecorded(const std::filesystem::path& folder, const results::Run& run,
                          std::vector<std::string>& missing);

}  // namespace rigor::validation
