// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Box2D 3 as a guest: its identity, its features, and its option keys.
import * as rg from '../../sdk/rigor_guest.mjs';
import { breaking } from '../shared/breaking.mjs';
import { version } from './library.mjs';
import { Box2dWorld } from './world.mjs';

const capabilities = {
    dynamics: true,
    dimensions: [2],
    shapes: ['circle', 'box', 'capsule', 'polygon', 'half_plane', 'segment', 'chain'],
    joints: [
        ...['hinge', 'hinge.limit', 'hinge.motor', 'hinge.spring', 'slider', 'slider.limit', 'slider.motor', 'slider.spring'],
        ...['fixed', 'distance', 'distance.limit', 'distance.spring', 'wheel', 'wheel.limit', 'wheel.motor', 'wheel.spring'],
        ...['distance.motor', 'six_dof', 'six_dof.limit', 'six_dof.motor', 'six_dof.spring'],
        ...breaking(['hinge', 'slider', 'fixed', 'distance', 'wheel', 'six_dof']),
    ],
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    rolling_friction: true,
    surface_velocity: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        '3D': 'README.md of box2d3-wasm: Box2D is a 2D physics engine',
        static_friction: 'Box2D.deluxe.d.ts, interface b2SurfaceMaterial: friction is the one coefficient of sliding',
    },
};

const options = [
    rg.number('substeps', 1, 100, 4, 4, 'sub-steps of the solver', true),
    rg.number('contact_hertz', 1, 1e6, 30, 30, 'stiffness of the soft contacts [Hz]'),
    rg.number('contact_damping_ratio', 0, 1000, 10, 10, 'damping ratio of the soft contacts'),
    rg.number('restitution_threshold', 0, 100, 1, 0, 'slower approaches do not bounce [m/s]'),
    rg.choice('continuous', ['on', 'off'], 'on', 'off', 'bodies are stopped at static shapes that they would pass'),
    rg.choice('sleeping', ['on', 'off'], 'on', 'off', 'bodies at rest are put to sleep'),
    rg.choice('fast_rotation', ['on', 'off'], 'off', 'on', 'off: a sub-step turns by at most a quarter of half a turn'),
    rg.number('max_linear_speed', 1, 1e9, 400, 1e6, 'velocities are cut off there [m/s]'),
];

rg.serve({
    name: 'box2d3',
    title: 'Box2D 3',
    version,
    precision: 'f32',
    build_notes: `box2d3-wasm ${version}, whose numbers are not those of Box2D, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new Box2dWorld(scenario, dt, settings),
});
