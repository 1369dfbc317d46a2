// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Conditions that a scenario or a query must meet before it is passed to a library: several of them abort or
// fall into a loop on NaN, zero mass or degenerate shapes.
#pragma once

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

/// Throws BadInput naming the body and the value: NaN or infinity anywhere, mass or inertia of a dynamic body
/// not positive definite, sizes not positive, quaternions not unit to 1e-6, dt not in [1e-7, 1] s, indices
/// out of range, hulls with fewer than 4 (2D: 3) points or without volume.
void checkScenarioInput(const Scenario& scenario, double dt);

/// The same for one query.
void checkQueryInput(const CollisionQuery& query);

/// Throws Unsupported naming the first feature of the scenario that `capabilities` lacks: as the library's
/// lack where Capabilities::libraryLacks has a document for it, else as the adapter's.
void checkSupported(const Scenario& scenario, const Capabilities& capabilities, const std::string& engine);

}  // namespace rigor::adapter
