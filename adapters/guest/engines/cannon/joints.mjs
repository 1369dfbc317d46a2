// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { ConeTwistConstraint, Constraint, DistanceConstraint, HingeConstraint, LockConstraint, PointToPointConstraint, Spring } from 'cannon-es';
import * as rg from '../../sdk/rigor_guest.mjs';
import { canBreak } from '../shared/breaking.mjs';
import { fromCannon, toCannon } from './vectors.mjs';

function refuse(joint, what, documentation = '') {
    throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
}

function refuseSprings(joint) {
    if (joint.type === 'distance') return;
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

/** The library's spring, whose force is applied where its other joints are prepared for the solver. */
class SpringDistance extends Constraint {
    constructor(a, b, options) {
        super(a, b);
        this.spring = new Spring(a, b, options);
        // The library takes 0 for no value.
        Object.assign(this.spring, { stiffness: options.stiffness, damping: options.damping });
    }
    update() {
        this.spring.applyForce();
    }
}

const kTwist = 'cannon-es.js, class ConeTwistConstraint, update: the tangents that measure the twist are found from either axis alone';

/** A ball whose swing may be bounded. */
function ballOrCone(joint, a, b) {
    const [swing, twist] = ['swing', 'twist'].map((name) => joint.axes.find((axis) => axis.name === name));
    const pivots = { pivotA: toCannon(a.place(joint.anchor_a)), pivotB: toCannon(b.place(joint.anchor_b)) };
    const isLocked = swing?.mode === 'locked';
    if (twist && twist.mode !== 'free') refuse(joint, 'cone_twist.limit of the twist', kTwist);
    if (swing?.mode !== 'limited' && !isLocked) return new PointToPointConstraint(a.body, pivots.pivotA, b.body, pivots.pivotB);
    const axes = { axisA: toCannon(a.turn(joint.axis_a)), axisB: toCannon(b.turn(joint.axis_b)) };
    if (isLocked) return new HingeConstraint(a.body, b.body, { ...pivots, ...axes });
    const created = new ConeTwistConstraint(a.body, b.body, { ...pivots, ...axes, angle: swing.upper ?? Math.PI });
    created.twistEquation.enabled = false;
    return created;
}

const makers = {
    ball: ballOrCone,
    cone_twist: ballOrCone,
    hinge,
    fixed: (_joint, a, b) => new LockConstraint(a.body, b.body),
    distance(joint, a, b) {
        const [{ mode, stiffness, damping, target }] = joint.axes;
        const pivots = [toCannon(a.place(joint.anchor_a)), toCannon(b.place(joint.anchor_b))];
        if (mode === 'free' && (stiffness > 0 || damping > 0) && !canBreak(joint)) {
            const [localAnchorA, localAnchorB] = pivots;
            return new SpringDistance(a.body, b.body, { restLength: target, stiffness, damping, localAnchorA, localAnchorB });
        }
        if (mode !== 'locked') refuse(joint, 'a distance with limits', 'cannon-es.d.ts, class DistanceConstraint: the distance to keep alone');
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
