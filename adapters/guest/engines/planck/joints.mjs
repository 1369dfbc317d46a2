// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { DistanceJoint, PrismaticJoint, RevoluteJoint, RopeJoint, WeldJoint } from 'planck';
import * as rg from '../../sdk/rigor_guest.mjs';
import { angleOf, toPlanck } from './shapes.mjs';

/** Limits and motor of a hinge or slider; `names` are those of the library's keys. */
function drive(joint, names) {
    const [axis] = joint.axes;
    if (!axis) return {};
    if (axis.stiffness > 0 || axis.damping > 0)
        throw new rg.Unsupported(`spring of a ${joint.type}`, '', `joint '${joint.name}'`);
    if (axis.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    const keys = {};
    if (axis.mode === 'limited')
        Object.assign(keys, { enableLimit: true, [names.lower]: axis.lower ?? -1e9, [names.upper]: axis.upper ?? 1e9 });
    if (axis.motor_max_force > 0)
        Object.assign(keys, { enableMotor: true, motorSpeed: axis.motor_speed, [names.force]: axis.motor_max_force });
    return keys;
}

export function jointOf(joint, bodyA, bodyB, poseA, poseB) {
    const keys = {
        bodyA,
        bodyB,
        collideConnected: joint.collide_connected,
        localAnchorA: toPlanck(joint.anchor_a),
        localAnchorB: toPlanck(joint.anchor_b),
        referenceAngle: angleOf(poseB.orientation) - angleOf(poseA.orientation),
    };
    switch (joint.type) {
        case 'hinge':
            return new RevoluteJoint({
                ...keys,
                ...drive(joint, { lower: 'lowerAngle', upper: 'upperAngle', force: 'maxMotorTorque' }),
            });
        case 'slider':
            return new PrismaticJoint({
                ...keys,
                localAxisA: toPlanck(joint.axis_a),
                ...drive(joint, { lower: 'lowerTranslation', upper: 'upperTranslation', force: 'maxMotorForce' }),
            });
        case 'fixed':
            return new WeldJoint(keys);
        default:
            return distance(joint, keys);
    }
}

/** A rod, or a rope: the library bounds a distance from above alone. */
function distance(joint, keys) {
    const [axis] = joint.axes;
    const refuse = (what, documentation = '') => {
        throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
    };
    if (axis.stiffness > 0 || axis.damping > 0) refuse('spring of a distance');
    if (axis.mode === 'locked') return new DistanceJoint({ ...keys, length: joint.length });
    if (axis.mode === 'free') refuse('a distance that is free');
    if (axis.lower > 0 || axis.upper === null)
        refuse('a least distance', 'planck.d.ts, interface RopeJointOpt: maxLength alone');
    return new RopeJoint({ ...keys, maxLength: axis.upper });
}
