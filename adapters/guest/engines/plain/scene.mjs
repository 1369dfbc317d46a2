// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes for programs that use a library as its manual does: the numbers of a scenario file, without Rigor.
// Bodies have boxes, balls or half-spaces; every pair of bodies has the same coefficients.
import { readFileSync } from 'node:fs';

const library = new URL('../../../../scenarios/library/', import.meta.url);

function quaternionOf(body) {
    if (body.angle !== undefined) return [Math.cos(body.angle / 2), 0, 0, Math.sin(body.angle / 2)];
    if (!body.axis_angle_deg) return [1, 0, 0, 0];
    const { axis, angle_deg } = body.axis_angle_deg;
    const half = (angle_deg * Math.PI) / 360;
    return [Math.cos(half), ...axis.map((x) => x * Math.sin(half))];
}

/** Inertia about the axes of a box or a ball of uniform density; 2D: about z. */
function inertiaOf(mass, shape, dimension) {
    if (shape.sphere) return new Array(3).fill(0.4 * mass * shape.sphere.radius ** 2);
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

export function read(name) {
    const dimension = name.endsWith('_2d') ? 2 : 3;
    const file = JSON.parse(readFileSync(new URL(`${dimension}d/${name}.json`, library)));
    const { friction, restitution } = file.pairs?.[0] ?? Object.values(file.materials)[0];
    const bodies = bodiesOf(file).map((body) => {
        const [shape] = body.shapes;
        const isStatic = body.type === 'static';
        return {
            isStatic,
            shape,
            mass: body.mass,
            inertia: isStatic ? null : inertiaOf(body.mass, shape, dimension),
            position: body.position,
            quaternion: quaternionOf(body),
            angle: body.angle ?? 0,
            velocity: body.velocity ?? [0, 0, 0],
            spin: body.angular_velocity ?? (dimension === 2 ? 0 : [0, 0, 0]),
        };
    });
    const chains = (file.generators ?? []).flatMap(({ chain }) => (chain ? [chain] : []));
    return { name, gravity: file.gravity, dt: 1 / 60, duration: file.duration, friction, restitution, bodies, chains };
}
