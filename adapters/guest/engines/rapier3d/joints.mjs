// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { distanceData, drive, driveAxis } from '../shared/rapier_joints.mjs';
import { openAxes, wheelAsSixDof } from '../shared/six_dof.mjs';
import { quatToRapier, toRapier } from './vectors.mjs';

function anyNormal(axis) {
    const normal = rg.cross(axis, Math.abs(axis[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]);
    return rg.scaled(1 / rg.norm(normal), normal);
}

/** The rotation that takes x to the unit vector `axis`, and y to its normal `y`, by default whichever. */
function frameAlong(axis, y = anyNormal(axis)) {
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
    six_dof: (joint) => {
        const locked = openAxes(joint).reduce((mask, axis, k) => (axis === null ? mask | (1 << k) : mask), 0);
        return RAPIER.JointData.generic(origin, origin, { x: 1, y: 0, z: 0 }, locked);
    },
};

const kGeneric = 'dynamics/impulse_joint.d.ts, JointData.generic';

/** Adds a joint. A side is a body of Rapier and the pose of the scenario's at the start. */
export function addJoint(world, given, a, b) {
    const joint = given.type === 'wheel' ? wheelAsSixDof(given, a.pose, b.pose, kGeneric) : given;
    if (joint.type === 'distance') {
        const anchored = distanceData(RAPIER, joint, toRapier(joint.anchor_a), toRapier(joint.anchor_b));
        world.createImpulseJoint(anchored, a.body, b.body, true).setContactsEnabled(joint.collide_connected);
        return;
    }
    const created = world.createImpulseJoint(data[joint.type](joint), a.body, b.body, true);
    // One frame in the world, seen from both bodies.
    const normal = joint.type === 'six_dof' ? joint.normal_a : undefined;
    const inWorld = rg.quaternionProduct(a.pose.orientation, frameAlong(joint.axis_a, normal));
    const frameIn = ({ pose }) => quatToRapier(rg.quaternionProduct(rg.conjugate(pose.orientation), inWorld));
    created.setLocalFrame1(toRapier(joint.anchor_a), frameIn(a));
    created.setLocalFrame2(toRapier(joint.anchor_b), frameIn(b));
    created.setContactsEnabled(joint.collide_connected);
    drive(RAPIER, created, joint);
    if (joint.type === 'six_dof')
        openAxes(joint).forEach((axis, k) => {
            if (axis !== null) driveAxis(RAPIER, created, k, axis, joint);
        });
}
