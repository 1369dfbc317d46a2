// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scenario as a model in the library's XML.
import * as rg from '../../sdk/rigor_guest.mjs';
import { solveCoefficients, touchingPairs } from '../shared/coefficients.mjs';
import { filterBits, mayTouch } from '../shared/filters.mjs';
import { element } from './library.mjs';
import { contactSolref } from './restitution.mjs';
import { geomOf } from './shapes.mjs';
import { canBreak } from '../shared/breaking.mjs';
import { canBeEquality, coordinatesOf, planTree, swingLimit } from './tree.mjs';

/** A kinematic body is that much heavier than everything else, and is set to its motion after each step. */
const kHeavy = 1e6;
/** Pairs of geoms that are listed one by one at most. */
const kMostPairs = 20000;
const kEqualities = 'MuJoCo documentation, XML reference, equality: connect, weld, joint, tendon and flex; none of a slider, of limits or of motors';
const kFree = { planar: ['slide', 'slide', 'hinge'], axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] };

export const bodyName = (index) => (index < 0 ? 'world' : `b${index}`);
const shapeName = (index, k) => `g${index}_${k}`;

export function principalInertia({ planar }, { inertia }) {
    const moment = inertia[8];
    return planar ? { moments: [moment, moment, moment], orientation: [1, 0, 0, 0] } : rg.principalAxes(inertia);
}

/** The scenario with the centre of mass of every dynamic body in the origin of its frame. */
export function centered(scenario) {
    const centerOf = (index) => {
        const body = index < 0 ? null : scenario.bodies[index];
        return body?.type === 'dynamic' ? body.center_of_mass : [0, 0, 0];
    };
    const bodies = scenario.bodies.map((body, i) => ({
        ...body,
        position: rg.sum(body.position, rg.rotate(body.orientation, centerOf(i))),
        center_of_mass: [0, 0, 0],
        shapes: body.shapes.map((shape) => ({ ...shape, position: rg.difference(shape.position, centerOf(i)) })),
    }));
    const joints = scenario.joints.map((joint) => ({
        ...joint,
        anchor_a: rg.difference(joint.anchor_a, centerOf(joint.body_a)),
        anchor_b: rg.difference(joint.anchor_b, centerOf(joint.body_b)),
    }));
    return { ...scenario, bodies, joints };
}

export class ModelText {
    constructor(scenario, dt, settings) {
        Object.assign(this, { scenario, dt, settings });
        this.plan = planTree(scenario);
        this.assets = [];
        this.motors = []; // {joint, speed, most}
        this.bits = filterBits(scenario);
        this.chooseContacts();
        this.sites = new Map(); // body -> sites of tendons
        this.constraints = { tendons: [], equalities: [] };
        this.constraintsOf = new Map(); // joint -> its equalities as {kind, index}
        for (const joint of this.plan.loops) this.addLoop(joint);
        for (const joint of scenario.joints) if (swingLimit(joint) !== null) this.addCone(joint);
        this.xml = this.whole();
    }

    /** Coefficients of geoms where the library's own combination (the greater one) gives every pair its value; else pairs. */
    chooseContacts() {
        const { scenario } = this;
        const pairs = touchingPairs(scenario);
        this.pairs = pairs;
        const uniform = (key) => pairs.every((pair) => pair[key] === pairs[0][key]);
        const friction = solveCoefficients(scenario.materials, pairs.map((p) => ({ a: p.a, b: p.b, value: p.friction })), ['max']);
        const simple = friction && ['restitution', 'rolling_friction', 'torsional_friction'].every(uniform);
        this.frictions = simple ? friction.values : null;
        this.common = pairs[0] ?? { restitution: 0, rolling_friction: 0, torsional_friction: 0 };
    }

    contactAttributes(pair, friction) {
        const { torsional_friction: torsion, rolling_friction: rolling } = pair;
        let condim = friction > 0 ? 3 : 1;
        if (torsion > 0) condim = 4;
        if (rolling > 0) condim = 6;
        return { condim, torsion, rolling, ...contactSolref(pair.restitution, this.dt, this.settings) };
    }

