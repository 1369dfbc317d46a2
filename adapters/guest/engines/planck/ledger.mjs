// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What Planck.js does otherwise than the scenario asks.
import * as rg from '../../sdk/rigor_guest.mjs';
import { ledgerOfBreaking } from '../shared/breaking.mjs';

export function ledgerOf({ scenario, settings, reach }) {
    const lines = [
        rg.exact('integrator', 'symplectic_euler'),
        rg.exact(
            'solver',
            `sequential impulses, ${settings.velocity_iterations} of velocities, ${settings.position_iterations} of positions`,
        ),
        rg.exact('pair_coefficients', "by the library's contact events"),
        rg.approximate('penetration_slop', '0', `${settings.linear_slop} m`, 'overlap that is left alone'),
        rg.approximate('skin', '0', `${2 * settings.linear_slop} m`, 'polygons and segments touch before they meet'),
        rg.approximate('max_travel', 'none', `${settings.max_travel} m in a step`, 'bodies are slowed down to it'),
    ];
    lines.push(
        Number(settings.restitution_threshold) > 0
            ? rg.approximate('restitution_threshold', '0', `${settings.restitution_threshold} m/s`, 'slower approaches do not bounce')
            : rg.exact('restitution_threshold', '0'),
        settings.sleeping === 'on'
            ? rg.approximate('sleeping', 'off', 'on', 'bodies at rest are stopped')
            : rg.exact('sleeping', 'off'),
    );
    const has = (name) => scenario.bodies.some((body) => body.collides && body.shapes.some(({ shape }) => shape === name));
    if (has('capsule'))
        lines.push(rg.approximate('capsule', 'one shape', 'a rectangle and two circles', 'the library has none; contacts may come twice where the parts meet'));
    if (has('half_plane'))
        lines.push(rg.approximate('half_plane', 'unbounded', `a box of side ${2 * reach} m`, 'the library has no half-plane'));
    if (scenario.joints.some(({ axes }) => axes.some((axis) => axis.stiffness > 0)))
        lines.push(
            rg.approximate('springs', 'of constant stiffness', 'of constant frequency', "the library's springs follow the mass of their coordinate"),
        );
    lines.push(...ledgerOfBreaking(scenario, 'getReactionForce and getReactionTorque'));
    return lines;
}
