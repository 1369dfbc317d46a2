// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rapier 3D as a guest: its identity, its features, and its option keys.
import RAPIER from '@dimforge/rapier3d-compat';
import * as rg from '../../sdk/rigor_guest.mjs';
import { collide } from '../shared/rapier_collide.mjs';
import { options } from '../shared/rapier_options.mjs';
import { RapierWorld } from '../shared/rapier_world.mjs';
import { space } from './space.mjs';

await RAPIER.init();

const joints = ['ball', 'fixed'];
for (const type of ['hinge', 'slider']) joints.push(type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`));

const capabilities = {
    dynamics: true,
    collision: true,
    signed_distance: true,
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

rg.serve({
    name: 'rapier3d',
    title: 'Rapier 3D',
    version: RAPIER.version(),
    precision: 'f32',
    build_notes: `@dimforge/rapier3d-compat, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new RapierWorld(space, scenario, dt, settings),
    collide: (a, b) => collide(space, a, b),
});
