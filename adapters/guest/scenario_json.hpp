// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario as guests get it: resolved, with every default written out (PROTOCOL.md, "The scenario").
#pragma once

#include "adapters/guest/frame.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::guest {

Json toJson(const scenario::Vec3& v);
Json toJson(const scenario::Quat& q);

/// {"shape": name, sizes by their names}. `dimension`: that of the shape's names.
Json geometryJson(const scenario::Geometry& geometry, int dimension);

/// `planar`: it is a scenario in 2D that was lifted for an engine in 3D.
Json scenarioJson(const scenario::Scenario& scenario, bool planar);

}  // namespace rigor::guest
