// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The speed at which two bodies come together at a point of their manifold.
#pragma once

#include "engine/contacts/contact.hpp"
#include "engine/contacts/row_lag.hpp"
#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// Velocity of a point's parts along the normal [m/s]; < 0: they approach.
template <class S>
typename S::Real normalSpeed(const BodyArrays<S>& bodies, const Contact<S>& contact,
                             const ManifoldPoint<S>& point) {
    const std::uint32_t a = contact.bodyA, b = contact.bodyB;
    const typename S::Vec &n = contact.manifold.normal, rA = point.pointA - bodies.pose[a].p,
                          rB = point.pointB - bodies.pose[b].p;
    return n.dot(relativeVelocity<S>({rA, rB, n}, bodies.velocity[a], bodies.velocity[b]));
}

}  // namespace rigor::engine
