// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Checks of what a caller gives a world.
#pragma once

#include "engine/core/error.hpp"

namespace rigor::engine {

/// Throws EngineError `id` unless `ok`.
inline void require(bool ok, const char* id, const char* message) {
    if (!ok) throw EngineError(id, message);
}

}  // namespace rigor::engine
