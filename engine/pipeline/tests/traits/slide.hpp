// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Friction laws identified by the motion of sliding bodies.
#pragma once

#include <optional>
#include <string>

#include "engine/solvers/traits.hpp"

namespace rigor::engine::test {

/// The law of a solver that steps by h / substeps, if the world's setting is `friction`.
FrictionShape frictionShapeOf(const std::string& solver, const std::string& friction, int substeps);

/// The law that a solver has for every setting of the world; empty: it obeys.
std::optional<FrictionShape> ownFriction(const std::string& solver, int substeps);

/// True if a plate on three feet that slides and turns at once is decelerated otherwise than by the friction
/// of each foot alone.
bool rubsInPatches(const std::string& solver);

}  // namespace rigor::engine::test
