// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { BoxShape, CircleShape, World } from 'planck';

export const engine = 'planck:preset=default';
export const bound = 1e-9;
export const scenes = ['bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'];

export function start({ gravity, dt, friction, restitution, bodies }) {
    const world = new World({ gravity: { x: gravity[0], y: gravity[1] } });
    const made = bodies.map((b) => {
        const body = world.createBody({
            type: b.isStatic ? 'static' : 'dynamic',
            position: { x: b.position[0], y: b.position[1] },
            angle: b.angle,
            linearVelocity: { x: b.velocity[0], y: b.velocity[1] },
            angularVelocity: b.spin,
        });
        const { box, circle } = b.shape;
        const area = box ? 4 * box.half_extents[0] * box.half_extents[1] : Math.PI * circle.radius ** 2;
        const shape = box ? new BoxShape(...box.half_extents) : new CircleShape(circle.radius);
        body.createFixture({ shape, density: b.isStatic ? 0 : b.mass / area, friction, restitution });
        return body;
    });
    return {
        step: () => world.step(dt, 8, 3),
        positions: () => made.map((body) => body.getPosition()).map(({ x, y }) => [x, y, 0]),
    };
}
