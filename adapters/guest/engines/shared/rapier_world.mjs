// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in Rapier, 2D or 3D. What differs between the two packages is in a `space` (rapier2d/space.mjs,
// rapier3d/space.mjs). Colliders have no mass, the mass is given.
import { performance } from 'node:perf_hooks';
import * as rg from '../../sdk/rigor_guest.mjs';
import { combine, solveCoefficients, touchingPairs } from './coefficients.mjs';
import { ledgerOf } from './rapier_ledger.mjs';

const kRules = { average: 'Average', min: 'Min', multiply: 'Multiply', max: 'Max' };
const kCombination = 'geometry/collider.d.ts, setFrictionCombineRule: one rule for the coefficients of two colliders';

/** Rapier multiplies a velocity by 1 / (1 + c dt), once a step; c for what is kept of it per second. */
const dampingFor = (kept, dt) => (kept ** -dt - 1) / dt;

/** Kinematic bodies turn about a centre of mass, which without one is that of their shapes. The scenario's turn about their origin. */
const kAboutOrigin = { mass: 1, center_of_mass: [0, 0, 0], inertia: [1, 0, 0, 0, 1, 0, 0, 0, 1] };

export class RapierWorld extends rg.World {
    impulses = true;
    set_states = 'kept';
    snapshots = true;

    constructor(space, scenario, dt, settings) {
        super();
        this.space = space;
        this.scenario = scenario;
        this.settings = settings;
        this.subSteps = Number(settings.solver_iterations);
        this.dt = dt;
        this.scheme = this.subSteps === 1 ? 'symplectic_euler' : 'unknown';
        this.world = new space.RAPIER.World(space.vector(scenario.gravity));
        this.world.timestep = dt;
        const parameters = this.world.integrationParameters;
        parameters.numSolverIterations = this.subSteps;
        parameters.numInternalPgsIterations = Number(settings.internal_pgs_iterations);
        parameters.normalizedAllowedLinearError = Number(settings.allowed_linear_error);
        parameters.normalizedPredictionDistance = Number(settings.prediction_distance);
        parameters.contact_natural_frequency = Number(settings.contact_frequency);
        this.owners = new Map(); // collider -> [body, shape]
        this.pushed = new Set();
        this.solvePairs();
        this.hooks = this.hooksOf();
        this.events = this.hooks && new space.RAPIER.EventQueue(true); // a step without one calls no hooks
        // Rapier's bodies may be turned against the scenario's from the start.
        this.frames = scenario.bodies.map((body) => space.frameOf(body));
        this.handles = scenario.bodies.map((body, i) => this.addBody(body, i).handle);
        for (const joint of scenario.joints) this.addJoint(joint);
        this.poses = this.states();
    }

    solvePairs() {
        this.pairs = touchingPairs(this.scenario);
        const solve = (key, rules) => {
            const pairs = this.pairs.map((p) => ({ a: p.a, b: p.b, value: p[key] }));
            const found = solveCoefficients(this.scenario.materials, pairs, rules);
            if (!found) throw new rg.Unsupported(`${key} of these pairs of materials`, kCombination);
            return found;
        };
        this.friction = solve('friction', ['multiply', 'average', 'min', 'max']);
        this.restitution = solve('restitution', ['min', 'multiply', 'average', 'max']);
    }

    /** Groups are no bits of Rapier's: they are decided in its callback, with everything else of the filter. */
    hooksOf() {
        const filters = this.scenario.bodies.flatMap((body) => body.shapes.map((shape) => shape.filter));
        if (filters.every((filter) => filter.group === 0)) return undefined;
        const filterOf = (handle) => {
            const [body, shape] = this.owners.get(handle);
            return this.scenario.bodies[body].shapes[shape].filter;
        };
        const mayTouch = (a, b) => {
            if (a.group !== 0 && a.group === b.group) return a.group > 0;
            return (a.collides_with & b.layers) !== 0 && (b.collides_with & a.layers) !== 0;
        };
        return {
            filterContactPair: (a, b) =>
                mayTouch(filterOf(a), filterOf(b)) ? this.space.RAPIER.SolverFlags.COMPUTE_IMPULSE : null,
            filterIntersectionPair: () => true,
        };
    }

    descOf(body, frame) {
        const { RigidBodyDesc } = this.space.RAPIER;
        if (body.type === 'static') return RigidBodyDesc.fixed();
        if (body.type === 'kinematic') return this.space.withMass(RigidBodyDesc.kinematicVelocityBased(), kAboutOrigin, frame);
        return this.space
            .withMass(RigidBodyDesc.dynamic(), body, frame)
            .setGravityScale(body.gravity_scale)
            .setLinearDamping(dampingFor(body.linear_velocity_kept, this.dt))
            .setAngularDamping(dampingFor(body.angular_velocity_kept, this.dt));
    }

