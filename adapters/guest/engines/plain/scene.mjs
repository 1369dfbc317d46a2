// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes for programs that use a library as its manual does: the numbers of a scenario file, without Rigor.
// Bodies have one shape each; every pair of bodies has the same coefficients.
import { readFileSync } from 'node:fs';

const library = new URL('../../../../scenarios/library/', import.meta.url);

function quaternionOf(body) {
    if (body.orientation) return body.orientation.map((c) => c / Math.hypot(...body.orientation));
    if (body.angle !== undefined) return [Math.cos(body.angle / 2), 0, 0, Math.sin(body.angle / 2)];
    if (!body.axis_angle_deg) return [1, 0, 0, 0];
    const { axis, angle_deg } = body.axis_angle_deg;
    const half = (angle_deg * Math.PI) / 360;
    return [Math.cos(half), ...axis.map((x) => x * Math.sin(half))];
}

/** Inertia about the axes of a box or a ball of uniform density; 2D: about z. */
function inertiaOf(mass, shape, dimension) {
    if (shape.sphere) return new Array(3).fill(0.4 * mass * shape.sphere.radius ** 2);
    if (shape.cylinder) {
        const [along, across] = [0.5 * shape.cylinder.radius ** 2, 0.25 * shape.cylinder.radius ** 2 + shape.cylinder.half_length ** 2 / 3];
        return [mass * across, mass * along, mass * across];
    }
    if (shape.circle) return 0.5 * mass * shape.circle.radius ** 2;
    const [x, y, z = 0] = shape.box.half_extents.map((h) => h * h);
    return dimension === 2 ? (mass * (x + y)) / 3 : [(mass * (y + z)) / 3, (mass * (x + z)) / 3, (mass * (x + y)) / 3];
}

function bodiesOf(file) {
    const copies = (file.generators ?? []).flatMap(({ grid }) => {
        const found = [];
        if (!grid) return found;
        for (let k = 0; k < grid.counts[1]; ++k) {
            const position = grid.origin.map((x, axis) => x + (axis === 1 ? k * grid.spacing[1] : 0));
            found.push({ ...grid.body, position });
        }
        return found;
    });
    return [...(file.bodies ?? []), ...copies];
}

/** The vector `v` of the world in the axes of a body that is turned by `q`; 2D: about z. */
export function inBody([w, x, y, z], v) {
    const u = [-x, -y, -z];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const t = cross(u, v).map((c) => 2 * c);
    return cross(u, t).map((c, axis) => v[axis] + w * t[axis] + c);
}

/** Hinges and balls. A body has its number, the world -1; the anchor is given in the world and in the axes of both bodies. */
function jointsOf(file, bodies) {
    const numbers = new Map((file.bodies ?? []).map(({ name }, k) => [name, k]));
    return (file.joints ?? []).map(({ type, a, b, anchor, axis = [0, 0, 1] }) => {
        const at = [...anchor, 0].slice(0, 3);
        const seenFrom = (k) => {
            if (k < 0) return at;
            const place = [...bodies[k].position, 0];
            return inBody(bodies[k].quaternion, at.map((x, i) => x - place[i]));
        };
        const [first, second] = [numbers.get(a) ?? -1, numbers.get(b)];
        return { type, a: first, b: second, axis, anchor: at, anchorA: seenFrom(first), anchorB: seenFrom(second) };
    });
}

export function read(name) {
    const dimension = name.endsWith('_2d') ? 2 : 3;
    const file = JSON.parse(readFileSync(new URL(`${dimension}d/${name}.json`, library)));
    const { friction, restitution } = file.pairs?.[0] ?? Object.values(file.materials)[0];
    const bodies = bodiesOf(file).map((body) => {
        const [shape] = body.shapes;
        const moves = (body.type ?? 'dynamic') === 'dynamic';
        return {
            isStatic: body.type === 'static',
            collides: body.collides ?? true,
            shape,
            mass: body.mass,
            inertia: moves ? (body.inertia ?? inertiaOf(body.mass, shape, dimension)) : null,
            position: body.position ?? [0, 0, 0],
            quaternion: quaternionOf(body),
            angle: body.angle ?? 0,
            velocity: body.velocity ?? [0, 0, 0],
            spin: body.angular_velocity ?? (dimension === 2 ? 0 : [0, 0, 0]),
        };
    });
    const chains = (file.generators ?? []).flatMap(({ chain }) => (chain ? [chain] : []));
    const joints = jointsOf(file, bodies);
    return { name, gravity: file.gravity, dt: file.dt[0], duration: file.duration, friction, restitution, bodies, chains, joints };
}
