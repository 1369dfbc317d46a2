// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// fcl::distance of two geometries.
#pragma once

#include <fcl/narrowphase/gjk_solver_type.h>

#include <optional>

#include "adapters/fcl/shapes.hpp"

namespace rigor::fcl_adapter {

/// Overlaps [m] below which EPA is not called; it failed at exact touch.
inline constexpr double kLeastDepth = 1e-7;

/// True for shapes that EPA measures exactly.
bool isPolytope(const adapter::Geometry& geometry);

struct Separation {
    double distance = 0.0;  ///< negative inside
    adapter::Vec3 onA, onB;
};

/// fcl::distance; nothing where libccd gives up (it throws). If `inside`, an overlap is measured by EPA;
/// otherwise its distance is some negative number.
std::optional<Separation> separation(const FclShape& a, const FclShape& b, bool inside,
                                     fcl::GJKSolverType solver = fcl::GST_LIBCCD);

/// True where the points are as far apart as the distance says.
bool pointsAgree(const Separation& s);

/// The contact of an overlap that fcl::distance measured: the normal runs from B's deepest point to A's.
adapter::ContactPoint contactOf(const Separation& s);

}  // namespace rigor::fcl_adapter
