// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests of Rigor in JavaScript (Node.js 18 or newer): the protocol of ../PROTOCOL.md, and a little geometry. No packages.
//
// An engine is an object with `name`, `title`, `version`, `precision`, `capabilities`, `options` and `build`; it ends with
// serve(engine). Consoles print to the log: standard output belongs to the protocol.
import fs from 'node:fs';
import { performance } from 'node:perf_hooks';
import { format } from 'node:util';

const PROTOCOL = 1;
const MAGIC = 0x31464752; // "RGF1"

for (const method of ['log', 'info', 'debug', 'warn', 'error'])
    console[method] = (...words) => fs.writeSync(2, `${format(...words)}\n`);

/** The scenario needs what is not here. `documentation`: where the library's own says that it has no such thing; without
 * it the feature counts as one that the guest does not offer yet. `user`: what needs it. */
export class Unsupported extends Error {
    constructor(lacking, documentation = '', user = '') {
        super(lacking);
        Object.assign(this, { lacking, documentation, user });
    }
}

/** Input that must not reach the engine. */
export class BadInput extends Error {}

/** A line of the ledger: what was requested is what the engine does. */
export const exact = (topic, resolved) => ({ topic, requested: resolved, resolved, realisation: 'exact', reason: '' });

/** A line of the ledger: what could not be matched, and why. */
export const approximate = (topic, requested, resolved, reason, realisation = 'approximate') => ({
    topic,
    requested,
    resolved,
    realisation,
    reason,
});

/** Options of an engine: named values, or numbers within a range. */
export const choice = (key, values, byDefault, matched, help) => ({ key, values, default: byDefault, matched, help });
export const number = (key, min, max, byDefault, matched, help, integer = false) => ({
    key,
    min,
    max,
    integer,
    default: String(byDefault),
    matched: String(matched),
    help,
});

/** One scenario at one time step; the methods of a world are those of its derived class. */
export class World {
    scheme = 'unknown';
    impulses = false; // true: applyImpulse() changes velocities at once
    set_states = ''; // what setStates() does with the warm start; '': it can not
    snapshots = false;

    /** Force and torque on a body during the next step, world frame, at the centre of mass. */
    applyForce(_body, _force, _torque) {
        throw new Error('applyForce is missing');
    }
    /** One step. May return {counters, phases, asleep, broken}. */
    step() {
        throw new Error('step is missing');
    }
    /** For every body 13 numbers: position, orientation w x y z, velocity of the centre of mass, angular velocity. */
    states() {
        throw new Error('states is missing');
    }
    /** For every contact of the last step 19 numbers; see contact(). */
    contacts() {
        return [];
    }
    /** {bodies, pairs}: 29 numbers for every body (see bodyRow()); for materials a, b: a, b, friction, restitution. */
    readBack() {
        throw new Error('readBack is missing');
    }
    ledger() {
        return [];
    }
    destroy() {}
}

/** A row of contacts. `normal` from A to B. Body A has the lower index: other rows are turned round here. */
export function contact(a, b, pointA, pointB, normal, depth, impulse, friction = [0, 0, 0], shapes = [0, 0]) {
    if (a > b) {
        const [shapeA, shapeB] = shapes;
        return contact(b, a, pointB, pointA, negated(normal), depth, impulse, negated(friction), [shapeB, shapeA]);
    }
    const known = impulse !== undefined;
    return [a, b, ...shapes, ...pointA, ...pointB, ...normal, depth, known ? 1 : 0, known ? impulse : 0, ...friction];
}

/** A row of readBack().bodies; `inertia`: 9 numbers, about the centre of mass, body axes. */
export const bodyRow = (mass, centerOfMass, inertia, state, gravity) => [
    mass,
    ...centerOfMass,
    ...inertia,
    ...state,
    ...gravity,
];

// ---------------------------------------------------------------------------------------------------- geometry
export const negated = (v) => v.map((x) => -x);
export const sum = (a, b) => a.map((x, i) => x + b[i]);
export const difference = (a, b) => a.map((x, i) => x - b[i]);
export const scaled = (s, v) => v.map((x) => s * x);
export const dot = (a, b) => a.reduce((total, x, i) => total + x * b[i], 0);
export const norm = (v) => Math.sqrt(dot(v, v));
export const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];

/** The vector v rotated by the unit quaternion q = [w, x, y, z]. */
export function rotate(q, v) {
    const u = q.slice(1);
    const t = scaled(2, cross(u, v));
    return sum(sum(v, scaled(q[0], t)), cross(u, t));
}
export const conjugate = (q) => [q[0], -q[1], -q[2], -q[3]];
export const rotateBack = (q, v) => rotate(conjugate(q), v);

export function quaternionProduct(a, b) {
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ];
}

