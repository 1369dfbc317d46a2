// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The smallest guest: bodies that fly freely and touch nothing, by symplectic Euler and turns at constant velocity.
import { existsSync } from 'node:fs';

const beside = new URL('rigor_guest.mjs', import.meta.url);
const rg = await import(existsSync(beside) ? beside : new URL('../../sdk/rigor_guest.mjs', import.meta.url));

class FreeFlightWorld extends rg.World {
    scheme = 'symplectic_euler';

    constructor(scenario, dt) {
        super();
        this.dt = dt;
        this.planar = scenario.dimension === 2;
        this.bodies = scenario.bodies.map((given) => {
            const moves = given.type === 'dynamic';
            const [q, com] = [given.orientation, given.center_of_mass];
            const x = rg.sum(given.position, rg.rotate(q, com)); // centre of mass
            const [v, w] = moves ? [given.velocity, given.angular_velocity] : [[0, 0, 0], [0, 0, 0]];
            const gravity = rg.scaled(moves ? given.gravity_scale : 0, scenario.gravity);
            return { given, moves, q, com, x, v, w, gravity, force: [0, 0, 0], torque: [0, 0, 0] };
        });
    }

    applyForce(body, force, torque) {
        const b = this.bodies[body];
        b.force = rg.sum(b.force, force);
        b.torque = rg.sum(b.torque, torque);
    }

    step() {
        for (const b of this.bodies.filter((body) => body.moves)) {
            const torque = rg.rotateBack(b.q, b.torque);
            const I = b.given.inertia;
            const turn = this.planar ? [0, 0, torque[2] / I[8]] : rg.times(rg.inverse(I), torque);
            b.v = rg.sum(b.v, rg.scaled(this.dt, rg.sum(b.gravity, rg.scaled(1 / b.given.mass, b.force))));
            b.w = rg.sum(b.w, rg.scaled(this.dt, rg.rotate(b.q, turn)));
            b.x = rg.sum(b.x, rg.scaled(this.dt, b.v));
            b.q = rg.turned(b.q, b.w, this.dt);
            b.force = b.torque = [0, 0, 0];
        }
    }

    stateOf = (b) => [...rg.difference(b.x, rg.rotate(b.q, b.com)), ...b.q, ...b.v, ...b.w];
    states = () => this.bodies.map(this.stateOf);
    readBack = () => ({
        bodies: this.bodies.map((b) => rg.bodyRow(b.given.mass, b.com, b.given.inertia, this.stateOf(b), b.gravity)),
        pairs: [],
    });
    ledger = () => [
        rg.exact('integrator', 'symplectic_euler'),
        rg.approximate('gyroscopic_term', 'exact rigid-body rotation', 'none', 'constant without torque'),
    ];
}

rg.serve({
    name: 'free_flight_javascript',
    title: 'Free flight, in JavaScript',
    version: '1.0',
    precision: 'f64',
    capabilities: { dynamics: true, dimensions: [2, 3], gravity_scale: true, center_of_mass_offset: true },
    build: (scenario, dt) => new FreeFlightWorld(scenario, dt),
});
