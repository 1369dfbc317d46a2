// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Poses and velocities of bodies as MuJoCo's coordinates: those of a free body are its own, those of a body that hangs
// on a joint are relative to the body it hangs on. What its joint does not allow is lost.
#include "adapters/mujoco/world.hpp"

namespace rigor::mujoco {

using adapter::BodyState;

/// World pose of MuJoCo's frame of a body.
Pose MujocoWorld::linkPose(int body, const BodyState& state) const {
    return Pose{state.position, state.orientation} * model_.forest.links[body].frame;
}

void MujocoWorld::placeFree(int body, const Pose& pose, const BodyState& state) {
    const mjModel& model = *model_.model;
    const int id = model_.bodies[body];
    mjtNum* q = data_->qpos + model.jnt_qposadr[model.body_jntadr[id]];
    mjtNum* v = data_->qvel + model.body_dofadr[id];
    if (planar_) {
        q[0] = pose.position.x;
        q[1] = pose.position.y;
        q[2] = adapter::nearestTurn(angleAboutZ(pose.orientation), q[2]);
        v[0] = state.velocity.x;
        v[1] = state.velocity.y;
        v[2] = state.angularVelocity.z;
        return;
    }
    toMujoco(pose.position, q);
    toMujoco(pose.orientation, q + 3);
    toMujoco(state.velocity, v);
    toMujoco(rotateInverse(pose.orientation, state.angularVelocity), v + 3);
}

void MujocoWorld::placeLink(int body, std::span<const BodyState> states) {
    const Link& link = model_.forest.links[body];
    if (link.fixed) return;
    if (link.joint == kNone) return placeFree(body, linkPose(body, states[body]), states[body]);
    const mjModel& model = *model_.model;
    const int id = model_.bodies[body], first = model.body_jntadr[id];
    const adapter::LinkMotion motion = adapter::motionOf(model_.forest, scenario_, body, states);
    for (int k = 0; k < model.body_jntnum[id]; ++k) {
        mjtNum* q = data_->qpos + model.jnt_qposadr[first + k];
        mjtNum* v = data_->qvel + model.jnt_dofadr[first + k];
        const Vec3 axis = fromMujoco(model.jnt_axis + 3 * (first + k));
        switch (model.jnt_type[first + k]) {
            case mjJNT_BALL:
                toMujoco(motion.turned, q);
                toMujoco(motion.turn, v);
                break;
            case mjJNT_HINGE:
                q[0] = adapter::nearestTurn(adapter::turnAbout(motion, axis), q[0]);
                v[0] = dot(motion.turn, axis);
                break;
            default: {
                const adapter::Travel travel = adapter::travelOf(link, motion, axis);
                q[0] = travel.length;
                v[0] = travel.speed;
            }
        }
    }
}

void MujocoWorld::setStates(std::span<const BodyState> states) {
    std::vector<BodyState> all(scenario_.bodies.size());
    readStates(all);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (scenario_.bodies[i].type == scenario::BodyType::Dynamic) all[i] = states[i];
    for (const int body : model_.forest.order)
        if (scenario_.bodies[body].type == scenario::BodyType::Dynamic) placeLink(body, all);
    mju_zero(data_->qacc_warmstart, model_.model->nv);
    updatePoses();
}

}  // namespace rigor::mujoco
