// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Facets: the neighbouring triangles of a surface that lie in one plane, the segments of a chain that lie on
// one line. A facet is what a body touches; how it is cut into pieces is not felt
// (narrowphase/facet_contact.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace rigor::engine {

/// Facet of each piece of a surface, by number of the piece. Both lists are empty where no facet has two
/// pieces.
struct Facets {
    std::vector<std::uint32_t> first;  ///< lowest piece of the facet: its name
    std::vector<std::uint8_t> inner;   ///< bit k: the piece beyond side (end) k is of the same facet

    std::uint32_t of(std::uint32_t piece) const { return first.empty() ? piece : first[piece]; }
    std::uint32_t innerSides(std::uint32_t piece) const { return inner.empty() ? 0u : inner[piece]; }
};

/// Finds the facets. `neighbours(piece)`: the pieces beyond its three sides (two ends, then kNullIndex),
/// kNullIndex at an open border;
/// `flat(piece, side)`: true where the neighbour continues the plane of the piece; `parallel(a, b)`: true
/// where two pieces have the same normal, up to its sign.
Facets findFacets(std::uint32_t pieces,
                  const std::function<std::array<std::uint32_t, 3>(std::uint32_t)>& neighbours,
                  const std::function<bool(std::uint32_t, int)>& flat,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& parallel);

}  // namespace rigor::engine
