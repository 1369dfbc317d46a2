// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { angleOf, B, withRot, withVec2 } from './library.mjs';

/** The library keeps limits of hinges below this [rad]. */
const kMostAngle = 0.99 * Math.PI;

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

function refuseSprings(joint, axis) {
    if (axis.stiffness > 0 || axis.damping > 0)
        throw new rg.Unsupported(`spring of a ${joint.type}`, '', `joint '${joint.name}'`);
}

const kinds = {
    hinge: {
        def: () => B.b2DefaultRevoluteJointDef(),
        create: (world, def) => B.b2CreateRevoluteJoint(world, def),
        set(def, axis, joint) {
            if (axis.mode === 'limited') {
                const [lower, upper] = [axis.lower ?? -kMostAngle, axis.upper ?? kMostAngle];
                if (lower < -kMostAngle || upper > kMostAngle || axis.lower === null || axis.upper === null)
                    throw new rg.Unsupported('hinge limits beyond half a turn', '', `joint '${joint.name}'`);
                Object.assign(def, { enableLimit: true, lowerAngle: lower, upperAngle: upper });
            }
            if (axis.motor_max_force > 0)
                Object.assign(def, { enableMotor: true, motorSpeed: axis.motor_speed, maxMotorTorque: axis.motor_max_force });
        },
    },
    slider: {
        def: () => B.b2DefaultPrismaticJointDef(),
        create: (world, def) => B.b2CreatePrismaticJoint(world, def),
        set(def, axis) {
            if (axis.mode === 'limited')
                Object.assign(def, {
                    enableLimit: true,
                    lowerTranslation: axis.lower ?? -1e5,
                    upperTranslation: axis.upper ?? 1e5,
                });
            if (axis.motor_max_force > 0)
                Object.assign(def, { enableMotor: true, motorSpeed: axis.motor_speed, maxMotorForce: axis.motor_max_force });
        },
    },
    fixed: { def: () => B.b2DefaultWeldJointDef(), create: (world, def) => B.b2CreateWeldJoint(world, def), set() {} },
    distance: {
        def: () => B.b2DefaultDistanceJointDef(),
        create: (world, def) => B.b2CreateDistanceJoint(world, def),
        set(def, axis, joint) {
            def.length = joint.length;
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
export function addJoint(world, joint, bodyA, bodyB, poseA, poseB) {
    const kind = kinds[joint.type];
    const [axis] = joint.axes;
    const driven = axis && (axis.mode !== 'free' || axis.motor_max_force > 0 || axis.stiffness > 0 || axis.damping > 0);
    if (driven) refuseSprings(joint, axis);
    if ((joint.type === 'hinge' || joint.type === 'slider') && axis?.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    const def = kind.def();
    const along = rg.rotate(poseA.orientation, joint.axis_a);
    const angle = joint.type === 'slider' ? Math.atan2(along[1], along[0]) : 0;
    const base = def.base;
    base.bodyIdA = bodyA;
    base.bodyIdB = bodyB;
    base.collideConnected = joint.collide_connected;
    setFrame(base, 'localFrameA', joint.anchor_a, angle - angleOf(poseA.orientation));
    setFrame(base, 'localFrameB', joint.anchor_b, angle - angleOf(poseB.orientation));
    def.base = base;
    if (axis) kind.set(def, axis, joint);
    const created = kind.create(world, def);
    def.delete();
    return created;
}
