// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bounding spheres (2D: circles): the smallest sphere around a shape. It turns with its body without any work.
#pragma once

#include <limits>
#include <span>

#include "engine/shapes/shape.hpp"

namespace rigor::engine {

template <class S>
struct BoundingSphere {
    typename S::Vec center = S::Vec::Zero();  ///< in the frame that its maker says [m]
    typename S::Real radius =
        std::numeric_limits<typename S::Real>::infinity();  ///< infinity: bounds nothing [m]
};

/// The smallest sphere that contains the shape, in the frame of the shape; its radius is rounded up. Shapes that
/// only static bodies have (half-spaces, segments, triangles, surfaces) get none: theirs would hold much of a scene.
template <class S>
BoundingSphere<S> boundingSphere(const Shape<S>& shape);

/// The smallest sphere that contains the points, to 1e-12 of its radius. Each step adds the furthest point and solves
/// the smallest sphere of at most dim + 2 points by enumeration, so that the radius grows until no point is
/// outside [Welzl1991; Gaertner1999 for the pivot rule].
template <int Dim>
BoundingSphere<Space<double, Dim>> smallestSphere(std::span<const Eigen::Matrix<double, Dim, 1>> points);

}  // namespace rigor::engine
