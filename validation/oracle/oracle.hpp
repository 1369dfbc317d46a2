// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The exact contact oracle: signed distance, all minimising normals and witness points of two convex shapes,
// by brute force over features in extended precision. Slow on purpose; has no code in common with any engine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/model/scenario.hpp"

namespace rigor::validation {

struct OracleAnswer {
    double signedDistance = 0.0;  ///< [m]; < 0: minus the penetration depth (minimum translation distance)
    std::vector<scenario::Vec3>
        normals;  ///< unit, A to B; all directions whose signed distance is within `tie` of the best
    bool continuum = false;  ///< infinitely many such directions: `normals` holds samples of them
    /// One pair of closest (or deepest) points; pointB - pointA = signedDistance * normals[0].
    scenario::Vec3 witnessA, witnessB;
};

/// Empty for shape pairs without an exact method: two half-spaces, surfaces made of pieces (chain, mesh,
/// height field), a segment in 3D, cylinder and cone in 2D. `tie` is relative to the larger shape.
std::optional<OracleAnswer> exactContact(const scenario::Geometry& a, const scenario::Pose& poseA,
                                         const scenario::Geometry& b, const scenario::Pose& poseB,
                                         int dimension, double tie = 1e-9);

/// Signed distance of the two shapes along one unit direction from A to B [m]: the gap between the supporting
/// planes. Never above signedDistance; equal to it exactly for the minimising normals, so that it judges any
/// normal an engine reports. Empty like exactContact, and -infinity along a direction in which a half-space
/// is unbounded.
std::optional<double> separationAlong(const scenario::Geometry& a, const scenario::Pose& poseA,
                                      const scenario::Geometry& b, const scenario::Pose& poseB, int dimension,
                                      scenario::Vec3 direction);

}  // namespace rigor::validation
