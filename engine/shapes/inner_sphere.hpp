// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The middle of a convex shape and a sphere around it (2D: a circle) that the shape contains.
#pragma once

#include "engine/shapes/shape.hpp"

namespace rigor::engine {

/// A sphere of this radius fits into the shape (rounded down where there is no closed form) [m]; the largest
/// number there is for half-spaces, which nothing passes through; 0 for surfaces, which have no thickness.
template <class S>
typename S::Real inscribedRadiusOf(const Shape<S>& shape);

/// The centre of such a sphere, or near it, in the frame of the shape [m]; zero for half-spaces and surfaces.
template <class S>
typename S::Vec middleOf(const Shape<S>& shape);

}  // namespace rigor::engine
