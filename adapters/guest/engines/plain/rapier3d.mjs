// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import RAPIER from '@dimforge/rapier3d-compat';

await RAPIER.init();

export const engine = 'rapier3d:preset=default';
// Single precision. Friction is multiplied as the guest does: averaged, it differs by a rounding, which the inner edges of
// the mesh of ball_in_cylinder make 3.2 mm.
export const bound = 1e-6;
export const scenes = ['hanging_chain_mode', 'ball_in_cylinder', 'backspin', 'bouncing_ball', 'box_stack'];

const vector = ([x, y, z]) => ({ x, y, z });

function colliderOf({ box, sphere, triangle_mesh: mesh }) {
    const { ColliderDesc } = RAPIER;
    if (box) return ColliderDesc.cuboid(...box.half_extents);
    if (sphere) return ColliderDesc.ball(sphere.radius);
    if (mesh) return ColliderDesc.trimesh(new Float32Array(mesh.vertices.flat()), new Uint32Array(mesh.triangles.flat()));
    return new ColliderDesc(new RAPIER.HalfSpace({ x: 0, y: 1, z: 0 }));
}

/** Bodies of the scenes are turned about the hinges' axis alone, so that it is the same in both. */
function addHinge(world, { anchorA, anchorB, axis }, a, b) {
    const data = RAPIER.JointData.revolute(vector(anchorA), vector(anchorB), vector(axis));
    world.createImpulseJoint(data, a, b, true);
}

export function start({ gravity, dt, friction, restitution, bodies, joints }) {
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
        if (!b.collides) {
            body.setAdditionalMassProperties(b.mass, vector([0, 0, 0]), vector(b.inertia), { w: 1, x: 0, y: 0, z: 0 }, true);
            return body;
        }
        const collider = colliderOf(b.shape);
        if (!b.isStatic) collider.setMass(b.mass);
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
