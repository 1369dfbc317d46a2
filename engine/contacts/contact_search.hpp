// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distances of the contact search.
#pragma once

#include "engine/state/island_size.hpp"

namespace rigor::engine {

/// WorldDef's settings of the same names, and what follows from them.
template <class S>
struct ContactSearch {
    using Real = typename S::Real;
    Real speculativeDistance = 0, cacheTolerance = 0, boxMargin = 0;
    Real motionTime = 0;           ///< speculativeMotion of the step [s]
    bool bouncesAhead = false;     ///< the solver keeps points that bounce until they touch
    Real largeCacheTolerance = 0;  ///< cacheTolerance of bodies of large islands (pipeline/island_method.hpp)

    Real toleranceOf(IslandSize islands) const {
        return islands == IslandSize::Large ? largeCacheTolerance : cacheTolerance;
    }
};

}  // namespace rigor::engine