    addBody(body, index) {
        const { space } = this;
        const frame = this.frames[index];
        const desc = this.descOf(body, frame)
            .setTranslation(...space.components(body.position))
            .setRotation(space.rotation(this.turnedTo(index, body.orientation)))
            .setCanSleep(this.settings.sleeping === 'on');
        if (body.type !== 'static')
            desc.setLinvel(...space.components(body.velocity)).setAngvel(space.turn(body.angular_velocity));
        const created = this.world.createRigidBody(desc);
        if (body.collides) this.addColliders(created, body, index, frame);
        // Otherwise done in the first step; and every collider that is added turns the axes of the moments a little, in single
        // precision, until it is.
        created.recomputeMassPropertiesFromColliders();
        return created;
    }

    addColliders(created, body, index, frame) {
        const { space } = this;
        body.shapes.forEach((shape, k) => {
            const { layers, collides_with } = shape.filter;
            const rules = space.RAPIER.CoefficientCombineRule;
            const collider = this.colliderOf(shape, frame, `body '${body.name}'`)
                .setFriction(this.friction.values[shape.material])
                .setFrictionCombineRule(rules[kRules[this.friction.rule]])
                .setRestitution(this.restitution.values[shape.material])
                .setRestitutionCombineRule(rules[kRules[this.restitution.rule]]);
            if (this.hooks) collider.setActiveHooks(space.RAPIER.ActiveHooks.FILTER_CONTACT_PAIRS);
            else collider.setCollisionGroups(((layers & 0xffff) << 16) | (collides_with & 0xffff));
            this.owners.set(this.world.createCollider(collider, created).handle, [index, k]);
        });
    }

    /** Rapier's orientation of a body for one of the scenario's. */
    turnedTo(index, orientation) {
        return rg.quaternionProduct(orientation, rg.conjugate(this.frames[index]));
    }

    colliderOf(shape, frame, user) {
        const { desc, offset = [0, 0, 0] } = this.space.builders[shape.shape](shape, this.settings);
        if (!desc) throw new rg.BadInput(`${user}: Rapier builds no hull of these vertices`);
        const inBody = rg.sum(shape.position, rg.rotate(shape.orientation, offset));
        return desc
            .setTranslation(...this.space.components(rg.rotate(frame, inBody)))
            .setRotation(this.space.rotation(rg.quaternionProduct(frame, shape.orientation)))
            .setDensity(0);
    }

    addJoint(joint) {
        const still = { position: [0, 0, 0], orientation: [1, 0, 0, 0] };
        const sideOf = (index) =>
            index < 0
                ? { body: this.world.createRigidBody(this.space.RAPIER.RigidBodyDesc.fixed()), pose: still, frame: [1, 0, 0, 0] }
                : { body: this.body(index), pose: this.scenario.bodies[index], frame: this.frames[index] };
        this.space.addJoint(this.world, joint, sideOf(joint.body_a), sideOf(joint.body_b));
    }

    body(index) {
        return this.world.getRigidBody(this.handles[index]);
    }

    stateOf(index) {
        const { space } = this;
        const body = this.body(index);
        return [
            ...space.fromVector(body.translation()),
            ...rg.quaternionProduct(space.fromRotation(body.rotation()), this.frames[index]),
            ...space.fromVector(body.linvel()),
            ...space.fromTurn(body.angvel()),
        ];
    }
    states() {
        return this.handles.map((_, i) => this.stateOf(i));
    }

    applyForce(index, force, torque) {
        this.body(index).addForce(this.space.vector(force), true);
        this.body(index).addTorque(this.space.turn(torque), true);
        this.pushed.add(index);
    }
    applyImpulse(index, linear, angular) {
        this.body(index).applyImpulse(this.space.vector(linear), true);
        this.body(index).applyTorqueImpulse(this.space.turn(angular), true);
    }

    step() {
        this.poses = this.states();
        const start = performance.now();
        this.world.step(this.events, this.hooks);
        const seconds = 1e-3 * (performance.now() - start);
        for (const index of this.pushed) {
            this.body(index).resetForces(false);
            this.body(index).resetTorques(false);
        }
        this.pushed.clear();
        const asleep = this.handles.flatMap((_, i) => (this.body(i).isDynamic() && this.body(i).isSleeping() ? [i] : []));
        return { seconds, asleep };
    }

