// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All roots of a smooth function of an angle, by sampling and bisection. Private to this folder.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "validation/oracle/core.hpp"

namespace rigor::validation::oracle {

/// Angles at which f, of period 2 pi, is zero or jumps through zero, to the last digit. Two roots between two
/// of the 64 samples are found by the extremum between them. Calls `found` with each.
template <class Function, class Found>
void forRoots(const Function& f, const Found& found) {
    constexpr std::size_t kSamples = 64;
    constexpr Real kStep = 2 * std::numbers::pi_v<Real> / kSamples;
    // Off the axes, where symmetric problems have their roots and their jumps.
    constexpr Real kStart = 0.0123456789L;
    const auto bisect = [&](Real low, Real high, bool lowIsNegative) {
        for (int i = 0; i < 70; ++i) {
            const Real middle = 0.5L * (low + high);
            if ((f(middle) < 0) == lowIsNegative)
                low = middle;
            else
                high = middle;
        }
        found(0.5L * (low + high));
    };
    std::array<Real, kSamples> value;
    for (std::size_t i = 0; i < kSamples; ++i) value[i] = f(kStart + static_cast<Real>(i) * kStep);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const Real at = kStart + static_cast<Real>(i) * kStep;
        const Real before = value[(i + kSamples - 1) % kSamples], here = value[i],
                   next = value[(i + 1) % kSamples];
        if (here == 0) found(at);
        if ((here < 0) != (next < 0)) bisect(at, at + kStep, here < 0);
        const bool dips = (before < 0) == (here < 0) && (next < 0) == (here < 0) &&
                          std::abs(here) <= std::abs(before) && std::abs(here) <= std::abs(next);
        if (!dips) continue;
        Real low = at - kStep, high = at + kStep;  // golden section for the least |f|, until it changes sign
        constexpr Real kGolden = 0.61803398874989484820L;
        for (int k = 0; k < 50; ++k) {
            const Real left = high - kGolden * (high - low), right = low + kGolden * (high - low);
            const Real fl = f(left), fr = f(right);
            const Real crossing = (fl < 0) != (here < 0) ? left : right;
            if ((f(crossing) < 0) != (here < 0)) {
                bisect(at - kStep, crossing, here < 0);
                bisect(crossing, at + kStep, here >= 0);
                break;
            }
            (std::abs(fl) < std::abs(fr) ? high : low) = std::abs(fl) < std::abs(fr) ? right : left;
        }
    }
}

}  // namespace rigor::validation::oracle
