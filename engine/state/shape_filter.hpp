// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The filter that says which shapes a shape collides with. A layer is a bit of 64. Two shapes collide if each has a layer of the
// other in its mask:
//
//     (A.mask & B.layers) != 0  and  (B.mask & A.layers) != 0
//
// Shapes that have the same group, not 0, go by the group alone: a positive one always collides, a negative one
// never.
#pragma once

#include <cstdint>

namespace rigor::engine {

struct ShapeFilter {
    std::uint64_t layers = 1;                ///< layers that the shape is in, a bit each
    std::uint64_t mask = ~std::uint64_t(0);  ///< layers that it collides with
    std::int32_t group = 0;                  ///< 0: none

    friend bool operator==(const ShapeFilter&, const ShapeFilter&) = default;
};

/// True if the filters of two shapes let them collide. Symmetric.
inline bool lets(const ShapeFilter& a, const ShapeFilter& b) {
    if (a.group != 0 && a.group == b.group) return a.group > 0;
    return (a.mask & b.layers) != 0 && (b.mask & a.layers) != 0;
}

}  // namespace rigor::engine
