// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario's exact pair coefficients inside Bullet. Bullet multiplies per-body coefficients; its contact
// callback is a process global, so what belongs to one world hangs on the bodies' user pointers.
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>

#include <vector>

#include "adapters/interface/pair_table.hpp"

namespace rigor::bullet {

/// Data behind a collision object's user pointer, read by Bullet's callbacks.
struct BodyTag {
    const adapter::PairTable* table = nullptr;
    int body = 0;
    std::vector<int> materials;              ///< material by shape index
    const scenario::Body* source = nullptr;  ///< null where no surface moves
    adapter::Pose frame;                     ///< the scenario's body frame in Bullet's, at the centre of mass
    int materialOf(int shape) const;
};

/// Installs the process-wide callback that writes the pair's coefficients into each new contact point. The
/// same function for every world.
void installContactCallback();

/// Friction and restitution that Bullet gives a contact point of these two objects' shapes, found by adding
/// one to a manifold through btManifoldResult, as a collision algorithm does.
scenario::PairCoefficients combinedByBullet(const btCollisionObject& a, int childA,
                                            const btCollisionObject& b, int childB);

}  // namespace rigor::bullet