    /** Attributes of a geom's contacts. */
    geomContacts(body, shape) {
        if (!body.collides || this.frictions === null) return { contype: 0, conaffinity: 0 };
        const friction = this.frictions[shape.material];
        const { condim, torsion, rolling, solref, solimp } = this.contactAttributes(this.common, friction);
        return { ...this.typeBits(body, shape), condim, friction: [friction, torsion, rolling], solref, solimp };
    }

    /** Bodies that are not dynamic have no affinity to each other; filters are categories. */
    typeBits(body, shape) {
        const { category, mask } = this.bits(shape);
        // Two geoms touch if a category of either one is in the mask of the other: masks are symmetric.
        return body.type === 'dynamic' ? { contype: category, conaffinity: mask } : { contype: 0, conaffinity: mask };
    }

    explicitPairs() {
        if (this.frictions !== null) return [];
        const { bodies } = this.scenario;
        const table = rg.pairTable(this.scenario);
        const found = [];
        const addPair = (i, k, j, l) => {
            const [s, t] = [bodies[i].shapes[k], bodies[j].shapes[l]];
            if (!mayTouch(s.filter, t.filter)) return;
            const pair = table(s.material, t.material);
            const { condim, torsion, rolling, solref, solimp } = this.contactAttributes(pair, pair.friction);
            const friction = [pair.friction, pair.friction, torsion, rolling, rolling];
            found.push(element('pair', { geom1: shapeName(i, k), geom2: shapeName(j, l), condim, friction, solref, solimp }));
        };
        bodies.forEach((body, i) => {
            for (let j = i + 1; j < bodies.length; ++j) {
                const other = bodies[j];
                if (!body.collides || !other.collides || this.isJoined(i, j)) continue;
                if (body.type !== 'dynamic' && other.type !== 'dynamic') continue;
                body.shapes.forEach((_, k) => other.shapes.forEach((_shape, l) => addPair(i, k, j, l)));
            }
            if (found.length > kMostPairs) throw new rg.Unsupported('pairs of so many shapes of different materials');
        });
        return found;
    }

    isJoined(i, j) {
        return this.scenario.joints.some(
            ({ body_a: a, body_b: b, collide_connected }) =>
                !collide_connected && ((a === i && b === j) || (a === j && b === i)),
        );
    }

    excludes() {
        const seen = new Set();
        return this.scenario.joints.flatMap(({ body_a: a, body_b: b, collide_connected }) => {
            const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
            if (a < 0 || collide_connected || seen.has(key)) return [];
            seen.add(key);
            return [element('exclude', { body1: bodyName(a), body2: bodyName(b) })];
        });
    }

    softness() {
        const given = this.settings;
        return {
            solref: [Math.max(Number(given.solref_timeconst), 2 * this.dt), given.solref_dampratio],
            solimp: [given.solimp_min, given.solimp_max, given.solimp_width],
        };
    }

    // ----------------------------------------------------------------------------------------------- bodies
    poseIn(parent, body) {
        if (parent < 0) return { pos: body.position, quat: body.orientation };
        const { position, orientation } = this.scenario.bodies[parent];
        return {
            pos: rg.rotateBack(orientation, rg.difference(body.position, position)),
            quat: rg.quaternionProduct(rg.conjugate(orientation), body.orientation),
        };
    }

    jointsOf(index) {
        const body = this.scenario.bodies[index];
        const { joint } = this.plan.parents[index];
        if (body.type === 'static') return [];
        if (joint === null) {
            if (!this.scenario.planar) return [element('joint', { type: 'free', name: `j${index}_0` })];
            const turn = (axis) => rg.rotateBack(body.orientation, axis);
            return kFree.planar.map((type, k) => element('joint', { type, axis: turn(kFree.axes[k]), name: `j${index}_${k}` }));
        }
        const { solref, solimp } = this.softness();
        return coordinatesOf(joint, joint.body_a === index, this.normalInB(joint), this.spinInA(joint)).map(({ attributes, motor }, k) => {
            const name = `j${index}_${k}`;
            if (motor) this.motors.push({ joint: name, ...motor });
            return element('joint', { name, ...attributes, solreflimit: solref, solimplimit: solimp });
        });
    }

