// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in cannon-es. The library's bodies have their origin in the centre of mass and a diagonal inertia, so their
// axes are the principal ones.
import { performance } from 'node:perf_hooks';
import { Body, ContactMaterial, Material, World } from 'cannon-es';
import * as rg from '../../sdk/rigor_guest.mjs';
import { filterBits } from '../shared/filters.mjs';
import { Breaking } from '../shared/breaking.mjs';
import { addJoints } from '../shared/joints.mjs';
import { contactRows } from './contacts.mjs';
import { jointOf, reactionOf } from './joints.mjs';
import { ledgerOf } from './ledger.mjs';
import { refuseUntouched, shapesOf } from './shapes.mjs';
import { fromCannon, quatFromCannon, quatToCannon, toCannon } from './vectors.mjs';

const kTypes = { static: Body.STATIC, kinematic: Body.KINEMATIC, dynamic: Body.DYNAMIC };

export class CannonWorld extends rg.World {
    scheme = 'symplectic_euler';
    impulses = true;
    set_states = 'kept';

    constructor(scenario, dt, settings) {
        super();
        this.scenario = scenario;
        this.settings = settings;
        this.dt = dt;
        refuseUntouched(scenario);
        this.world = new World({ gravity: toCannon(scenario.gravity), allowSleep: settings.sleeping === 'on' });
        this.world.solver.iterations = Number(settings.iterations);
        this.world.solver.tolerance = Number(settings.tolerance);
        this.world.narrowphase.enableFrictionReduction = settings.friction_reduction === 'on';
        this.addMaterials();
        this.bits = filterBits(scenario);
        this.owners = new Map(); // shape of the library -> its number in the body
        this.indexOf = new Map(); // body of the library -> its index in the scenario
        this.frames = scenario.bodies.map((body) => this.frameOf(body));
        this.bodies = scenario.bodies.map((body, i) => this.addBody(body, i));
        this.bodies.forEach((body, i) => this.indexOf.set(body, i));
        this.addJoints();
    }

    addMaterials() {
        const { settings, scenario, world } = this;
        this.materials = Array.from({ length: scenario.materials }, () => new Material());
        const stiffness = Number(settings.contact_stiffness);
        const relaxation = Number(settings.contact_relaxation);
        // The solver bounds impulses by what the library reckons as a force.
        const bound = settings.friction_bound === 'impulse' ? this.dt : 1;
        for (const { a, b, friction, restitution } of scenario.pairs)
            world.addContactMaterial(
                new ContactMaterial(this.materials[a], this.materials[b], {
                    friction: friction * bound,
                    restitution,
                    contactEquationStiffness: stiffness,
                    contactEquationRelaxation: relaxation,
                    frictionEquationStiffness: stiffness,
                    frictionEquationRelaxation: relaxation,
                }),
            );
    }

    /** The pose of the library's body in the scenario's, and its moments. */
    frameOf(body) {
        if (body.type !== 'dynamic') return { center: [0, 0, 0], axes: [1, 0, 0, 0], moments: [0, 0, 0] };
        if (this.scenario.planar) {
            const I = body.inertia[8];
            return { center: body.center_of_mass, axes: [1, 0, 0, 0], moments: [I, I, I] };
        }
        const { moments, orientation } = rg.principalAxes(body.inertia);
        return { center: body.center_of_mass, axes: orientation, moments };
    }

    addBody(body, index) {
        const { center, axes } = this.frames[index];
        const created = new Body({
            type: kTypes[body.type],
            mass: body.type === 'dynamic' ? body.mass : 0,
            position: toCannon(rg.sum(body.position, rg.rotate(body.orientation, center))),
            quaternion: quatToCannon(rg.quaternionProduct(body.orientation, axes)),
            linearDamping: 1 - body.linear_velocity_kept,
            angularDamping: 1 - body.angular_velocity_kept,
            allowSleep: this.settings.sleeping === 'on',
        });
        if (this.scenario.planar && body.type === 'dynamic') {
            created.linearFactor.set(1, 1, 0);
            created.angularFactor.set(0, 0, 1);
        }
        if (body.collides) this.addShapes(created, body, index);
        if (body.type === 'dynamic') this.setInertia(created, index);
        if (body.type !== 'static') {
            created.velocity.set(...body.velocity);
            created.angularVelocity.set(...body.angular_velocity);
        }
        this.world.addBody(created);
        return created;
    }

    addShapes(created, body, index) {
        const { center, axes } = this.frames[index];
        created.collisionFilterGroup = 0;
        created.collisionFilterMask = 0;
        const how = { segments: Number(this.settings.segments), planar: this.scenario.planar, user: `body '${body.name}'` };
        body.shapes.forEach((given, k) => {
            const { category, mask } = this.bits(given);
            created.collisionFilterGroup |= category;
            created.collisionFilterMask |= mask;
            for (const { shape, position, orientation } of shapesOf(given, how)) {
                shape.collisionFilterGroup = category;
                shape.collisionFilterMask = mask;
                shape.material = this.materials[given.material];
                const offset = rg.rotateBack(axes, rg.difference(position, center));
                const turn = rg.quaternionProduct(rg.conjugate(axes), orientation);
                created.addShape(shape, toCannon(offset), quatToCannon(turn));
                this.owners.set(shape, k);
            }
        });
    }

