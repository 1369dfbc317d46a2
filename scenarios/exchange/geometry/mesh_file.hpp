// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Mesh files (OBJ, STL, glTF, ... through assimp) as shapes: connected parts; convex hulls for bodies that move,
// triangles for those that do not.
#pragma once

#include "scenarios/exchange/geometry/hull.hpp"

namespace rigor::models {

/// A connected piece of a mesh; vertices at one place are one vertex.
using MeshPart = scenario::TriangleMesh;

/// The parts of a mesh file, every coordinate times `scale` [m per unit]. Throws Refusal.
std::vector<MeshPart> readMesh(const std::filesystem::path& file, const scenario::Vec3& scale,
                               const Place& place);

/// True where the mesh is the surface of its convex hull, within 1e-6 of its size.
bool isConvex(const MeshPart& part, const HullOfMesh& hull);

/// Adds a mesh to a body: triangles if it is static; else a hull for each part, each of which must be convex unless
/// the options say `hull`. What can not be is refused.
void addMesh(SceneBuilder& builder, Report& report, int body, const std::vector<MeshPart>& parts,
             const scenario::Pose& pose, const Surface& surface, int kind, const ReadOptions& options,
             const Place& place);

}  // namespace rigor::models
