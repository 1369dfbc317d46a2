// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario in MuJoCo 3.
import { performance } from 'node:perf_hooks';
import * as rg from '../../sdk/rigor_guest.mjs';
import { breakingOf } from './breaking.mjs';
import { ledgerOf } from './ledger.mjs';
import { M, modelOf, sixNumbers } from './library.mjs';
import { bodyName, centered, ModelText, principalInertia } from './model.mjs';
import { restitutionIn } from './restitution.mjs';

const kBody = M.mjtObj.mjOBJ_BODY.value;
const kGeom = M.mjtObj.mjOBJ_GEOM.value;
const kWhole = M.mjtState.mjSTATE_INTEGRATION.value;
const kSchemes = { RK4: 'rk4', Euler: 'symplectic_euler', implicit: 'symplectic_euler', implicitfast: 'symplectic_euler' };
const kFree = M.mjtJoint.mjJNT_FREE.value;
const kPlane = [[1, 0, 0], [0, 1, 0]];
const kBall = M.mjtJoint.mjJNT_BALL.value;
const kSlide = M.mjtJoint.mjJNT_SLIDE.value;

export class MujocoWorld extends rg.World {
    set_states = 'kept';
    snapshots = true;

    constructor(scenario, dt, settings) {
        super();
        // `given` is the scenario, `scenario` has the origins of bodies in their centres of mass.
        Object.assign(this, { given: scenario, scenario: centered(scenario), dt, settings });
        this.scheme = kSchemes[settings.integrator];
        this.text = new ModelText(this.scenario, dt, settings);
        this.model = modelOf(this.text.xml);
        this.data = new M.MjData(this.model);
        this.bodyIds = scenario.bodies.map((_, i) => M.mj_name2id(this.model, kBody, bodyName(i)));
        this.time = 0;
        this.breaking = breakingOf(this);
        this.nameGeoms();
        this.setInertias();
        this.answer = new M.DoubleBuffer(Math.max(1, this.model.nv));
        this.setScales();
        this.damped = scenario.bodies.some((b) => b.linear_velocity_kept !== 1 || b.angular_velocity_kept !== 1);
        const row = ({ position, orientation, velocity, angular_velocity: w }) => [...position, ...orientation, ...velocity, ...w];
        this.setCentered(this.scenario.bodies.map(row), true);
    }

    nameGeoms() {
        this.owners = new Map(); // geom of the library -> [body, shape]
        this.scenario.bodies.forEach((body, i) => {
            if (!body.collides) return;
            body.shapes.forEach((_, k) => this.owners.set(M.mj_name2id(this.model, kGeom, `g${i}_${k}`), [i, k]));
        });
    }

    setInertias() {
        this.scenario.bodies.forEach((body, i) => {
            if (body.type !== 'dynamic') return;
            this.model.body_inertia.set(principalInertia(this.scenario, body).moments, 3 * this.bodyIds[i]);
        });
        M.mj_setConst(this.model, this.data);
    }

    /**
     * A motor without load reaches its speed in a step that its force allows: the force is the missing speed over the step, by
     * what a unit of force does to the coordinate's own rate in the pose of the step.
     */
    setMotors() {
        const { model, data, text } = this;
        if (text.motors.length === 0) return;
        for (const part of [M.mj_kinematics, M.mj_comPos, M.mj_tendon, M.mj_transmission, M.mj_makeM, M.mj_factorM]) part(model, data);
        text.motors.forEach(({ speed, most }, k) => {
            const moment = this.momentOf(k);
            M.mj_solveM(model, data, this.answer, moment);
            const along = (other) => moment.reduce((sum, x, i) => sum + x * other[i], 0);
            const wanted = (speed - along(data.qvel)) / (along(this.answer.GetView()) * this.dt);
            data.ctrl[k] = Math.max(-most, Math.min(most, wanted));
        });
    }

    /** What a unit of an actuator's control does to the forces of the coordinates; the library keeps rows of what is not zero. */
    momentOf(actuator) {
        const { model, data } = this;
        const moment = new Array(model.nv).fill(0);
        const start = data.moment_rowadr[actuator];
        for (let k = start; k < start + data.moment_rownnz[actuator]; ++k) moment[data.moment_colind[k]] = data.actuator_moment[k];
        return moment;
    }

