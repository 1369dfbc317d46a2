// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers that change little from frame to frame as bytes that gzip well: rounded to multiples of a quantum,
// predicted from what came before, the difference stored as a variable-length integer. Exact to half a
// quantum. web/src/replay/codec.ts reads it.
//
// A code is 0 for what is not finite, else 1 + zigzag(difference); zigzag maps 0, -1, 1, -2 to 0, 1, 2, 3.
// Bytes hold seven bits each, lowest first, the eighth says that more follow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rigor::report {

using Bytes = std::vector<std::uint8_t>;

/// Rounded values beyond this many quanta count as not finite: no picture could show them.
inline constexpr double kMostQuanta = 1e15;

/// `columns` numbers a sample, sample by sample; written column by column, each value predicted along the
/// straight line through the two finite ones before it. quantum > 0.
void appendSeries(Bytes& out, std::span<const double> values, std::size_t columns, double quantum);

/// One column in which value i is predicted by value previous[i] < i, or by 0 where previous[i] is -1.
void appendLinked(Bytes& out, std::span<const double> values, std::span<const std::int64_t> previous,
                  double quantum);

/// The power of two at or below `typical` / 2^bits; `least` where that is smaller or not finite.
double quantumOf(double typical, int bits, double least);

}  // namespace rigor::report
