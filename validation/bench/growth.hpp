// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Growth of measured times, counts and memory with the size of a scene or part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/results/types.hpp"

namespace rigor::validation {

/// Between two sizes of one work, spec and number of threads that follow each other, both with valid times:
/// exponents p of value ~ size^p. A value that is not measured, or zero, has none.
struct Growth {
    std::string part, name, engine, sizeUnit;
    int threads = 1;
    double from = 0.0, to = 0.0;  ///< sizes, from < to
    double time = 0.0;            ///< exponent of the medians, by the clock of the larger case
    std::optional<double> longest, contacts, memory;  ///< longest step, contacts, what the world took
};

/// In the order of the cases; those of one work and spec by size.
std::vector<Growth> growthsOf(const std::vector<results::BenchCase>& cases);

/// The largest memory that a repetition's world took [KiB]; 0: not measured.
std::int64_t worldMemory(const results::BenchCase& c);

}  // namespace rigor::validation
