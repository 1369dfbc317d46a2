// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bead of `rotating_hoop` by its equation of motion, and by a scheme that holds its hinge on velocities. The angle of
// the bead about the hinge is zero below the hinge.

/** Arm of the bead [m], rate of the shaft [rad/s], moments about the anchor [kg m^2]. */
function numbersOf({ gravity, bodies: [shaft, bead] }) {
    const arm = Math.hypot(...bead.position);
    const [x, y, z] = bead.inertia;
    const swing = bead.mass * arm * arm;
    return { g: -gravity[1], mass: bead.mass, arm, rate: shaft.spin[1], own: { x, y, z }, about: { x: x + swing, y, z: z + swing } };
}

function placeOf(arm, angle, shaftAngle) {
    const aside = arm * Math.sin(angle);
    return [aside * Math.cos(shaftAngle), -arm * Math.cos(angle), -aside * Math.sin(shaftAngle)];
}

/** Places of the bead after every step by I_z a'' = (I_x - I_y) rate^2 sin a cos a - m g arm sin a, with RK4 in steps of dt / 100. */
export function exactly(scene, steps) {
    const { g, mass, arm, rate, about } = numbersOf(scene);
    const acceleration = (a) => ((about.x - about.y) * rate * rate * Math.cos(a) - mass * g * arm) * (Math.sin(a) / about.z);
    const h = scene.dt / 100;
    let [angle, speed] = [Math.atan2(scene.bodies[1].position[0], -scene.bodies[1].position[1]), 0];
    const places = [];
    for (let k = 1; k <= 100 * steps; ++k) {
        const [v1, a1] = [speed, acceleration(angle)];
        const [v2, a2] = [speed + 0.5 * h * a1, acceleration(angle + 0.5 * h * v1)];
        const [v3, a3] = [speed + 0.5 * h * a2, acceleration(angle + 0.5 * h * v2)];
        const [v4, a4] = [speed + h * a3, acceleration(angle + h * v3)];
        angle += (h / 6) * (v1 + 2 * v2 + 2 * v3 + v4);
        speed += (h / 6) * (a1 + 2 * a2 + 2 * a3 + a4);
        if (k % 100 === 0) places.push(placeOf(arm, angle, rate * h * k));
    }
    return places;
}

/**
 * The same by symplectic Euler on `subSteps` sub-steps h = dt / subSteps: the hinge's impulse makes the velocities agree with
 * the joint at the start of a sub-step, the bead flies straight along them, and is put back onto the joint with the least
 * displacement as its mass and its moment weigh it. Coordinates are those of the plane of the hoop, which turns by
 * rate h in a sub-step.
 */
export function byVelocities(scene, steps, subSteps) {
    const { g, mass, arm, rate, own, about } = numbersOf(scene);
    const h = scene.dt / subSteps;
    const [cos, sin] = [Math.cos(rate * h), Math.sin(rate * h)];
    let angle = Math.atan2(scene.bodies[1].position[0], -scene.bodies[1].position[1]);
    let [vx, vy, spin] = [0, 0, 0]; // of the bead in the plane
    const places = [];
    for (let k = 1; k <= steps * subSteps; ++k) {
        const [c, s] = [Math.cos(angle), Math.sin(angle)];
        const push = mass * arm * (vx * c + (vy - g * h) * s) + own.z * spin + h * (own.x - own.y) * rate * rate * s * c;
        const speed = push / about.z; // about the hinge
        const velocity = [speed * arm * c, speed * arm * s, -rate * arm * s];
        const flown = [arm * s + h * velocity[0], -arm * c + h * velocity[1], h * velocity[2]];
        const pointed = Math.atan2(cos * flown[0] - sin * flown[2], -flown[1]);
        angle = (mass * arm * arm * pointed + own.z * (angle + h * speed)) / about.z;
        [vx, vy, spin] = [cos * velocity[0] - sin * velocity[2], velocity[1], cos * speed];
        if (k % subSteps === 0) places.push(placeOf(arm, angle, rate * h * k));
    }
    return places;
}
