// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One case in this process: load, check, build, compare what was built, step, measure.
#pragma once

#include <memory>

#include "validation/runner/evaluate.hpp"
#include "validation/runner/runner.hpp"

namespace rigor::validation {

/// A case with all that is needed to write its trajectory file.
struct WholeCase {
    LiveCase live;
    std::unique_ptr<Reference> reference;
    adapter::Scheme scheme = adapter::Scheme::Unknown;
};

/// Throws Unsupported, BadInput.
WholeCase runWholeCase(const scenario::Scenario& scenario, const adapter::EngineSpec& spec, double dt,
                       const LiveOptions& options);

}  // namespace rigor::validation
