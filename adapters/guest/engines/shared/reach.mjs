// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import * as rg from '../../sdk/rigor_guest.mjs';

/** Half the side of the box that stands for a half-plane: no body gets farther in free flight [m]. */
export function reachOf(scenario) {
    const t = scenario.duration;
    const fall = 0.5 * rg.norm(scenario.gravity) * t * t;
    const farthest = scenario.bodies.map((body) => rg.norm(body.position) + rg.norm(body.velocity) * t + fall);
    return Math.min(1000, Math.max(20, 2 * Math.max(...farthest)));
}
