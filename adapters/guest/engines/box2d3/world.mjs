// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in Box2D 3. The coefficients of a pair come from the library's callbacks, by the materials' numbers.
import { performance } from 'node:perf_hooks';
import * as rg from '../../sdk/rigor_guest.mjs';
import { Breaking } from '../shared/breaking.mjs';
import { touchingPairs } from '../shared/coefficients.mjs';
import { addJoints } from '../shared/joints.mjs';
import { reachOf } from '../shared/reach.mjs';
import { addJoint, reactionOf } from './joints.mjs';
import { ledgerOf } from './ledger.mjs';
import { angleOf, B, quaternionOf, vector, withRot, withVec2 } from './library.mjs';
import { addShapes, tangentSpeed } from './shapes.mjs';

/** The library multiplies velocities by 1 / (1 + c h) in every sub-step h; c for what is kept per second. */
const dampingFor = (kept, h) => (kept ** -h - 1) / h;
const keyOf = (shape) => shape.index1;

const kRolling = 'Box2D.deluxe.d.ts, interface b2SurfaceMaterial: rollingResistance is of a shape, and no callback combines two';

export class Box2dWorld extends rg.World {
    impulses = true;
    set_states = 'kept';

    constructor(scenario, dt, settings) {
        super();
        this.scenario = scenario;
        this.settings = settings;
        this.dt = dt;
        this.substeps = Number(settings.substeps);
        this.scheme = this.substeps === 1 ? 'symplectic_euler' : 'unknown';
        this.coefficients = rg.pairTable(scenario);
        this.owners = new Map(); // number of a shape in the library -> [body, shape]
        this.used = new Map(); // pair of materials -> the coefficients that the library has asked for
        this.createWorld();
        this.reach = reachOf(scenario);
        this.bodies = scenario.bodies.map((body, i) => this.addBody(body, i));
        const outside = () => this.stillBody();
        const joints = addJoints(scenario, this.bodies, outside, (...joint) => addJoint(this.world, scenario, ...joint));
        this.breaking = new Breaking(scenario, joints, reactionOf, (joint) => B.b2DestroyJoint(joint, true));
    }

    createWorld() {
        const given = this.settings;
        const def = B.b2DefaultWorldDef();
        withVec2(this.scenario.gravity, (gravity) => {
            def.gravity = gravity;
        });
        Object.assign(def, {
            enableSleep: given.sleeping === 'on',
            enableContinuous: given.continuous === 'on',
            restitutionThreshold: Number(given.restitution_threshold),
            contactHertz: Number(given.contact_hertz),
            contactDampingRatio: Number(given.contact_damping_ratio),
            maximumLinearSpeed: Number(given.max_linear_speed),
        });
        this.world = B.b2CreateWorld(def);
        def.delete();
        const pairOf = (a, b) => this.coefficients(Number(a), Number(b));
        B.b2World_SetFrictionCallback(this.world, (_fA, a, _fB, b) => pairOf(a, b).friction);
        B.b2World_SetRestitutionCallback(this.world, (_eA, a, _eB, b) => pairOf(a, b).restitution);
    }

    stillBody() {
        const def = B.b2DefaultBodyDef();
        const body = B.b2CreateBody(this.world, def);
        def.delete();
        return body;
    }

    addBody(body, index) {
        const def = B.b2DefaultBodyDef();
        def.type = B.b2BodyType[`b2_${body.type}Body`];
        withVec2(body.position, (p) => {
            def.position = p;
        });
        withRot(angleOf(body.orientation), (q) => {
            def.rotation = q;
        });
        const h = this.dt / this.substeps;
        Object.assign(def, {
            linearDamping: dampingFor(body.linear_velocity_kept, h),
            angularDamping: dampingFor(body.angular_velocity_kept, h),
            gravityScale: body.gravity_scale,
            enableSleep: this.settings.sleeping === 'on',
            allowFastRotation: this.settings.fast_rotation === 'on',
        });
        const created = B.b2CreateBody(this.world, def);
        def.delete();
        if (body.collides) body.shapes.forEach((shape, k) => this.addShape(created, body, shape, index, k));
        if (body.type === 'dynamic') this.setMass(created, body);
        if (body.type !== 'static') this.setVelocity(created, body.velocity, body.angular_velocity[2]);
        return created;
    }

    /**
     * The library's is a part of the radius of round shapes, and the greater of two shapes': one material of a round shape has one
     * rolling friction with all that it touches.
     */
    rollingResistance(shape, user) {
        const met = touchingPairs(this.scenario).filter(({ a, b }) => a === shape.material || b === shape.material);
        const all = new Set(met.map((pair) => pair.rolling_friction));
        if (all.size === 0 || (all.size === 1 && all.has(0)) || !(shape.radius > 0)) return 0;
        if (all.size > 1) throw new rg.Unsupported('several rolling frictions of one material', kRolling, user);
        return [...all][0] / shape.radius;
    }