    /** The solver's tolerance is relative to the mean inertia, which the heavy kinematic bodies must not be part of. */
    setScales() {
        const dynamic = this.scenario.bodies.filter((body) => body.type === 'dynamic');
        if (dynamic.length === this.scenario.bodies.length || dynamic.length === 0) return;
        if (!this.scenario.bodies.some((body) => body.type === 'kinematic')) return;
        this.model.stat.meaninertia = dynamic.reduce((sum, body) => sum + body.mass, 0) / dynamic.length;
    }

    // ---------------------------------------------------------------------------------------------- states
    /** Poses and velocities of the bodies for the coordinates as they are now; contacts stay those of the last step. */
    refresh() {
        M.mj_kinematics(this.model, this.data);
        M.mj_comPos(this.model, this.data);
        M.mj_comVel(this.model, this.data);
    }

    stateOf(index) {
        const { data, model } = this;
        const id = this.bodyIds[index];
        const pose = [...data.xpos.slice(3 * id, 3 * id + 3), ...data.xquat.slice(4 * id, 4 * id + 4)];
        if (this.scenario.bodies[index].type === 'static') return [...pose, 0, 0, 0, 0, 0, 0];
        const v = sixNumbers((six) => M.mj_objectVelocity(model, data, kBody, id, six, 0));
        return [...pose, ...v.slice(3), ...v.slice(0, 3)];
    }
    states() {
        return this.scenario.bodies.map((_, i) => this.moved(i, this.stateOf(i), -1));
    }

    setStates(states) {
        this.setCentered(states.map((row, i) => this.moved(i, row, 1)));
    }

    /** A state whose position is the centre of mass (sign 1), from one of the body's origin, or the other way round (-1). */
    moved(index, row, sign) {
        const { type, center_of_mass: center } = this.given.bodies[index];
        if (type !== 'dynamic') return row;
        return [...rg.sum(row.slice(0, 3), rg.scaled(sign, rg.rotate(row.slice(3, 7), center))), ...row.slice(3)];
    }

    /** `states` have the centre of mass; `all`: of kinematic bodies, too. */
    setCentered(states, all = false) {
        const pose = (index) =>
            index < 0
                ? { p: [0, 0, 0], q: [1, 0, 0, 0], v: [0, 0, 0], w: [0, 0, 0] }
                : this.motionOf(states[index]);
        this.scenario.bodies.forEach((body, i) => {
            if (body.type === 'dynamic' || (all && body.type === 'kinematic'))
                this.setCoordinates(i, pose(i), pose(this.text.plan.parents[i].parent));
        });
        this.refresh();
    }

    motionOf(row) {
        return { p: row.slice(0, 3), q: row.slice(3, 7), v: row.slice(7, 10), w: row.slice(10, 13) };
    }

    /** The coordinates of a body from its motion and that of the body on which it hangs. */
    setCoordinates(index, own, parent) {
        const { model, data } = this;
        const id = this.bodyIds[index];
        const inOwn = (v) => rg.rotateBack(own.q, v);
        const relative = rg.difference(own.w, parent.w);
        for (let k = 0; k < model.body_jntnum[id]; ++k) {
            const j = model.body_jntadr[id] + k;
            const [q, v] = [model.jnt_qposadr[j], model.jnt_dofadr[j]];
            const type = model.jnt_type[j];
            const anchor = rg.rotate(own.q, [...model.jnt_pos.slice(3 * j, 3 * j + 3)]);
            const axis = rg.rotate(own.q, [...model.jnt_axis.slice(3 * j, 3 * j + 3)]);
            if (type === kFree) {
                data.qpos.set([...own.p, ...own.q], q);
                data.qvel.set([...own.v, ...inOwn(own.w)], v);
            } else if (type === kBall) {
                data.qpos.set(this.turnSince(index, own, parent), q);
                data.qvel.set(inOwn(relative), v);
            } else if (type === kSlide) {
                const motion = this.slideOf(index, own, parent, anchor);
                const direction = this.directionOf(index, parent, k, axis);
                data.qpos[q] = model.qpos0[q] + rg.dot(motion.travel, direction);
                data.qvel[v] = rg.dot(motion.velocity, direction);
            } else {
                const turn = this.turnSince(index, own, parent);
                const local = [...model.jnt_axis.slice(3 * j, 3 * j + 3)];
                const angle = 2 * Math.atan2(rg.dot(turn.slice(1), local), turn[0]);
                const before = data.qpos[q];
                data.qpos[q] = angle + 2 * Math.PI * Math.round((before - angle) / (2 * Math.PI));
                data.qvel[v] = rg.dot(relative, axis);
            }
        }
    }

