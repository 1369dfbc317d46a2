// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Springs of joints in 2D for libraries that take a frequency and a damping ratio on the mass of the coordinate.
import * as rg from '../../sdk/rigor_guest.mjs';

/** Inverse mass of a body against an impulse of direction `n` at `arm` from its centre, or against a turn (no direction). */
function inverseMass(body, n, arm) {
    if (body?.type !== 'dynamic') return 0;
    if (!n) return 1 / body.inertia[8];
    return 1 / body.mass + (arm[0] * n[1] - arm[1] * n[0]) ** 2 / body.inertia[8];
}

/**
 * {hertz, dampingRatio} that give a coordinate its stiffness and damping at the start; null without a spring. `n`: the
 * direction of a travel; none for an angle, whose mass is constant.
 */
export function springOf(axis, sides, joint, n) {
    if (!(axis.stiffness > 0 || axis.damping > 0)) return null;
    if (axis.stiffness === 0) throw new rg.Unsupported(`damper of a ${joint.type}`, '', `joint '${joint.name}'`);
    const mass = 1 / sides.reduce((sum, { body, arm }) => sum + inverseMass(body, n, arm), 0);
    const rate = Math.sqrt(axis.stiffness / mass);
    return { hertz: rate / (2 * Math.PI), dampingRatio: axis.damping / (2 * mass * rate) };
}

/** Direction of a joint's coordinate in the world: its axis, or the line of its anchors. */
export function directionOf(joint, poseA, poseB) {
    if (joint.type !== 'distance') return rg.rotate(poseA.orientation, joint.axis_a);
    const anchorOf = ({ position, orientation }, anchor) => rg.sum(position, rg.rotate(orientation, anchor));
    const line = rg.difference(anchorOf(poseB, joint.anchor_b), anchorOf(poseA, joint.anchor_a));
    return rg.scaled(1 / Math.max(rg.norm(line), 1e-12), line);
}

/** The two bodies of a joint with the arms of its anchors in the world; no body for the world itself. */
export function sidesOf(scenario, joint, poseA, poseB) {
    const sideOf = (index, pose, anchor) => {
        const body = scenario.bodies[index];
        return { body, arm: body ? rg.rotate(pose.orientation, rg.difference(anchor, body.center_of_mass)) : [0, 0, 0] };
    };
    return [sideOf(joint.body_a, poseA, joint.anchor_a), sideOf(joint.body_b, poseB, joint.anchor_b)];
}
