// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { quatToRapier, toRapier } from './shapes.mjs';

/** The rotation that takes x to the unit vector `axis`, and y to whichever normal of it. */
function frameAlong(axis) {
    const other = Math.abs(axis[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
    let y = rg.cross(axis, other);
    y = rg.scaled(1 / rg.norm(y), y);
    const z = rg.cross(axis, y);
    // Quaternion of the matrix with the columns axis, y, z; the largest of its components first.
    const m = [axis, y, z];
    const trace = m[0][0] + m[1][1] + m[2][2];
    const q = [
        1 + trace,
        1 + m[0][0] - m[1][1] - m[2][2],
        1 - m[0][0] + m[1][1] - m[2][2],
        1 - m[0][0] - m[1][1] + m[2][2],
    ];
    const largest = q.indexOf(Math.max(...q));
    const [xy, xz, yz] = [m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]];
    const [wx, wy, wz] = [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]];
    const row = [
        [q[0], wx, wy, wz],
        [wx, q[1], xy, xz],
        [wy, xy, q[2], yz],
        [wz, xz, yz, q[3]],
    ][largest];
    return rg.scaled(1 / rg.norm(row), row);
}

const origin = { x: 0, y: 0, z: 0 };
const identity = { w: 1, x: 0, y: 0, z: 0 };
const data = {
    ball: () => RAPIER.JointData.spherical(origin, origin),
    fixed: () => RAPIER.JointData.fixed(origin, identity, origin, identity),
    hinge: () => RAPIER.JointData.revolute(origin, origin, { x: 1, y: 0, z: 0 }),
    slider: () => RAPIER.JointData.prismatic(origin, origin, { x: 1, y: 0, z: 0 }),
};

/** Adds a joint between two bodies. `poseA`, `poseB`: those of the scenario's bodies at the start. */
export function addJoint(world, joint, bodyA, bodyB, poseA, poseB) {
    const created = world.createImpulseJoint(data[joint.type](), bodyA, bodyB, true);
    // One frame in the world, seen from both bodies.
    const inWorld = rg.quaternionProduct(poseA.orientation, frameAlong(joint.axis_a));
    const frameIn = (pose) => rg.quaternionProduct(rg.conjugate(pose.orientation), inWorld);
    created.setLocalFrame1(toRapier(joint.anchor_a), quatToRapier(frameIn(poseA)));
    created.setLocalFrame2(toRapier(joint.anchor_b), quatToRapier(frameIn(poseB)));
    created.setContactsEnabled(joint.collide_connected);
    const [axis] = joint.axes;
    if ((joint.type === 'hinge' || joint.type === 'slider') && axis) drive(created, joint, axis);
    return created;
}

function drive(created, joint, axis) {
    if (axis.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    if (axis.mode === 'limited') created.setLimits(axis.lower ?? -1e9, axis.upper ?? 1e9);
    const spring = axis.stiffness > 0 || axis.damping > 0;
    if (axis.motor_max_force > 0 && spring)
        throw new rg.Unsupported(`motor and spring of one ${joint.type}`, '', `joint '${joint.name}'`);
    created.configureMotorModel(RAPIER.MotorModel.ForceBased);
    if (spring) created.configureMotorPosition(axis.target, axis.stiffness, axis.damping);
    if (axis.motor_max_force > 0) {
        // The acceleration-based model keeps the speed whatever the mass; the force has its bound.
        created.configureMotorModel(RAPIER.MotorModel.AccelerationBased);
        created.configureMotorVelocity(axis.motor_speed, 1e6);
        created.setMotorMaxForce(axis.motor_max_force);
    }
}
