// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Curves thinned for viewing. The full ones stay in the trajectory files.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rigor::report {

inline constexpr std::size_t kCurvePoints = 200;

/// Indices, at most `most` of 0..count-1, evenly spread, first and last among them.
std::vector<std::size_t> evenIndices(std::size_t count, std::size_t most);

/// Indices, at most `most`, that keep the outline of a curve: first, last, and the least and greatest finite
/// value of each of (most - 2) / 2 equal intervals, so that a spike of one sample stays visible.
std::vector<std::size_t> outlineIndices(std::span<const double> values, std::size_t most);

/// Little-endian IEEE singles in base64: how curves are stored in the page.
std::string packSingles(std::span<const double> values);

}  // namespace rigor::report
