// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier2d-compat';

await RAPIER.init();

export const engine = 'rapier2d:preset=default';
export const bound = 2e-5; // single precision; the guest's coefficients multiply to those given here
export const scenes = ['hanging_chain_mode_2d', 'bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'];

export function start({ gravity, dt, friction, restitution, bodies, joints }) {
    const world = new RAPIER.World({ x: gravity[0], y: gravity[1] });
    world.timestep = dt;
    const made = bodies.map((b) => {
        const kind = b.isStatic ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic();
        const [x, y] = b.position;
        const desc = kind.setTranslation(x, y).setRotation(b.angle).setLinvel(b.velocity[0], b.velocity[1]).setAngvel(b.spin);
        const body = world.createRigidBody(desc);
        if (!b.collides) {
            body.setAdditionalMassProperties(b.mass, { x: 0, y: 0 }, b.inertia, true);
            return body;
        }
        const { box, circle } = b.shape;
        const collider = box ? RAPIER.ColliderDesc.cuboid(...box.half_extents) : RAPIER.ColliderDesc.ball(circle.radius);
        if (!b.isStatic) collider.setMass(b.mass);
        world.createCollider(collider.setFriction(friction).setRestitution(restitution), body);
        return body;
    });
    const vector = ([x, y]) => ({ x, y });
    for (const { a, b, anchorA, anchorB } of joints) {
        const first = made[a] ?? world.createRigidBody(RAPIER.RigidBodyDesc.fixed());
        world.createImpulseJoint(RAPIER.JointData.revolute(vector(anchorA), vector(anchorB)), first, made[b], true);
    }
    return {
        step: () => world.step(),
        positions: () => made.map((body) => body.translation()).map(({ x, y }) => [x, y, 0]),
    };
}
