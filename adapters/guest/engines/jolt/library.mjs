// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library, and its vectors as arrays. Objects of the library that are made by `new` stay until they are destroyed.
import { readFileSync } from 'node:fs';
import init from 'jolt-physics';

export const J = await init();

const manifest = new URL('../node_modules/jolt-physics/package.json', import.meta.url);
export const version = JSON.parse(readFileSync(manifest)).version;

/** Runs `use` with an object of the library and destroys it afterwards. */
export function using(object, use) {
    const result = use(object);
    J.destroy(object);
    return result;
}
export const withVec3 = ([x, y, z], use) => using(new J.Vec3(x, y, z), use);
export const withRVec3 = ([x, y, z], use) => using(new J.RVec3(x, y, z), use);
export const withQuat = ([w, x, y, z], use) => using(new J.Quat(x, y, z, w), use);

/** What functions return is overwritten by the next call: it is read at once. */
export const vector = (v) => [v.GetX(), v.GetY(), v.GetZ()];
export const quaternion = (q) => [q.GetW(), q.GetX(), q.GetY(), q.GetZ()];
