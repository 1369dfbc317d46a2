// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "engine/shapes/shape.hpp"

namespace rigor::engine {

template <class S>
struct CastResult {
    bool touches = false;
    typename S::Real fraction = 0;
    typename S::Vec point, normal;  ///< world frame; normal from the moved shape to the other
    bool startsTouching = false;
    bool converged = true;
};

/// First touch of convex `a`, moved from Xa along `translation` without turning, with convex `b` at Xb, at a
/// fraction of at most `most`.
template <class S>
CastResult<S> castConvex(const Shape<S>& a, const Pose<S>& Xa, const typename S::Vec& translation,
                         const Shape<S>& b, const Pose<S>& Xb, typename S::Real most);

}  // namespace rigor::engine
