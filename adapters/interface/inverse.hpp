// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The inverse of an inertia tensor, for adapters whose library takes it or whose coordinates need it.
#pragma once

#include "scenarios/model/scenario.hpp"

namespace rigor::adapter {

/// Inverse of a symmetric positive definite tensor by cofactors.
inline scenario::Mat3 inverseOf(const scenario::Mat3& a) {
    const auto cofactor = [&](int i, int j) {
        const int r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return a(r, c) * a(s, d) - a(r, d) * a(s, c);
    };
    const double det = a(0, 0) * cofactor(0, 0) + a(0, 1) * cofactor(0, 1) + a(0, 2) * cofactor(0, 2);
    scenario::Mat3 inverse;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inverse(i, j) = cofactor(j, i) / det;
    return inverse;
}

}  // namespace rigor::adapter
