// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Directions of the searches for minimising normals.
#pragma once

#include <cmath>
#include <cstddef>

#include "validation/oracle/solid.hpp"

namespace rigor::validation::oracle {

inline constexpr std::size_t kMostNormals = 64;  ///< maximum number of normals of a tie or a continuum

inline Vec unit(Vec v) {
    return (1 / norm(v)) * v;
}

/// A unit vector normal to the unit vector u.
inline Vec anyNormalTo(Vec u) {
    const Vec axis =
        std::abs(u.x) < 0.6L ? Vec{1, 0, 0} : (std::abs(u.y) < 0.6L ? Vec{0, 1, 0} : Vec{0, 0, 1});
    return unit(cross(u, axis));
}

}  // namespace rigor::validation::oracle
