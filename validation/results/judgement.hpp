// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conditions that make a run red, for exit codes and every report alike. The nearness of a case to the
// physics is not one of them: it is its grade.
#pragma once

#include "validation/results/types.hpp"

namespace rigor::results {

/// The engine of the authors of the comparison. It is held to its record without excuses, and others are
/// shown beside it.
inline constexpr const char* kInHouseEngine = "rigor";

/// The worst grade that the numbers on record have; None where none of them has a scale.
Grade recordedGrade(const CaseRow& row);

/// Crashed, timed out, gave no finite numbers, was not as requested, missed a bound that its scenario sets;
/// the in-house engine: worse than on record, or off by a known deviation; another engine: it does not end as
/// on record any more, or its grade fell.
bool isRed(const CaseRow& row);

}  // namespace rigor::results
