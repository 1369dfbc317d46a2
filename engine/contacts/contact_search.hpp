// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distances of the contact search.
#pragma once

#include "engine/contacts/bounding_volume.hpp"
#include "engine/state/island_kind.hpp"

namespace rigor::engine {

/// WorldDef's settings of the same names, and what follows from them.
template <class S>
struct ContactSearch {
    using Real = typename S::Real;
    Real speculativeDistance = 0, cacheTolerance = 0, boxMargin = 0;
    Real motionTime = 0;        ///< speculativeMotion of the step [s]
    Real largeMotionTime = 0;   ///< the same where a body of a large island takes part; 0: there is none [s]
    bool bouncesAhead = false;  ///< the solver keeps points that bounce until they touch
    BoundingVolume volume{};    ///< the volume that stands for a shape
    Real largeCacheTolerance = 0;  ///< cacheTolerance of bodies of large islands (pipeline/island_method.hpp)

    /// Time in which the motion of shapes is looked ahead, of all or of some pairs [s].
    Real longestMotionTime() const { return motionTime > 0 ? motionTime : largeMotionTime; }
    Real toleranceOf(IslandKind islands) const {
        return islands == IslandKind::Large ? largeCacheTolerance : cacheTolerance;
    }
};

}  // namespace rigor::engine
