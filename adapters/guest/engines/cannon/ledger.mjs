// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What cannon-es does otherwise than the scenario asks, as measured (README.md).
import * as rg from '../../sdk/rigor_guest.mjs';
import { ledgerOfBreaking } from '../shared/breaking.mjs';

export function ledgerOf({ scenario, settings }) {
    const { iterations, contact_stiffness, friction_bound } = settings;
    const lines = [
        rg.exact('integrator', 'symplectic_euler'),
        rg.exact('solver', `Gauss-Seidel, at most ${iterations} sweeps, without warm start`),
        rg.exact('pair_coefficients', 'a ContactMaterial for every pair'),
        rg.approximate('contact_softness', 'rigid', `${contact_stiffness} N/m`, 'contacts are springs and dampers'),
        rg.approximate(
            'friction_law',
            'Coulomb cone',
            `each of two directions of a contact bounded by mu m g${friction_bound === 'impulse' ? ' dt' : ', taken for an impulse'}`,
            'the bound is of the reduced mass and gravity, whatever the normal force',
        ),
        rg.approximate('gyroscopic_term', 'on', 'off', 'the library has none'),
        rg.approximate('restitution', 'of the relative velocity of the points', 'of that of the centres of mass', 'angular velocities do not bounce'),
        settings.sleeping === 'on'
            ? rg.approximate('sleeping', 'off', 'on', 'bodies at rest are stopped')
            : rg.exact('sleeping', 'off'),
    ];
    const has = (...names) => scenario.bodies.some((body) => body.shapes.some(({ shape }) => names.includes(shape)));
    if (has('cylinder', 'cone'))
        lines.push(rg.approximate('round_shapes', 'round', `${settings.segments} sides`, 'they are convex polyhedra'));
    if (has('capsule')) {
        const middle = scenario.planar ? 'a box' : `a cylinder of ${settings.segments} sides`;
        lines.push(rg.approximate('capsule', 'one shape', `${middle} and two balls`, 'the library has none; contacts come from every part'));
    }
    if (scenario.joints.length > 0)
        lines.push(
            rg.approximate('joint_softness', 'rigid', `${settings.joint_stiffness} N/m`, 'joints are springs and dampers'),
            settings.joint_step === 'scenario'
                ? rg.exact('joint_step', 'scenario')
                : rg.approximate('joint_step', 'scenario', '1/60 s', 'the library gives every joint the step of its default'),
        );
    lines.push(...ledgerOfBreaking(scenario, "the equations' multipliers"));
    return lines;
}