/** The orientation q after dt at the constant angular velocity w (world frame), by the exponential map. */
export function turned(q, w, dt) {
    const rate = norm(w);
    if (rate === 0) return q;
    const next = quaternionProduct([Math.cos(0.5 * rate * dt), ...scaled(Math.sin(0.5 * rate * dt) / rate, w)], q);
    return scaled(1 / norm(next), next);
}

/** 3 x 3 matrices of 9 numbers, row by row. */
export const times = (m, v) => [0, 3, 6].map((r) => m[r] * v[0] + m[r + 1] * v[1] + m[r + 2] * v[2]);
export function inverse([a, b, c, d, e, f, g, h, i]) {
    const det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    const cofactors = [
        [e * i - f * h, c * h - b * i, b * f - c * e],
        [f * g - d * i, a * i - c * g, c * d - a * f],
        [d * h - e * g, b * g - a * h, a * e - b * d],
    ];
    return cofactors.flat().map((x) => x / det);
}

/** Eigenvalues of a symmetric matrix of 9 numbers and the quaternion of its axes (columns), by Jacobi's rotations. */
export function principalAxes(matrix) {
    const m = [matrix.slice(0, 3), matrix.slice(3, 6), matrix.slice(6, 9)];
    let q = [1, 0, 0, 0];
    for (let sweep = 0; sweep < 60; ++sweep) {
        const [i, j] = [
            [0, 1],
            [0, 2],
            [1, 2],
        ].reduce((best, p) => (Math.abs(m[p[0]][p[1]]) > Math.abs(m[best[0]][best[1]]) ? p : best));
        if (Math.abs(m[i][j]) <= 1e-16 * (Math.abs(m[0][0]) + Math.abs(m[1][1]) + Math.abs(m[2][2]))) break;
        const angle = 0.5 * Math.atan2(2 * m[i][j], m[i][i] - m[j][j]);
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        for (let k = 0; k < 3; ++k) [m[k][i], m[k][j]] = [c * m[k][i] + s * m[k][j], c * m[k][j] - s * m[k][i]];
        for (let k = 0; k < 3; ++k) [m[i][k], m[j][k]] = [c * m[i][k] + s * m[j][k], c * m[j][k] - s * m[i][k]];
        // The new axes i and j are the old ones turned by `angle` from i to j.
        const axis = [0, 0, 0];
        axis[3 - i - j] = i === 0 && j === 2 ? -1 : 1;
        q = quaternionProduct(q, [Math.cos(0.5 * angle), ...scaled(Math.sin(0.5 * angle), axis)]);
    }
    return { moments: [m[0][0], m[1][1], m[2][2]], orientation: scaled(1 / norm(q), q) };
}

/** Tensor of these moments about axes of this orientation. */
export function tensorOf(moments, orientation) {
    const axes = [0, 1, 2].map((k) => rotate(orientation, [+(k === 0), +(k === 1), +(k === 2)]));
    const m = [];
    for (let r = 0; r < 3; ++r)
        for (let c = 0; c < 3; ++c) m.push(moments.reduce((total, I, k) => total + I * axes[k][r] * axes[k][c], 0));
    return m;
}

/** Coefficients of pairs of materials by number, either order. */
export function pairTable(scenario) {
    const table = new Map();
    for (const pair of scenario.pairs) {
        table.set(pair.a * scenario.materials + pair.b, pair);
        table.set(pair.b * scenario.materials + pair.a, pair);
    }
    return (a, b) => table.get(a * scenario.materials + b);
}

// ------------------------------------------------------------------------------------------------------ frames
function readExactly(size) {
    const bytes = Buffer.alloc(size);
    for (let got = 0; got < size; ) {
        let n = 0;
        try {
            n = fs.readSync(0, bytes, got, size - got, null);
        } catch (error) {
            if (error.code === 'EAGAIN') continue;
            if (error.code === 'EOF' || error.code === 'ECONNRESET') return null;
            throw error;
        }
        if (n === 0) return null;
        got += n;
    }
    return bytes;
}

function readFrame() {
    const prefix = readExactly(16);
    if (prefix === null) return null;
    if (prefix.readUInt32LE(0) !== MAGIC) throw new Error('no frame');
    const header = JSON.parse(readExactly(prefix.readUInt32LE(4)).toString());
    const payload = readExactly(Number(prefix.readBigUInt64LE(8)));
    const arrays = {};
    let offset = 0;
    for (const { name, type, shape } of header.arrays ?? []) {
        const count = shape.reduce((a, b) => a * b, 1);
        if (type === 'u8') arrays[name] = payload.subarray(offset, (offset += count));
        else {
            const rows = Array.from({ length: shape[0] }, () => new Array(shape[1]));
            for (const row of rows) for (let c = 0; c < shape[1]; ++c, offset += 8) row[c] = payload.readDoubleLE(offset);
            arrays[name] = rows;
        }
    }
    return { header, arrays };
}

