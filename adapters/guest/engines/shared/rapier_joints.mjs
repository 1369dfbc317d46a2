// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';

/** Limits, motor or spring of a hinge or slider that Rapier has created. */
export function drive(RAPIER, created, joint) {
    const [axis] = joint.axes;
    if ((joint.type !== 'hinge' && joint.type !== 'slider') || !axis) return;
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
