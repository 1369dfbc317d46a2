// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library, and its vectors as arrays of three numbers, z = 0. What its functions return is deleted after reading.
import { readFileSync } from 'node:fs';
import init from 'box2d3-wasm';

export const B = await init();

const manifest = new URL('../node_modules/box2d3-wasm/package.json', import.meta.url);
export const version = JSON.parse(readFileSync(manifest)).version;

export function vector(v) {
    const result = [v.x, v.y, 0];
    v.delete();
    return result;
}
/** Runs `use` with a vector of the library. */
export function withVec2([x, y], use) {
    const v = new B.b2Vec2(x, y);
    const result = use(v);
    v.delete();
    return result;
}
/** b2MakeRot is an approximation, off by up to 1.7e-3 rad: cosine and sine are given instead. */
export function withRot(angle, use) {
    const q = new B.b2Rot();
    q.c = Math.cos(angle);
    q.s = Math.sin(angle);
    const result = use(q);
    q.delete();
    return result;
}

/** Angle about z of a quaternion that turns about z, and the quaternion of an angle. */
export const angleOf = ([w, , , z]) => 2 * Math.atan2(z, w);
export const quaternionOf = (angle) => [Math.cos(0.5 * angle), 0, 0, Math.sin(0.5 * angle)];
