// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Runs the plain programs of this folder, and the same scenes through the guests; both must place every body alike in
// every step. What a program says beyond that (`findings`) has to hold. Arguments: the program `rigor`, and names of
// engines (default: all whose libraries are installed).
// Exits with 77 where no library is installed.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { read } from './scene.mjs';

const engines = ['rapier3d', 'rapier2d', 'jolt', 'box2d3', 'mujoco3', 'cannon', 'planck'];
const [rigor, ...named] = process.argv.slice(2);
const modules = new URL('../node_modules/', import.meta.url);
if (!existsSync(modules)) process.exit(77);

/** Rows of `rigor run --csv`: for every step the positions of the bodies. */
function throughTheGuest(scene, engine) {
    // Its exit code says how well the engine did.
    const told = scene.told.flatMap((value) => ['--set', value]);
    const { stdout: out } = spawnSync(rigor, ['run', scene.name, '--engine', engine, '--dt', String(scene.dt), ...told, '--csv', '-'], {
        maxBuffer: 1 << 28,
        stdio: ['ignore', 'pipe', 'inherit'],
        encoding: 'utf8',
    });
    const steps = new Map();
    for (const line of out.split('\n')) {
        const [t, , x, y, z] = line.split(',');
        if (!/^[-0-9.e]+$/.test(t ?? '') || z === undefined) continue;
        if (!steps.has(t)) steps.set(t, []);
        steps.get(t).push([x, y, z].map(Number));
    }
    return [...steps.values()];
}

function greatestDistance(plain, guest) {
    let greatest = 0;
    guest.forEach((positions, k) => {
        if (k > 0) plain.step();
        plain.positions().forEach((p, i) => {
            greatest = Math.max(greatest, Math.hypot(...p.map((x, axis) => x - positions[i][axis])));
        });
    });
    plain.end?.();
    return greatest;
}

let failed = 0;
for (const name of named.length > 0 ? named : engines) {
    const program = await import(`./${name}.mjs`);
    const runs = Object.entries(program.scenes).flatMap(([preset, scenes]) => scenes.map((each) => [preset, each]));
    for (const [preset, each] of runs) {
        const scene = read(each, preset);
        const guest = throughTheGuest(scene, `${name}:preset=${preset}`).slice(0, 1 + (program.steps?.[each] ?? Infinity));
        const distance = greatestDistance(program.start(scene), guest);
        const isAlike = guest.length > 1 && distance <= (program.bounds?.[each] ?? program.bound);
        failed += isAlike ? 0 : 1;
        const found = `${distance.toExponential(1)} m in ${guest.length - 1} steps`;
        console.log(`${isAlike ? 'alike ' : 'DIFFER'} ${name} ${preset} ${each}: ${found}`);
    }
    for (const [sentence, holds] of program.findings?.(read) ?? []) {
        failed += holds ? 0 : 1;
        console.log(`${holds ? 'holds ' : 'FAILS '} ${name}: ${sentence}`);
    }
}
process.exit(failed > 0 ? 1 : 0);
