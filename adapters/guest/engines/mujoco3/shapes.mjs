// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of the format as geoms and assets of the library's XML. The library's capsules and cylinders lie along z.
import * as rg from '../../sdk/rigor_guest.mjs';
import { element } from './library.mjs';

const half = Math.SQRT1_2;
/** Takes z to y, and y to -z. */
const zToY = [half, -half, 0, 0];

/** The rotation that takes z to the unit vector `n`. */
function fromZ(n) {
    if (n[2] < -1 + 1e-12) return [0, 1, 0, 0];
    const q = [1 + n[2], -n[1], n[0], 0];
    return rg.scaled(1 / rg.norm(q), q);
}

/** Heights between 0 and 1. In XML the rows begin at the greatest y of the library, which is the least z here. */
function heightField(s, name) {
    const [lowest, highest] = [Math.min(...s.heights), Math.max(...s.heights)];
    const span = Math.max(highest - lowest, 1e-6);
    const size = [0.5 * (s.columns - 1) * s.spacing_x, 0.5 * (s.rows - 1) * s.spacing_z, span, s.thickness];
    const elevation = s.heights.map((height) => (height - lowest) / span);
    return {
        asset: element('hfield', { name, nrow: s.rows, ncol: s.columns, size, elevation }),
        geom: { type: 'hfield', hfield: name },
        position: [0, lowest, 0],
        orientation: zToY,
    };
}

const mesh = (vertices, name) => ({
    asset: element('mesh', { name, vertex: vertices.flat(), inertia: 'convex' }),
    geom: { type: 'mesh', mesh: name },
});

const builders = {
    sphere: (s) => ({ geom: { type: 'sphere', size: s.radius } }),
    box: (s) => ({ geom: { type: 'box', size: s.half_extents } }),
    capsule: (s) => ({ geom: { type: 'capsule', size: [s.radius, s.half_length] }, orientation: zToY }),
    cylinder: (s) => ({ geom: { type: 'cylinder', size: [s.radius, s.half_length] }, orientation: zToY }),
    ellipsoid: (s) => ({ geom: { type: 'ellipsoid', size: s.half_axes } }),
    hull: (s, name) => mesh(s.vertices, name),
    half_space: (s) => ({
        geom: { type: 'plane', size: [0, 0, 1] },
        position: rg.scaled(s.offset, s.normal),
        orientation: fromZ(s.normal),
    }),
    height_field: heightField,
};

/** {geom, asset} of a shape; `geom` are attributes, with its pose in the frame of its body. `asset` may be missing. */
export function geomOf(shape, name) {
    const { geom, asset, position = [0, 0, 0], orientation = [1, 0, 0, 0] } = builders[shape.shape](shape, `asset_${name}`);
    const pos = rg.sum(shape.position, rg.rotate(shape.orientation, position));
    const quat = rg.quaternionProduct(shape.orientation, orientation);
    return { asset, geom: { name, ...geom, pos, quat } };
}
