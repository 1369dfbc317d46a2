// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Columns that take several runs: symmetries, divergence, ensembles.
#pragma once

#include "validation/studies/study.hpp"

namespace rigor::validation {

/// Fills them in the rows of the result, from the trajectories and numbers of the run's folder.
void fillDerivedColumns(StudyResult& result, const StudyPlan& plan, const results::Run& run);

}  // namespace rigor::validation