    /** A wheel's pin in the frame of A at the start. */
    spinInA({ body_a: a, body_b: b, spin_axis_b: spin }) {
        if (!spin) return undefined;
        const { bodies } = this.scenario;
        const inWorld = rg.rotate(bodies[b].orientation, spin);
        return a < 0 ? inWorld : rg.rotateBack(bodies[a].orientation, inWorld);
    }

    normalInB({ body_a: a, body_b: b, normal_a: normal }) {
        if (!normal) return undefined;
        const { bodies } = this.scenario;
        const inWorld = a < 0 ? normal : rg.rotate(bodies[a].orientation, normal);
        return rg.rotateBack(bodies[b].orientation, inWorld);
    }

    inertial(body) {
        if (body.type === 'static') return [];
        if (body.type === 'kinematic') {
            const total = this.scenario.bodies.reduce((sum, other) => sum + (other.type === 'dynamic' ? other.mass : 0), 1);
            const heavy = kHeavy * total;
            return [element('inertial', { pos: [0, 0, 0], mass: heavy, diaginertia: [heavy, heavy, heavy] })];
        }
        // The compiler refuses moments of no body; they are set in the model.
        const { moments, orientation } = principalInertia(this.scenario, body);
        const most = Math.max(...moments);
        return [element('inertial', { pos: [0, 0, 0], quat: orientation, mass: body.mass, diaginertia: [most, most, most] })];
    }

    bodyOf(index) {
        const body = this.scenario.bodies[index];
        const { parent } = this.plan.parents[index];
        const geoms = body.shapes.flatMap((shape, k) => {
            if (!body.collides) return [];
            const { geom, asset } = geomOf(shape, shapeName(index, k));
            if (asset) this.assets.push(asset);
            return [element('geom', { ...geom, ...this.geomContacts(body, shape) })];
        });
        const gravcomp = body.type === 'kinematic' ? 1 : 1 - body.gravity_scale;
        const attributes = { name: bodyName(index), ...this.poseIn(parent, body), gravcomp: gravcomp || undefined };
        const children = [...this.jointsOf(index), ...this.inertial(body), ...geoms, ...(this.sites.get(index) ?? [])];
        return element('body', attributes, [...children, ...this.bodiesOn(index)]);
    }

    bodiesOn(index) {
        const { parents } = this.plan;
        return parents.flatMap(({ parent }, i) => (parent === index ? [this.bodyOf(i)] : []));
    }

    // ------------------------------------------------------------------------------------------------- loops
    addEquality(joint, kind, attributes) {
        const { equalities } = this.constraints;
        if (!this.constraintsOf.has(joint)) this.constraintsOf.set(joint, []);
        this.constraintsOf.get(joint).push({ kind, index: equalities.length });
        equalities.push(element(kind, attributes));
    }

    addLoop(joint) {
        const refuse = (what, documentation = '') => {
            throw new rg.Unsupported(what, documentation, `joint '${joint.name}'`);
        };
        if (joint.type === 'distance') return this.addTendon(joint);
        if (!canBeEquality(joint)) refuse(`a ${joint.type} with more than its kind that ${canBreak(joint) ? 'breaks' : 'closes a loop'}`, kEqualities);
        const ends = { body1: bodyName(joint.body_b), body2: joint.body_a < 0 ? undefined : bodyName(joint.body_a), ...this.softness() };
        const connect = (anchor) => this.addEquality(joint, 'connect', { ...ends, anchor });
        // The anchor of a weld is in the frame of its second body.
        if (joint.type === 'fixed') this.addEquality(joint, 'weld', { ...ends, anchor: joint.anchor_a });
        else if (joint.type === 'ball' || this.scenario.planar) connect(joint.anchor_b);
        else for (const side of [-0.25, 0.25]) connect(rg.sum(joint.anchor_b, rg.scaled(side, joint.axis_b)));
    }

