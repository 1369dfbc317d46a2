// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Another engine's collision queries as the narrow phase of the in-house solver: narrow_phase=bullet, fcl.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/narrowphase/manifold.hpp"

namespace rigor::adapter {

/// Names of the engines that can be queried and are installed, sorted; each is the name of its adapter.
std::vector<std::string> foreignNarrowPhases();
/// Installed or not.
bool isForeignNarrowPhase(const std::string& name);

/// Loads the adapter of that name and wraps its collision queries; 3D only. Throws BadInput when its module
/// is not installed. Shapes that the engine does not have throw Unsupported when they come near each other.
template <class S>
std::shared_ptr<const engine::NarrowPhase<S>> makeForeignNarrowPhase(const std::string& name);

}  // namespace rigor::adapter
