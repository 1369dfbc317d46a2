// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Signed distance and normal of pairs of posed shapes that have a simple closed form.
// Source: Ericson, Real-Time Collision Detection, 2005, chapter 5.
#pragma once

#include <optional>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

struct PairGeometry {
    double distance = 0.0;  ///< signed distance [m], < 0 when overlapping
    scenario::Vec3 normal;  ///< unit, from A to B
};

/// sphere-sphere, sphere-box (either order), and sphere, box, capsule or hull with a half-space (either
/// order). Empty for other pairs, and where the normal is not unique (concentric spheres, centre of a sphere
/// inside the box). Poses are of the shapes in the world; the distance of box, capsule and hull to a
/// half-space is exact.
std::optional<PairGeometry> closedFormPair(const scenario::Geometry& a, const scenario::Pose& poseA,
                                           const scenario::Geometry& b, const scenario::Pose& poseB,
                                           int dimension);

}  // namespace rigor::validation
