// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in Planck.js.
import { performance } from 'node:perf_hooks';
import { Settings, World } from 'planck';
import * as rg from '../../sdk/rigor_guest.mjs';
import { Breaking } from '../shared/breaking.mjs';
import { addJoints } from '../shared/joints.mjs';
import { reachOf } from '../shared/reach.mjs';
import { Contacts } from './contacts.mjs';
import { jointOf } from './joints.mjs';
import { ledgerOf } from './ledger.mjs';
import { angleOf, shapesOf, toPlanck } from './shapes.mjs';

const quaternionOf = (angle) => [Math.cos(0.5 * angle), 0, 0, Math.sin(0.5 * angle)];
const fromPlanck = ({ x, y }) => [x, y, 0];

export class PlanckWorld extends rg.World {
    scheme = 'symplectic_euler';
    impulses = true;
    set_states = 'kept';

    constructor(scenario, dt, settings) {
        super();
        this.scenario = scenario;
        this.settings = settings;
        this.dt = dt;
        this.applySettings();
        this.world = new World({
            gravity: toPlanck(scenario.gravity),
            allowSleep: settings.sleeping === 'on',
            continuousPhysics: settings.continuous === 'on',
            warmStarting: settings.warm_starting === 'on',
        });
        this.contactsOf = new Contacts(scenario);
        this.contactsOf.listenTo(this.world);
        this.reach = reachOf(scenario);
        this.bodies = scenario.bodies.map((body, i) => this.addBody(body, i));
        const outside = () => this.world.createBody();
        const joints = addJoints(scenario, this.bodies, outside, (...joint) =>
            this.world.createJoint(jointOf(scenario, ...joint)),
        );
        const reactionOf = (joint) => ({
            force: joint.getReactionForce(1 / dt).length(),
            torque: Math.abs(joint.getReactionTorque(1 / dt)),
        });
        this.breaking = new Breaking(scenario, joints, reactionOf, (joint) => this.world.destroyJoint(joint));
    }

    /** The library's settings are of the whole process: set again for every step. */
    applySettings() {
        Settings.linearSlop = Number(this.settings.linear_slop);
        Settings.velocityThreshold = Number(this.settings.restitution_threshold);
        Settings.maxTranslation = Number(this.settings.max_travel);
        Settings.maxRotation = 1e6;
        if (this.settings.max_travel === '2') Settings.maxRotation = 0.5 * Math.PI;
    }

    addBody(body, index) {
        // The library multiplies velocities by 1 / (1 + c dt).
        const dampingFor = (kept) => (kept ** -this.dt - 1) / this.dt;
        const created = this.world.createBody({
            type: body.type,
            position: toPlanck(body.position),
            angle: angleOf(body.orientation),
            linearDamping: dampingFor(body.linear_velocity_kept),
            angularDamping: dampingFor(body.angular_velocity_kept),
            gravityScale: body.gravity_scale,
            allowSleep: this.settings.sleeping === 'on',
        });
        if (body.collides)
            body.shapes.forEach((shape, k) => {
                const traits = {
                    density: 0,
                    filterCategoryBits: shape.filter.layers,
                    filterMaskBits: shape.filter.collides_with,
                    filterGroupIndex: shape.filter.group,
                    userData: [index, k],
                };
                for (const part of shapesOf(shape, this.reach, `body '${body.name}'`)) created.createFixture(part, traits);
            });
        if (body.type === 'dynamic') {
            const center = body.center_of_mass;
            // About the origin of the body.
            const I = body.inertia[8] + body.mass * rg.dot(center, center);
            created.setMassData({ mass: body.mass, center: toPlanck(center), I });
        }
        if (body.type !== 'static') {
            created.setLinearVelocity(toPlanck(body.velocity));
            created.setAngularVelocity(body.angular_velocity[2]);
        }
        return created;
    }

    stateOf(body) {
        const velocity = fromPlanck(body.getLinearVelocity());
        const pose = [...fromPlanck(body.getPosition()), ...quaternionOf(body.getAngle())];
        return [...pose, ...velocity, 0, 0, body.getAngularVelocity()];
    }
    states() {
        return this.bodies.map((body) => this.stateOf(body));
    }

    applyForce(index, force, torque) {
        this.bodies[index].applyForceToCenter(toPlanck(force), true);
        this.bodies[index].applyTorque(torque[2], true);
    }
    applyImpulse(index, linear, angular) {
        const body = this.bodies[index];
        body.applyLinearImpulse(toPlanck(linear), body.getWorldCenter(), true);
        body.applyAngularImpulse(angular[2], true);
    }

    step() {
        this.applySettings();
        this.contactsOf.beginStep(this.bodies);
        const start = performance.now();
        this.world.step(this.dt, Number(this.settings.velocity_iterations), Number(this.settings.position_iterations));
        const seconds = 1e-3 * (performance.now() - start);
        const asleep = this.bodies.flatMap((body, i) => (body.isDynamic() && !body.isAwake() ? [i] : []));
        return { seconds, asleep, broken: this.breaking.afterStep() };
    }

    contacts() {
        return this.contactsOf.rows();
    }

    setStates(states) {
        states.forEach((row, i) => {
            const body = this.bodies[i];
            if (!body.isDynamic()) return;
            body.setTransform(toPlanck(row), angleOf(row.slice(3, 7)));
            body.setLinearVelocity(toPlanck(row.slice(7, 9)));
            body.setAngularVelocity(row[12]);
            body.setAwake(true);
        });
    }

    readBack() {
        const whole = fromPlanck(this.world.getGravity());
        const bodies = this.scenario.bodies.map((given, i) => {
            const body = this.bodies[i];
            const gravity = rg.scaled(body.getGravityScale(), whole);
            const inertia = new Array(9).fill(0);
            if (given.type !== 'dynamic') return rg.bodyRow(0, [0, 0, 0], inertia, this.stateOf(body), gravity);
            const center = fromPlanck(body.getLocalCenter());
            inertia[8] = body.getInertia() - body.getMass() * rg.dot(center, center);
            return rg.bodyRow(body.getMass(), center, inertia, this.stateOf(body), gravity);
        });
        // The listener gives every contact these numbers.
        return { bodies, pairs: this.scenario.pairs.map((p) => [p.a, p.b, p.friction, p.restitution]) };
    }

    ledger() {
        return ledgerOf(this);
    }
}
