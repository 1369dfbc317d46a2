// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References are computed in children with limits: one that never ends, eats the memory or crashes costs its
// own solution, is reported by a name of its own, and counts against no engine.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

class Reference;

/// Function that makes a reference; `makeReference` except in tests.
using ReferenceMaker = std::function<std::unique_ptr<Reference>(const scenario::Scenario&)>;

enum class ReferenceOutcome {
    None,         ///< the scenario names none
    Holds,        ///< it was made, and its last state and its quantities were evaluated
    Assumption,   ///< the values break one of its assumptions
    Invalid,      ///< unknown, or its parameters are wrong
    Timeout,      ///< it did not finish within the limit
    OutOfMemory,  ///< it needed more memory than the limit
    Crashed       ///< it ended its process
};
/// "none", "holds", "reference_assumption", "reference_invalid", "reference_timeout",
/// "reference_out_of_memory", "reference_crashed".
const char* referenceOutcomeName(ReferenceOutcome outcome);
ReferenceOutcome parseReferenceOutcome(const std::string& name);  ///< throws std::runtime_error

struct ReferenceCheck {
    ReferenceOutcome outcome = ReferenceOutcome::None;
    std::string problem;  ///< reason why there is none: a sentence, "" for None and Holds

    /// It broke down: neither the scenario's values nor an engine can be named as the cause.
    bool brokeDown() const;
    /// "reference_timeout: the reference did not finish within 20 s".
    std::string text() const;
};

struct ReferenceLimits {
    double seconds = 20.0;         ///< wall time of one reference
    std::size_t memoryMiB = 2048;  ///< address space of its process; not set in sanitizer builds
};

/// A scenario as the child loads it: its text, overrides applied, and its name for messages.
struct ReferenceQuestion {
    std::string text, name;
    bool hasReference = false;  ///< if there is none no child is started
};

/// One result per query, in order, `jobs` children at a time. `binary` is the program itself, run again as
/// `rigor __reference ...`.
std::vector<ReferenceCheck> checkReferences(const std::vector<ReferenceQuestion>& queries,
                                            const ReferenceLimits& limits,
                                            const std::filesystem::path& binary, int jobs);
ReferenceCheck checkReference(const ReferenceQuestion& query, const ReferenceLimits& limits,
                              const std::filesystem::path& binary);

/// Reason why a process that computed a reference gave no solution, as of waitpid.
ReferenceCheck referenceFailure(bool timedOut, int status, const ReferenceLimits& limits);

/// The child's side: `__reference <request.json>`.
int referenceChild(const std::filesystem::path& request, const ReferenceMaker& make);

}  // namespace rigor::validation
