// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases that a row is run in beside its own: symmetric ones, and the members of an ensemble. They are cases
// like others: a child process each, stored, resumable.
#pragma once

#include <map>
#include <set>
#include <string>

#include "validation/studies/study.hpp"

namespace rigor::validation {

class DerivedRunPlanner {
  public:
    DerivedRunPlanner(StudyPlan& plan, const OptionLookup& options) : plan_(plan), options_(options) {}

    /// Adds a case unless it is planned already.
    void add(const CasePlan& one);
    /// Adds the derived runs that the part requests beside `own`, the row's case.
    void addTo(StudyRow& row, const scenario::StudyPart& part, const CasePlan& own);

  private:
    struct Made {
        std::string problem;
        scenario::LoadedScenario loaded;
        double timeFactor = 1.0;
        std::function<Trajectory(const Trajectory&)> back;
    };
    /// Scenarios are the same for all variants: each is made once.
    const Made& symmetric(const CasePlan& own, const std::string& symmetry);
    const Made& member(const CasePlan& own, const scenario::StudyPart& part, int number);
    void addSymmetric(StudyRow& row, const CasePlan& own, const std::string& symmetry);
    bool hasThreads(const std::string& engine);
    std::string addCase(const Made& made, const adapter::EngineSpec& spec, double dt);

    StudyPlan& plan_;
    const OptionLookup& options_;
    std::set<std::string> planned_;
    std::map<std::string, Made> made_;
    std::map<std::string, bool> threads_;
};

/// A name of at most 64 characters that no other base gives with this tail.
std::string derivedName(const std::string& base, const std::string& tail);

}  // namespace rigor::validation
