// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library's contact listener: it gives every contact the coefficients of its pair of materials, refuses those that
// the scenario's filters refuse, and keeps the points, which stand at the poses at which the step began.
import * as rg from '../../sdk/rigor_guest.mjs';
import { J, quaternion, vector } from './library.mjs';

/** Contacts farther apart than this act only if their bodies approach each other so far in the step [m]. */
const kTouching = 1e-4;

const isMoving = (velocity) => [...velocity.linear, ...velocity.angular].some((x) => x !== 0);

export class Contacts {
    constructor(scenario, dt) {
        this.scenario = scenario;
        this.dt = dt;
        this.coefficients = rg.pairTable(scenario);
        this.clear();
        this.owners = new Map(); // number of a body in the library -> index in the scenario
        this.joined = new Set();
        const count = scenario.bodies.length;
        for (const joint of scenario.joints)
            if (!joint.collide_connected && joint.body_a >= 0)
                this.joined.add(Math.min(joint.body_a, joint.body_b) * count + Math.max(joint.body_a, joint.body_b));
        const first = scenario.bodies.flatMap((body) => body.shapes)[0]?.filter;
        this.filters = scenario.bodies.some((body) =>
            body.shapes.some(({ filter: f }) => f.group !== 0 || f.layers !== first.layers || f.collides_with !== first.collides_with),
        ) || (first !== undefined && (first.layers & first.collides_with) === 0);
        this.surfacesMove = scenario.bodies.some((body) => body.shapes.some(({ surface_velocity: v }) => isMoving(v)));
        this.listener = this.makeListener();
    }

    makeListener() {
        const listener = new J.ContactListenerJS();
        listener.OnContactValidate = (bodyA, bodyB, _offset, result) => this.validate(bodyA, bodyB, result);
        listener.OnContactAdded = listener.OnContactPersisted = (bodyA, bodyB, manifold, settings) =>
            this.add(
                J.wrapPointer(bodyA, J.Body),
                J.wrapPointer(bodyB, J.Body),
                J.wrapPointer(manifold, J.ContactManifold),
                J.wrapPointer(settings, J.ContactSettings),
            );
        listener.OnContactRemoved = () => {};
        return listener;
    }

    ownerOf(body) {
        return this.owners.get(body.GetID().GetIndex());
    }
    shapeAt(body, subShape) {
        return Math.max(0, Number(body.GetShape().GetSubShapeUserData(subShape)) - 1);
    }

    validate(pointerA, pointerB, pointerResult) {
        if (this.joined.size === 0 && !this.filters) return J.ValidateResult_AcceptAllContactsForThisBodyPair;
        const [bodyA, bodyB] = [J.wrapPointer(pointerA, J.Body), J.wrapPointer(pointerB, J.Body)];
        const [a, b] = [this.ownerOf(bodyA), this.ownerOf(bodyB)];
        const count = this.scenario.bodies.length;
        if (this.joined.has(Math.min(a, b) * count + Math.max(a, b)))
            return J.ValidateResult_RejectAllContactsForThisBodyPair;
        if (!this.filters) return J.ValidateResult_AcceptAllContactsForThisBodyPair;
        const result = J.wrapPointer(pointerResult, J.CollideShapeResult);
        const filterOf = (index, body, subShape) =>
            this.scenario.bodies[index].shapes[this.shapeAt(body, subShape)].filter;
        const first = filterOf(a, bodyA, result.mSubShapeID1);
        const second = filterOf(b, bodyB, result.mSubShapeID2);
        const same = first.group !== 0 && first.group === second.group;
        const layers = (first.collides_with & second.layers) !== 0 && (second.collides_with & first.layers) !== 0;
        return (same ? first.group > 0 : layers) ? J.ValidateResult_AcceptContact : J.ValidateResult_RejectContact;
    }

    add(bodyA, bodyB, manifold, settings) {
        this.manifolds += 1;
        const [a, b] = [this.ownerOf(bodyA), this.ownerOf(bodyB)];
        const shapes = [this.shapeAt(bodyA, manifold.mSubShapeID1), this.shapeAt(bodyB, manifold.mSubShapeID2)];
        const material = (body, shape) => this.scenario.bodies[body].shapes[shape].material;
        const pair = this.coefficients(material(a, shapes[0]), material(b, shapes[1]));
        settings.mCombinedFriction = pair.friction;
        settings.mCombinedRestitution = pair.restitution;
        if (this.surfacesMove) this.setSurfaceVelocity(settings, [bodyA, bodyB], [a, b], shapes);
        const normal = vector(manifold.mWorldSpaceNormal);
        const count = manifold.mRelativeContactPointsOn1.size();
        for (let k = 0; k < count; ++k) {
            const p = vector(manifold.GetWorldSpaceContactPointOn1(k));
            const q = vector(manifold.GetWorldSpaceContactPointOn2(k));
            const depth = rg.dot(rg.difference(p, q), normal);
            const approach = rg.dot(rg.difference(this.velocityAt(bodyA, p), this.velocityAt(bodyB, q)), normal);
            if (-depth > kTouching + Math.max(0, approach) * this.dt) continue;
            const middle = rg.scaled(0.5, rg.sum(p, q));
            const half = rg.scaled(0.5 * depth, normal);
            const [onA, onB] = [rg.sum(middle, half), rg.difference(middle, half)];
            this.rows.push(rg.contact(a, b, onA, onB, normal, depth, undefined, undefined, shapes));
        }
    }

    /** Velocity of B's surface against A's: linear at A's centre of mass, and angular about it. */
    setSurfaceVelocity(settings, bodies, indices, shapes) {
        const center = vector(bodies[0].GetCenterOfMassPosition());
        const [first, second] = bodies.map((body, side) => {
            const { linear, angular } = this.scenario.bodies[indices[side]].shapes[shapes[side]].surface_velocity;
            const turn = quaternion(body.GetRotation());
            const w = rg.rotate(turn, angular);
            const arm = rg.difference(center, vector(body.GetPosition()));
            return { v: rg.sum(rg.rotate(turn, linear), rg.cross(w, arm)), w };
        });
        settings.mRelativeLinearSurfaceVelocity.Set(...rg.difference(second.v, first.v));
        settings.mRelativeAngularSurfaceVelocity.Set(...rg.difference(second.w, first.w));
    }

    velocityAt(body, point) {
        if (body.IsStatic()) return [0, 0, 0];
        const arm = rg.difference(point, vector(body.GetCenterOfMassPosition()));
        return rg.sum(vector(body.GetLinearVelocity()), rg.cross(vector(body.GetAngularVelocity()), arm));
    }

    clear() {
        this.rows = [];
        this.manifolds = 0;
    }

    /** With more contacts than it has room for the library goes on without an error (measured). */
    checkNumber(most) {
        if (this.manifolds > most) throw new Error(`found ${this.manifolds} contacts, expected at most ${most}`);
    }
}
