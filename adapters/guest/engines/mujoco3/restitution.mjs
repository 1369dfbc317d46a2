// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Restitution by a contact's spring and damper, for a library that has no coefficient of it.
//
// A unit mass on a spring of angular frequency w and damping ratio z bounces with a part e of its speed, which falls with z
// from 1 at z = 0. It is taken from the library's own steps of it: the acceleration at the start of a step, never towards the
// ground, then the velocity, then the position; the mean over where in a step the mass arrives.

/** Angular frequency of such springs times the time step: a bounce lasts some ten steps. */
const kRate = 0.3;
const kArrivals = 16;

function bounce(ratio, arrival) {
    let [x, v] = [arrival, -1];
    for (let k = 0; k < 1000 && !(x >= 0 && v > 0); ++k) {
        if (x < 0) v += Math.max(0, -kRate * kRate * x - 2 * ratio * kRate * v);
        x += v;
    }
    return v;
}

/** Mean part of the speed that a damping ratio leaves. */
export function restitutionOf(ratio) {
    let total = 0;
    for (let k = 0; k < kArrivals; ++k) total += bounce(ratio, (k + 0.5) / kArrivals);
    return Math.max(0, total / kArrivals);
}

export function dampingRatioFor(restitution) {
    let [low, high] = [0, 2];
    for (let k = 0; k < 40; ++k) {
        const middle = 0.5 * (low + high);
        if (restitutionOf(middle) > restitution) low = middle;
        else high = middle;
    }
    return low;
}

/** solref and solimp of the contacts of a pair. */
export function contactSolref(restitution, dt, settings) {
    const solimp = [settings.solimp_min, settings.solimp_max, settings.solimp_width];
    const timeconst = Math.max(Number(settings.solref_timeconst), 2 * dt);
    if (settings.restitution === 'none' || restitution === 0) return { solref: [timeconst, settings.solref_dampratio], solimp };
    const frequency = kRate / dt;
    const damping = 2 * dampingRatioFor(restitution) * frequency;
    return { solref: [-frequency * frequency, -damping], solimp };
}

/** What a solref bounces with, for reading back. */
export function restitutionIn([stiffness, damping]) {
    return stiffness < 0 ? restitutionOf(-damping / (2 * Math.sqrt(-stiffness))) : 0;
}
