// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier2d-compat';

await RAPIER.init();

export const engine = 'rapier2d:preset=default';
export const bound = 2e-5; // single precision; the guest's coefficients multiply to those given here
export const scenes = ['bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'];

export function start({ gravity, dt, friction, restitution, bodies }) {
    const world = new RAPIER.World({ x: gravity[0], y: gravity[1] });
    world.timestep = dt;
    const made = bodies.map((b) => {
        const kind = b.isStatic ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic();
        const [x, y] = b.position;
        const desc = kind.setTranslation(x, y).setRotation(b.angle).setLinvel(b.velocity[0], b.velocity[1]).setAngvel(b.spin);
        const body = world.createRigidBody(desc);
        const { box, circle } = b.shape;
        const collider = box ? RAPIER.ColliderDesc.cuboid(...box.half_extents) : RAPIER.ColliderDesc.ball(circle.radius);
        if (!b.isStatic) collider.setMass(b.mass);
        world.createCollider(collider.setFriction(friction).setRestitution(restitution), body);
        return body;
    });
    return {
        step: () => world.step(),
        positions: () => made.map((body) => body.translation()).map(({ x, y }) => [x, y, 0]),
    };
}
