// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Grade of a run's nearness to the physics: one scale for every engine. A relative error is an error over the
// scenario's own scale of that error (validation/accuracy); its grade is the decade pair it falls into. No
// number here comes from a result.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace rigor::results {

/// A: relative error up to 1e-6, what single precision can hold. B: up to 1e-4, invisible in any picture. C:
/// up to 1e-2, seen beside the exact solution. D: up to 1e-1, seen without it. E: beyond, or another outcome
/// (it falls where it stands, another law). None: there is no error to be graded by.
enum class Grade { None, A, B, C, D, E };
inline constexpr std::array<Grade, 5> kGrades{Grade::A, Grade::B, Grade::C, Grade::D, Grade::E};

const char* gradeName(Grade grade);     ///< "A" .. "E"; "" for None
const char* gradeMeaning(Grade grade);  ///< "relative error up to 1e-6", ...; "no exact solution" for None
/// Throws std::runtime_error for anything that gradeName() does not return.
Grade parseGrade(const std::string& name);

/// Largest relative error of a grade; infinite for E. 0 for None.
double gradeLimit(Grade grade);
/// The grade of a relative error, >= 0; E for infinity and for what is not a number.
Grade gradeOf(double relative);

/// An error beside the one that an ideal run of the engine's own time-stepping scheme has at this step.
enum class AgainstScheme { Unknown, Nearer, Same, Farther };
const char* againstSchemeName(AgainstScheme a);  ///< "unknown", "nearer", "same", "farther"

/// The error of a run is at most that of the ideal run plus the distance between the two (triangle
/// inequality). Above twice the ideal's, more of the error is the engine's own than its scheme's: Farther.
/// Below half of it the run is not that of the scheme either, and lies nearer: Nearer. Both errors count as
/// no less than the limit of grade A, below which they are rounding.
AgainstScheme againstScheme(std::optional<double> relative, std::optional<double> ideal);

}  // namespace rigor::results