    /**
     * The direction of a travel. It is the parent's, which may have turned against the body, but for a wheel's whose frame hangs on
     * it: that is the body's own, `axis`.
     */
    directionOf(index, parent, k, axis) {
        const { joint, parent: on } = this.text.plan.parents[index];
        if (joint === null) return kPlane[k];
        if (joint.type === 'wheel' && joint.body_a === index) return axis;
        const base = on < 0 ? [1, 0, 0, 0] : this.scenario.bodies[on].orientation;
        const j = this.model.body_jntadr[this.bodyIds[index]] + k;
        const local = [...this.model.jnt_axis.slice(3 * j, 3 * j + 3)];
        const atStart = rg.rotate(this.scenario.bodies[index].orientation, local);
        return rg.rotate(parent.q, rg.rotateBack(base, atStart));
    }

    /** How the body has turned against its parent since the start, in its own axes. */
    turnSince(index, own, parent) {
        const start = this.scenario.bodies[index].orientation;
        const { parent: on } = this.text.plan.parents[index];
        const first = on < 0 ? start : rg.quaternionProduct(rg.conjugate(this.scenario.bodies[on].orientation), start);
        const now = rg.quaternionProduct(rg.conjugate(parent.q), own.q);
        return rg.quaternionProduct(rg.conjugate(first), now);
    }

    /** How far the anchor has moved against the parent since the start, in the world, and its velocity against it. */
    slideOf(index, own, parent, anchor) {
        const body = this.scenario.bodies[index];
        const { parent: on } = this.text.plan.parents[index];
        const base = on < 0 ? { position: [0, 0, 0], orientation: [1, 0, 0, 0] } : this.scenario.bodies[on];
        const local = rg.rotateBack(own.q, anchor);
        const startPoint = rg.sum(body.position, rg.rotate(body.orientation, local));
        const first = rg.rotateBack(base.orientation, rg.difference(startPoint, base.position));
        const point = rg.sum(own.p, anchor);
        const travel = rg.difference(point, rg.sum(parent.p, rg.rotate(parent.q, first)));
        const ownVelocity = rg.sum(own.v, rg.cross(own.w, anchor));
        const arm = rg.difference(point, parent.p);
        const velocity = rg.difference(ownVelocity, rg.sum(parent.v, rg.cross(parent.w, arm)));
        return { travel, velocity };
    }

    // ------------------------------------------------------------------------------------------------ step
    applyForce(index, force, torque) {
        const at = 6 * this.bodyIds[index];
        const { xfrc_applied: applied } = this.data;
        [...force, ...torque].forEach((x, k) => {
            applied[at + k] += x;
        });
    }

    step() {
        this.setMotors();
        if (this.settings.integrator === 'RK4') this.starts = this.contactsAtStart();
        const start = performance.now();
        M.mj_step(this.model, this.data);
        const seconds = 1e-3 * (performance.now() - start);
        this.data.xfrc_applied.fill(0);
        this.time += this.dt;
        this.contactRows = this.starts ?? this.readContacts(true);
        this.afterStep();
        const iterations = this.data.solver_niter[0];
        const broken = this.breaking.afterStep();
        return { seconds, broken, counters: { contacts: this.contactRows.length, solver_iterations: iterations } };
    }

    /** Kinematic bodies are put where they belong; dampings of bodies are applied. */
    afterStep() {
        this.refresh();
        const kinematic = this.scenario.bodies.some((body) => body.type === 'kinematic');
        if (!kinematic && !this.damped) return;
        const rows = this.scenario.bodies.map((_, i) => {
            const row = this.stateOf(i);
            const body = this.scenario.bodies[i];
            if (body.type === 'kinematic') return this.kinematicState(body);
            if (body.type === 'static') return row;
            const [linear, angular] = [body.linear_velocity_kept ** this.dt, body.angular_velocity_kept ** this.dt];
            return [...row.slice(0, 7), ...rg.scaled(linear, row.slice(7, 10)), ...rg.scaled(angular, row.slice(10))];
        });
        this.setCentered(rows, true);
    }

    kinematicState({ position, orientation, velocity, angular_velocity: w }) {
        const q = rg.turned(orientation, w, this.time);
        return [...rg.sum(position, rg.scaled(this.time, velocity)), ...q, ...velocity, ...w];
    }

    /** RK4's last stage is not at the start of the step: positions are looked at before, and impulses are not known. */
    contactsAtStart() {
        M.mj_fwdPosition(this.model, this.data);
        return this.readContacts(false);
    }

