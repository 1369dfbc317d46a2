// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Philox 4x32-10: random numbers that are a function of a counter and a key, the same on every machine and in
// any order. Source: Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC 2011,
// sec. 4.3.
#pragma once

#include <array>
#include <cstdint>

namespace rigor::validation {

using PhiloxBlock = std::array<std::uint32_t, 4>;

constexpr PhiloxBlock philox(PhiloxBlock counter, std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t kMultiply[2] = {0xD2511F53u, 0xCD9E8D57u};
    constexpr std::uint32_t kWeyl[2] = {0x9E3779B9u, 0xBB67AE85u};
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = kMultiply[0] * counter[0], b = kMultiply[1] * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += kWeyl[0];
        key[1] += kWeyl[1];
    }
    return counter;
}

/// Uniform in (-1, 1), symmetric about 0, never 0.
constexpr double philoxUniform(std::uint32_t word) {
    return (word + 0.5) / 2147483648.0 - 1.0;
}

}  // namespace rigor::validation