    addShape(created, body, shape, index, k) {
        const def = B.b2DefaultShapeDef();
        const material = def.material;
        material.userMaterialId = BigInt(shape.material);
        material.tangentSpeed = tangentSpeed(shape, body, this.scenario.gravity);
        material.rollingResistance = this.rollingResistance(shape, `body '${body.name}'`);
        def.material = material;
        const filter = def.filter;
        filter.categoryBits = shape.filter.layers;
        filter.maskBits = shape.filter.collides_with;
        filter.groupIndex = shape.filter.group;
        def.filter = filter;
        // The library needs a mass of the shapes for the extent by which it lets turning bodies sleep.
        def.density = 1;
        def.updateBodyMass = true;
        const ids = addShapes(created, shape, def, this.reach, `body '${body.name}'`);
        def.delete();
        for (const id of ids) this.owners.set(keyOf(id), [index, k]);
    }

    setMass(created, body) {
        const data = B.b2Body_GetMassData(created);
        data.mass = body.mass;
        data.rotationalInertia = body.inertia[8];
        withVec2(body.center_of_mass, (center) => {
            data.center = center;
        });
        B.b2Body_SetMassData(created, data);
        data.delete();
    }

    setVelocity(created, velocity, rate) {
        withVec2(velocity, (v) => B.b2Body_SetLinearVelocity(created, v));
        B.b2Body_SetAngularVelocity(created, rate);
    }

    stateOf(body) {
        const q = B.b2Body_GetRotation(body);
        const angle = Math.atan2(q.s, q.c);
        q.delete();
        const position = vector(B.b2Body_GetPosition(body));
        const velocity = vector(B.b2Body_GetLinearVelocity(body));
        return [...position, ...quaternionOf(angle), ...velocity, 0, 0, B.b2Body_GetAngularVelocity(body)];
    }
    states() {
        return this.bodies.map((body) => this.stateOf(body));
    }

    applyForce(index, force, torque) {
        withVec2(force, (f) => B.b2Body_ApplyForceToCenter(this.bodies[index], f, true));
        B.b2Body_ApplyTorque(this.bodies[index], torque[2], true);
    }
    applyImpulse(index, linear, angular) {
        withVec2(linear, (p) => B.b2Body_ApplyLinearImpulseToCenter(this.bodies[index], p, true));
        B.b2Body_ApplyAngularImpulse(this.bodies[index], angular[2], true);
    }

    step() {
        const start = performance.now();
        B.b2World_Step(this.world, this.dt, this.substeps);
        const seconds = 1e-3 * (performance.now() - start);
        const asleep = this.bodies.flatMap((body, i) =>
            this.scenario.bodies[i].type === 'dynamic' && !B.b2Body_IsAwake(body) ? [i] : [],
        );
        return { seconds, asleep, broken: this.breaking.afterStep() };
    }

    /** Manifolds are those of the start of the step. Points that are apart and were never pushed did not act. */
    contacts() {
        const rows = [];
        this.bodies.forEach((body, i) => {
            if (this.scenario.bodies[i].type !== 'dynamic') return;
            const found = B.b2Body_GetContactData(body, B.b2Body_GetContactCapacity(body));
            for (const data of found) this.appendContact(rows, data, i);
        });
        return rows;
    }

    appendContact(rows, data, seenFrom) {
        const [[a, shapeA], [b, shapeB]] = [data.shapeIdA, data.shapeIdB].map((id) => this.owners.get(keyOf(id)));
        // Of two dynamic bodies the one of lower index reports.
        const other = a === seenFrom ? b : a;
        if (this.scenario.bodies[other].type === 'dynamic' && other < seenFrom) return;
        const manifold = data.manifold;
        const normal = vector(manifold.normal);
        for (let k = 0; k < manifold.pointCount; ++k) {
            const point = manifold.GetPoint(k);
            const depth = -point.separation;
            if (depth >= 0 || point.totalNormalImpulse > 0) {
                const middle = vector(point.point);
                const half = rg.scaled(0.5 * depth, normal);
                const [p, q] = [rg.sum(middle, half), rg.difference(middle, half)];
                rows.push(rg.contact(a, b, p, q, normal, depth, undefined, undefined, [shapeA, shapeB]));
            }
            point.delete();
        }
        manifold.delete();
    }

    setStates(states) {
        states.forEach((row, i) => {
            if (this.scenario.bodies[i].type !== 'dynamic') return;
            const body = this.bodies[i];
            withVec2(row.slice(0, 2), (p) =>
                withRot(angleOf(row.slice(3, 7)), (q) => B.b2Body_SetTransform(body, p, q)),
            );
            this.setVelocity(body, row.slice(7, 9), row[12]);
            B.b2Body_SetAwake(body, true);
        });
    }

    readBack() {
        const whole = vector(B.b2World_GetGravity(this.world));
        const bodies = this.scenario.bodies.map((given, i) => {
            const body = this.bodies[i];
            const gravity = rg.scaled(B.b2Body_GetGravityScale(body), whole);
            const inertia = new Array(9).fill(0);
            if (given.type !== 'dynamic') return rg.bodyRow(0, [0, 0, 0], inertia, this.stateOf(body), gravity);
            inertia[8] = B.b2Body_GetRotationalInertia(body);
            const center = vector(B.b2Body_GetLocalCenterOfMass(body));
            return rg.bodyRow(B.b2Body_GetMass(body), center, inertia, this.stateOf(body), gravity);
        });
        // The callbacks return these numbers.
        const pairs = this.scenario.pairs.map((p) => [p.a, p.b, Math.fround(p.friction), Math.fround(p.restitution)]);
        return { bodies, pairs };
    }

    ledger() {
        return ledgerOf(this);
    }
    destroy() {
        B.b2DestroyWorld(this.world);
    }
}
