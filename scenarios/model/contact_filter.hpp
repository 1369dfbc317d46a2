// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Filters of contacts: layers that a file names, and groups.
#pragma once

#include <cstdint>

namespace rigor::scenario {

/// Layers of a file, "default" among them: as many as the library with the fewest takes.
inline constexpr int kMaxLayers = 16;
inline constexpr std::uint32_t kAllLayers = (1U << kMaxLayers) - 1U;
/// Name of the layer of shapes that name none: bit 0.
inline constexpr const char* kDefaultLayer = "default";

/// Two shapes may touch if each collides with a layer of the other. The group alone decides for shapes of
/// one group, not 0: a positive one always touches, a negative one never.
struct ContactFilter {
    std::uint32_t layers = 1;                 ///< bit k: Scenario::layers[k]; never 0
    std::uint32_t collidesWith = kAllLayers;  ///< bits of the layers that the shape collides with
    int group = 0;                            ///< 0: none; from -32768 to 32767

    friend bool operator==(const ContactFilter&, const ContactFilter&) = default;
};

inline bool mayTouch(const ContactFilter& a, const ContactFilter& b) {
    if (a.group != 0 && a.group == b.group) return a.group > 0;
    return (a.collidesWith & b.layers) != 0 && (b.collidesWith & a.layers) != 0;
}

}  // namespace rigor::scenario
