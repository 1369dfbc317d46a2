// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The references of many scenarios, checked at the same time once all are loaded.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"
#include "validation/runner/reference_guard.hpp"

namespace rigor::cli {

class ReferenceChecks {
  public:
    /// Loads a scenario as loadWithReference (command.hpp) does, its reference still unknown.
    scenario::LoadedScenario load(const std::string& nameOrFile, const std::vector<std::string>& overrides);
    /// Results of the references, by name of the scenario (the one that was loaded last), `jobs` of them computed
    /// at a time, of `only` these scenarios if that is given. Reports and throws as loadWithReference does.
    std::map<std::string, validation::ReferenceCheck> check(
        const validation::ReferenceLimits& limits, int jobs, bool mustHold = false,
        const std::set<std::string>* only = nullptr) const;

  private:
    struct Loaded {
        std::filesystem::path file;
        int line = 0;  ///< line of the reference in the file
    };
    std::vector<Loaded> loaded_;
    std::vector<validation::ReferenceQuestion> questions_;
    std::map<std::string, std::size_t> last_;  ///< place of the last scenario with a name
};

}  // namespace rigor::cli
