// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See planar_events.hpp.
#include "validation/references/planar/planar_events.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>

#include "validation/references/numerics/roots.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

constexpr int kLooks = 64;        // samples of the event functions in a piece
constexpr int kHalvings = 30;     // halvings of the first sample, for motions that come back at once
constexpr int kMinimumBits = 24;  // bits of the time of a least value

/// The time in [low, high], with f(high) < 0, at which f becomes negative. At the start of a piece f may be
/// zero by the event that led there; then f has to have moved before it counts.
Real zeroBetween(const Watched& watched, Real low, Real high, bool isStart) {
    const auto& [f, small] = watched;
    if (!isStart) return numerics::findRoot(f, low, high);
    // An excursion from zero and back that is shorter than a sample: look nearer to the start.
    Real above = low;
    Real below = high;
    for (int halving = 0; !(f(above) > small) && halving < kHalvings; ++halving) {
        const Real middle = low + (below - low) / 2;
        (f(middle) > small ? above : below) = middle;
    }
    return f(above) > small ? numerics::findRoot(f, above, below) : low;
}

}  // namespace

std::optional<Real> firstZero(const Watched& watched, Real begin, Real end) {
    const auto timeOf = [&](int k) { return begin + (end - begin) * k / kLooks; };
    Real before = 0;
    Real last = watched.value(begin);
    for (int k = 1; k <= kLooks; ++k) {
        const Real value = watched.value(timeOf(k));
        if (value < 0) return zeroBetween(watched, timeOf(k - 1), timeOf(k), k == 1);
        const Real rise = std::max(before, value) - last;
        if (k > 1 && last < before && last <= value && last < rise) {
            const auto [low, least] =
                boost::math::tools::brent_find_minima(watched.value, timeOf(k - 2), timeOf(k), kMinimumBits);
            if (least < -watched.small) return zeroBetween(watched, timeOf(k - 2), low, k == 2);
        }
        before = last;
        last = value;
    }
    return std::nullopt;
}

}  // namespace rigor::validation
