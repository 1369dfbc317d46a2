// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenes for programs that use a library as its manual does: the numbers of a scenario file, without Rigor.
// Bodies have one shape each; every pair of bodies has the same coefficients. Shapes of 2D are 1 m deep in 3D libraries.
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

/** Corners of a polygon from its leftmost one on, as the guest is given them. */
function cornersOf({ vertices }) {
    const first = vertices.indexOf(vertices.reduce((a, b) => (b[0] < a[0] ? b : a)));
    return [...vertices.slice(first), ...vertices.slice(0, first)];
}

/** Area and centre of a polygon, and its second moment about the centre over the area, by triangles from its first corner. */
function polygonOf([[x, y], ...others]) {
    let [area, first, second] = [0, [0, 0], 0];
    const arms = others.map(([u, v]) => [u - x, v - y]);
    for (let k = 0; k + 1 < arms.length; ++k) {
        const [[a, b], [c, d]] = [arms[k], arms[k + 1]];
        const part = 0.5 * (a * d - b * c);
        area += part;
        first = [first[0] + (part / 3) * (a + c), first[1] + (part / 3) * (b + d)];
        second += (part / 12) * (a * a + b * b + c * c + d * d + (a + c) ** 2 + (b + d) ** 2);
    }
    const arm = first.map((c) => c / area);
    return { area, center: [x + arm[0], y + arm[1], 0], moment: second / area - arm[0] ** 2 - arm[1] ** 2 };
}

/** Inertia about the centre of a body of uniform density, along the axes; 2D: about z. */
function inertiaOf(mass, shape, dimension) {
    if (shape.polygon) return mass * polygonOf(shape.polygon).moment;
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

/** Springs from points of the world to points of bodies, in their axes, and torques. Bodies have their numbers. */
function forcesOf(file) {
    const numberOf = (name) => file.bodies.findIndex((body) => body.name === name);
    return (file.forces ?? []).map(({ spring, constant }) =>
        spring
            ? { spring: { ...spring, body: numberOf(spring.b), fixed: spring.anchor_a, anchor: spring.anchor_b } }
            : { constant: { ...constant, body: numberOf(constant.body) } },
    );
}

/** Force of a spring on the body that it holds at `point`. */
export function pullOf({ fixed, stiffness, rest_length: rest }, point) {
    const arm = point.map((x, axis) => x - fixed[axis]);
    const length = Math.hypot(...arm);
    return arm.map((x) => (-stiffness * (length - rest) * x) / length);
}

/** The scene of a file of the library; `preset`: whose settings of a library it is run with. */
export function read(name, preset = 'default') {
    const dimension = name.endsWith('_2d') ? 2 : 3;
    const file = JSON.parse(readFileSync(new URL(`${dimension}d/${name}.json`, library)));
    const [material] = Object.values(file.materials);
    const { friction, restitution } = file.pairs?.[0] ?? material;
    const { density } = material;
    const bodies = bodiesOf(file).map((body) => {
        const [given] = body.shapes;
        const shape = given.polygon ? { ...given, polygon: cornersOf(given.polygon) } : given;
        const moves = (body.type ?? 'dynamic') === 'dynamic';
        const mass = body.mass ?? (shape.polygon && density * polygonOf(shape.polygon).area);
        return {
            isStatic: body.type === 'static',
            isKinematic: body.type === 'kinematic',
            collides: body.collides ?? true,
            shape,
            shapePosition: shape.position ?? [0, 0, 0],
            shapeAngle: ((shape.angle_deg ?? shape.axis_angle_deg?.angle_deg ?? 0) * Math.PI) / 180, // about z
            mass,
            center: shape.polygon ? polygonOf(shape.polygon).center : [0, 0, 0],
            inertia: moves ? (body.inertia ?? inertiaOf(mass, shape, dimension)) : null,
            position: body.position ?? [0, 0, 0],
            quaternion: quaternionOf(body),
            angle: body.angle ?? 0,
            velocity: body.velocity ?? [0, 0, 0],
            spin: body.angular_velocity ?? (dimension === 2 ? 0 : [0, 0, 0]),
        };
    });
    // What just touches hangs on the last bits of masses and centres: the guest is told those that are reckoned here.
    const told = bodies.flatMap(({ shape, mass, inertia, center }, k) => {
        const values = shape.polygon ? { mass, inertia, center_of_mass: `[${center.slice(0, 2)}]` } : {};
        return Object.entries(values).map(([key, value]) => `bodies.${file.bodies[k].name}.${key}=${value}`);
    });
    const chains = (file.generators ?? []).flatMap(({ chain }) => (chain ? [chain] : []));
    const joints = jointsOf(file, bodies);
    const { gravity, duration } = file;
    const forces = forcesOf(file);
    return { name, preset, dimension, gravity, dt: file.dt[0], duration, friction, restitution, bodies, chains, joints, forces, told };
}
