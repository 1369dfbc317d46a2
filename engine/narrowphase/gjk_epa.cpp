// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The "gjk_epa" narrow phase: distance and normal of every pair of bounded convex shapes by GJK between their
// cores, by EPA where the cores overlap (gjk.cpp, 2d/epa.cpp, 3d/epa.cpp); contact points by clipping the
// features that support the normal (feature_manifold.cpp). Half-spaces are the closed forms of "sat".
//
// Known limits: on the pairs of sat.cpp no wrong verdict beyond 1e-9 m of touching, and depths and what
// normals lose within 2e-15 of size and place. Curved shapes with a ring of equally deep penetration vectors
// (a cylinder in a cone about one axis) run out of EPA's vertices; the descents of mpr.cpp bring them to the
// end.
#include "engine/narrowphase/minkowski.hpp"
#include "engine/narrowphase/narrowphases.hpp"
#include "engine/narrowphase/surface_contact.hpp"

namespace rigor::engine {

template <class S>
void collideGjkEpa(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                   typename S::Real speculativeDistance, Manifold<S>& out) {
    if (collideSurfaces<S>(&collideGjkEpa<S>, a, Xa, b, Xb, speculativeDistance, out)) return;
    if (std::holds_alternative<HalfSpace<S>>(a) || std::holds_alternative<HalfSpace<S>>(b)) {
        collideSat<S>(a, Xa, b, Xb, speculativeDistance, out);
        return;
    }
    out.count = 0;
    const Minkowski<S> D(a, Xa, b, Xb);
    CoreContact<S> contact = closestCores<S>(D);
    if (out.memory.count > 0)
        keepNormal<S>(a, b, D, rotateInverse<typename S::Real>(Xa.q, out.memory.normal), contact);
    if (contact.distance - roundingRadius<S>(a) - roundingRadius<S>(b) > speculativeDistance) return;
    featureManifold<typename S::Real>(a, b, D, contact, speculativeDistance, out);
    toWorldFrame<S>(out, Xa);
    remember(out);
}

#define INSTANTIATE(S)                                                                               \
    template void collideGjkEpa<S>(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, \
                                   S::Real, Manifold<S>&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
