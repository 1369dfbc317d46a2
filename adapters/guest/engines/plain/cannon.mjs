// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { Body, Box, Material, Plane, Quaternion, Sphere, Vec3, World } from 'cannon-es';

export const engine = 'cannon:preset=default';
export const bound = 1e-6; // the library's own inertia is that of the box around the shapes in the axes of the world
export const scenes = ['slide_and_stop', 'incline_slip', 'box_stack'];

function shapeOf({ box, sphere }) {
    if (box) return new Box(new Vec3(...box.half_extents));
    return sphere ? new Sphere(sphere.radius) : new Plane();
}

export function start({ gravity, dt, friction, restitution, bodies }) {
    const world = new World({ gravity: new Vec3(...gravity) });
    // Of two materials with coefficients the library takes the products.
    const material = new Material({ friction: Math.sqrt(friction), restitution: Math.sqrt(restitution) });
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const body = new Body({
            mass: b.isStatic ? 0 : b.mass,
            material,
            shape: shapeOf(b.shape),
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
    return {
        step: () => world.step(dt),
        positions: () => made.map((body) => body.position.toArray()),
    };
}
