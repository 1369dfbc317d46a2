// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of narrow phases (narrowphases.def).
#pragma once

#include <memory>
#include <span>
#include <string>

#include "engine/narrowphase/manifold.hpp"

namespace rigor::engine {

struct NarrowPhaseEntry {
    const char* name;
    const char* summary;
};
/// Every narrow phase findNarrowPhase knows.
std::span<const NarrowPhaseEntry> narrowPhases();

/// The entry of that name as an object. Throws EngineError "unknown_algorithm" listing the names there are.
template <class S>
std::shared_ptr<const NarrowPhase<S>> makeNarrowPhase(const std::string& name);

#define ALGORITHM(name, function, summary)                                                    \
    template <class S>                                                                        \
    void function(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb, \
                  typename S::Real speculativeDistance, Manifold<S>& out);
#include "engine/narrowphase/narrowphases.def"

}  // namespace rigor::engine