    readContacts(withForces) {
        const { model, data } = this;
        const rows = [];
        const list = data.contact;
        for (let k = 0; k < data.ncon; ++k) {
            const contact = list.get(k);
            const [a, b] = [this.owners.get(contact.geom1), this.owners.get(contact.geom2)];
            const frame = [...contact.frame];
            const [normal, t1, t2] = [frame.slice(0, 3), frame.slice(3, 6), frame.slice(6, 9)];
            const depth = -contact.dist;
            const middle = [...contact.pos];
            const offset = rg.scaled(0.5 * depth, normal);
            const force = withForces ? sixNumbers((six) => M.mj_contactForce(model, data, k, six)) : null;
            contact.delete();
            if (!a || !b) continue;
            const impulse = force ? Math.max(0, this.dt * force[0]) : undefined;
            const along = force ? rg.scaled(this.dt, rg.sum(rg.scaled(force[1], t1), rg.scaled(force[2], t2))) : [0, 0, 0];
            const [p, q] = [rg.sum(middle, offset), rg.difference(middle, offset)];
            rows.push(rg.contact(a[0], b[0], p, q, normal, depth, impulse, along, [a[1], b[1]]));
        }
        list.delete();
        return rows;
    }

    contacts() {
        return this.contactRows ?? [];
    }

    // --------------------------------------------------------------------------------------------- reading
    save() {
        const buffer = new M.DoubleBuffer(M.mj_stateSize(this.model, kWhole));
        M.mj_getState(this.model, this.data, buffer, kWhole);
        const numbers = Float64Array.from([this.time, ...buffer.GetView()]);
        buffer.delete();
        return new Uint8Array(numbers.buffer);
    }
    restore(bytes) {
        const numbers = new Float64Array(Uint8Array.from(bytes).buffer);
        if (numbers.length !== 1 + M.mj_stateSize(this.model, kWhole)) return false;
        this.time = numbers[0];
        M.mj_setState(this.model, this.data, [...numbers.slice(1)], kWhole);
        this.breaking = breakingOf(this);
        this.refresh();
        return true;
    }

    readBack() {
        const { model } = this;
        const whole = [...model.opt.gravity];
        const bodies = this.scenario.bodies.map((given, i) => {
            const id = this.bodyIds[i];
            const gravity = rg.scaled(1 - model.body_gravcomp[id], whole);
            const state = this.moved(i, this.stateOf(i), -1);
            if (given.type !== 'dynamic') return rg.bodyRow(0, [0, 0, 0], new Array(9).fill(0), state, gravity);
            const part = (array, n) => [...array.slice(n * id, n * id + n)];
            const inertia = rg.tensorOf(part(model.body_inertia, 3), part(model.body_iquat, 4));
            const center = rg.sum(this.given.bodies[i].center_of_mass, part(model.body_ipos, 3));
            return rg.bodyRow(model.body_mass[id], center, inertia, state, gravity);
        });
        return { bodies, pairs: this.text.pairs.map(({ a, b }) => [a, b, ...this.coefficientsOf(a, b)]) };
    }

    /** Friction and restitution of two materials, from the geoms or from the first listed pair that has them. */
    coefficientsOf(a, b) {
        const { model } = this;
        const material = (geom) => {
            const [body, shape] = this.owners.get(geom);
            return this.scenario.bodies[body].shapes[shape].material;
        };
        const width = (array, count) => array.length / count;
        if (this.text.frictions !== null) {
            const find = (wanted) => [...this.owners.keys()].find((geom) => material(geom) === wanted);
            const [first, second] = [find(a), find(b)];
            const friction = Math.max(model.geom_friction[3 * first], model.geom_friction[3 * second]);
            const step = width(model.geom_solref, model.ngeom);
            return [friction, restitutionIn(model.geom_solref.slice(step * first, step * first + 2))];
        }
        for (let k = 0; k < model.npair; ++k) {
            const found = [material(model.pair_geom1[k]), material(model.pair_geom2[k])];
            if (Math.min(...found) !== a || Math.max(...found) !== b) continue;
            const [f, s] = [width(model.pair_friction, model.npair), width(model.pair_solref, model.npair)];
            return [model.pair_friction[f * k], restitutionIn(model.pair_solref.slice(s * k, s * k + 2))];
        }
        const given = this.text.pairs.find((pair) => pair.a === a && pair.b === b);
        return [given.friction, given.restitution];
    }

    ledger() {
        return ledgerOf(this);
    }
    destroy() {
        this.answer.delete();
        this.data.delete();
        this.model.delete();
    }
}
