// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { BoxShape, CircleShape, RevoluteJoint, World } from 'planck';

export const engine = 'planck:preset=default';
export const bound = 1e-9;
export const scenes = ['dominoes_2d', 'hanging_chain_mode_2d', 'bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'];

export function start({ gravity, dt, friction, restitution, bodies, joints }) {
    const world = new World({ gravity: { x: gravity[0], y: gravity[1] } });
    const made = bodies.map((b) => {
        const body = world.createBody({
            type: b.isStatic ? 'static' : 'dynamic',
            position: { x: b.position[0], y: b.position[1] },
            angle: b.angle,
            linearVelocity: { x: b.velocity[0], y: b.velocity[1] },
            angularVelocity: b.spin,
        });
        if (!b.collides) {
            body.setMassData({ mass: b.mass, center: { x: 0, y: 0 }, I: b.inertia });
            return body;
        }
        const { box, circle } = b.shape;
        const area = box ? 4 * box.half_extents[0] * box.half_extents[1] : Math.PI * circle.radius ** 2;
        const shape = box ? new BoxShape(...box.half_extents) : new CircleShape(circle.radius);
        body.createFixture({ shape, density: b.isStatic ? 0 : b.mass / area, friction, restitution });
        return body;
    });
    const vector = ([x, y]) => ({ x, y });
    for (const { a, b, anchor } of joints) {
        const first = made[a] ?? world.createBody();
        world.createJoint(new RevoluteJoint({}, first, made[b], vector(anchor)));
    }
    return {
        step: () => world.step(dt, 8, 3),
        positions: () => made.map((body) => body.getPosition()).map(({ x, y }) => [x, y, 0]),
    };
}
