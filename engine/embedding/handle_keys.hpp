// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Handles as keys, so that a program can keep what it knows of its bodies, shapes and joints in a map:
//
//     std::map<BodyId, Player> players;
//     std::unordered_map<ShapeId, Sound> sounds;
//
// A handle never names a newer object, so that an entry of what is gone is never found for another.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "engine/core/ids.hpp"

namespace rigor::engine {

/// Order by index, then by generation. It has no meaning but that of a key.
template <class Tag>
constexpr std::strong_ordering operator<=>(const Id<Tag>& a, const Id<Tag>& b) {
    if (const auto order = a.index <=> b.index; order != 0) return order;
    return a.generation <=> b.generation;
}

}  // namespace rigor::engine

template <class Tag>
struct std::hash<rigor::engine::Id<Tag>> {
    std::size_t operator()(const rigor::engine::Id<Tag>& id) const noexcept {
        return std::hash<std::uint64_t>()((std::uint64_t(id.generation) << 32) | id.index);
    }
};