    /** The library reckons the inertia of the box around the shapes whenever one is added: replaced by the given one. */
    setInertia(created, index) {
        const { moments } = this.frames[index];
        created.inertia.set(...moments);
        created.invInertia.set(...moments.map((moment) => 1 / moment));
        created.updateInertiaWorld(true);
    }

    addJoints() {
        const outside = new Body({ mass: 0 });
        const sideOf = (body) => {
            const { center, axes } = this.frames[this.indexOf.get(body)] ?? { center: [0, 0, 0], axes: [1, 0, 0, 0] };
            const turn = (v) => rg.rotateBack(axes, v);
            return { body, turn, place: (p) => turn(rg.difference(p, center)) };
        };
        if (this.scenario.joints.some((joint) => joint.body_a < 0)) this.world.addBody(outside);
        const joints = addJoints(this.scenario, this.bodies, () => outside, (joint, a, b) => {
            const created = jointOf(joint, sideOf(a), sideOf(b), this.dt, this.settings);
            this.world.addConstraint(created);
            return created;
        });
        this.breaking = new Breaking(this.scenario, joints, reactionOf, (joint) => this.world.removeConstraint(joint));
    }

    stateOf(index) {
        const body = this.bodies[index];
        const { center, axes } = this.frames[index];
        const orientation = rg.quaternionProduct(quatFromCannon(body.quaternion), rg.conjugate(axes));
        const position = rg.difference(fromCannon(body.position), rg.rotate(orientation, center));
        return [...position, ...orientation, ...fromCannon(body.velocity), ...fromCannon(body.angularVelocity)];
    }
    states() {
        return this.bodies.map((_, i) => this.stateOf(i));
    }

    applyForce(index, force, torque) {
        const body = this.bodies[index];
        body.wakeUp();
        body.force.vadd(toCannon(force), body.force);
        body.torque.vadd(toCannon(torque), body.torque);
    }
    applyImpulse(index, linear, angular) {
        const body = this.bodies[index];
        body.wakeUp();
        body.velocity.addScaledVector(body.invMass, toCannon(linear), body.velocity);
        body.angularVelocity.vadd(body.invInertiaWorld.vmult(toCannon(angular)), body.angularVelocity);
    }

    /** The library has one gravity for all bodies: what a body's own differs is a force. */
    applyGravityScales() {
        this.scenario.bodies.forEach((body, i) => {
            if (body.type !== 'dynamic' || body.gravity_scale === 1) return;
            const force = rg.scaled(body.mass * (body.gravity_scale - 1), this.scenario.gravity);
            this.bodies[i].force.vadd(toCannon(force), this.bodies[i].force);
        });
    }

    step() {
        this.applyGravityScales();
        const start = performance.now();
        this.world.step(this.dt);
        const seconds = 1e-3 * (performance.now() - start);
        const asleep = this.bodies.flatMap((body, i) => (body.sleepState === Body.SLEEPING ? [i] : []));
        const broken = this.breaking.afterStep();
        return { seconds, asleep, broken, counters: { contacts: this.world.contacts.length } };
    }

    contacts() {
        return contactRows(this);
    }

    setStates(states) {
        states.forEach((row, i) => {
            const body = this.bodies[i];
            if (body.type !== Body.DYNAMIC) return;
            const { center, axes } = this.frames[i];
            const orientation = row.slice(3, 7);
            body.position.set(...rg.sum(row.slice(0, 3), rg.rotate(orientation, center)));
            body.quaternion.copy(quatToCannon(rg.quaternionProduct(orientation, axes)));
            body.velocity.set(...row.slice(7, 10));
            body.angularVelocity.set(...row.slice(10, 13));
            body.aabbNeedsUpdate = true;
            body.updateInertiaWorld(true);
            body.wakeUp();
        });
    }

    readBack() {
        const whole = fromCannon(this.world.gravity);
        const bodies = this.scenario.bodies.map((given, i) => {
            const body = this.bodies[i];
            const gravity = rg.scaled(given.gravity_scale, whole);
            if (given.type !== 'dynamic')
                return rg.bodyRow(0, [0, 0, 0], new Array(9).fill(0), this.stateOf(i), gravity);
            const inertia = rg.tensorOf(fromCannon(body.inertia), this.frames[i].axes);
            return rg.bodyRow(body.mass, this.frames[i].center, inertia, this.stateOf(i), gravity);
        });
        const bound = this.settings.friction_bound === 'impulse' ? this.dt : 1;
        const pairs = this.scenario.pairs.map(({ a, b }) => {
            const own = this.world.getContactMaterial(this.materials[a], this.materials[b]);
            return [a, b, own.friction / bound, own.restitution];
        });
        return { bodies, pairs };
    }

    ledger() {
        return ledgerOf(this);
    }
}
