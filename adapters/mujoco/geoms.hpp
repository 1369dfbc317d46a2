// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <string>

#include "adapters/mujoco/convert.hpp"

namespace rigor::mujoco {

/// A shape as MJCF: attributes of a geom, and the asset that it uses.
struct GeomText {
    std::string attributes;  ///< type="..." size="..."
    Pose frame;              ///< frame of the geom in the scenario's shape frame
    std::string asset;       ///< element of <asset>, or ""
};

/// `name` names the asset. Throws Unsupported for shapes that MuJoCo does not have.
GeomText geomText(const adapter::Geometry& geometry, const std::string& name);

/// Elevations of a height field in MuJoCo's order, from 0 to 1.
std::vector<float> elevations(const scenario::HeightField& field);

/// 17 significant digits, which give the same number back.
std::string exact(double value);
std::string exact(const Vec3& v);
std::string exact(const Quat& q);

inline constexpr const char* kGeomTypes = "mujoco/mjmodel.h, enum mjtGeom";
inline constexpr const char* kConvexMeshes =
    "MuJoCo manual, XML reference, asset/mesh: \"the convex hull is used for collision detection\"";

}  // namespace rigor::mujoco
