// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of a scenario as the library has them: those of a tree are coordinates of their bodies, the others constraints.
import * as rg from '../../sdk/rigor_guest.mjs';
import { canBreak } from '../shared/breaking.mjs';

export const isPlain = (axis) => axis.mode === 'free' && axis.stiffness === 0 && axis.damping === 0 && axis.motor_max_force === 0;

/** An equality of the library holds all that the joint does. */
export const canBeEquality = ({ type, axes }) =>
    type === 'fixed' || ((type === 'ball' || type === 'hinge') && axes.every(isPlain));

/**
 * The joints that are coordinates: those that no equality can replace first, the others by their order. Bodies that joints do not
 * move count as one. Joints that can break are none, for only an equality can be switched off.
 */
function chooseCoordinates({ bodies, joints }) {
    const group = bodies.map((_, i) => i);
    const ground = -1;
    const groupOf = (index) => {
        let at = index;
        while (at !== ground && bodies[at].type === 'dynamic' && group[at] !== at) at = group[at];
        return at === ground || bodies[at].type !== 'dynamic' ? ground : at;
    };
    const chosen = new Set();
    for (const replaceable of [false, true])
        for (const joint of joints) {
            if (joint.type === 'distance' || canBreak(joint) || canBeEquality(joint) !== replaceable) continue;
            const [a, b] = [groupOf(joint.body_a), groupOf(joint.body_b)];
            if (a === b) continue;
            if (a === ground) group[b] = ground;
            else group[a] = b;
            chosen.add(joint);
        }
    return chosen;
}

/** {parents, loops}: for every body {parent, joint} (parent -1: the world; joint null: free), and the joints that are constraints. */
export function planTree(scenario) {
    const { bodies, joints } = scenario;
    const parents = bodies.map((body) => (body.type === 'dynamic' ? null : { parent: -1, joint: null }));
    const chosen = chooseCoordinates(scenario);
    const used = new Set();
    const placed = (index) => index < 0 || parents[index] !== null;
    const attach = () => {
        for (const joint of joints) {
            if (used.has(joint) || !chosen.has(joint)) continue;
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

function refuse(joint, what, documentation = '') {
    throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
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
    if (open.length === 3 && open.every((name) => isPlain(named[name]))) found.push({ attributes: { type: 'ball', pos: joint.anchor_b }, motor: null });
    else if (open.length === 1) found.push(coordinate('hinge', turns[open[0]], joint.anchor_b, named[open[0]]));
    else if (open.length > 0) refuse(joint, 'a six_dof with several angles that are not all free');
    return found;
}

/** The spin axis is B's; the travel's is A's, and the first joint of a body turns or moves the axes of the next. */
function wheel(joint, isA, spinInA) {
    const named = Object.fromEntries(joint.axes.map((axis) => [axis.name, axis]));
    const { travel, angle } = named;
    const along = coordinate('slide', isA ? rg.negated(joint.axis_a) : joint.axis_b, isA ? joint.anchor_a : joint.anchor_b, travel);
    const about = coordinate('hinge', isA ? rg.negated(spinInA) : joint.spin_axis_b, isA ? joint.anchor_a : joint.anchor_b, angle);
    const found = [
        [along, travel],
        [about, angle],
    ];
    return (isA ? found.reverse() : found).filter(([, axis]) => axis?.mode !== 'locked').map(([made]) => made);
}

const kSwing = 'MuJoCo documentation, XML reference, body/joint: range and stiffness of a ball are of its whole rotation';

/** The greatest angle between the axes of A and B, or null. */
export function swingLimit({ axes }) {
    const swing = axes.find((axis) => axis.name === 'swing');
    return swing?.mode === 'limited' && swing.upper !== null && swing.upper < Math.PI ? swing.upper : null;
}

/** A ball, whose swing is bounded by a tendon (model.mjs); a twist alone is a hinge. */
function ballOrCone(joint, pos, axis) {
    const named = Object.fromEntries(joint.axes.map((given) => [given.name, given]));
    const { swing, twist } = named;
    if (swing?.mode === 'locked') return twist?.mode === 'locked' ? [] : [coordinate('hinge', axis, pos, twist)];
    if (twist && !isPlain({ ...twist, motor_max_force: 0 })) refuse(joint, 'a cone_twist whose twist is not free while it swings', kSwing);
    if (swing && !isPlain({ ...swing, mode: 'free' })) refuse(joint, 'springs and motors of a swing', kSwing);
    const { motor } = coordinate('ball', axis, pos, twist);
    return [{ attributes: { type: 'ball', pos }, motor: motor && { ...motor, gear: axis } }];
}

/**
 * The coordinates of a body that hangs on another by this joint. Where the body is A, the axis is turned round, so that
 * coordinates keep their signs.
 */
export function coordinatesOf(joint, isA, normalInB, spinInA) {
    const pos = isA ? joint.anchor_a : joint.anchor_b;
    const axis = isA ? rg.negated(joint.axis_a) : joint.axis_b;
    const [given] = joint.axes;
    switch (joint.type) {
        case 'ball':
        case 'cone_twist':
            return ballOrCone(joint, pos, axis);
        case 'hinge':
            return given?.mode === 'locked' ? [] : [coordinate('hinge', axis, pos, given)];
        case 'slider':
            return given?.mode === 'locked' ? [] : [coordinate('slide', axis, pos, given)];
        case 'wheel':
            return wheel(joint, isA, spinInA);
        case 'six_dof':
            return sixDof(joint, isA, normalInB);
        default:
            return [];
    }
}
