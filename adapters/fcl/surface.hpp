// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meshes of triangles against one other shape.
#pragma once

#include <fcl/narrowphase/gjk_solver_type.h>

#include "adapters/interface/types.hpp"

namespace rigor::fcl_adapter {

/// The result of a query in which one of the shapes is a TriangleMesh: a contact for each triangle, or, if `strips`,
/// for each pair of triangles (adapters/interface/planar.hpp), deepest first. If not `exact`, contacts are those of
/// fcl::collide as they are. Throws adapter::Unsupported if the other shape is one that cannot move.
adapter::CollisionAnswer collideSurface(const adapter::PosedShape& a, const adapter::PosedShape& b,
                                        bool strips, bool exact, fcl::GJKSolverType solver);

}  // namespace rigor::fcl_adapter
