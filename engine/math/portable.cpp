// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Argument reductions that are exact or nearly so, then Taylor series:
//     atan2   with t = min/max of |x|, |y| and c = k/8 next to t:  atan t = atan c + atan((t - c)/(1 + t c));
//             what is left is at most 1/16
//     log     x = m 2^e, m in [sqrt(1/2), sqrt(2)):  ln m = 2 artanh s, s = (m - 1)/(m + 1), |s| < 0.172
//     expm1   halved until |x| <= 1/16, doubled again by  e^2x - 1 = (e^x - 1)(e^x - 1 + 2)
#include "engine/math/portable.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace rigor::engine::portable {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1, kPiRest = 0x1.1a62633145c07p-53;

/// atan(k/8) and what a double leaves of it.
struct Angle {
    double value, rest;
};
constexpr Angle kAtanEighths[] = {
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {kPi / 4, kPiRest / 4},
};

/// atan(low / high) for 0 <= low <= high, high > 0: value + rest.
Angle atanOfRatio(double low, double high) {
    const double eighths = std::floor(low / high * 8 + 0.5), c = eighths / 8;
    const double d = eighths > 0 ? (low - c * high) / (high + c * low) : low / high, x = d * d;
    double series = 0;
    // (-1)^k / (2k + 1), k >= 1; x <= 1/256: what is left out is below 1e-21 of d.
    for (const double a : {-1.0 / 15, 1.0 / 13, -1.0 / 11, 1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3})
        series = series * x + a;
    const Angle& near = kAtanEighths[static_cast<std::size_t>(eighths)];
    // near.value is 0 or larger than |d|: the sum's rounding is what it leaves of d.
    const double rest = near.rest + d * x * series, sum = near.value + d;
    return {sum, rest + (d - (sum - near.value))};
}

}  // namespace

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
    double ax = std::abs(x), ay = std::abs(y);
    if (std::isinf(ax) && std::isinf(ay)) ax = ay = 1;
    Angle angle{0, 0};
    if (ax >= ay && ax > 0)
        angle = atanOfRatio(ay, ax);
    else if (ay > 0) {
        const Angle other = atanOfRatio(ax, ay);
        const double sum = kPi / 2 - other.value;
        angle = {sum, (kPi / 2 - sum - other.value) + (kPiRest / 2 - other.rest)};
    }
    if (std::signbit(x)) {
        const double sum = kPi - angle.value;
        angle = {sum, (kPi - sum - angle.value) + (kPiRest - angle.rest)};
    }
    return std::copysign(angle.value + angle.rest, y);
}

double log(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // in [1/2, 1)
    if (m < 0.7071067811865476) {
        m *= 2;
        --exponent;
    }
    const double s = (m - 1) / (m + 1), s2 = s * s;
    double series = 0;
    // 1 / (2k + 1), k >= 1; s2 < 0.0295: what is left out is below 1e-20 of s.
    for (const double a : {1.0 / 25, 1.0 / 23, 1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11,
                           1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3})
        series = series * s2 + a;
    // ln m = f - f^2/2 + ..., f = m - 1 exact: 2 s = f - s f. The rest is small beside f.
    const double f = m - 1, rest = s * (2 * s2 * series - f);
    constexpr double kLn2 = 0x1.62e42p-1, kLn2Rest = 4.7493250390316726e-07;  // the first times 2^11 is exact
    return exponent * kLn2 + (f + (rest + exponent * kLn2Rest));
}

double expm1(double x) {
    if (x < -40) return -1;
    int halvings = 0;
    for (; x < -1.0 / 16; ++halvings) x *= 0.5;
    double series = 0;
    // 1 / k!, k >= 2; |x| <= 1/16: what is left out is below 1e-21 of x.
    for (const double a : {1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720, 1.0 / 120,
                           1.0 / 24, 1.0 / 6, 1.0 / 2})
        series = series * x + a;
    double result = x + x * x * series;
    for (; halvings > 0; --halvings) result *= result + 2;
    return result;
}

}  // namespace rigor::engine::portable
