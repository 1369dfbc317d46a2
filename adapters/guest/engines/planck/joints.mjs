// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { DistanceJoint, PrismaticJoint, RevoluteJoint, RopeJoint, WeldJoint, WheelJoint } from 'planck';
import * as rg from '../../sdk/rigor_guest.mjs';
import { planarJoint } from '../shared/planar_six_dof.mjs';
import { directionOf, sidesOf, springOf } from '../shared/springs_2d.mjs';
import { angleOf, toPlanck } from './shapes.mjs';

const kSprings = 'planck.d.ts, interfaces RevoluteJointOpt and PrismaticJointOpt: limits and a motor';
const kTravels = 'planck.d.ts, classes derived from Joint: none leaves two travels free and holds anything';

/** Limits and motor of a hinge or slider; `names` are those of the library's keys. */
function drive(joint, names) {
    const [axis] = joint.axes;
    if (!axis) return {};
    if (axis.stiffness > 0 || axis.damping > 0)
        throw new rg.Unsupported(`spring of a ${joint.type}`, kSprings, `joint '${joint.name}'`);
    if (axis.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    const keys = {};
    if (axis.mode === 'limited')
        Object.assign(keys, { enableLimit: true, [names.lower]: axis.lower ?? -1e9, [names.upper]: axis.upper ?? 1e9 });
    if (axis.motor_max_force > 0)
        Object.assign(keys, { enableMotor: true, motorSpeed: axis.motor_speed, [names.force]: axis.motor_max_force });
    return keys;
}

/** The library's keys of a spring. */
const softness = (spring) => (spring ? { frequencyHz: spring.hertz, dampingRatio: spring.dampingRatio } : {});

export function jointOf(scenario, given, bodyA, bodyB, poseA, poseB) {
    const joint = planarJoint(given, kTravels);
    const keys = {
        bodyA,
        bodyB,
        collideConnected: joint.collide_connected,
        localAnchorA: toPlanck(joint.anchor_a),
        localAnchorB: toPlanck(joint.anchor_b),
        referenceAngle: angleOf(poseB.orientation) - angleOf(poseA.orientation),
    };
    const along = directionOf(joint, poseA, poseB);
    const springAt = (axis) => springOf(axis, sidesOf(scenario, joint, poseA, poseB), joint, along);
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
        case 'wheel':
            return wheel(joint, keys, springAt);
        default:
            return distance(joint, keys, springAt);
    }
}

/** A wheel of frequency 0 has no number in the library after one step (measured): this is none for any mass [Hz]. */
const kNoSpring = 1e-6;

/** The library's wheels have a spring without a target, for which A's anchor is moved along the axis, and no limits. */
function wheel(joint, keys, springAt) {
    const [travel, angle] = ['travel', 'angle'].map((name) => joint.axes.find((given) => given.name === name));
    const isPlain = (travel?.mode ?? 'free') === 'free' && (angle?.mode ?? 'free') === 'free';
    if (!isPlain || travel?.motor_max_force > 0)
        throw new rg.Unsupported('limits of a wheel', 'planck.d.ts, interface WheelJointOpt: none', `joint '${joint.name}'`);
    const moved = rg.sum(joint.anchor_a, rg.scaled(travel?.target ?? 0, joint.axis_a));
    const motor = angle?.motor_max_force > 0;
    return new WheelJoint({
        ...keys,
        frequencyHz: kNoSpring,
        dampingRatio: 0,
        ...softness(travel && springAt(travel)),
        localAnchorA: toPlanck(moved),
        localAxisA: toPlanck(joint.axis_a),
        ...(motor ? { enableMotor: true, motorSpeed: angle.motor_speed, maxMotorTorque: angle.motor_max_force } : {}),
    });
}

/** A rod, a spring, or a rope: the library bounds a distance from above alone. */
function distance(joint, keys, springAt) {
    const [axis] = joint.axes;
    const refuse = (what, documentation = '') => {
        throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
    };
    const spring = springAt(axis);
    if (spring && axis.mode === 'limited') refuse('limits and spring of one distance');
    if (spring) return new DistanceJoint({ ...keys, length: axis.target, ...softness(spring) });
    if (axis.mode === 'locked') return new DistanceJoint({ ...keys, length: joint.length });
    if (axis.mode === 'free') refuse('a distance that is free');
    if (axis.lower > 0 || axis.upper === null)
        refuse('a least distance', 'planck.d.ts, interface RopeJointOpt: maxLength alone');
    return new RopeJoint({ ...keys, maxLength: axis.upper });
}