    /** A pair's collider in the world, as it stood when the step began. */
    placeOf([body, shape]) {
        const pose = this.poses[body];
        const given = this.scenario.bodies[body].shapes[shape];
        const offset = given.shape === 'half_space' ? rg.scaled(given.offset, given.normal) : [0, 0, 0];
        const origin = rg.sum(given.position, rg.rotate(given.orientation, offset));
        const orientation = pose.slice(3, 7);
        return (point) => {
            const inBody = rg.sum(origin, rg.rotate(given.orientation, point));
            return rg.sum(pose.slice(0, 3), rg.rotate(orientation, inBody));
        };
    }

    /**
     * Rapier keeps contacts over steps without updating their distances, so the depth is that of the points at the poses
     * of the step. Contacts that are apart and without impulse did not act.
     */
    contacts() {
        const rows = [];
        for (const handle of this.owners.keys()) {
            const collider = this.world.getCollider(handle);
            this.world.contactPairsWith(collider, (other) => {
                if (other.handle > handle && this.owners.has(other.handle)) this.appendPair(rows, collider, other);
            });
        }
        return rows;
    }

    appendPair(rows, colliderA, colliderB) {
        this.world.contactPair(colliderA, colliderB, (manifold, flipped) => {
            const [first, second] = (flipped ? [colliderB, colliderA] : [colliderA, colliderB]).map((c) =>
                this.owners.get(c.handle),
            );
            const [inFirst, inSecond] = [this.placeOf(first), this.placeOf(second)];
            const { fromVector } = this.space;
            const normal = fromVector(manifold.normal());
            for (let k = 0; k < manifold.numContacts(); ++k) {
                const p = inFirst(fromVector(manifold.localContactPoint1(k)));
                const q = inSecond(fromVector(manifold.localContactPoint2(k)));
                const depth = rg.dot(rg.difference(p, q), normal);
                if (depth < 0 && !(manifold.contactImpulse(k) > 0)) continue;
                const middle = rg.scaled(0.5, rg.sum(p, q));
                const half = rg.scaled(0.5 * depth, normal);
                const [a, b] = [rg.sum(middle, half), rg.difference(middle, half)];
                rows.push(
                    rg.contact(first[0], second[0], a, b, normal, depth, undefined, undefined, [first[1], second[1]]),
                );
            }
        });
    }

    setStates(states) {
        states.forEach((row, i) => {
            const body = this.body(i);
            if (!body.isDynamic()) return;
            const { space } = this;
            body.setTranslation(space.vector(row.slice(0, 3)), true);
            body.setRotation(space.rotation(this.turnedTo(i, row.slice(3, 7))), true);
            body.setLinvel(space.vector(row.slice(7, 10)), true);
            body.setAngvel(space.turn(row.slice(10, 13)), true);
        });
    }

    save() {
        return this.world.takeSnapshot();
    }
    restore(bytes) {
        const restored = this.space.RAPIER.World.restoreSnapshot(Uint8Array.from(bytes));
        if (!restored) return false;
        this.world.free();
        this.world = restored;
        return true;
    }

    readBack() {
        const bodies = this.scenario.bodies.map((given, i) => {
            const body = this.body(i);
            const { space } = this;
            const gravity = rg.scaled(body.gravityScale(), space.fromVector(this.world.gravity));
            if (given.type !== 'dynamic')
                return rg.bodyRow(0, [0, 0, 0], new Array(9).fill(0), this.stateOf(i), gravity);
            const center = rg.rotateBack(this.frames[i], space.fromVector(body.localCom()));
            return rg.bodyRow(body.mass(), center, space.inertiaOf(body), this.stateOf(i), gravity);
        });
        return { bodies, pairs: this.pairs.map(({ a, b }) => [a, b, ...this.coefficientsOf(a, b)]) };
    }

    /** Friction and restitution of two materials as the colliders have them. */
    coefficientsOf(a, b) {
        const colliderWith = (material) => {
            for (const [handle, [body, shape]] of this.owners)
                if (this.scenario.bodies[body].shapes[shape].material === material) return this.world.getCollider(handle);
        };
        const [first, second] = [colliderWith(a), colliderWith(b)];
        return [
            combine[this.friction.rule](first.friction(), second.friction()),
            combine[this.restitution.rule](first.restitution(), second.restitution()),
        ];
    }

    ledger() {
        return ledgerOf(this);
    }
    destroy() {
        this.world.free();
    }
}
