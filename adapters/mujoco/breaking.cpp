// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints that break. MuJoCo breaks none, but an equality constraint can be switched off: joints with a strength are
// equalities, and after a step in which one has borne more it is off.
#include <algorithm>
#include <cmath>

#include "adapters/mujoco/world.hpp"

namespace rigor::mujoco {

using scenario::Joint;

/// Force, and torque about the anchor, in the last step. The rows of `connect` are a force at its point. Those of `weld`
/// are a force at the anchor and twice the torque, for their error is the vector part of a quaternion: half an angle.
MujocoWorld::Reaction MujocoWorld::reactionOf(int index) const {
    const Joint& joint = scenario_.joints[index];
    const std::vector<int>& equalities = model_.equalities.at(index);
    const int body = joint.bodyB != kNone ? joint.bodyB : joint.bodyA;
    const adapter::BodyState state = stateOf(body);
    const Vec3 axis = rotate(state.orientation, joint.bodyB != kNone ? joint.axisB : joint.axisA);
    Vec3 force, torque;
    for (int row = 0; row < data_->nefc; ++row) {
        if (data_->efc_type[row] != mjCNSTR_EQUALITY) continue;
        const auto found = std::find(equalities.begin(), equalities.end(), data_->efc_id[row]);
        if (found == equalities.end()) continue;
        const mjtNum* rows = data_->efc_force + row;
        const int kind = model_.model->eq_type[*found];
        if (kind == mjEQ_TENDON) return {std::abs(rows[0]), 0.0};
        const Vec3 here = fromMujoco(rows);
        force = force + here;
        if (kind == mjEQ_WELD) torque = torque + 0.5 * fromMujoco(rows + 3);
        if (kind == mjEQ_CONNECT && found != equalities.begin())
            torque = torque + cross(kConnectArm * axis, here);
        row += kind == mjEQ_WELD ? 5 : 2;
    }
    return {norm(force), norm(torque)};
}

void MujocoWorld::breakJoints() {
    bool any = false;
    for (const auto& [index, equalities] : model_.equalities) {
        const Joint& joint = scenario_.joints[index];
        if (!canBreak(joint) || !jointHolds(index)) continue;
        const Reaction reaction = reactionOf(index);
        if (reaction.force <= joint.breakForce && reaction.torque <= joint.breakTorque) continue;
        for (const int equality : equalities) model_.model->eq_active[equality] = 0;
        any = true;
    }
    if (any) updatePairs();
}

bool MujocoWorld::jointHolds(int joint) const {
    const auto found = model_.equalities.find(joint);
    return found == model_.equalities.end() || model_.model->eq_active[found->second.front()] != 0;
}

/// Bodies that a joint kept from colliding collide once it has broken.
void MujocoWorld::updatePairs() {
    pairs_.keepApart(scenario_, [&](std::size_t joint) { return jointHolds(static_cast<int>(joint)); });
}

}  // namespace rigor::mujoco
