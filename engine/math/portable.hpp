// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Functions that a step needs and whose last bit differs from one libm to the next, between versions and between
// processors. These are made of IEEE additions, multiplications, divisions and square roots alone, which every
// processor rounds alike. Errors are measured in portable_test.cpp.
#pragma once

#include <cmath>
#include <type_traits>

namespace rigor::engine::portable {

/// Angle of (x, y) [rad], -pi .. pi, as std::atan2; within 1.5 units in the last place.
double atan2(double y, double x);
inline float atan2(float y, float x) {
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
/// ln x for x > 0; within 1.5 units in the last place.
double log(double x);
/// e^x - 1 for x <= 0; within 4 units in the last place.
double expm1(double x);

/// sqrt(x^2 + y^2), for lengths whose square is a number.
template <class R>
R hypot(R x, R y) {
    if constexpr (std::is_same_v<R, float>) {
        const double dx = static_cast<double>(x), dy = static_cast<double>(y);
        return static_cast<float>(std::sqrt(dx * dx + dy * dy));
    } else {
        return std::sqrt(x * x + y * y);
    }
}

}  // namespace rigor::engine::portable
