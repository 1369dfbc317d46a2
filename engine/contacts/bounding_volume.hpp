// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounding volumes: what stands for a shape until its contacts are looked for; the family `bounding_volume`.
//
//                        broad phase compares        before the narrow phase      a shape costs in each step
//     aabb               boxes around the shapes     -                            its box, from its vertices
//     bounding_sphere    boxes around the spheres    the spheres are compared     one point and a radius
//     aabb_and_sphere    boxes around the shapes     the spheres are compared     both
//
// All let every pair pass that can have contacts: the contacts are the same, the pairs and the narrow phase's
// queries are not. Shapes of static bodies alone (half-spaces, surfaces) have boxes and no sphere.
#pragma once

#include <span>

#include "engine/core/table.hpp"

namespace rigor::engine {

struct BoundingVolume {
    bool boxesOfSpheres = false;   ///< the broad phase gets the boxes around the spheres
    bool comparesSpheres = false;  ///< pairs whose spheres are apart have no narrow phase
};

std::span<const AlgorithmEntry<BoundingVolume>> boundingVolumeTable();

}  // namespace rigor::engine
