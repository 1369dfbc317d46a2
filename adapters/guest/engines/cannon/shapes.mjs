// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { Box, ConvexPolyhedron, Cylinder, Heightfield, Plane, Sphere, Trimesh } from 'cannon-es';
import * as rg from '../../sdk/rigor_guest.mjs';
import { hullFaces } from '../shared/hull_faces.mjs';
import { toCannon } from './vectors.mjs';

const unturned = [1, 0, 0, 0];

/** The rotation that takes z to the unit vector `n`. */
function fromZ(n) {
    if (n[2] < -1 + 1e-12) return [0, 1, 0, 0];
    const q = [1 + n[2], -n[1], n[0], 0];
    return rg.scaled(1 / rg.norm(q), q);
}

const convex = (vertices) =>
    new ConvexPolyhedron({ vertices: vertices.map(toCannon), faces: hullFaces(vertices) });

function coneVertices({ radius, half_length }, segments) {
    const rim = Array.from({ length: segments }, (_, k) => (2 * Math.PI * k) / segments);
    return [[0, half_length, 0], ...rim.map((a) => [radius * Math.cos(a), -half_length, radius * Math.sin(a)])];
}

/** The library's x, y and z (heights) are z, x and y here: then its cells are split along the same diagonal. */
const cyclic = [0.5, -0.5, -0.5, -0.5];

function heightField(s, user) {
    if (Math.abs(s.spacing_x - s.spacing_z) > 1e-12 * s.spacing_x)
        throw new rg.Unsupported('cells that are no squares', 'cannon-es.d.ts, class Heightfield: one elementSize', user);
    const data = Array.from({ length: s.rows }, (_, k) => s.heights.slice(k * s.columns, (k + 1) * s.columns));
    const lowest = Math.min(...s.heights);
    return {
        shape: new Heightfield(data, { elementSize: s.spacing_x, minValue: lowest - s.thickness }),
        position: [-0.5 * (s.columns - 1) * s.spacing_x, 0, -0.5 * (s.rows - 1) * s.spacing_z],
        orientation: cyclic,
    };
}

const builders = {
    sphere: (s) => ({ shape: new Sphere(s.radius) }),
    box: (s) => ({ shape: new Box(toCannon(s.half_extents)) }),
    cylinder: (s, segments) => ({ shape: new Cylinder(s.radius, s.radius, 2 * s.half_length, segments) }),
    cone: (s, segments) => ({ shape: convex(coneVertices(s, segments)) }),
    hull: (s) => ({ shape: convex(s.vertices) }),
    // The library's plane contains the origin and faces z.
    half_space: (s) => ({
        shape: new Plane(),
        position: rg.scaled(s.offset, s.normal),
        orientation: fromZ(s.normal),
    }),
    triangle_mesh: (s) => ({ shape: new Trimesh(s.vertices.flat(), s.triangles.flat()) }),
    height_field: (s, _segments, user) => heightField(s, user),
};

/** A ball at either end of a cylinder; in the plane that is a box, whose sides are straight. */
function capsule({ radius, half_length }, segments, planar) {
    const middle = planar ? { shape: 'box', half_extents: [radius, half_length, radius] } : { shape: 'cylinder', radius, half_length };
    const ends = [half_length, -half_length].map((y) => ({ shape: new Sphere(radius), position: [0, y, 0] }));
    return [builders[middle.shape](middle, segments), ...ends];
}

/** Shapes of the library that make one of the format's, with their poses in the frame of its body. */
export function shapesOf(given, { segments, planar, user }) {
    const parts = given.shape === 'capsule' ? capsule(given, segments, planar) : [builders[given.shape](given, segments, user)];
    return parts.map(({ shape, position = [0, 0, 0], orientation = unturned }) => ({
        shape,
        position: rg.sum(given.position, rg.rotate(given.orientation, position)),
        orientation: rg.quaternionProduct(given.orientation, orientation),
    }));
}

/** Triangle meshes touch spheres alone. */
export function refuseUntouched(scenario) {
    const moving = scenario.bodies.filter((body) => body.type === 'dynamic' && body.collides);
    const has = (bodies, wanted) => bodies.some((body) => body.shapes.some(({ shape }) => wanted(shape)));
    if (has(scenario.bodies, (shape) => shape === 'triangle_mesh') && has(moving, (shape) => shape !== 'sphere'))
        throw new rg.Unsupported(
            'contacts of triangle meshes with other shapes than spheres',
            'cannon-es.d.ts, COLLISION_TYPES: sphereTrimesh and planeTrimesh',
        );
}
