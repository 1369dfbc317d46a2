// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';

const kRods = 'dynamics/impulse_joint.d.ts, enum JointType: Rope bounds a distance from above, Spring is soft';

/** Data of a joint of distances: a rope or a spring between two anchors, which are the library's vectors. */
export function distanceData(RAPIER, joint, anchorA, anchorB) {
    const [{ mode, lower, upper, target, stiffness, damping }] = joint.axes;
    const isSpring = stiffness > 0 || damping > 0;
    if (mode === 'free' && isSpring) return RAPIER.JointData.spring(target, stiffness, damping, anchorA, anchorB);
    if (mode === 'limited' && !isSpring && !(lower > 0) && upper !== null) return RAPIER.JointData.rope(upper, anchorA, anchorB);
    throw new rg.Unsupported('a distance that is neither a rope nor a spring', kRods, `joint '${joint.name}'`);
}

const kUnitAxis = { hinge: 3, slider: 0 };

/** Limits, motor or spring of a hinge or slider that Rapier has created. */
export function drive(RAPIER, created, joint) {
    const [axis] = joint.axes;
    if (!(joint.type in kUnitAxis) || !axis) return;
    if (axis.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    driveAxis(RAPIER, created, created.rawAxis?.() ?? kUnitAxis[joint.type], axis, joint);
}

/** The same of one coordinate, by Rapier's number, of any joint. */
export function driveAxis(RAPIER, created, number, axis, joint) {
    const { rawSet, handle } = created;
    if (axis.mode === 'limited') rawSet.jointSetLimits(handle, number, axis.lower ?? -1e9, axis.upper ?? 1e9);
    const spring = axis.stiffness > 0 || axis.damping > 0;
    if (axis.motor_max_force > 0 && spring)
        throw new rg.Unsupported(`motor and spring of one ${joint.type}`, '', `joint '${joint.name}'`);
    rawSet.jointConfigureMotorModel(handle, number, RAPIER.MotorModel.ForceBased);
    if (spring) rawSet.jointConfigureMotorPosition(handle, number, axis.target, axis.stiffness, axis.damping);
    if (axis.motor_max_force > 0) {
        // The acceleration-based model keeps the speed whatever the mass; the force has its bound.
        rawSet.jointConfigureMotorModel(handle, number, RAPIER.MotorModel.AccelerationBased);
        rawSet.jointConfigureMotorVelocity(handle, number, axis.motor_speed, 1e6);
        rawSet.jointSetMotorMaxForce(handle, number, axis.motor_max_force);
    }
}
