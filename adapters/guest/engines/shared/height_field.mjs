// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

/** The surface of a height field as a triangle mesh: {vertices, triangles}, normals up, cells split as the format says. */
export function surfaceOf({ columns, rows, spacing_x, spacing_z, heights }) {
    const at = (i, k) => k * columns + i;
    const vertices = [];
    for (let k = 0; k < rows; ++k)
        for (let i = 0; i < columns; ++i)
            vertices.push([(i - 0.5 * (columns - 1)) * spacing_x, heights[at(i, k)], (k - 0.5 * (rows - 1)) * spacing_z]);
    const triangles = [];
    for (let k = 0; k + 1 < rows; ++k)
        for (let i = 0; i + 1 < columns; ++i)
            triangles.push([at(i, k), at(i, k + 1), at(i + 1, k)], [at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)]);
    return { vertices, triangles };
}
