// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What Jolt does otherwise than the scenario asks, as measured (README.md).
import * as rg from '../../sdk/rigor_guest.mjs';
import { ledgerOfBreaking } from '../shared/breaking.mjs';

export function ledgerOf({ scenario, settings, collisionSteps }) {
    const off = (topic, value, unit, reason) =>
        Number(value) > 0 ? rg.approximate(topic, '0', `${value} ${unit}`, reason) : rg.exact(topic, '0');
    const lines = [
        rg.approximate('precision', 'f64', 'f32', 'the package has no build in double precision'),
        rg.exact('integrator', collisionSteps === 1 ? 'symplectic_euler' : `${collisionSteps} sub-steps of symplectic Euler`),
        rg.exact('solver', `sequential impulses, ${settings.velocity_steps} of velocities, ${settings.position_steps} of positions`),
        rg.exact('pair_coefficients', 'set in the contact listener'),
        off('penetration_slop', settings.penetration_slop, 'm', 'overlap that is left alone'),
        off('convex_radius', settings.convex_radius, 'm', 'edges and corners are rounded'),
        off('restitution_threshold', settings.restitution_threshold, 'm/s', 'slower approaches do not bounce'),
        rg.approximate(
            'velocity_limits',
            'none',
            `${settings.max_linear_velocity} m/s and ${settings.max_angular_velocity} rad/s`,
            'the library cuts velocities off there',
        ),
        rg.approximate(
            'impulses',
            'reported',
            'not reported',
            'the package gives contact points to the listener before they are solved, and no impulses afterwards',
        ),
    ];
    lines.push(
        settings.gyroscopic_term === 'on'
            ? rg.exact('gyroscopic_term', 'on')
            : rg.approximate('gyroscopic_term', 'on', 'off', 'as the library ships'),
        settings.sleeping === 'on'
            ? rg.approximate('sleeping', 'off', 'on', 'bodies at rest are stopped')
            : rg.exact('sleeping', 'off'),
    );
    lines.push(...ledgerOfBreaking(scenario, 'GetTotalLambdaPosition and GetTotalLambdaRotation'));
    return lines;
}
