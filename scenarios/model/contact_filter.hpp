// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Which shapes may touch each other: by layers that a file names, and by groups.
#pragma once

#include <cstdint>

namespace rigor::scenario {

/// Layers of a file, "default" among them: as many as the library with the fewest takes.
inline constexpr int kMaxLayers = 16;
inline constexpr std::uint32_t kAllLayers = (1U << kMaxLayers) - 1U;
/// Name of the layer of shapes that name none: bit 0.
inline constexpr const char* kDefaultLayer = "default";

/// Two shapes may touch if each collides with a layer of the other. Shapes of one group, not 0, ask the group alone:
/// a positive one always, a negative one never.
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
