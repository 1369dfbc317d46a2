// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';
import { canBreak } from '../shared/breaking.mjs';
import { openAxes, wheelAsSixDof } from '../shared/six_dof.mjs';
import { J, withQuat, withVec3 } from './library.mjs';

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
    /** The package does not give the impulses of the library's fixed joint, but those of one that holds six coordinates. */
    fixed_that_breaks: () => {
        const settings = new J.SixDOFConstraintSettings();
        for (let k = 0; k < 6; ++k) settings.MakeFixedAxis(k);
        return settings;
    },
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
    cone_twist: (joint, axis) => {
        const settings = new J.SwingTwistConstraintSettings();
        for (const vector of [settings.mTwistAxis1, settings.mTwistAxis2]) set(vector, axis);
        for (const vector of [settings.mPlaneAxis1, settings.mPlaneAxis2]) set(vector, normalTo(axis));
        const [twist, swing] = ['twist', 'swing'].map((name) => joint.axes.find((given) => given.name === name));
        const bound = (given, value) => (given === undefined || given.mode === 'free' ? Math.PI : (value ?? Math.PI));
        const isLocked = (given) => given?.mode === 'locked';
        const cone = isLocked(swing) ? 0 : bound(swing, swing?.upper);
        settings.mNormalHalfConeAngle = settings.mPlaneHalfConeAngle = cone;
        settings.mTwistMinAngle = isLocked(twist) ? 0 : -bound(twist, twist?.lower === null ? null : -twist?.lower);
        settings.mTwistMaxAngle = isLocked(twist) ? 0 : bound(twist, twist?.upper);
        return settings;
    },
    six_dof: (joint, axis, normal) => {
        const settings = new J.SixDOFConstraintSettings();
        for (const vector of [settings.mAxisX1, settings.mAxisX2]) set(vector, axis);
        for (const vector of [settings.mAxisY1, settings.mAxisY2]) set(vector, normal);
        openAxes(joint).forEach((given, k) => {
            if (given === null) settings.MakeFixedAxis(k);
            else if (given.mode === 'free') settings.MakeFreeAxis(k);
            else settings.SetLimitedAxis(k, given.lower ?? -1e9, given.upper ?? 1e9);
        });
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

/** A ball with limits or springs is a cone_twist whose twist is free. */
const isPlain = (axis) => axis.mode === 'free' && axis.stiffness === 0 && axis.damping === 0 && axis.motor_max_force === 0;
const isCone = (joint) => joint.type === 'cone_twist' || (joint.type === 'ball' && !joint.axes.every(isPlain));

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

/** Springs of swing and twist towards the start, and a motor of the twist. */
function driveCone(created, joint) {
    const constraint = J.castObject(created, J.SwingTwistConstraint);
    const [twist, swing] = ['twist', 'swing'].map((name) => joint.axes.find((given) => given.name === name));
    const refuse = (what, documentation) => {
        throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
    };
    const hasSpring = (axis) => axis?.stiffness > 0 || axis?.damping > 0;
    if (swing?.motor_max_force > 0) refuse('a motor of a swing', kSwingMotor);
    if (hasSpring(swing) && swing.target !== 0) refuse('a spring of a swing towards an angle', kSwingMotor);
    if (hasSpring(twist) && twist.motor_max_force > 0) refuse('motor and spring of one twist', kSwingMotor);
    if (hasSpring(swing)) {
        spring(constraint.GetSwingMotorSettings().mSpringSettings, swing.stiffness, swing.damping);
        constraint.SetSwingMotorState(J.EMotorState_Position);
    }
    if (hasSpring(twist)) {
        spring(constraint.GetTwistMotorSettings().mSpringSettings, twist.stiffness, twist.damping);
        constraint.SetTwistMotorState(J.EMotorState_Position);
        const half = 0.5 * twist.target;
        withQuat([Math.cos(half), Math.sin(half), 0, 0], (q) => constraint.SetTargetOrientationCS(q));
    }
    if (twist?.motor_max_force > 0) {
        const most = twist.motor_max_force;
        Object.assign(constraint.GetTwistMotorSettings(), { mMinTorqueLimit: -most, mMaxTorqueLimit: most });
        constraint.SetTwistMotorState(J.EMotorState_Velocity);
        withVec3([twist.motor_speed, 0, 0], (w) => constraint.SetTargetAngularVelocityCS(w));
    }
}

/** Motors and springs of six coordinates: one kind of each for every axis, with targets as vectors. */
function driveSix(created, joint) {
    const constraint = J.castObject(created, J.SixDOFConstraint);
    const [speeds, targets] = [new Array(6).fill(0), new Array(6).fill(0)];
    openAxes(joint).forEach((axis, k) => {
        if (axis === null) return;
        const hasSpring = axis.stiffness > 0 || axis.damping > 0;
        if (axis.motor_max_force > 0 && hasSpring)
            throw new rg.Unsupported('motor and spring of one coordinate', '', `joint '${joint.name}'`);
        if (hasSpring && k >= 3) throw new rg.Unsupported('springs of angles of a six_dof', '', `joint '${joint.name}'`);
        const motor = constraint.GetMotorSettings(k);
        if (axis.motor_max_force > 0) {
            const most = axis.motor_max_force;
            Object.assign(motor, { mMinForceLimit: -most, mMaxForceLimit: most, mMinTorqueLimit: -most, mMaxTorqueLimit: most });
            constraint.SetMotorState(k, J.EMotorState_Velocity);
            speeds[k] = axis.motor_speed;
        }
        if (hasSpring) {
            spring(motor.mSpringSettings, axis.stiffness, axis.damping);
            constraint.SetMotorState(k, J.EMotorState_Position);
            targets[k] = axis.target;
        }
    });
    withVec3(speeds.slice(0, 3), (v) => constraint.SetTargetVelocityCS(v));
    withVec3(speeds.slice(3), (w) => constraint.SetTargetAngularVelocityCS(w));
    withVec3(targets.slice(0, 3), (p) => constraint.SetTargetPositionCS(p));
}

const kSwingMotor = 'types.d.ts, class SwingTwistConstraint: its swing motor has a target as an orientation, none of an angle';
const kSixDof = 'types.d.ts, class SixDOFConstraintSettings, mAxisX1 and mAxisY1';

function kindOf(joint) {
    if (joint.type === 'fixed' && canBreak(joint)) return 'fixed_that_breaks';
    return isCone(joint) ? 'cone_twist' : joint.type;
}

/** Adds a joint. `poseA`: of the scenario's body A at the start; anchors and axes are given in the world. */
export function addJoint(system, given, bodyA, bodyB, poseA, poseB) {
    const joint = given.type === 'wheel' ? wheelAsSixDof(given, poseA, poseB, kSixDof) : given;
    const anchorOf = (pose, anchor) => rg.sum(pose.position, rg.rotate(pose.orientation, anchor));
    const axis = rg.rotate(poseA.orientation, joint.axis_a);
    const normal = joint.normal_a && rg.rotate(poseA.orientation, joint.normal_a);
    const kind = kindOf(joint);
    const settings = makers[kind](joint, axis, normal);
    settings.mSpace = J.EConstraintSpace_WorldSpace;
    const placed = ['six_dof', 'cone_twist', 'fixed_that_breaks'].includes(kind) ? 'mPosition' : 'mPoint';
    set(settings[`${placed}1`], anchorOf(poseA, joint.anchor_a));
    set(settings[`${placed}2`], anchorOf(poseB, joint.anchor_b));
    if (kind === 'fixed') settings.mAutoDetectPoint = false;
    const driven = joint.type === 'hinge' || joint.type === 'slider';
    if (driven) limit(settings, joint, joint.axes[0] ?? { mode: 'free' });
    const created = settings.Create(bodyA, bodyB);
    J.destroy(settings);
    if (driven && joint.axes[0]) drive(created, joint, joint.axes[0]);
    if (joint.type === 'six_dof') driveSix(created, joint);
    if (kind === 'cone_twist') driveCone(created, joint);
    system.AddConstraint(created);
    return created;
}

/** Classes of joints whose force, and whose torque, is read. */
const kReactions = {
    ball: 'PointConstraint',
    fixed: 'SixDOFConstraint',
    hinge: 'HingeConstraint',
    slider: 'SliderConstraint',
    distance: 'DistanceConstraint',
    six_dof: 'SixDOFConstraint',
    wheel: 'SixDOFConstraint',
    cone_twist: 'SwingTwistConstraint',
};
export const breakable = Object.keys(kReactions);

/** Mean force and torque of a joint over the last `seconds`. */
export function reactionOf(created, given, seconds) {
    const type = isCone(given) ? 'cone_twist' : given.type;
    const joint = J.castObject(created, J[kReactions[type]]);
    const length = (value) => {
        if (typeof value === 'number') return Math.abs(value);
        return value.Length ? value.Length() : Math.hypot(value.GetComponent(0), value.GetComponent(1));
    };
    const force = length(joint.GetTotalLambdaPosition()) / seconds;
    if (type === 'cone_twist')
        return { force, torque: Math.hypot(joint.GetTotalLambdaTwist(), joint.GetTotalLambdaSwingY(), joint.GetTotalLambdaSwingZ()) / seconds };
    return {
        force,
        torque: joint.GetTotalLambdaRotation ? length(joint.GetTotalLambdaRotation()) / seconds : 0,
    };
}
