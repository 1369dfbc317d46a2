// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checks of what a caller gives a world.
#pragma once

#include <cstddef>
#include <string>

#include "engine/core/error.hpp"

namespace rigor::engine {

/// Throws EngineError `id` unless `ok`.
inline void require(bool ok, const char* id, const char* message) {
    if (!ok) throw EngineError(id, message);
}

/// Throws EngineError "shape_material" unless a world of `count` materials has this one.
inline void requireMaterial(std::size_t material, std::size_t count) {
    if (material >= count)
        throw EngineError("shape_material", "there is no material " + std::to_string(material) +
                                                ": the world has " + std::to_string(count) +
                                                " (World::addMaterial)");
}

}  // namespace rigor::engine
