// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Faces of a convex hull of few vertices: planes through three of them with all others behind, tried one by one
// (n^4 for n vertices), with the vertices of a plane in order about its normal.
import * as rg from '../../sdk/rigor_guest.mjs';

/** Lists of indices into `vertices`, counter-clockwise seen from outside. */
export function hullFaces(vertices) {
    const size = Math.max(...vertices.map((v) => rg.norm(rg.difference(v, vertices[0]))));
    const near = 1e-9 * size;
    const faces = new Map();
    for (let i = 0; i < vertices.length; ++i)
        for (let j = i + 1; j < vertices.length; ++j)
            for (let k = j + 1; k < vertices.length; ++k)
                for (const face of facesThrough(vertices, i, j, k, near)) faces.set([...face].sort().join(), face);
    return [...faces.values()];
}

function facesThrough(vertices, i, j, k, near) {
    const cross = rg.cross(rg.difference(vertices[j], vertices[i]), rg.difference(vertices[k], vertices[i]));
    const length = rg.norm(cross);
    if (length <= near * near) return [];
    const normal = rg.scaled(1 / length, cross);
    const heights = vertices.map((v) => rg.dot(rg.difference(v, vertices[i]), normal));
    const on = heights.flatMap((height, v) => (Math.abs(height) <= near ? [v] : []));
    const found = [];
    if (heights.every((height) => height <= near)) found.push(inOrder(vertices, on, normal));
    if (heights.every((height) => height >= -near)) found.push(inOrder(vertices, on, rg.negated(normal)));
    return found;
}

function inOrder(vertices, indices, normal) {
    const middle = rg.scaled(1 / indices.length, indices.map((v) => vertices[v]).reduce(rg.sum));
    const first = rg.difference(vertices[indices[0]], middle);
    const second = rg.cross(normal, first);
    const angleOf = (v) => {
        const arm = rg.difference(vertices[v], middle);
        return Math.atan2(rg.dot(arm, second), rg.dot(arm, first));
    };
    return [...indices].sort((a, b) => angleOf(a) - angleOf(b));
}
