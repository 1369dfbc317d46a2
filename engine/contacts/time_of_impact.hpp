// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time of impact of two moving convex shapes.
#pragma once

#include "engine/contacts/moving_shape.hpp"
#include "engine/narrowphase/distance.hpp"
#include "engine/narrowphase/manifold.hpp"

namespace rigor::engine {

template <class S>
struct TimeOfImpact {
    using Real = typename S::Real;
    bool hit = false;
    Real time = 0;             ///< time at which the shapes are within the tolerance of each other and do not
                               ///< overlap [s]
    Real exact = 0;            ///< time extrapolated to a gap of zero [s]
    Real approach = 0;         ///< closing speed of the closest points then [m/s], > 0 if converged
    ClosestPoints<S> closest;  ///< closest points at `time`
    int evaluations = 0;       ///< distance queries
    bool converged = true;     ///< false: gave up; the result is the last safe time
};

/// Gap that counts as touching for two shapes near `scale` [m] from the origin: far below their thickness,
/// above the rounding of their coordinates.
template <class S>
typename S::Real touchingGap(const MovingShape<S>& a, const MovingShape<S>& b);

/// The first time in [0, horizon] at which the shapes are within touchingGap and approaching, by conservative
/// advancement (time_of_impact.cpp). An approach that starts from touching, or any approach of shapes whose
/// contact is `known` to the solver, counts only if it would carry them deeper into each other than a quarter
/// of their thickness until the horizon. At least one of the shapes must not be a half-space.
template <class S>
TimeOfImpact<S> timeOfImpact(const MovingShape<S>& a, const MovingShape<S>& b, typename S::Real horizon,
                             bool known = false);

/// The manifold of a hit where it takes place: the narrow phase's within twice the touching gap, or the
/// closest points where it finds none. There must be at least one point.
template <class S>
void collideAt(const MovingShape<S>& a, const MovingShape<S>& b, const TimeOfImpact<S>& impact,
               const NarrowPhase<S>& narrowPhase, Manifold<S>& manifold);

}  // namespace rigor::engine
