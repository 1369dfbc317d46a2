// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Traits of the choices of continuous collision (core/traits.hpp).
#pragma once

#include <span>
#include <string>

#include "engine/core/traits.hpp"

namespace rigor::engine {

struct ContinuousCollisionTraits {
    bool acts = true;            ///< fast bodies do not pass through thin ones
    bool givesContacts = false;  ///< fast bodies get contacts that lie ahead of them, for one sub-step
    bool losesRest = false;  ///< the motion of a fast body in the rest of the step after an impact is lost
};
std::span<const TraitsEntry<ContinuousCollisionTraits>> continuousCollisionTraitsTable();

inline const ContinuousCollisionTraits& continuousCollisionTraits(const std::string& name) {
    return findTraits(continuousCollisionTraitsTable(), "continuous_collision", name);
}

}  // namespace rigor::engine
