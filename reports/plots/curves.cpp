// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/plots/curves.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "reports/encoding/data_files.hpp"

namespace rigor::report {

std::size_t curvePoints(std::size_t cases, std::size_t most, std::size_t fewest) {
    return std::clamp(most * kCasesOfWholeCurves / std::max(cases, std::size_t{1}), fewest, most);
}

std::vector<std::size_t> evenIndices(std::size_t count, std::size_t most) {
    std::vector<std::size_t> out;
    if (count <= most || most < 2) {
        for (std::size_t i = 0; i < count; ++i) out.push_back(i);
        return out;
    }
    for (std::size_t k = 0; k < most; ++k) out.push_back(k * (count - 1) / (most - 1));
    return out;
}

std::vector<std::size_t> outlineIndices(std::span<const double> values, std::size_t most) {
    const std::size_t count = values.size();
    if (count <= most || most < 4) return evenIndices(count, most);
    const std::size_t stretches = (most - 2) / 2;
    std::vector<std::size_t> out{0};
    for (std::size_t s = 0; s < stretches; ++s) {
        const std::size_t begin = s * count / stretches, end = (s + 1) * count / stretches;
        std::size_t least = end, greatest = end;
        for (std::size_t i = begin; i < end; ++i) {
            if (!std::isfinite(values[i])) continue;
            if (least == end || values[i] < values[least]) least = i;
            if (greatest == end || values[i] > values[greatest]) greatest = i;
        }
        if (least == end) least = greatest = begin;  // nothing finite: keep the gap
        for (const std::size_t i : {std::min(least, greatest), std::max(least, greatest)})
            if (i > out.back()) out.push_back(i);
    }
    if (out.back() != count - 1) out.push_back(count - 1);
    return out;
}

std::string packSingles(std::span<const double> values) {
    std::string bytes;
    bytes.reserve(values.size() * 4);
    for (const double value : values) {
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xFF);
    }
    return base64(bytes);
}

}  // namespace rigor::report
