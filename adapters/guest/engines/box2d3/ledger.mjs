// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What Box2D 3 does otherwise than the scenario asks, as measured (README.md).
import * as rg from '../../sdk/rigor_guest.mjs';
import { ledgerOfBreaking } from '../shared/breaking.mjs';
import { moves } from './shapes.mjs';

export function ledgerOf({ scenario, settings, substeps, reach }) {
    const lines = [
        rg.approximate('precision', 'f64', 'f32', 'the library has single precision only'),
        rg.exact('solver', `soft contacts, ${substeps} sub-steps`),
        rg.exact('pair_coefficients', "by the library's callbacks"),
        rg.approximate(
            'contact_softness',
            'rigid',
            `${settings.contact_hertz} Hz, damping ratio ${settings.contact_damping_ratio}`,
            'contacts are springs and dampers',
        ),
        rg.approximate(
            'impulses',
            'reported',
            'not reported',
            'the package gives those of the last sub-step and a sum that counts relaxation, neither of which is that of the step',
        ),
        rg.approximate('max_linear_speed', 'none', `${settings.max_linear_speed} m/s`, 'velocities are cut off there'),
    ];
    lines.push(
        substeps === 1
            ? rg.exact('integrator', 'symplectic_euler')
            : rg.approximate(
                  'integrator',
                  'one step of dt',
                  `${substeps} sub-steps of symplectic Euler`,
                  'sub-steps are the iterations of the solver',
              ),
        Number(settings.restitution_threshold) > 0
            ? rg.approximate('restitution_threshold', '0', `${settings.restitution_threshold} m/s`, 'slower approaches do not bounce')
            : rg.exact('restitution_threshold', '0'),
        settings.fast_rotation === 'on'
            ? rg.exact('fast_rotation', 'on')
            : rg.approximate('fast_rotation', 'on', 'off', 'a sub-step turns by at most a quarter of half a turn'),
        settings.sleeping === 'on'
            ? rg.approximate('sleeping', 'off', 'on', 'bodies at rest are stopped')
            : rg.exact('sleeping', 'off'),
    );
    if (scenario.bodies.some((body) => body.shapes.some((shape) => shape.shape === 'half_plane')))
        lines.push(
            rg.approximate('half_plane', 'unbounded', `a box of side ${2 * reach} m`, 'the library has no half-plane'),
        );
    const springs = scenario.joints.some(({ type, axes }) => type !== 'hinge' && axes.some((axis) => axis.stiffness > 0));
    if (springs)
        lines.push(
            rg.approximate('springs', 'of constant stiffness', 'of constant frequency', "the library's springs follow the mass of their coordinate"),
        );
    if (scenario.bodies.some((body) => body.shapes.some(moves)))
        lines.push(
            rg.approximate('surface_velocity', 'of every point', 'round the shape', 'the library has one speed for a whole outline: that of its upper side'),
        );
    if (scenario.pairs.some((pair) => pair.rolling_friction > 0))
        lines.push(
            rg.approximate(
                'rolling_friction',
                'of every pair',
                'of round shapes on others',
                'the library takes the greater part of a radius and the greater radius: two circles of different radii have more',
            ),
        );
    lines.push(...ledgerOfBreaking(scenario, 'b2Joint_GetConstraintForce and b2Joint_GetConstraintTorque'));
    return lines;
}
