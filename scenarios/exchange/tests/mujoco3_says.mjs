// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What MuJoCo 3 says of an unchanged MJCF file, as JSON:
//     node mujoco3_says.mjs PACKAGE FILE
// PACKAGE is the folder of @mujoco/mujoco. All files beside FILE can be named by it.
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, file] = process.argv.slice(2);
const { default: load } = await import(pathToFileURL(join(folder, 'mujoco.js')));
const M = await load();
const files = new M.MjVFS();
for (const name of readdirSync(dirname(file))) {
    const path = join(dirname(file), name);
    if (path !== file && statSync(path).isFile()) files.addBuffer(name, readFileSync(path));
}
const m = M.MjModel.from_xml_string(readFileSync(file, 'utf8'), files);
const d = new M.MjData(m);
M.mj_forward(m, d);

const bytes = Buffer.from(m.names);
const nameAt = (start) => bytes.toString('utf8', start, bytes.indexOf(0, start));
const part = (array, k, width) => [...array].slice(width * k, width * (k + 1));
const count = (n) => [...Array(n).keys()];
console.log(
    JSON.stringify({
        bodies: count(m.nbody).map((k) => ({
            name: nameAt(m.name_bodyadr[k]),
            position: part(d.xpos, k, 3),
            axes: part(d.xmat, k, 9),
            mass: m.body_mass[k],
            centre: part(d.xipos, k, 3),
            principal_axes: part(d.ximat, k, 9),
            moments: part(m.body_inertia, k, 3),
        })),
        joints: count(m.njnt).map((k) => ({
            name: nameAt(m.name_jntadr[k]),
            anchor: part(d.xanchor, k, 3),
            axis: part(d.xaxis, k, 3),
            range: part(m.jnt_range, k, 2).map((q) => q - d.qpos[m.jnt_qposadr[k]]),
        })),
    }),
);
