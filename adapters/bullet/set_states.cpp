// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies put somewhere else between two steps. Bullet keeps contacts, and the impulses that the next step
// starts from, with the overlapping pairs: those of a moved body are dropped and found again.
#include "adapters/bullet/convert.hpp"
#include "adapters/bullet/world.hpp"

namespace rigor::bullet {

void BulletWorld::setStates(std::span<const adapter::BodyState> states) {
    if (articulations_) throw adapter::notInAdapter("bullet", "setting of the states of btMultiBody's links");
    btOverlappingPairCache& pairs = *broadphase_->getOverlappingPairCache();
    for (std::size_t i = 0; i < records_.size(); ++i) {
        BodyRecord& record = *records_[i];
        btRigidBody& body = *record.body;
        if (body.isStaticOrKinematicObject()) continue;
        const adapter::BodyState& state = states[i];
        const btTransform pose = toBullet(Pose{state.position, state.orientation} * record.comFrame);
        const btVector3 velocity = toBullet(state.velocity), spin = toBullet(state.angularVelocity);
        body.setWorldTransform(pose);
        body.setInterpolationWorldTransform(pose);
        body.setLinearVelocity(velocity);
        body.setAngularVelocity(spin);
        body.setInterpolationLinearVelocity(velocity);
        body.setInterpolationAngularVelocity(spin);
        body.updateInertiaTensor();
        body.activate(true);
        world_->updateSingleAabb(&body);
        if (body.getBroadphaseHandle() != nullptr)
            pairs.cleanProxyFromPairs(body.getBroadphaseHandle(), dispatcher_.get());
    }
}

}  // namespace rigor::bullet
