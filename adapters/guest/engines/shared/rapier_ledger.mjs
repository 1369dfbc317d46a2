// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What Rapier does otherwise than the scenario asks, as measured (rapier3d/README.md).
import * as rg from '../../sdk/rigor_guest.mjs';

export function ledgerOf({ settings, subSteps, friction, restitution }) {
    const lines = [
        rg.approximate('precision', 'f64', 'f32', 'the library has single precision only'),
        rg.exact('solver', `soft contacts, ${subSteps} sub-steps of ${settings.internal_pgs_iterations} sweeps`),
        rg.exact('friction_rule', friction.rule),
        rg.exact('restitution_rule', restitution.rule),
        rg.approximate(
            'velocity_limits',
            'none',
            '400 m/s, and an eighth of a turn in a step',
            'the library bounds velocities and has no setting for it',
        ),
        rg.approximate(
            'contact_softness',
            'rigid',
            `${settings.contact_frequency} Hz`,
            'contacts are springs and dampers; bodies at rest overlap',
        ),
        rg.approximate(
            'friction_impulses',
            'reported',
            'not reported',
            'those of the single points are near zero while the body is slowed, so that no impulses are given',
        ),
        settings.sleeping === 'on'
            ? rg.approximate('sleeping', 'off', 'on', 'bodies at rest are stopped')
            : rg.exact('sleeping', 'off'),
    ];
    if (subSteps === 1) lines.push(rg.exact('integrator', 'symplectic_euler'));
    else
        lines.push(
            rg.approximate(
                'integrator',
                'one step of dt',
                `${subSteps} sub-steps of symplectic Euler`,
                'sub-steps are the iterations of the solver',
            ),
        );
    if (Number(settings.allowed_linear_error) > 0)
        lines.push(
            rg.approximate('penetration_slop', '0', `${settings.allowed_linear_error} m`, 'overlap that is left alone'),
        );
    return lines;
}
