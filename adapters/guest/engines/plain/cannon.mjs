// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import {
    Body,
    Box,
    ContactMaterial,
    ConvexPolyhedron,
    Cylinder,
    HingeConstraint,
    Material,
    Plane,
    Quaternion,
    Sphere,
    Trimesh,
    Vec3,
    World,
} from 'cannon-es';

export const bound = 1e-6; // the library's own inertia is that of the box around the shapes in the axes of the world
const kHalfDepth = 0.5; // of what is flat [m]

export const scenes = {
    default: [
        ...['hanging_chain_mode', 'euler_disc', 'mass_ratio_heavy_above', 'slide_and_stop', 'incline_slip', 'box_stack'],
        'arch_stands_2d',
    ],
    matched: ['euler_disc', 'mass_ratio_heavy_above', 'ball_in_cylinder'],
};

/** Faces of the prism over a polygon of four corners. Sweeps end before contacts agree, so that the order counts: it is the guest's. */
const kFaces = [
    [1, 0, 3, 2],
    [4, 0, 1, 5],
    [3, 0, 4, 7],
    [5, 1, 2, 6],
    [6, 2, 3, 7],
    [6, 7, 4, 5],
];

function prismOf(polygon) {
    const vertices = [-kHalfDepth, kHalfDepth].flatMap((z) => polygon.map(([x, y]) => new Vec3(x, y, z)));
    return new ConvexPolyhedron({ vertices, faces: kFaces });
}

function shapeOf({ box, sphere, cylinder, polygon, triangle_mesh: mesh }, sides) {
    if (mesh) return new Trimesh(mesh.vertices.flat(), mesh.triangles.flat());
    if (polygon) return prismOf(polygon);
    if (box) return new Box(new Vec3(...[...box.half_extents, kHalfDepth].slice(0, 3)));
    if (cylinder) return new Cylinder(cylinder.radius, cylinder.radius, 2 * cylinder.half_length, sides);
    return sphere ? new Sphere(sphere.radius) : new Plane();
}

/** Coefficients of all contacts; for `matched` impulses are bounded by impulses, and contacts are stiff. */
function addMaterial(world, { friction, restitution, dt }, isMatched) {
    // Of two materials with coefficients the library takes the products.
    if (!isMatched) return new Material({ friction: Math.sqrt(friction), restitution: Math.sqrt(restitution) });
    const material = new Material();
    const [contactEquationStiffness, frictionEquationStiffness] = [1e9, 1e9];
    const [contactEquationRelaxation, frictionEquationRelaxation] = [100, 100];
    const stiff = { contactEquationStiffness, frictionEquationStiffness, contactEquationRelaxation, frictionEquationRelaxation };
    world.addContactMaterial(new ContactMaterial(material, material, { friction: friction * dt, restitution, ...stiff }));
    world.solver.iterations = 200;
    world.solver.tolerance = 0;
    return material;
}

// Contacts of stones that just touch hang on the last bit, which is 0.1 m after 120 steps.
export const steps = { arch_stands_2d: 60 };

/** How far masses that are greater by 1e-14 move the stones of the arch in its time [m], and how far the stones move. */
function archWith(read) {
    const scene = read('arch_stands_2d');
    const heavier = scene.bodies.map((b) => ({ ...b, mass: b.mass * (1 + 1e-14) }));
    const [first, second] = [start(scene), start({ ...scene, bodies: heavier })];
    const before = first.positions();
    for (let k = 0; k < Math.round(scene.duration / scene.dt); ++k) for (const run of [first, second]) run.step();
    const farthest = (p, q) => Math.max(...p.map((point, k) => Math.hypot(...point.map((x, axis) => x - q[k][axis]))));
    return { apart: farthest(first.positions(), second.positions()), moved: farthest(first.positions(), before) };
}

export function findings(read) {
    const { apart, moved } = archWith(read);
    return [
        [`the arch falls: its stones move by more than 1 m (${moved.toFixed(1)} m)`, moved > 1],
        [`masses greater by 1e-14 put its stones more than 1 cm elsewhere (${apart.toFixed(2)} m)`, apart > 0.01],
    ];
}

export function start(scene) {
    const { preset, dimension, gravity, dt, bodies, joints } = scene;
    const isMatched = preset === 'matched';
    const world = new World({ gravity: new Vec3(...gravity) });
    const material = addMaterial(world, scene, isMatched);
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const orientation = new Quaternion(x, y, z, w);
        const body = new Body({
            mass: b.isStatic ? 0 : b.mass,
            material,
            position: new Vec3(...b.position).vadd(orientation.vmult(new Vec3(...b.center))),
            quaternion: orientation,
            velocity: new Vec3(...b.velocity),
            angularVelocity: dimension === 2 ? new Vec3(0, 0, b.spin) : new Vec3(...b.spin),
            linearDamping: 0,
            angularDamping: 0,
        });
        // The library has the origin of a body in its centre of mass.
        if (b.collides) body.addShape(shapeOf(b.shape, isMatched ? 24 : 8), new Vec3(...b.center.map((c) => -c)));
        if (!b.isStatic) {
            const moments = dimension === 2 ? new Array(3).fill(b.inertia) : b.inertia;
            body.inertia.set(...moments);
            body.invInertia.set(...moments.map((I) => 1 / I));
            body.updateInertiaWorld(true);
            if (dimension === 2) {
                body.linearFactor.set(1, 1, 0);
                body.angularFactor.set(0, 0, 1);
            }
        }
        world.addBody(body);
        return body;
    });
    const outside = new Body({ mass: 0 });
    if (joints.some(({ a }) => a < 0)) world.addBody(outside);
    for (const { a, b, anchorA, anchorB, axis } of joints) {
        // Bodies of the scenes are turned about the hinges' axis alone, so that it is the same in both.
        const [axisA, axisB] = [new Vec3(...axis), new Vec3(...axis)];
        const pivots = { pivotA: new Vec3(...anchorA), pivotB: new Vec3(...anchorB) };
        world.addConstraint(new HingeConstraint(made[a] ?? outside, made[b], { ...pivots, axisA, axisB, collideConnected: false }));
    }
    return {
        step: () => world.step(dt),
        positions: () =>
            made.map(({ position, quaternion }, k) => {
                const center = quaternion.vmult(new Vec3(...bodies[k].center));
                return position.vsub(center).toArray();
            }),
    };
}
