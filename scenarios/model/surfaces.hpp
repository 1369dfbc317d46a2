// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Chains, triangle meshes and height fields of the model: what may be wrong with them, and their vertices.
#pragma once

#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::scenario {

/// Shapes of static bodies only: half-spaces, segments, chains, meshes and height fields.
bool isStaticOnly(const Geometry& geometry);

/// Description of what is wrong, or an empty text: too few vertices, numbers that are not finite, neighbours
/// of a chain at one place, triangles without area or of unknown vertices, a count of heights that does not
/// fit the grid.
std::string surfaceProblem(const Chain& chain);
std::string surfaceProblem(const TriangleMesh& mesh);
std::string surfaceProblem(const HeightField& field);

/// Local frame [m].
std::vector<Vec3> surfaceVertices(const Chain& chain);
std::vector<Vec3> surfaceVertices(const TriangleMesh& mesh);
std::vector<Vec3> surfaceVertices(const HeightField& field);

}  // namespace rigor::scenario