    /** A straight tendon between two points: its name and its sites. */
    straight(joint, pointA, pointB) {
        const name = `t${this.constraints.tendons.length}`;
        const site = (body, side, pos) => {
            const id = `${name}${side}`;
            if (!this.sites.has(body)) this.sites.set(body, []);
            this.sites.get(body).push(element('site', { name: id, pos }));
            return element('site', { site: id });
        };
        return { name, path: [site(joint.body_a, 'a', pointA), site(joint.body_b, 'b', pointB)] };
    }

    limits(lower, upper) {
        const { solref, solimp } = this.softness();
        return { limited: 'true', range: [lower, upper], solreflimit: solref, solimplimit: solimp };
    }

    /**
     * A swing's bound as a tendon's: two points a metre from the anchor, along the axes of A and B, are 2 sin(swing / 2) apart. A
     * ball's own bound is that of its whole rotation, with the twist.
     */
    addCone(joint) {
        const { name, path } = this.straight(joint, rg.sum(joint.anchor_a, joint.axis_a), rg.sum(joint.anchor_b, joint.axis_b));
        this.constraints.tendons.push(element('spatial', { name, ...this.limits(0, 2 * Math.sin(0.5 * swingLimit(joint))) }, path));
    }

    addTendon(joint) {
        const { name, path } = this.straight(joint, joint.anchor_a, joint.anchor_b);
        const [axis] = joint.axes;
        const attributes = { name };
        if (axis.mode === 'limited') Object.assign(attributes, this.limits(Math.max(0, axis.lower ?? 0), axis.upper ?? 1e10));
        if (axis.motor_max_force > 0) this.motors.push({ tendon: name, speed: axis.motor_speed, most: axis.motor_max_force });
        if (axis.stiffness > 0 || axis.damping > 0)
            Object.assign(attributes, { stiffness: axis.stiffness, damping: axis.damping, springlength: axis.target });
        else if (axis.mode === 'locked') {
            const { solref, solimp } = this.softness();
            this.addEquality(joint, 'tendon', { tendon1: name, solref, solimp });
        }
        if (canBreak(joint) && !this.constraintsOf.has(joint))
            throw new rg.Unsupported('a distance that breaks and is no rod', kEqualities, `joint '${joint.name}'`);
        this.constraints.tendons.push(element('spatial', attributes, path));
    }

    // ------------------------------------------------------------------------------------------------- whole
    whole() {
        const { settings, scenario } = this;
        const worldbody = element('worldbody', {}, [...(this.sites.get(-1) ?? []), ...this.bodiesOn(-1)]);
        const pairs = [...this.excludes(), ...this.explicitPairs()];
        // A ball's gear is the axis in its body about which it is turned.
        const motors = this.motors.map(({ joint, tendon, gear }) =>
            element('motor', { joint, tendon, gear: gear && [...gear, 0, 0, 0] }),
        );
        const { integrator, solver, cone, iterations, tolerance, noslip_iterations, impratio } = settings;
        const flags = { autoreset: 'disable', filterparent: 'disable', nativeccd: settings.native_ccd === 'on' ? 'enable' : 'disable' };
        const option = { timestep: this.dt, gravity: scenario.gravity, integrator, solver, cone, iterations, tolerance, noslip_iterations, impratio };
        const groups = {
            asset: this.assets,
            contact: pairs,
            tendon: this.constraints.tendons,
            equality: this.constraints.equalities,
            actuator: motors,
        };
        return element('mujoco', {}, [
            '<compiler angle="radian" autolimits="false" fusestatic="false"/>',
            element('option', option, [element('flag', flags)]),
            '<size memory="64M"/>',
            worldbody,
            ...Object.entries(groups).flatMap(([name, children]) => (children.length > 0 ? [element(name, {}, children)] : [])),
        ]);
    }
}
