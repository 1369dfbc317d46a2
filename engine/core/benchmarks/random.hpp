// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random numbers for benchmarks: the same on every machine and with every standard library.
#pragma once

#include <cstdint>

namespace rigor::engine::benchmark_scene {

/// Knuth's 64-bit linear congruential generator (MMIX), upper 53 bits.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Uniform random number in [0, 1).
    double unit() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * unit(); }

  private:
    std::uint64_t state_;
};

}  // namespace rigor::engine::benchmark_scene