function writeFrame(header, arrays) {
    const parts = [];
    const listed = [];
    for (const [name, content] of Object.entries(arrays)) {
        if (content instanceof Uint8Array) {
            listed.push({ name, type: 'u8', shape: [content.length] });
            parts.push(content);
            continue;
        }
        const { columns, rows } = content;
        const bytes = Buffer.alloc(8 * columns * rows.length);
        rows.forEach((row, r) => {
            if (row.length !== columns) throw new Error(`${name}: expected rows of ${columns} numbers`);
            for (let c = 0; c < columns; ++c) bytes.writeDoubleLE(row[c], 8 * (r * columns + c));
        });
        listed.push({ name, shape: [rows.length, columns] });
        parts.push(bytes);
    }
    const head = Buffer.from(JSON.stringify(listed.length > 0 ? { ...header, arrays: listed } : header));
    const prefix = Buffer.alloc(16);
    prefix.writeUInt32LE(MAGIC, 0);
    prefix.writeUInt32LE(head.length, 4);
    prefix.writeBigUInt64LE(BigInt(parts.reduce((total, part) => total + part.length, 0)), 8);
    const bytes = Buffer.concat([prefix, head, ...parts]);
    for (let sent = 0; sent < bytes.length; ) {
        try {
            sent += fs.writeSync(1, bytes, sent);
        } catch (error) {
            if (error.code !== 'EAGAIN') throw error;
        }
    }
}

// ----------------------------------------------------------------------------------------------------- serving
const statesOf = (world) => ({ states: { columns: 13, rows: world.states() } });

function requestsOf(engine) {
    const worlds = new Map();
    const worldOf = (header) => {
        const world = worlds.get(header.world);
        if (!world) throw new BadInput(`there is no world ${header.world}`);
        return world;
    };
    return {
        hello() {
            const { name, title, version, precision, build_notes } = engine;
            const about = { name, title, version, precision, build_notes: build_notes ?? '' };
            const { capabilities, options = [], presets = [] } = engine;
            return [{ protocol: PROTOCOL, engine: about, capabilities, options, presets }];
        },
        build(header) {
            const world = engine.build(header.scenario, header.dt, header.settings);
            worlds.set(header.world, world);
            const { scheme, impulses, set_states, snapshots } = world;
            return [{ scheme, impulses, set_states, snapshots }, statesOf(world)];
        },
        step(header, arrays) {
            const world = worldOf(header);
            for (const row of arrays.forces) world.applyForce(row[0], row.slice(1, 4), row.slice(4, 7));
            const start = performance.now();
            const more = world.step();
            return [{ seconds: 1e-3 * (performance.now() - start), ...more }, statesOf(world)];
        },
        impulse(header, arrays) {
            const world = worldOf(header);
            world.applyImpulse(header.body, arrays.impulse[0].slice(0, 3), arrays.impulse[0].slice(3, 6));
            return [{}, statesOf(world)];
        },
        set_states(header, arrays) {
            const world = worldOf(header);
            world.setStates(arrays.states);
            return [{}, statesOf(world)];
        },
        contacts: (header) => [{}, { contacts: { columns: 19, rows: worldOf(header).contacts() } }],
        read_back(header) {
            const { bodies, pairs } = worldOf(header).readBack();
            return [{}, { bodies: { columns: 29, rows: bodies }, pairs: { columns: 4, rows: pairs } }];
        },
        ledger: (header) => [{ lines: worldOf(header).ledger() }],
        save: (header) => [{}, { snapshot: worldOf(header).save() }],
        restore(header, arrays) {
            const world = worldOf(header);
            return [{ restored: Boolean(world.restore(arrays.snapshot)) }, statesOf(world)];
        },
        destroy(header) {
            worlds.get(header.world)?.destroy();
            worlds.delete(header.world);
            return [{}];
        },
        collide(header) {
            const { contacts, witnesses, ...found } = engine.collide(header.a, header.b, header.dimension, header.max_contacts);
            const arrays = { contacts: { columns: 19, rows: contacts } };
            if (witnesses) arrays.witnesses = { columns: 3, rows: witnesses };
            return [found, arrays];
        },
    };
}

function errorOf(error) {
    if (error instanceof Unsupported) {
        const { lacking, documentation, user } = error;
        return { code: 'unsupported', message: error.message, lacking, documentation, user };
    }
    if (error instanceof BadInput) return { code: 'bad_input', message: error.message };
    console.error(error);
    return { code: 'failed', message: String(error) };
}

/** Answers requests until the input ends. */
export function serve(engine) {
    const requests = requestsOf(engine);
    for (let frame = readFrame(); frame !== null; frame = readFrame()) {
        const { id, request } = frame.header;
        try {
            if (!Object.hasOwn(requests, request)) throw new Error(`unknown request '${request}'`);
            const [header, arrays] = requests[request](frame.header, frame.arrays);
            writeFrame({ id, ...header }, arrays ?? {});
        } catch (error) {
            writeFrame({ id, error: errorOf(error) }, {});
        }
    }
    process.exit(0);
}
