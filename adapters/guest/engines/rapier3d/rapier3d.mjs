// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 3D as a guest: its identity, its features, and its option keys.
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { RapierWorld } from './world.mjs';

await RAPIER.init();

const joints = ['ball', 'fixed'];
for (const type of ['hinge', 'slider']) joints.push(type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`));

const capabilities = {
    dynamics: true,
    dimensions: [3],
    shapes: ['sphere', 'box', 'capsule', 'cylinder', 'cone', 'hull', 'half_space'],
    joints,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        '2D': 'README.md of @dimforge/rapier3d-compat: 2D is another package, rapier2d',
        ellipsoid: 'geometry/shape.d.ts, enum ShapeType: none is an ellipsoid',
        distance: 'dynamics/impulse_joint.d.ts, enum JointType: Rope bounds a distance from above, Spring is soft',
        static_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
        rolling_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
        torsional_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
    },
};

const options = [
    rg.number('solver_iterations', 1, 1000, 4, 4, 'sub-steps of the solver, numSolverIterations', true),
    rg.number('internal_pgs_iterations', 1, 1000, 1, 4, 'sweeps in each sub-step, numInternalPgsIterations', true),
    rg.choice('sleeping', ['on', 'off'], 'on', 'off', 'bodies at rest are put to sleep'),
    rg.number('allowed_linear_error', 0, 1, 0.005, 0, 'overlap that is left alone [m], normalizedAllowedLinearError'),
    rg.number('prediction_distance', 0, 1, 0.02, 0.02, 'contacts are found so far ahead [m]'),
    rg.number('contact_frequency', 1, 1e6, 30, 30, 'natural frequency of the soft contacts [Hz]'),
];

rg.serve({
    name: 'rapier3d',
    title: 'Rapier 3D',
    version: RAPIER.version(),
    precision: 'f32',
    build_notes: `@dimforge/rapier3d-compat, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new RapierWorld(scenario, dt, settings),
});
