// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { J } from './library.mjs';

function set(target, [x, y, z]) {
    target.Set(x, y, z);
}

function normalTo(axis) {
    const other = Math.abs(axis[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
    const normal = rg.cross(axis, other);
    return rg.scaled(1 / rg.norm(normal), normal);
}

function spring(settings, stiffness, damping) {
    settings.mMode = J.ESpringMode_StiffnessAndDamping;
    settings.mStiffness = stiffness;
    settings.mDamping = damping;
}

const makers = {
    ball: () => new J.PointConstraintSettings(),
    fixed: () => new J.FixedConstraintSettings(),
    hinge: (_joint, axis) => {
        const settings = new J.HingeConstraintSettings();
        for (const vector of [settings.mHingeAxis1, settings.mHingeAxis2]) set(vector, axis);
        for (const vector of [settings.mNormalAxis1, settings.mNormalAxis2]) set(vector, normalTo(axis));
        return settings;
    },
    slider: (_joint, axis) => {
        const settings = new J.SliderConstraintSettings();
        for (const vector of [settings.mSliderAxis1, settings.mSliderAxis2]) set(vector, axis);
        for (const vector of [settings.mNormalAxis1, settings.mNormalAxis2]) set(vector, normalTo(axis));
        return settings;
    },
    distance: (joint) => {
        const settings = new J.DistanceConstraintSettings();
        const [axis] = joint.axes;
        const hasSpring = axis.stiffness > 0 || axis.damping > 0;
        if (axis.mode === 'free' && !hasSpring)
            throw new rg.Unsupported('a distance that is free', '', `joint '${joint.name}'`);
        const length = hasSpring ? axis.target : joint.length;
        const limited = axis.mode === 'limited';
        if (limited && hasSpring)
            throw new rg.Unsupported('limits and spring of one distance', '', `joint '${joint.name}'`);
        settings.mMinDistance = limited ? Math.max(0, axis.lower ?? 0) : length;
        settings.mMaxDistance = limited ? (axis.upper ?? 1e9) : length;
        if (hasSpring) spring(settings.mLimitsSpringSettings, axis.stiffness, axis.damping);
        return settings;
    },
};

function limit(settings, joint, axis) {
    if (axis.mode === 'locked')
        throw new rg.Unsupported(`a ${joint.type} whose coordinate is locked`, '', `joint '${joint.name}'`);
    if (axis.mode !== 'limited') return;
    const [lower, upper] = [axis.lower ?? Number.NEGATIVE_INFINITY, axis.upper ?? Number.POSITIVE_INFINITY];
    const most = joint.type === 'hinge' ? Math.PI : 1e9;
    if (lower > 0 || upper < 0)
        throw new rg.Unsupported('limits that exclude the start', '', `joint '${joint.name}'`);
    if (joint.type === 'hinge' && (lower < -most || upper > most) && Number.isFinite(lower + upper))
        throw new rg.Unsupported('hinge limits beyond half a turn', '', `joint '${joint.name}'`);
    settings.mLimitsMin = Math.max(lower, -most);
    settings.mLimitsMax = Math.min(upper, most);
}

function drive(created, joint, axis) {
    const constraint = J.castObject(created, joint.type === 'hinge' ? J.HingeConstraint : J.SliderConstraint);
    const motor = constraint.GetMotorSettings();
    const hasSpring = axis.stiffness > 0 || axis.damping > 0;
    const hasMotor = axis.motor_max_force > 0;
    if (hasMotor && hasSpring)
        throw new rg.Unsupported(`motor and spring of one ${joint.type}`, '', `joint '${joint.name}'`);
    if (hasMotor) {
        const most = axis.motor_max_force;
        Object.assign(motor, { mMinForceLimit: -most, mMaxForceLimit: most, mMinTorqueLimit: -most, mMaxTorqueLimit: most });
        constraint.SetMotorState(J.EMotorState_Velocity);
        if (joint.type === 'hinge') constraint.SetTargetAngularVelocity(axis.motor_speed);
        else constraint.SetTargetVelocity(axis.motor_speed);
    }
    if (hasSpring) {
        spring(motor.mSpringSettings, axis.stiffness, axis.damping);
        constraint.SetMotorState(J.EMotorState_Position);
        if (joint.type === 'hinge') constraint.SetTargetAngle(axis.target);
        else constraint.SetTargetPosition(axis.target);
    }
}

/** Adds a joint. `poseA`: of the scenario's body A at the start; anchors and axes are given in the world. */
export function addJoint(system, joint, bodyA, bodyB, poseA, poseB) {
    const anchorOf = (pose, anchor) => rg.sum(pose.position, rg.rotate(pose.orientation, anchor));
    const axis = rg.rotate(poseA.orientation, joint.axis_a);
    const settings = makers[joint.type](joint, axis);
    settings.mSpace = J.EConstraintSpace_WorldSpace;
    set(settings.mPoint1, anchorOf(poseA, joint.anchor_a));
    set(settings.mPoint2, anchorOf(poseB, joint.anchor_b));
    if (joint.type === 'fixed') settings.mAutoDetectPoint = false;
    const driven = joint.type === 'hinge' || joint.type === 'slider';
    if (driven) limit(settings, joint, joint.axes[0] ?? { mode: 'free' });
    const created = settings.Create(bodyA, bodyB);
    J.destroy(settings);
    if (driven && joint.axes[0]) drive(created, joint, joint.axes[0]);
    system.AddConstraint(created);
}
