// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Planck.js, Box2D 2.4's algorithm in JavaScript and double precision, as a guest: its identity, its features, its keys.
import { readFileSync } from 'node:fs';
import * as rg from '../../sdk/rigor_guest.mjs';
import { breaking } from '../shared/breaking.mjs';
import { PlanckWorld } from './world.mjs';

const manifest = new URL('../node_modules/planck/package.json', import.meta.url);
const { version } = JSON.parse(readFileSync(manifest));

const capabilities = {
    dynamics: true,
    dimensions: [2],
    shapes: ['circle', 'box', 'capsule', 'polygon', 'half_plane', 'segment', 'chain'],
    joints: [
        ...['hinge', 'hinge.limit', 'hinge.motor', 'slider', 'slider.limit', 'slider.motor', 'fixed'],
        ...['distance', 'distance.limit', 'distance.spring', 'wheel', 'wheel.motor', 'wheel.spring'],
        ...['six_dof', 'six_dof.limit', 'six_dof.motor', 'six_dof.spring'],
        ...breaking(['hinge', 'slider', 'fixed', 'distance', 'wheel', 'six_dof']),
    ],
    contact_impulses: true,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    surface_velocity: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        '3D': 'README.md of planck: "2D JavaScript Physics Engine"',
        'hinge.spring': 'planck.d.ts, interface RevoluteJointOpt: limits and a motor',
        'slider.spring': 'planck.d.ts, interface PrismaticJointOpt: limits and a motor',
        'distance.motor': 'planck.d.ts, interface DistanceJointOpt: length and softness',
        'wheel.limit': 'planck.d.ts, interface WheelJointOpt: none',
        static_friction: 'planck.d.ts, interface FixtureOpt: friction is the one coefficient',
        rolling_friction: 'planck.d.ts, interface FixtureOpt: friction is the one coefficient',
    },
};

const options = [
    rg.number('velocity_iterations', 1, 100000, 8, 50, 'velocity iterations per step', true),
    rg.number('position_iterations', 0, 100000, 3, 10, 'position iterations per step', true),
    rg.number('linear_slop', 1e-9, 1, 0.005, 1e-5, 'overlap that is left alone, half the skin of polygons [m]'),
    rg.number('restitution_threshold', 0, 1e9, 1, 0, 'slower approaches do not bounce [m/s]'),
    rg.choice('warm_starting', ['on', 'off'], 'on', 'on', 'start from the last impulses'),
    rg.choice('continuous', ['on', 'off'], 'on', 'off', 'time-of-impact handling of fast bodies'),
    rg.choice('sleeping', ['on', 'off'], 'on', 'off', 'bodies at rest are stopped and skipped'),
    rg.number('max_travel', 1e-3, 1e9, 2, 1e6, 'farthest way of a body in a step [m]'),
];

rg.serve({
    name: 'planck',
    title: 'Planck.js',
    version,
    precision: 'f64',
    build_notes: `planck ${version}, JavaScript, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new PlanckWorld(scenario, dt, settings),
});
