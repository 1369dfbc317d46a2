// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 2D as a guest: its identity and its features.
import RAPIER from '@dimforge/rapier2d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { collide } from '../shared/rapier_collide.mjs';
import { options } from '../shared/rapier_options.mjs';
import { RapierWorld } from '../shared/rapier_world.mjs';
import { space } from './space.mjs';

await RAPIER.init();

const joints = ['fixed'];
for (const type of ['hinge', 'slider']) joints.push(type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`));

const capabilities = {
    dynamics: true,
    collision: true,
    signed_distance: true,
    dimensions: [2],
    shapes: ['circle', 'box', 'capsule', 'polygon', 'half_plane', 'segment'],
    joints,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        '3D': 'README.md of @dimforge/rapier2d-compat: 3D is another package, rapier3d',
        distance: 'dynamics/impulse_joint.d.ts, enum JointType: Rope bounds a distance from above, Spring is soft',
        static_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
        rolling_friction: 'geometry/collider.d.ts, setFriction: the one coefficient of friction',
    },
};

rg.serve({
    name: 'rapier2d',
    title: 'Rapier 2D',
    version: RAPIER.version(),
    precision: 'f32',
    build_notes: `@dimforge/rapier2d-compat, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new RapierWorld(space, scenario, dt, settings),
    collide: (a, b) => collide(space, a, b),
});
