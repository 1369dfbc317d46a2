// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Derived runs of a study and the report.
#pragma once

#include "validation/results/types.hpp"

namespace rigor::report {

/// The run without the derived scenarios of a study (tag "derived": a transformed or perturbed scene) and
/// their cases. Pages, plots and the summary show this; the numbers of derived runs stay in results.csv and
/// in the columns of the study.
results::Run withoutDerivedRuns(results::Run run);

}  // namespace rigor::report
