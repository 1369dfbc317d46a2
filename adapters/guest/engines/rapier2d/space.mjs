// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier's package in 2D, as shared/rapier_world.mjs needs it.
import RAPIER from '@dimforge/rapier2d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { planarJoint } from '../shared/planar_six_dof.mjs';
import { distanceData, drive } from '../shared/rapier_joints.mjs';

export const kinds = 'dynamics/impulse_joint.d.ts, class JointData in 2D: fixed, spring, rope, revolute, prismatic';

const toRapier = ([x, y]) => ({ x, y });
const fromVector = ({ x, y }) => [x, y, 0];

/** Joints have one axis for both bodies: Rapier's bodies start unturned, so that it is that of the world. */
function dataOf(joint, a, b) {
    const anchorIn = ({ frame }, anchor) => toRapier(rg.rotate(frame, anchor));
    const [anchorA, anchorB] = [anchorIn(a, joint.anchor_a), anchorIn(b, joint.anchor_b)];
    const { JointData } = RAPIER;
    if (joint.type === 'distance') return distanceData(RAPIER, joint, anchorA, anchorB);
    if (joint.type === 'hinge') return JointData.revolute(anchorA, anchorB);
    if (joint.type === 'fixed') return JointData.fixed(anchorA, 0, anchorB, 0);
    return JointData.prismatic(anchorA, anchorB, toRapier(rg.rotate(a.pose.orientation, joint.axis_a)));
}

export const space = {
    RAPIER,
    vector: toRapier,
    fromVector,
    components: ([x, y]) => [x, y],
    rotation: ([w, , , z]) => 2 * Math.atan2(z, w),
    fromRotation: (angle) => [Math.cos(0.5 * angle), 0, 0, Math.sin(0.5 * angle)],
    turn: (w) => w[2],
    fromTurn: (rate) => [0, 0, rate],
    frameOf: (body) => body.orientation,

    addJoint(world, given, a, b) {
        const joint = planarJoint(given, kinds);
        if (joint.type === 'wheel') throw new rg.Unsupported('a six_dof with a travel and an angle', kinds, `joint '${joint.name}'`);
        const created = world.createImpulseJoint(dataOf(joint, a, b), a.body, b.body, true);
        created.setContactsEnabled(joint.collide_connected);
        drive(RAPIER, created, joint);
    },

    withMass: (desc, body, frame) =>
        desc.setAdditionalMassProperties(body.mass, toRapier(rg.rotate(frame, body.center_of_mass)), body.inertia[8]),
    inertiaOf: (body) => [0, 0, 0, 0, 0, 0, 0, 0, body.principalInertia()],

    builders: {
        circle: (s) => ({ desc: RAPIER.ColliderDesc.ball(s.radius) }),
        box: (s) => ({ desc: RAPIER.ColliderDesc.cuboid(s.half_extents[0], s.half_extents[1]) }),
        capsule: (s) => ({ desc: RAPIER.ColliderDesc.capsule(s.half_length, s.radius) }),
        polygon: (s) => ({
            desc: RAPIER.ColliderDesc.convexHull(new Float32Array(s.vertices.flatMap(([x, y]) => [x, y]))),
        }),
        segment: (s) => ({ desc: RAPIER.ColliderDesc.segment(toRapier(s.a), toRapier(s.b)) }),
        chain: (s) => {
            const points = new Float32Array(s.vertices.flatMap(([x, y]) => [x, y]));
            const pairs = s.vertices.slice(1).flatMap((_, k) => [k, k + 1]);
            if (s.loop) pairs.push(s.vertices.length - 1, 0);
            return { desc: RAPIER.ColliderDesc.polyline(points, new Uint32Array(pairs)) };
        },
        // Its surface contains the origin of the collider.
        half_plane: (s) => ({
            desc: new RAPIER.ColliderDesc(new RAPIER.HalfSpace(toRapier(s.normal))),
            offset: rg.scaled(s.offset, s.normal),
        }),
    },
};
