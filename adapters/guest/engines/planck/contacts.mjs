// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library's contact events: coefficients of the pair before the solve, impulses of the step after it. Manifolds are
// read before the solve and placed with the poses of the start of the step: those of a time of impact, too, which the
// library stores in the axes of the bodies.
import { Transform } from 'planck';
import * as rg from '../../sdk/rigor_guest.mjs';
import { skinOf } from './shapes.mjs';

export class Contacts {
    constructor(scenario) {
        this.scenario = scenario;
        this.starts = [];
        this.coefficients = rg.pairTable(scenario);
        this.points = new Map(); // contact of the library -> its points
    }

    listenTo(world) {
        world.on('pre-solve', (contact) => this.beforeSolve(contact));
        world.on('post-solve', (contact, impulse) => this.afterSolve(contact, impulse));
    }

    /** To be called before a step. */
    beginStep(bodies) {
        this.points.clear();
        this.starts = bodies.map((body) => Transform.clone(body.getTransform()));
    }

    shapeOf([body, shape]) {
        return this.scenario.bodies[body].shapes[shape];
    }

    beforeSolve(contact) {
        const [a, b] = [contact.getFixtureA().getUserData(), contact.getFixtureB().getUserData()];
        const [shapeA, shapeB] = [this.shapeOf(a), this.shapeOf(b)];
        const pair = this.coefficients(shapeA.material, shapeB.material);
        contact.setFriction(pair.friction);
        contact.setRestitution(pair.restitution);
        const parts = [contact.getFixtureA().getShape(), contact.getFixtureB().getShape()];
        const radii = parts.map((part) => part.getRadius());
        const manifold = contact
            .getManifold()
            .getWorldManifold(null, this.starts[a[0]], radii[0], this.starts[b[0]], radii[1]);
        const normal = [manifold.normal.x, manifold.normal.y, 0];
        const skins = parts.map(skinOf);
        if (manifold.pointCount > 0) contact.setTangentSpeed(this.surfaceSpeed([a, b], manifold));
        const points = [];
        for (let k = 0; k < manifold.pointCount; ++k) {
            // The library's point is the middle between the surfaces with their skins.
            const { x, y } = manifold.points[k];
            const separation = manifold.separations[k];
            const onA = rg.sum([x, y, 0], rg.scaled(-0.5 * separation - skins[0], normal));
            const onB = rg.sum([x, y, 0], rg.scaled(0.5 * separation + skins[1], normal));
            points.push({ a, b, onA, onB, normal, depth: -(separation + skins[0] + skins[1]), impulse: 0, friction: 0 });
        }
        this.points.set(contact, points);
    }

    /** The library's tangent speed: of A's surface against B's, along the tangent, in the middle of the points. */
    surfaceSpeed(owners, { normal, points, pointCount }) {
        const used = points.slice(0, pointCount);
        const middle = ['x', 'y'].map((key) => used.reduce((sum, point) => sum + point[key], 0) / pointCount);
        const [first, second] = owners.map((owner) => {
            const { linear, angular } = this.shapeOf(owner).surface_velocity;
            const { p, q } = this.starts[owner[0]];
            const turned = [q.c * linear[0] - q.s * linear[1], q.s * linear[0] + q.c * linear[1]];
            return [turned[0] - angular[2] * (middle[1] - p.y), turned[1] + angular[2] * (middle[0] - p.x)];
        });
        return (first[0] - second[0]) * normal.y - (first[1] - second[1]) * normal.x;
    }

    afterSolve(contact, impulse) {
        const points = this.points.get(contact) ?? [];
        points.forEach((point, k) => {
            point.impulse = impulse.normalImpulses[k] ?? 0;
            point.friction = impulse.tangentImpulses[k] ?? 0;
        });
    }

    rows() {
        const rows = [];
        for (const points of this.points.values())
            for (const { a, b, onA, onB, normal, depth, impulse, friction } of points) {
                const tangent = [normal[1], -normal[0], 0]; // cross(normal, 1)
                const along = rg.scaled(friction, tangent);
                rows.push(rg.contact(a[0], b[0], onA, onB, normal, depth, impulse, along, [a[1], b[1]]));
            }
        return rows;
    }
}
