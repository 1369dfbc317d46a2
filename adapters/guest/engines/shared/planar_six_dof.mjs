// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of three coordinates in the plane, for libraries that have joints of one and two.
import * as rg from '../../sdk/rigor_guest.mjs';

const isHeld = (axis) =>
    !axis || (axis.mode === 'locked' && axis.stiffness === 0 && axis.damping === 0 && axis.motor_max_force === 0);

/**
 * The joint, or for a six_dof the hinge, slider, wheel or fixed joint that leaves the same coordinates free. `source`: where the
 * library's documentation shows that none of its joints leaves both travels free.
 */
export function planarJoint(joint, source) {
    if (joint.type !== 'six_dof') return joint;
    const [x, y, angle] = ['x', 'y', 'angle'].map((name) => joint.axes.find((axis) => axis.name === name));
    if (!isHeld(x) && !isHeld(y)) throw new rg.Unsupported('a six_dof with two travels', source, `joint '${joint.name}'`);
    const about = isHeld(angle) ? [] : [{ ...angle, name: 'angle' }];
    if (isHeld(x) && isHeld(y)) return { ...joint, type: about.length > 0 ? 'hinge' : 'fixed', axes: about };
    const turned = ([p, q]) => (isHeld(x) ? [-q, p, 0] : [p, q, 0]);
    const travel = { ...(isHeld(x) ? y : x), name: 'travel' };
    const axes = { axis_a: turned(joint.axis_a), axis_b: turned(joint.axis_b) };
    return { ...joint, ...axes, type: about.length > 0 ? 'wheel' : 'slider', axes: [travel, ...about] };
}
