// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// cannon-es as a guest: its identity, its features, and its option keys.
import { readFileSync } from 'node:fs';
import * as rg from '../../sdk/rigor_guest.mjs';
import { breaking } from '../shared/breaking.mjs';
import { CannonWorld } from './world.mjs';

const manifest = new URL('../node_modules/cannon-es/package.json', import.meta.url);
const { version } = JSON.parse(readFileSync(manifest));

const shapeTypes = 'cannon-es.d.ts, SHAPE_TYPES: none is of this kind';
const constraints = 'cannon-es.d.ts, constraints: ConeTwist, Distance, Hinge, Lock, PointToPoint';
const oneCoefficient = 'cannon-es.d.ts, class ContactMaterial: friction is the one coefficient';

const kMeshes = 'cannon-es.js, Narrowphase: triangle meshes meet spheres and planes alone, and nothing else is flat';

const capabilities = {
    dynamics: true,
    dimensions: [3],
    planar: true,
    shapes: [
        ...['sphere', 'box', 'capsule', 'cylinder', 'cone', 'hull', 'half_space', 'triangle_mesh', 'height_field'],
        ...['circle', 'polygon', 'half_plane'],
    ],
    joints: [
        ...['ball', 'ball.limit', 'cone_twist', 'cone_twist.limit', 'hinge', 'hinge.motor', 'fixed', 'distance', 'distance.spring'],
        ...breaking(['ball', 'cone_twist', 'hinge', 'fixed', 'distance']),
    ],
    contact_impulses: true,
    kinematic_bodies: true,
    damping: true,
    gravity_scale: true,
    center_of_mass_offset: true,
    contact_filters: true,
    shape_filters: true,
    library_lacks: {
        ellipsoid: shapeTypes,
        slider: constraints,
        wheel: constraints,
        six_dof: constraints,
        segment: kMeshes,
        chain: kMeshes,
        'distance.motor': 'cannon-es.d.ts, class DistanceConstraint: the distance to keep alone',
        'cone_twist.motor': 'cannon-es.d.ts, class ConeTwistConstraint: angles alone',
        'distance.limit': 'cannon-es.d.ts, class DistanceConstraint: the distance to keep alone',
        'ball.spring': 'cannon-es.d.ts, class Spring: between points of two bodies',
        'cone_twist.spring': 'cannon-es.d.ts, class Spring: between points of two bodies',
        'hinge.spring': 'cannon-es.d.ts, class HingeConstraint: motor alone',
        'hinge.limit': 'cannon-es.d.ts, class HingeConstraint: motor alone',
        surface_velocity: 'cannon-es.d.ts, class FrictionEquation: the velocity of the bodies alone',
        static_friction: oneCoefficient,
        rolling_friction: oneCoefficient,
        torsional_friction: oneCoefficient,
    },
};

const options = [
    rg.number('iterations', 1, 100000, 10, 200, 'sweeps of the Gauss-Seidel solver', true),
    rg.number('tolerance', 0, 1, 1e-7, 0, 'sweeps end where all changes of impulses add up to less [N s]'),
    rg.number('contact_stiffness', 1, 1e15, 1e7, 1e9, 'contactEquationStiffness [N/m]'),
    rg.number('contact_relaxation', 0.1, 1000, 3, 100, 'contactEquationRelaxation, steps'),
    rg.number('joint_stiffness', 1, 1e15, 1e7, 1e9, 'stiffness of the equations of joints [N/m]'),
    rg.number('joint_relaxation', 0.1, 1000, 4, 4, 'relaxation of the equations of joints, steps'),
    rg.choice('joint_step', ['1/60', 'scenario'], '1/60', 'scenario', 'time step that the equations of joints reckon with'),
    rg.choice(
        'friction_bound',
        ['force', 'impulse'],
        'force',
        'impulse',
        'force: a number of newtons bounds an impulse, as the library ships; impulse: times the time step',
    ),
    rg.choice('friction_reduction', ['on', 'off'], 'off', 'off', 'one friction for all points of a pair of shapes'),
    rg.number('segments', 3, 256, 8, 24, 'sides of cylinders and cones', true),
    rg.choice('sleeping', ['on', 'off'], 'off', 'off', 'bodies at rest are put to sleep'),
];

rg.serve({
    name: 'cannon',
    title: 'cannon-es',
    version,
    precision: 'f64',
    build_notes: `cannon-es ${version}, JavaScript, Node.js ${process.versions.node}`,
    capabilities,
    options,
    build: (scenario, dt, settings) => new CannonWorld(scenario, dt, settings),
});
