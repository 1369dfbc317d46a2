// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The deepest point alone: a first engine does so with the result of GJK, EPA or SAT. Enough for spheres; a
// box at rest has nothing to keep it from tipping about its point, which jumps from corner to corner. The
// first of equally deep points is kept.
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"

namespace rigor::engine {

ManifoldTraits manifoldDeepestTraits() {
    return {};
}

template <class S>
void manifoldDeepest(const ManifoldPair<S>&, ManifoldCache<S>&, Manifold<S>& manifold) {
    int deepest = 0;
    for (int i = 1; i < manifold.count; ++i)
        if (manifold.points[i].separation < manifold.points[deepest].separation) deepest = i;
    manifold.points[0] = manifold.points[deepest];
    manifold.count = 1;
}

RIGOR_INSTANTIATE_MANIFOLD(manifoldDeepest);

}  // namespace rigor::engine
