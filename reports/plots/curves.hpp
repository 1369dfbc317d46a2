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

/// Points of a curve in the page.
inline constexpr std::size_t kCurvePoints = 200;
inline constexpr std::size_t kFewestCurvePoints = 24;
/// Points of a curve in a plot for a paper.
inline constexpr std::size_t kPlotPoints = 800;
inline constexpr std::size_t kFewestPlotPoints = 48;
/// The curves of a run have as many points together as those of so many cases: fewer each in a larger run, whose page
/// would fill a disk.
inline constexpr std::size_t kCasesOfWholeCurves = 5000;
/// Points of a curve in the page, or in a plot, of a run of so many cases.
std::size_t curvePoints(std::size_t cases, std::size_t most = kCurvePoints,
                        std::size_t fewest = kFewestCurvePoints);

/// Indices, at most `most` of 0..count-1, evenly spread, first and last among them.
std::vector<std::size_t> evenIndices(std::size_t count, std::size_t most);

/// Indices, at most `most`, that keep the outline of a curve: first, last, and the least and greatest finite
/// value of each of (most - 2) / 2 equal intervals, so that a spike of one sample stays visible.
std::vector<std::size_t> outlineIndices(std::span<const double> values, std::size_t most);

/// Little-endian IEEE singles in base64: how curves are stored in the page.
std::string packSingles(std::span<const double> values);

}  // namespace rigor::report
