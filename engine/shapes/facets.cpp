// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/shapes/facets.hpp"

#include "engine/core/ids.hpp"

namespace rigor::engine {

/// Grows each facet from its lowest piece, breadth first. Cost: O(pieces).
Facets findFacets(std::uint32_t pieces,
                  const std::function<std::array<std::uint32_t, 3>(std::uint32_t)>& neighbours,
                  const std::function<bool(std::uint32_t, int)>& flat,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& parallel) {
    Facets facets;
    facets.first.assign(pieces, kNullIndex);
    std::vector<std::uint32_t> grown;
    bool any = false;
    for (std::uint32_t seed = 0; seed < pieces; ++seed) {
        if (facets.first[seed] != kNullIndex) continue;
        facets.first[seed] = seed;
        grown.assign(1, seed);
        for (std::size_t k = 0; k < grown.size(); ++k) {
            const std::uint32_t piece = grown[k];
            const std::array<std::uint32_t, 3> beyond = neighbours(piece);
            for (int side = 0; side < 3; ++side) {
                const std::uint32_t next = beyond[static_cast<std::size_t>(side)];
                if (next == kNullIndex || facets.first[next] != kNullIndex) continue;
                if (!flat(piece, side) || !parallel(seed, next)) continue;
                facets.first[next] = seed;
                grown.push_back(next);
                any = true;
            }
        }
    }
    if (!any) return {};
    facets.inner.assign(pieces, 0);
    for (std::uint32_t piece = 0; piece < pieces; ++piece) {
        const std::array<std::uint32_t, 3> beyond = neighbours(piece);
        for (unsigned side = 0; side < 3; ++side)
            if (beyond[side] != kNullIndex && facets.first[beyond[side]] == facets.first[piece] &&
                flat(piece, static_cast<int>(side)))
                facets.inner[piece] = static_cast<std::uint8_t>(facets.inner[piece] | 1u << side);
    }
    return facets;
}

}  // namespace rigor::engine
