// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

const atOrigin = { position: [0, 0, 0], orientation: [1, 0, 0, 0] };

/**
 * Calls add(joint, bodyA, bodyB, poseA, poseB) for every joint of a scenario and returns what it returned. `bodies` are the library's, in the scenario's
 * order; where A is the world, its body is what outside() returns, in the world frame.
 */
export function addJoints(scenario, bodies, outside, add) {
    return scenario.joints.map((joint) => {
        const [a, b] = [joint.body_a, joint.body_b];
        const bodyA = a < 0 ? outside() : bodies[a];
        const poseA = a < 0 ? atOrigin : scenario.bodies[a];
        return add(joint, bodyA, bodies[b], poseA, scenario.bodies[b]);
    });
}
