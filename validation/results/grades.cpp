// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/grades.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rigor::results {
namespace {

struct Row {
    Grade grade;
    const char *name, *meaning;
    double limit;
};
constexpr std::array<Row, 6> kRows{
    {{Grade::None, "", "no exact solution", 0.0},
     {Grade::A, "A", "relative error up to 1e-6", 1e-6},
     {Grade::B, "B", "relative error up to 1e-4", 1e-4},
     {Grade::C, "C", "relative error up to 1e-2", 1e-2},
     {Grade::D, "D", "relative error up to 1e-1", 1e-1},
     {Grade::E, "E", "beyond 1e-1, or another outcome", std::numeric_limits<double>::infinity()}}};

const Row& rowOf(Grade grade) {
    return kRows.at(static_cast<std::size_t>(grade));
}

}  // namespace

const char* gradeName(Grade grade) {
    return rowOf(grade).name;
}

const char* gradeMeaning(Grade grade) {
    return rowOf(grade).meaning;
}

double gradeLimit(Grade grade) {
    return rowOf(grade).limit;
}

Grade parseGrade(const std::string& name) {
    for (const Row& row : kRows)
        if (name == row.name) return row.grade;
    throw std::runtime_error("results: found grade '" + name + "', expected A, B, C, D, E or nothing");
}

Grade gradeOf(double relative) {
    for (const Grade grade : kGrades)
        if (std::abs(relative) <= gradeLimit(grade)) return grade;
    return Grade::E;
}

const char* againstSchemeName(AgainstScheme a) {
    static constexpr std::array<const char*, 4> names{"unknown", "nearer", "same", "farther"};
    return names.at(static_cast<std::size_t>(a));
}

AgainstScheme againstScheme(std::optional<double> relative, std::optional<double> ideal) {
    if (!relative || !ideal || std::isnan(*ideal)) return AgainstScheme::Unknown;
    if (std::isnan(*relative)) return AgainstScheme::Farther;
    const double rounding = gradeLimit(Grade::A);
    const double own = std::max(*relative, rounding), best = std::max(*ideal, rounding);
    if (own > 2.0 * best) return AgainstScheme::Farther;
    return own < 0.5 * best ? AgainstScheme::Nearer : AgainstScheme::Same;
}

}  // namespace rigor::results
