// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { BoxShape, CircleShape, RevoluteJoint, Settings, World } from 'planck';

export const bound = 1e-9;
export const scenes = {
    default: ['dominoes_2d', 'hanging_chain_mode_2d', 'bouncing_disc_2d', 'backspin_2d', 'box_stack_2d'],
    matched: ['four_bar_linkage_2d', 'physical_pendulum_2d', 'turning_pendulum_2d'],
};

const { linearSlop, velocityThreshold, maxTranslation, maxRotation } = Settings;
/** Settings of the process, options of a world, and iterations. `default` is what the library has. */
const presets = {
    default: { settings: { linearSlop, velocityThreshold, maxTranslation, maxRotation }, options: {}, iterations: [8, 3] },
    matched: {
        settings: { linearSlop: 1e-5, velocityThreshold: 0, maxTranslation: 1e6, maxRotation: 1e6 },
        options: { allowSleep: false, continuousPhysics: false },
        iterations: [50, 10],
    },
};

export function start({ preset, gravity, dt, friction, restitution, bodies, joints }) {
    const { settings, options, iterations } = presets[preset];
    Object.assign(Settings, settings);
    const world = new World({ gravity: { x: gravity[0], y: gravity[1] }, ...options });
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
        step: () => world.step(dt, ...iterations),
        positions: () => made.map((body) => body.getPosition()).map(({ x, y }) => [x, y, 0]),
    };
}
