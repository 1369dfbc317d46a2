// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Jolt Physics as a guest: its identity, its features, and its option keys.
import * as rg from '../../sdk/rigor_guest.mjs';
import { breaking } from '../shared/breaking.mjs';
import { breakable } from './joints.mjs';
import { version } from './library.mjs';
import { JoltWorld } from './world.mjs';

const joints = ['ball', 'fixed', 'distance', 'distance.limit', 'distance.spring'];
for (const type of ['hinge', 'slider']) joints.push(type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`));

joints.push('cone_twist', 'cone_twist.limit', 'six_dof', 'six_dof.limit', 'six_dof.motor', 'six_dof.spring');
joints.push('ball.limit', 'ball.spring', 'cone_twist.motor', 'cone_twist.spring');
joints.push('wheel', 'wheel.limit', 'wheel.motor', 'wheel.spring');
joints.push(...breaking(breakable));

const oneCoefficient = 'types.d.ts, class ContactSettings: mCombinedFriction is the one coefficient of a contact';
const capabilities = {
    dynamics: true,
    dimensions: [3],
    planar: true,
    shapes: [
        ...['sphere', 'box', 'capsule', 'cylinder', 'cone', 'hull', 'half_space', 'triangle_mesh', 'height_field'],
        ...['circle', 'polygon', 'half_plane', 'segment', 'chain'],
    ],
    joints,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    surface_velocity: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        'distance.motor': 'types.d.ts, class DistanceConstraint: limits and their spring',
        ellipsoid: 'types.d.ts, EShapeSubType: none is an ellipsoid',
        static_friction: oneCoefficient,
        rolling_friction: oneCoefficient,
        torsional_friction: oneCoefficient,
    },
};

const options = [
    rg.number('velocity_steps', 1, 1000, 10, 40, 'iterations of velocities, mNumVelocitySteps', true),
    rg.number('position_steps', 0, 1000, 2, 10, 'iterations of positions, mNumPositionSteps', true),
    rg.number('collision_steps', 1, 100, 1, 1, 'sub-steps, each with its own collision detection', true),
    rg.number('baumgarte', 0, 1, 0.2, 0.2, 'part of the overlap that an iteration of positions removes'),
    rg.number('penetration_slop', 0, 1, 0.02, 0, 'overlap that is left alone [m]'),
    rg.number('speculative_distance', 0, 1, 0.02, 0.02, 'contacts are found so far ahead [m]'),
    rg.number('convex_radius', 0, 1, 0.05, 0, 'rounding of boxes, cylinders and hulls, inwards [m]'),
    rg.number('restitution_threshold', 0, 100, 1, 0, 'slower approaches do not bounce [m/s]'),
    rg.choice('gyroscopic_term', ['on', 'off'], 'off', 'on', 'mApplyGyroscopicForce of every body'),
    rg.choice('internal_edge_removal', ['on', 'off'], 'off', 'on', 'mEnhancedInternalEdgeRemoval of every body: inner edges are not felt'),
    rg.choice('sleeping', ['on', 'off'], 'on', 'off', 'bodies at rest are put to sleep'),
    rg.choice('contact_cache', ['on', 'off'], 'on', 'off', 'contacts of pairs that hardly moved are kept over steps'),
    rg.number('max_linear_velocity', 1, 1e9, 500, 1e6, 'velocities are cut off there [m/s]'),
    rg.number('max_angular_velocity', 1, 1e9, 47.1238899230957, 1e6, 'angular velocities are cut off there [rad/s]'),
];

rg.serve({
    name: 'jolt',
    title: 'Jolt Physics',
    version,
    precision: 'f32',
    build_notes: `jolt-physics ${version} of npm, whose numbers are not those of the C++ library, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new JoltWorld(scenario, dt, settings),
});
