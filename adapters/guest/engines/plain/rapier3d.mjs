// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';

await RAPIER.init();

export const engine = 'rapier3d:preset=default';
export const bound = 2e-5; // single precision; the guest's coefficients multiply to those given here
export const scenes = ['backspin', 'bouncing_ball', 'box_stack'];

const vector = ([x, y, z]) => ({ x, y, z });

export function start({ gravity, dt, friction, restitution, bodies }) {
    const world = new RAPIER.World(vector(gravity));
    world.timestep = dt;
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const kind = b.isStatic ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic();
        const desc = kind
            .setTranslation(...b.position)
            .setRotation({ w, x, y, z })
            .setLinvel(...b.velocity)
            .setAngvel(vector(b.spin));
        const body = world.createRigidBody(desc);
        const { box, sphere } = b.shape;
        let collider = new RAPIER.ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 1, z: 0 }));
        if (box) collider = RAPIER.ColliderDesc.cuboid(...box.half_extents);
        if (sphere) collider = RAPIER.ColliderDesc.ball(sphere.radius);
        if (!b.isStatic) collider.setMass(b.mass);
        world.createCollider(collider.setFriction(friction).setRestitution(restitution), body);
        return body;
    });
    return {
        step: () => world.step(),
        positions: () => made.map((body) => body.translation()).map(({ x, y, z }) => [x, y, z]),
    };
}
