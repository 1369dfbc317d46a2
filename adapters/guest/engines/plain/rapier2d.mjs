// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier2d-compat';

await RAPIER.init();

export const bound = 5e-5; // single precision; the guest's coefficients multiply to those given here
export const scenes = {
    default: ['hanging_chain_mode_2d', 'bouncing_disc_2d', 'backspin_2d', 'box_stack_2d', 'rod_strikes_ball_2d'],
    matched: ['bouncing_disc_2d', 'slide_on_chain_2d', 'ball_in_trough_2d', 'rod_strikes_ball_2d'],
};

function kindOf({ isStatic, isKinematic }) {
    if (isKinematic) return RAPIER.RigidBodyDesc.kinematicVelocityBased();
    return isStatic ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic();
}

function colliderOf({ box, circle, capsule, chain }) {
    const { ColliderDesc } = RAPIER;
    if (chain) return ColliderDesc.polyline(new Float32Array(chain.vertices.flat()));
    if (box) return ColliderDesc.cuboid(...box.half_extents);
    return capsule ? ColliderDesc.capsule(capsule.half_length, capsule.radius) : ColliderDesc.ball(circle.radius);
}

export function start({ preset, gravity, dt, friction, restitution, bodies, joints }) {
    const world = new RAPIER.World({ x: gravity[0], y: gravity[1] });
    world.timestep = dt;
    if (preset === 'matched') {
        world.integrationParameters.numInternalPgsIterations = 4;
        world.integrationParameters.normalizedAllowedLinearError = 0;
    }
    const made = bodies.map((b) => {
        const [x, y] = b.position;
        const desc = kindOf(b)
            .setTranslation(x, y)
            .setRotation(b.angle)
            .setLinvel(b.velocity[0], b.velocity[1])
            .setAngvel(b.spin)
            .setCanSleep(preset !== 'matched');
        const body = world.createRigidBody(desc);
        if (!b.collides) {
            body.setAdditionalMassProperties(b.mass, { x: 0, y: 0 }, b.inertia, true);
            return body;
        }
        // Without a mass of its own a kinematic body would turn about the middle of its shape.
        if (b.isKinematic) body.setAdditionalMassProperties(1, { x: 0, y: 0 }, 1, true);
        const collider = colliderOf(b.shape).setTranslation(b.shapePosition[0], b.shapePosition[1]).setRotation(b.shapeAngle);
        if (!b.isStatic) collider.setMass(b.mass ?? 0);
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
