// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { DistanceConstraint, HingeConstraint, LockConstraint, PointToPointConstraint } from 'cannon-es';
import * as rg from '../../sdk/rigor_guest.mjs';
import { fromCannon, toCannon } from './vectors.mjs';

function refuse(joint, what, documentation = '') {
    throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
}

function refuseSprings(joint) {
    for (const axis of joint.axes)
        if (axis.stiffness > 0 || axis.damping > 0) refuse(joint, `spring of a ${joint.type}`);
}

function hinge(joint, a, b, dt) {
    const [axis] = joint.axes;
    if (axis?.mode === 'limited' || axis?.mode === 'locked') refuse(joint, 'hinge.limit');
    const created = new HingeConstraint(a.body, b.body, {
        pivotA: toCannon(a.place(joint.anchor_a)),
        pivotB: toCannon(b.place(joint.anchor_b)),
        axisA: toCannon(a.turn(joint.axis_a)),
        axisB: toCannon(b.turn(joint.axis_b)),
    });
    if (axis?.motor_max_force > 0) {
        created.enableMotor();
        // Positive speed turns A against B.
        created.setMotorSpeed(-axis.motor_speed);
        // The solver bounds impulses by it.
        created.setMotorMaxForce(axis.motor_max_force * dt);
    }
    return created;
}

/**
 * The library's distance holds the centres of mass together; between other points it is a ball's first equation, which is
 * turned along the line of the anchors in each step.
 */
class AnchoredDistance extends DistanceConstraint {
    constructor(a, b, pivotA, pivotB, length) {
        super(a, b, length);
        Object.assign(this, { pivotA, pivotB });
    }
    update() {
        const { bodyA, bodyB, pivotA, pivotB, distance } = this;
        const [equation] = this.equations;
        bodyA.quaternion.vmult(pivotA, equation.ri);
        bodyB.quaternion.vmult(pivotB, equation.rj);
        const { ni } = equation;
        bodyB.position.vsub(bodyA.position, ni);
        ni.vadd(equation.rj, ni);
        ni.vsub(equation.ri, ni);
        ni.normalize();
        // The equation's error is the gap of its two points along ni: the first one is moved by the length.
        ni.scale(distance, this.reach ??= ni.clone());
        equation.ri.vadd(this.reach, equation.ri);
    }
}

const makers = {
    ball: (joint, a, b) =>
        new PointToPointConstraint(a.body, toCannon(a.place(joint.anchor_a)), b.body, toCannon(b.place(joint.anchor_b))),
    hinge,
    fixed: (_joint, a, b) => new LockConstraint(a.body, b.body),
    distance(joint, a, b) {
        if (joint.axes[0].mode !== 'locked') refuse(joint, 'a distance that is no rod');
        const pivots = [toCannon(a.place(joint.anchor_a)), toCannon(b.place(joint.anchor_b))];
        return new AnchoredDistance(a.body, b.body, ...pivots, joint.length);
    },
};

/** A constraint of the library. Sides have `body`, and the functions `place` and `turn` into its frame. */
export function jointOf(joint, a, b, dt, settings) {
    refuseSprings(joint);
    const created = makers[joint.type](joint, a, b, dt);
    created.collideConnected = joint.collide_connected;
    created.anchorOnB = toCannon(b.place(joint.anchor_b));
    const step = settings.joint_step === 'scenario' ? dt : 1 / 60;
    for (const equation of created.equations)
        equation.setSpookParams(Number(settings.joint_stiffness), Number(settings.joint_relaxation), step);
    return created;
}

/** Force and torque on B that the solver has found for the last step; the torque is about the joint's anchor. */
export function reactionOf(joint) {
    const sums = { force: [0, 0, 0], torque: [0, 0, 0] };
    for (const { multiplier, jacobianElementB: on } of joint.equations) {
        sums.force = rg.sum(sums.force, rg.scaled(multiplier, fromCannon(on.spatial)));
        sums.torque = rg.sum(sums.torque, rg.scaled(multiplier, fromCannon(on.rotational)));
    }
    const arm = fromCannon(joint.bodyB.previousQuaternion.vmult(joint.anchorOnB));
    return { force: rg.norm(sums.force), torque: rg.norm(rg.difference(sums.torque, rg.cross(arm, sums.force))) };
}
