// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier as a guest: what its packages for 2D and 3D share.
import * as rg from '../../sdk/rigor_guest.mjs';
import { collide } from './rapier_collide.mjs';
import { options } from './rapier_options.mjs';
import { RapierWorld } from './rapier_world.mjs';

const oneCoefficient = 'geometry/collider.d.ts, setFriction: the one coefficient of friction';
/** Nothing tells what a joint has borne, so that nothing can break it. */
const lacksOfBreaking = (joints) =>
    Object.fromEntries(joints.map((type) => [`${type}.break`, 'dynamics/impulse_joint.d.ts, class ImpulseJoint: no force of a joint']));
const limited = ['hinge', 'slider'].flatMap((type) => [type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`)]);

/** Serves the package of `space`. `own` has its shapes, the joints and the lacks that the other package does not have. */
export function serveRapier(space, dimension, own) {
    rg.serve({
        name: `rapier${dimension}d`,
        title: `Rapier ${dimension}D`,
        version: space.RAPIER.version(),
        precision: 'f32',
        build_notes: `@dimforge/rapier${dimension}d-compat, WebAssembly, Node.js ${process.versions.node}`,
        capabilities: {
            dynamics: true,
            collision: true,
            signed_distance: true,
            dimensions: [dimension],
            shapes: own.shapes,
            joints: [...own.joints, 'fixed', 'distance', 'distance.limit', 'distance.spring', ...limited],
            kinematic_bodies: true,
            damping: true,
            gravity_scale: true,
            center_of_mass_offset: true,
            contact_filters: true,
            shape_filters: true,
            library_lacks: {
                ...own.lacks,
                ...lacksOfBreaking(['ball', 'hinge', 'slider', 'fixed', 'distance', 'six_dof', 'wheel', 'cone_twist']),
                'distance.motor': 'dynamics/impulse_joint.d.ts, JointData.spring and JointData.rope: rest length and softness, greatest length',
                surface_velocity: 'geometry/narrow_phase.d.ts: solverContactTangentVelocity is read, and nothing sets it',
                static_friction: oneCoefficient,
                rolling_friction: oneCoefficient,
            },
        },
        options,
        build: (scenario, dt, settings) => new RapierWorld(space, scenario, dt, settings),
        collide: (a, b) => collide(space, a, b),
    });
}
