// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of a scenario as the library has them: those of a tree are coordinates of their bodies, the others constraints.
import * as rg from '../../sdk/rigor_guest.mjs';

const kTree = new Set(['ball', 'hinge', 'slider', 'fixed', 'six_dof']);

/** {parents, loops}: for every body {parent, joint} (parent -1: the world; joint null: free), and joints that close loops. */
export function planTree(scenario) {
    const { bodies, joints } = scenario;
    const parents = bodies.map((body) => (body.type === 'dynamic' ? null : { parent: -1, joint: null }));
    const used = new Set();
    const placed = (index) => index < 0 || parents[index] !== null;
    const attach = () => {
        for (const joint of joints) {
            if (used.has(joint) || !kTree.has(joint.type)) continue;
            const [a, b] = [joint.body_a, joint.body_b];
            if (placed(a) === placed(b)) continue;
            used.add(joint);
            if (placed(a)) parents[b] = { parent: a, joint };
            else parents[a] = { parent: b, joint };
            return true;
        }
        return false;
    };
    const place = () => {
        while (attach());
        const next = parents.indexOf(null);
        if (next >= 0) parents[next] = { parent: -1, joint: null };
        return next >= 0;
    };
    while (place());
    return { parents, loops: joints.filter((joint) => !used.has(joint)) };
}

function refuse(joint, what) {
    throw new rg.Unsupported(what, '', `joint '${joint.name}'`);
}

/** A coordinate as a joint of the library: {attributes, motor}; `axis` in the frame of the child. */
function coordinate(type, axis, pos, given) {
    const attributes = { type, axis, pos };
    if (given?.mode === 'limited')
        Object.assign(attributes, { limited: 'true', range: [given.lower ?? -1e10, given.upper ?? 1e10] });
    if (given?.stiffness > 0 || given?.damping > 0)
        Object.assign(attributes, { stiffness: given.stiffness, damping: given.damping, springref: given.target });
    const motor = given?.motor_max_force > 0 ? { speed: given.motor_speed, most: given.motor_max_force } : null;
    return { attributes, motor };
}

/** `normalInB`: the joint's normal in the frame of B. */
function sixDof(joint, isA, normalInB) {
    if (isA) refuse(joint, 'a six_dof whose body A hangs on its body B');
    const along = { x: joint.axis_b, y: normalInB };
    along.z = rg.cross(along.x, along.y);
    const isOpen = (axis) => axis && axis.mode !== 'locked';
    const named = Object.fromEntries(joint.axes.map((axis) => [axis.name, axis]));
    const found = ['x', 'y', 'z']
        .filter((name) => isOpen(named[name]))
        .map((name) => coordinate('slide', along[name], joint.anchor_b, named[name]));
    const turns = { twist: along.x, swing_y: along.y, swing_z: along.z, angle: [0, 0, 1] };
    const open = Object.keys(turns).filter((name) => isOpen(named[name]));
    const plain = open.every((name) => {
        const { mode, stiffness, damping, motor_max_force } = named[name];
        return mode === 'free' && stiffness === 0 && damping === 0 && motor_max_force === 0;
    });
    if (open.length === 3 && plain) found.push({ attributes: { type: 'ball', pos: joint.anchor_b }, motor: null });
    else if (open.length === 1) found.push(coordinate('hinge', turns[open[0]], joint.anchor_b, named[open[0]]));
    else if (open.length > 0) refuse(joint, 'a six_dof with several angles that are not all free');
    return found;
}

/**
 * The coordinates of a body that hangs on another by this joint. Where the body is A, the axis is turned round, so that
 * coordinates keep their signs.
 */
export function coordinatesOf(joint, isA, normalInB) {
    const pos = isA ? joint.anchor_a : joint.anchor_b;
    const axis = isA ? rg.negated(joint.axis_a) : joint.axis_b;
    const [given] = joint.axes;
    switch (joint.type) {
        case 'ball':
            return [{ attributes: { type: 'ball', pos }, motor: null }];
        case 'hinge':
            return given?.mode === 'locked' ? [] : [coordinate('hinge', axis, pos, given)];
        case 'slider':
            return given?.mode === 'locked' ? [] : [coordinate('slide', axis, pos, given)];
        case 'six_dof':
            return sixDof(joint, isA, normalInB);
        default:
            return [];
    }
}
