// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The functions without libm against long double ones of libm, in units in the last place; and their signs and ends.
#include "engine/math/portable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rigor::engine::test {
namespace {

double ulps(double value, long double exact) {
    const double near = std::abs(static_cast<double>(exact));
    const double ulp = std::nextafter(near, std::numeric_limits<double>::infinity()) - near;
    return static_cast<double>(std::abs(static_cast<long double>(value) - exact) /
                               static_cast<long double>(ulp));
}

TEST(Portable, Atan2IsThatOfLibm) {
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const double angle = -3.14159 + i * 3.1415e-5, length = 1 + 0.37 * (i % 11);
        const double y = length * std::sin(angle), x = length * std::cos(angle);
        worst = std::max(worst, ulps(portable::atan2(y, x),
                                     std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    }
    for (double small = 1; small > 1e-300; small *= 0.37)
        worst = std::max(
            worst, ulps(portable::atan2(small, 3.0), std::atan2(static_cast<long double>(small), 3.0L)));
    RecordProperty("atan2_ulps", std::to_string(worst));
    EXPECT_LT(worst, 1.5);
    EXPECT_GT(worst, 0.4) << "no rounding at all is not possible";
}

TEST(Portable, Atan2HasTheSignsAndEndsOfLibm) {
    const double inf = std::numeric_limits<double>::infinity();
    for (const double y : {0.0, -0.0, 1.0, -2.0, inf, -inf})
        for (const double x : {0.0, -0.0, 1.0, -2.0, inf, -inf}) {
            EXPECT_EQ(portable::atan2(y, x), std::atan2(y, x)) << y << ", " << x;
            EXPECT_EQ(std::signbit(portable::atan2(y, x)), std::signbit(std::atan2(y, x))) << y << ", " << x;
        }
    EXPECT_TRUE(std::isnan(portable::atan2(std::nan(""), 1.0)));
    EXPECT_TRUE(std::isnan(portable::atan2(1.0, std::nan(""))));
    EXPECT_EQ(portable::atan2(1.0f, 2.0f), static_cast<float>(std::atan2(1.0, 2.0)));
}

TEST(Portable, LogAndExpm1AreThoseOfLibm) {
    double log = 0, expm1 = 0;
    for (int i = 1; i < 200000; ++i) {
        const double x = i * 1e-5;
        log = std::max(log, ulps(portable::log(x), std::log(static_cast<long double>(x))));
        expm1 = std::max(expm1, ulps(portable::expm1(-3 * x), std::expm1(static_cast<long double>(-3 * x))));
    }
    for (double x = 1e-300; x < 1e300; x *= 37)
        log = std::max(log, ulps(portable::log(x), std::log(static_cast<long double>(x))));
    for (double x = 1; x > 1e-300; x *= 0.29)
        expm1 = std::max(expm1, ulps(portable::expm1(-x), std::expm1(static_cast<long double>(-x))));
    RecordProperty("log_ulps", std::to_string(log));
    RecordProperty("expm1_ulps", std::to_string(expm1));
    EXPECT_LT(log, 1.5);
    EXPECT_LT(expm1, 4);
    EXPECT_EQ(portable::log(1.0), 0);
    EXPECT_EQ(portable::expm1(0.0), 0);
    EXPECT_EQ(portable::expm1(-1000.0), -1);
}

TEST(Portable, HypotIsThatOfLibm) {
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const double x = 1e-3 * i, y = 3 + 2e-4 * i;
        worst = std::max(worst, ulps(portable::hypot(x, y),
                                     std::hypot(static_cast<long double>(x), static_cast<long double>(y))));
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        EXPECT_EQ(portable::hypot(fx, fy),
                  static_cast<float>(std::hypot(static_cast<double>(fx), static_cast<double>(fy))));
    }
    EXPECT_LT(worst, 1.25);
}

}  // namespace
}  // namespace rigor::engine::test
