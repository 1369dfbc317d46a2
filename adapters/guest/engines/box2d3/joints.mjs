// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { planarJoint } from '../shared/planar_six_dof.mjs';
import { directionOf, sidesOf, springOf } from '../shared/springs_2d.mjs';
import { angleOf, B, withRot, withVec2 } from './library.mjs';

/** The library keeps limits of hinges below this [rad]. */
const kMostAngle = 0.99 * Math.PI;

const kWheels = 'Box2D.deluxe.d.ts, interface b2WheelJointDef: limits and spring of the travel, motor of the angle';
const kTravels = 'Box2D.deluxe.d.ts, b2Create...Joint: none leaves two travels free and holds anything';

function setFrame(base, key, anchor, angle) {
    const frame = new B.b2Transform();
    withVec2(anchor, (p) => {
        frame.p = p;
    });
    withRot(angle, (q) => {
        frame.q = q;
    });
    base[key] = frame;
    frame.delete();
}

/** The library's keys of a spring; none without one. */
const enabled = (spring) => (spring ? { enableSpring: true, ...spring } : {});

/** The library's wheels have no target of their spring: A's anchor is moved by it along the axis. */
function wheelTarget(joint) {
    return joint.type === 'wheel' ? (joint.axes.find(({ name }) => name === 'travel')?.target ?? 0) : 0;
}

const kinds = {
    hinge: {
        def: () => B.b2DefaultRevoluteJointDef(),
        create: (world, def) => B.b2CreateRevoluteJoint(world, def),
        set(def, axis, joint, sides) {
            if (axis.mode === 'limited') {
                const [lower, upper] = [axis.lower ?? -kMostAngle, axis.upper ?? kMostAngle];
                if (lower < -kMostAngle || upper > kMostAngle || axis.lower === null || axis.upper === null)
                    throw new rg.Unsupported('hinge limits beyond half a turn', '', `joint '${joint.name}'`);
                Object.assign(def, { enableLimit: true, lowerAngle: lower, upperAngle: upper });
            }
            if (axis.motor_max_force > 0)
                Object.assign(def, { enableMotor: true, motorSpeed: axis.motor_speed, maxMotorTorque: axis.motor_max_force });
            Object.assign(def, enabled(springOf(axis, sides, joint)));
            def.targetAngle = axis.target ?? 0;
        },
    },
    slider: {
        def: () => B.b2DefaultPrismaticJointDef(),
        create: (world, def) => B.b2CreatePrismaticJoint(world, def),
        set(def, axis, joint, sides, along) {
            if (axis.mode === 'limited')
                Object.assign(def, {
                    enableLimit: true,
                    lowerTranslation: axis.lower ?? -1e5,
                    upperTranslation: axis.upper ?? 1e5,
                });
            if (axis.motor_max_force > 0)
                Object.assign(def, { enableMotor: true, motorSpeed: axis.motor_speed, maxMotorForce: axis.motor_max_force });
            Object.assign(def, enabled(springOf(axis, sides, joint, along)));
            def.targetTranslation = axis.target ?? 0;
        },
    },
    wheel: {
        def: () => B.b2DefaultWheelJointDef(),
        create: (world, def) => B.b2CreateWheelJoint(world, def),
        set(def, _first, joint, sides, along) {
            const [travel, angle] = ['travel', 'angle'].map((name) => joint.axes.find((given) => given.name === name));
            def.enableSpring = false;
            if (travel?.mode === 'locked' || angle?.mode === 'locked' || angle?.mode === 'limited' || travel?.motor_max_force > 0)
                throw new rg.Unsupported('a wheel with locks, limits of its angle or a motor of its travel', kWheels, `joint '${joint.name}'`);
            if (travel) Object.assign(def, enabled(springOf(travel, sides, joint, along)));
            if (travel?.mode === 'limited')
                Object.assign(def, {
                    enableLimit: true,
                    lowerTranslation: (travel.lower ?? -1e5) - wheelTarget(joint),
                    upperTranslation: (travel.upper ?? 1e5) - wheelTarget(joint),
                });
            if (angle?.motor_max_force > 0)
                Object.assign(def, { enableMotor: true, motorSpeed: angle.motor_speed, maxMotorTorque: angle.motor_max_force });
        },
    },
    fixed: { def: () => B.b2DefaultWeldJointDef(), create: (world, def) => B.b2CreateWeldJoint(world, def), set() {} },
    distance: {
        def: () => B.b2DefaultDistanceJointDef(),
        create: (world, def) => B.b2CreateDistanceJoint(world, def),
        set(def, axis, joint, sides, along) {
            const spring = enabled(springOf(axis, sides, joint, along));
            def.length = spring.enableSpring ? axis.target : joint.length;
            if (axis.motor_max_force > 0) {
                // The library drives distances of joints that have a spring.
                const soft = spring.enableSpring ? {} : { enableSpring: true, hertz: 0, dampingRatio: 0 };
                Object.assign(def, soft, { enableMotor: true, motorSpeed: axis.motor_speed, maxMotorForce: axis.motor_max_force });
                if (!spring.enableSpring && axis.mode === 'free') return;
            }
            if (spring.enableSpring && axis.mode !== 'limited') {
                Object.assign(def, spring);
                return;
            }
            if (spring.enableSpring) throw new rg.Unsupported('limits and spring of one distance', '', `joint '${joint.name}'`);
            if (axis.mode === 'locked') return;
            if (axis.mode === 'free') throw new rg.Unsupported('a distance that is free', '', `joint '${joint.name}'`);
            // A rod whose spring has no stiffness is held by its limits alone.
            Object.assign(def, { enableSpring: true, hertz: 0, dampingRatio: 0, enableLimit: true });
            def.minLength = Math.max(0, axis.lower ?? 0);
            def.maxLength = axis.upper ?? 1e5;
        },
    },
};

/** Adds a joint between two bodies of these poses at the start. */
export function addJoint(world, scenario, given, bodyA, bodyB, poseA, poseB) {
    const joint = planarJoint(given, kTravels);
    const kind = kinds[joint.type];
    const [axis] = joint.axes;
    if ((joint.type === 'hinge' || joint.type === 'slider') && axis?.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    const def = kind.def();
    const along = directionOf(joint, poseA, poseB);
    const turned = joint.type === 'slider' || joint.type === 'wheel';
    const angle = turned ? Math.atan2(along[1], along[0]) : 0;
    const base = def.base;
    base.bodyIdA = bodyA;
    base.bodyIdB = bodyB;
    base.collideConnected = joint.collide_connected;
    const anchorA = rg.sum(joint.anchor_a, rg.scaled(wheelTarget(joint), joint.axis_a ?? [0, 0, 0]));
    setFrame(base, 'localFrameA', anchorA, angle - angleOf(poseA.orientation));
    setFrame(base, 'localFrameB', joint.anchor_b, angle - angleOf(poseB.orientation));
    def.base = base;
    const sides = sidesOf(scenario, joint, poseA, poseB);
    if (axis) kind.set(def, axis, joint, sides, along);
    const created = kind.create(world, def);
    def.delete();
    return created;
}

/** Force and torque of the last sub-step. */
export function reactionOf(joint) {
    const { x, y } = B.b2Joint_GetConstraintForce(joint);
    return { force: Math.hypot(x, y), torque: Math.abs(B.b2Joint_GetConstraintTorque(joint)) };
}
