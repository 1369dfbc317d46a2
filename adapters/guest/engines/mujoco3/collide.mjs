// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Queries of pairs of shapes: a model of two geoms, the library's contacts, and its distance.
import * as rg from '../../sdk/rigor_guest.mjs';
import { element, M, modelOf, sixNumbers } from './library.mjs';
import { geomOf } from './shapes.mjs';

/** Distances are found up to here [m]. */
const kFarthest = 1e3;

/** Static geoms touch nothing, so that B is a body. */
function pairModel(a, b, origin) {
    const made = [a, b].map((shape, k) => geomOf({ ...shape, position: rg.difference(shape.position, origin) }, `g${k}`));
    const [first, second] = made.map(({ geom }) => element('geom', geom));
    const moving = element('body', { name: 'b' }, [
        '<freejoint/>',
        element('inertial', { pos: [0, 0, 0], mass: 1, diaginertia: [1, 1, 1] }),
        second,
    ]);
    const assets = made.flatMap(({ asset }) => (asset ? [asset] : []));
    return modelOf(
        element('mujoco', {}, [
            '<compiler angle="radian"/><option gravity="0 0 0"/>',
            element('asset', {}, assets),
            element('worldbody', {}, [first, moving]),
        ]),
    );
}

/** Half the depth of what stands for a 2D shape, in its sizes. */
const kDeep = 10;

function lifted(shape) {
    const sizes = shape.half_extents ?? shape.vertices?.flat() ?? [1];
    const depth = kDeep * Math.max(...sizes.map(Math.abs));
    switch (shape.shape) {
        case 'circle':
            return { ...shape, shape: 'sphere' };
        case 'box':
            return { ...shape, half_extents: [...shape.half_extents.slice(0, 2), depth] };
        case 'polygon':
            return { ...shape, shape: 'hull', vertices: shape.vertices.flatMap(([x, y]) => [[x, y, depth], [x, y, -depth]]) };
        case 'half_plane':
            return { ...shape, shape: 'half_space' };
        default:
            return shape;
    }
}

/** Points of deep shapes without their depth, each once. */
function flattened({ contacts, witnesses, ...rest }) {
    const flat = ([x, y]) => [x, y, 0];
    const seen = new Map();
    for (const row of contacts) {
        if (Math.abs(row[12]) > 1e-6) throw new rg.Unsupported('a 2D query that the depth answers');
        const [p, q] = [flat(row.slice(4, 7)), flat(row.slice(7, 10))];
        const key = p.map((x) => x.toFixed(9)).join();
        if (!seen.has(key)) seen.set(key, rg.contact(0, 1, p, q, flat(row.slice(10, 13)), row[13]));
    }
    return { ...rest, contacts: [...seen.values()], witnesses: witnesses.map(flat) };
}

/** 2D shapes are lifted to deep ones, symmetrical about their plane. */
export function collide(a, b, dimension, most) {
    if (dimension === 2) {
        const answer = flattened(query(lifted(a), lifted(b), Infinity));
        return { ...answer, contacts: answer.contacts.slice(0, most) };
    }
    return query(a, b, most);
}

function query(a, b, most) {
    const isHalf = (shape) => shape.shape === 'half_space';
    if (isHalf(a) && isHalf(b)) throw new rg.Unsupported('queries of two half-spaces');
    // A plane belongs to the world.
    if (isHalf(b)) return turned(query(b, a, most));
    const origin = a.position;
    const model = pairModel(a, b, origin);
    const data = new M.MjData(model);
    try {
        M.mj_fwdPosition(model, data);
        return found(model, data, origin, most);
    } finally {
        data.delete();
        model.delete();
    }
}

function turned({ contacts, witnesses, ...rest }) {
    const rows = contacts.map((row) =>
        rg.contact(0, 1, row.slice(7, 10), row.slice(4, 7), rg.negated(row.slice(10, 13)), row[13]),
    );
    return { ...rest, contacts: rows, witnesses: [witnesses[1], witnesses[0]] };
}

function found(model, data, origin, most) {
    let distance = 0;
    const points = sixNumbers((six) => {
        distance = M.mj_geomDistance(model, data, 0, 1, kFarthest, six);
    });
    const contacts = [];
    for (let k = 0; k < data.ncon; ++k) {
        const contact = data.contact.get(k);
        const depth = -contact.dist;
        // The library's normal goes from its first geom to its second.
        const sign = contact.geom1 === 0 ? 1 : -1;
        const normal = rg.scaled(sign, [...contact.frame].slice(0, 3));
        const middle = rg.sum(origin, [...contact.pos]);
        const offset = rg.scaled(0.5 * depth, normal);
        contact.delete();
        if (depth >= 0) contacts.push(rg.contact(0, 1, rg.sum(middle, offset), rg.difference(middle, offset), normal, depth));
    }
    contacts.sort((first, second) => second[13] - first[13]);
    contacts.length = Math.min(contacts.length, most);
    const witnesses = [points.slice(0, 3), points.slice(3, 6)].map((point) => rg.sum(origin, point));
    return { overlap: distance <= 0, contacts, signed_distance: distance, witnesses };
}
