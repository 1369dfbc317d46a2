// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { Body, Box, Cylinder, HingeConstraint, Material, Plane, Quaternion, Sphere, Vec3, World } from 'cannon-es';

export const engine = 'cannon:preset=default';
export const bound = 1e-6; // the library's own inertia is that of the box around the shapes in the axes of the world
export const scenes = ['hanging_chain_mode', 'euler_disc', 'mass_ratio_heavy_above', 'slide_and_stop', 'incline_slip', 'box_stack'];

function shapeOf({ box, sphere, cylinder }) {
    if (box) return new Box(new Vec3(...box.half_extents));
    if (cylinder) return new Cylinder(cylinder.radius, cylinder.radius, 2 * cylinder.half_length, 8);
    return sphere ? new Sphere(sphere.radius) : new Plane();
}

export function start({ gravity, dt, friction, restitution, bodies, joints }) {
    const world = new World({ gravity: new Vec3(...gravity) });
    // Of two materials with coefficients the library takes the products.
    const material = new Material({ friction: Math.sqrt(friction), restitution: Math.sqrt(restitution) });
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const body = new Body({
            mass: b.isStatic ? 0 : b.mass,
            material,
            shape: b.collides ? shapeOf(b.shape) : undefined,
            position: new Vec3(...b.position),
            quaternion: new Quaternion(x, y, z, w),
            velocity: new Vec3(...b.velocity),
            angularVelocity: new Vec3(...b.spin),
            linearDamping: 0,
            angularDamping: 0,
        });
        if (!b.isStatic) {
            body.inertia.set(...b.inertia);
            body.invInertia.set(...b.inertia.map((I) => 1 / I));
            body.updateInertiaWorld(true);
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
        positions: () => made.map((body) => body.position.toArray()),
    };
}
