// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/grades.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace rigor::results {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Grades, EachLimitBelongsToItsGradeAndWhatIsAboveToTheNext) {
    for (const Grade grade : kGrades) {
        EXPECT_EQ(gradeOf(gradeLimit(grade)), grade);
        if (grade == Grade::E) continue;
        const auto next = static_cast<Grade>(static_cast<int>(grade) + 1);
        EXPECT_EQ(gradeOf(std::nextafter(gradeLimit(grade), 1.0)), next);
    }
    EXPECT_EQ(gradeOf(0.0), Grade::A);
    EXPECT_EQ(gradeOf(kInfinite), Grade::E);
    EXPECT_EQ(gradeOf(kNaN), Grade::E);
}

TEST(Grades, NamesComeBack) {
    for (const Grade grade : kGrades) EXPECT_EQ(parseGrade(gradeName(grade)), grade);
    EXPECT_EQ(parseGrade(""), Grade::None);
    EXPECT_THROW(parseGrade("F"), std::runtime_error);
}

TEST(Grades, TwiceTheIdealErrorIsWhereTheEnginesOwnPartIsTheLarger) {
    EXPECT_EQ(againstScheme(0.02, 0.01), AgainstScheme::Same);
    EXPECT_EQ(againstScheme(0.0201, 0.01), AgainstScheme::Farther);
    EXPECT_EQ(againstScheme(0.005, 0.01), AgainstScheme::Same);
    EXPECT_EQ(againstScheme(0.0049, 0.01), AgainstScheme::Nearer);
    EXPECT_EQ(againstScheme(kInfinite, 0.01), AgainstScheme::Farther);
    EXPECT_EQ(againstScheme(kNaN, 0.01), AgainstScheme::Farther);
}

TEST(Grades, RoundingIsNotHeldAgainstAnyone) {
    EXPECT_EQ(againstScheme(9e-7, 0.0), AgainstScheme::Same) << "single precision beside an exact scheme";
    EXPECT_EQ(againstScheme(2.1e-6, 0.0), AgainstScheme::Farther);
    EXPECT_EQ(againstScheme(0.0, 9e-7), AgainstScheme::Same);
    EXPECT_EQ(againstScheme({}, 0.1), AgainstScheme::Unknown);
    EXPECT_EQ(againstScheme(0.1, {}), AgainstScheme::Unknown);
}

}  // namespace
}  // namespace rigor::results
