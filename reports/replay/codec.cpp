// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/replay/codec.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::report {
namespace {

void appendCode(Bytes& out, std::uint64_t code) {
    for (; code >= 128; code >>= 7) out.push_back(static_cast<std::uint8_t>(code | 128));
    out.push_back(static_cast<std::uint8_t>(code));
}

std::uint64_t zigzag(std::int64_t value) {
    return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}

/// False: not finite, or too many quanta.
bool rounded(double value, double quantum, std::int64_t& out) {
    const double quanta = value / quantum;
    if (!(std::abs(quanta) <= kMostQuanta)) return false;
    out = std::llround(quanta);
    return true;
}

}  // namespace

void appendSeries(Bytes& out, std::span<const double> values, std::size_t columns, double quantum) {
    const std::size_t samples = columns == 0 ? 0 : values.size() / columns;
    for (std::size_t c = 0; c < columns; ++c) {
        std::int64_t last = 0, before = 0, value = 0;
        int known = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            if (!rounded(values[i * columns + c], quantum, value)) {
                appendCode(out, 0);
                continue;
            }
            const std::int64_t predicted = known >= 2 ? 2 * last - before : last;
            appendCode(out, 1 + zigzag(value - predicted));
            before = last;
            last = value;
            ++known;
        }
    }
}

void appendLinked(Bytes& out, std::span<const double> values, std::span<const std::int64_t> previous,
                  double quantum) {
    // integers of the values; a value that is not finite gets its predecessor's
    std::vector<std::int64_t> kept(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::int64_t predicted = previous[i] < 0 ? 0 : kept[previous[i]];
        if (rounded(values[i], quantum, kept[i])) {
            appendCode(out, 1 + zigzag(kept[i] - predicted));
        } else {
            appendCode(out, 0);
            kept[i] = predicted;
        }
    }
}

double quantumOf(double typical, int bits, double least) {
    if (!std::isfinite(typical) || typical <= 0.0) return least;
    return std::max(least, std::exp2(std::floor(std::log2(typical)) - bits));
}

}  // namespace rigor::report
