// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits of the manifold choices (core/traits.hpp).
#pragma once

#include <span>
#include <string>

#include "engine/core/traits.hpp"

namespace rigor::engine {

struct ManifoldTraits {
    bool remembers = false;  ///< keeps points from step to step: lives from the narrow phase of every step
};
std::span<const TraitsEntry<ManifoldTraits>> manifoldTraitsTable();

inline const ManifoldTraits& manifoldTraits(const std::string& name) {
    return findTraits(manifoldTraitsTable(), "manifold", name);
}

}  // namespace rigor::engine
