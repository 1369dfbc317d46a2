// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// What MuJoCo does otherwise than the scenario asks, as measured (README.md).
import * as rg from '../../sdk/rigor_guest.mjs';
import { ledgerOfBreaking } from '../shared/breaking.mjs';

export function ledgerOf({ scenario, settings, text, dt }) {
    const { solver, cone, iterations, integrator } = settings;
    const timeconst = Math.max(Number(settings.solref_timeconst), 2 * dt);
    const lines = [
        integrator === 'RK4'
            ? rg.approximate('integrator', 'one step of dt', 'RK4', 'constraint forces are those of four stages')
            : rg.exact('integrator', integrator === 'Euler' ? 'symplectic_euler' : integrator),
        rg.exact('solver', `${solver}, at most ${iterations} iterations`),
        cone === 'elliptic'
            ? rg.exact('friction_law', 'elliptic cone')
            : rg.approximate('friction_law', 'Coulomb cone', 'pyramidal', 'the pyramid lies within the cone of a friction sqrt(2) smaller along its edges'),
        rg.exact('pair_coefficients', text.frictions === null ? 'a pair element for every two geoms' : 'of the geoms, by the greater one'),
        rg.approximate('contact_softness', 'rigid', `time constant ${timeconst} s, impedance ${settings.solimp_min} to ${settings.solimp_max}`, 'constraints are soft; bodies at rest overlap and creep'),
        rg.exact('sleeping', 'off'),
        rg.exact('gyroscopic_term', 'on'),
    ];
    if (scenario.pairs.some((pair) => pair.restitution > 0))
        lines.push(
            settings.restitution === 'none'
                ? rg.approximate('restitution', 'of the pair', 'that of the softness', 'as the library ships', 'unsupported')
                : rg.approximate('restitution', 'of the pair', 'by an undamped spring', 'the library has no coefficient of restitution, but direct solref'),
        );
    if (scenario.bodies.some((body) => body.type === 'kinematic'))
        lines.push(rg.approximate('kinematic_bodies', 'unmoved', 'heavy and set to their motion after each step', "the library's own mocap bodies have no velocity in contacts"));
    if (text.motors.length > 0)
        lines.push(rg.approximate('motors', 'speed and greatest force', 'a force set at the start of each step, bounded', 'what else acts on the coordinate in the step is not counted'));
    if (integrator === 'RK4') lines.push(rg.approximate('impulses', 'reported', 'not reported', "RK4's last stage is not at the start of the step"));
    lines.push(...ledgerOfBreaking(scenario, 'forces of equalities (efc_force)'));
    const curved = scenario.bodies.some((body) => body.shapes.some(({ shape }) => shape === 'height_field'));
    if (curved) lines.push(rg.approximate('height_field', 'f64', 'f32', 'heights are kept in single precision'));
    return lines;
}
