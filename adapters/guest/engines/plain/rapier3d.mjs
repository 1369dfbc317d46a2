// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';
import { byVelocities, exactly } from './rotating_hoop.mjs';

await RAPIER.init();

// Single precision. Friction is multiplied as the guest does: averaged, it differs by a rounding, which the inner edges of
// the mesh of ball_in_cylinder make 3.2 mm.
export const bound = 1e-6;
/** The guest gives a hinge frames whose x is its axis, this program an axis: 3.0e-6 m apart from rounding in 180 steps. */
export const bounds = { rotating_hoop: 1e-5 };
export const scenes = {
    default: ['hanging_chain_mode', 'ball_in_cylinder', 'backspin', 'bouncing_ball', 'box_stack', 'rod_strikes_ball'],
    matched: [
        ...['ball_in_trough', 'mass_ratio_heavy_above', 'tipping_slope', 'rotating_hoop', 'hanging_chain_mode'],
        ...['rod_strikes_ball', 'rod_strikes_ball_with_its_end'],
    ],
};

const vector = ([x, y, z]) => ({ x, y, z });

function kindOf({ isStatic, isKinematic }) {
    if (isKinematic) return RAPIER.RigidBodyDesc.kinematicVelocityBased();
    return isStatic ? RAPIER.RigidBodyDesc.fixed() : RAPIER.RigidBodyDesc.dynamic();
}

function colliderOf({ box, sphere, capsule, triangle_mesh: mesh }, preset) {
    const { ColliderDesc } = RAPIER;
    if (box) return ColliderDesc.cuboid(...box.half_extents);
    if (sphere) return ColliderDesc.ball(sphere.radius);
    if (capsule) return ColliderDesc.capsule(capsule.half_length, capsule.radius);
    if (mesh) {
        const flags = preset === 'matched' ? RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES_TWO_SIDED : undefined;
        return ColliderDesc.trimesh(new Float32Array(mesh.vertices.flat()), new Uint32Array(mesh.triangles.flat()), flags);
    }
    return new ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 1, z: 0 }));
}

/** Bodies of the scenes are turned about the hinges' axis alone, so that it is the same in both. */
function addHinge(world, { anchorA, anchorB, axis }, a, b) {
    const data = RAPIER.JointData.revolute(vector(anchorA), vector(anchorB), vector(axis));
    world.createImpulseJoint(data, a, b, true);
}

const kSubSteps = 4; // the library's own

function farthest(places, others) {
    return Math.max(...places.map((p, k) => Math.hypot(...p.map((x, axis) => x - others[k][axis]))));
}

/** Places of the bead on the hoop after every step. */
function beadOf(scene, steps) {
    const run = start(scene);
    return Array.from({ length: steps }, () => {
        run.step();
        return run.positions()[1];
    });
}

/** Whose loss it is that the bead of `rotating_hoop` is behind: sentences, and whether they hold. */
export function findings(read) {
    const steps = Math.round(read('rotating_hoop').duration / read('rotating_hoop').dt);
    return ['default', 'matched'].flatMap((preset) => {
        const scene = read('rotating_hoop', preset);
        const bead = beadOf(scene, steps);
        const error = farthest(bead, exactly(scene, steps));
        const rest = farthest(bead, byVelocities(scene, steps, kSubSteps));
        return [
            [`the bead on the hoop is 0.7 m and more off (${error.toFixed(3)} m, ${preset})`, error > 0.7],
            [`it is where a joint held on velocities has it, to 2 mm (${rest.toExponential(1)} m, ${preset})`, rest < 2e-3],
        ];
    });
}

export function start({ preset, gravity, dt, friction, restitution, bodies, joints }) {
    const world = new RAPIER.World(vector(gravity));
    world.timestep = dt;
    if (preset === 'matched') {
        world.integrationParameters.numInternalPgsIterations = 4;
        world.integrationParameters.normalizedAllowedLinearError = 0;
    }
    const made = bodies.map((b) => {
        const [w, x, y, z] = b.quaternion;
        const desc = kindOf(b)
            .setTranslation(...b.position)
            .setRotation({ w, x, y, z })
            .setLinvel(...b.velocity)
            .setAngvel(vector(b.spin))
            .setCanSleep(preset !== 'matched');
        const body = world.createRigidBody(desc);
        const giveMass = (mass, inertia) =>
            body.setAdditionalMassProperties(mass, vector([0, 0, 0]), vector(inertia), { w: 1, x: 0, y: 0, z: 0 }, true);
        // Without a mass of its own a kinematic body would turn about the middle of its shape.
        if (b.isKinematic) giveMass(1, [1, 1, 1]);
        else if (!b.collides) giveMass(b.mass, b.inertia);
        if (!b.collides) return body;
        const half = 0.5 * b.shapeAngle;
        const turn = { w: Math.cos(half), x: 0, y: 0, z: Math.sin(half) };
        const collider = colliderOf(b.shape, preset).setTranslation(...b.shapePosition).setRotation(turn);
        if (!b.isStatic) collider.setMass(b.mass ?? 0);
        collider.setFriction(Math.sqrt(friction)).setFrictionCombineRule(RAPIER.CoefficientCombineRule.Multiply);
        world.createCollider(collider.setRestitution(restitution), body);
        return body;
    });
    const outside = () => world.createRigidBody(RAPIER.RigidBodyDesc.fixed());
    for (const joint of joints) addHinge(world, joint, made[joint.a] ?? outside(), made[joint.b]);
    return {
        step: () => world.step(),
        positions: () => made.map((body) => body.translation()).map(({ x, y, z }) => [x, y, z]),
    };
}
