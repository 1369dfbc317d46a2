// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MuJoCo 3 as a guest: its identity, its features, and its option keys.
import * as rg from '../../sdk/rigor_guest.mjs';
import { breaking } from '../shared/breaking.mjs';
import { collide } from './collide.mjs';
import { M } from './library.mjs';
import { MujocoWorld } from './world.mjs';

const geoms = 'MuJoCo documentation, XML reference, geom/type: none is of this kind';
const joints = ['ball', 'fixed', 'distance', 'distance.limit', 'distance.spring', 'six_dof'];
for (const type of ['hinge', 'slider']) joints.push(type, ...['limit', 'motor', 'spring'].map((f) => `${type}.${f}`));
joints.push('six_dof.limit', 'six_dof.motor', 'six_dof.spring', 'ball.limit', 'cone_twist', 'cone_twist.limit');
joints.push('cone_twist.motor', 'distance.motor');
joints.push('wheel', 'wheel.limit', 'wheel.motor', 'wheel.spring', ...breaking(['ball', 'hinge', 'fixed', 'distance']));

const wholeRotation = 'MuJoCo documentation, XML reference, body/joint: range and stiffness of a ball are of its whole rotation';
const equalities = 'MuJoCo documentation, XML reference, equality: connect, weld, joint, tendon, flex; only these have an active flag';
const capabilities = {
    dynamics: true,
    collision: true,
    signed_distance: true,
    dimensions: [3],
    planar: true,
    shapes: [
        ...['sphere', 'box', 'capsule', 'cylinder', 'ellipsoid', 'hull', 'half_space', 'height_field'],
        ...['circle', 'polygon', 'half_plane'],
    ],
    joints,
    contact_impulses: true,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    rolling_friction: true,
    torsional_friction: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        cone: geoms,
        segment: geoms,
        chain: geoms,
        'ball.spring': wholeRotation,
        'cone_twist.spring': wholeRotation,
        ...Object.fromEntries(['slider', 'wheel', 'six_dof', 'cone_twist'].map((type) => [`${type}.break`, equalities])),
        triangle_mesh: 'MuJoCo documentation, Computation, Collision detection: a mesh collides as its convex hull',
        surface_velocity: 'MuJoCo documentation, XML reference, geom: none of its attributes is a velocity',
        static_friction: 'MuJoCo documentation, XML reference, geom/friction: sliding, torsional, rolling',
    },
};

const options = [
    rg.choice('integrator', ['Euler', 'RK4', 'implicit', 'implicitfast'], 'Euler', 'Euler', 'scheme of the time step'),
    rg.choice('solver', ['PGS', 'CG', 'Newton'], 'Newton', 'Newton', 'solver of the constraints'),
    rg.choice('cone', ['pyramidal', 'elliptic'], 'pyramidal', 'elliptic', 'friction law'),
    rg.number('iterations', 1, 1e6, 100, 500, 'most iterations of the solver', true),
    rg.number('tolerance', 0, 1, 1e-8, 1e-12, 'the solver stops at a smaller improvement'),
    rg.number('noslip_iterations', 0, 1e6, 0, 0, 'sweeps that remove slip afterwards', true),
    rg.number('impratio', 1e-3, 1e6, 1, 10, 'stiffness of friction against that of normal forces'),
    rg.number('solref_timeconst', 0, 10, 0.02, 0, 'time constant of contacts and joints; never below two steps [s]'),
    rg.number('solref_dampratio', 1e-3, 100, 1, 1, 'damping ratio of contacts and joints'),
    rg.number('solimp_min', 1e-4, 0.9999, 0.9, 0.99, 'least impedance'),
    rg.number('solimp_max', 1e-4, 0.9999, 0.95, 0.999, 'greatest impedance'),
    rg.number('solimp_width', 1e-9, 1, 0.001, 0.001, 'overlap at which the impedance is greatest [m]'),
    rg.choice('native_ccd', ['on', 'off'], 'on', 'on', "on: the library's own convex collision, off: libccd"),
    rg.choice('restitution', ['none', 'solref'], 'solref', 'solref', 'solref: contacts that bounce are springs of that restitution'),
];

rg.serve({
    name: 'mujoco3',
    title: 'MuJoCo 3',
    version: M.mj_versionString(),
    precision: 'f64',
    build_notes: `@mujoco/mujoco, WebAssembly, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new MujocoWorld(scenario, dt, settings),
    collide,
});
