// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of six coordinates as libraries have them: travels along the axes of body A, and angles that are coordinates of
// their own only where a single one is open, or where nothing but freedom is asked of them.
import * as rg from '../../sdk/rigor_guest.mjs';

/** The library's number of a coordinate; 2D has x, y and angle. */
export const kSixDofAxes = { x: 0, y: 1, z: 2, twist: 3, swing_y: 4, swing_z: 5, angle: 5 };

const isPlain = (axis) => axis.mode === 'free' && axis.stiffness === 0 && axis.damping === 0 && axis.motor_max_force === 0;

/** For the numbers 0 to 5 the coordinate, or null if it is locked. Refuses several angles that are not all free. */
export function openAxes(joint) {
    const open = new Array(6).fill(null);
    for (const axis of joint.axes) if (axis.mode !== 'locked') open[kSixDofAxes[axis.name]] = axis;
    const angles = open.slice(3).filter((axis) => axis !== null);
    if (angles.length > 1 && !angles.every(isPlain))
        throw new rg.Unsupported('a six_dof with several angles that are not all free', '', `joint '${joint.name}'`);
    return open;
}

const kRightAngles = 'the axes of its joint of six coordinates are normal to each other';

/**
 * A wheel as a joint of six coordinates: its strut is the axis, its pin the third one. `poseA`, `poseB`: of its bodies at the start;
 * `source`: where the library's documentation says that such axes are normal to each other.
 */
export function wheelAsSixDof(joint, poseA, poseB, source) {
    const pin = rg.rotateBack(poseA.orientation, rg.rotate(poseB.orientation, joint.spin_axis_b));
    if (Math.abs(rg.dot(pin, joint.axis_a)) > 1e-9)
        throw new rg.Unsupported('a wheel whose pin is not normal to its strut', `${source}: ${kRightAngles}`, `joint '${joint.name}'`);
    const names = { travel: 'x', angle: 'swing_z' };
    const axes = joint.axes.map((axis) => ({ ...axis, name: names[axis.name] }));
    return { ...joint, type: 'six_dof', normal_a: rg.cross(pin, joint.axis_a), axes };
}
