// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The library's contact equations of the last step, which have their points relative to the centres of mass and their
// forces. Friction equations follow in the order of the contacts: two for each of them, or two for all of a pair of
// shapes, which then stand with the last contact of the pair.
import * as rg from '../../sdk/rigor_guest.mjs';
import { fromCannon } from './vectors.mjs';

const same = (u, v) => u.x === v.x && u.y === v.y && u.z === v.z;
const ofOnePair = (c, d) => c !== undefined && c.bi === d.bi && c.bj === d.bj && c.si === d.si && c.sj === d.sj;

/** For every contact its friction equations. */
function frictionOf({ contacts, frictionEquations }) {
    let next = 0;
    const take = (contact, ofPoint) => {
        const equation = frictionEquations[next];
        const belongs = equation && equation.bi === contact.bi && equation.bj === contact.bj;
        if (!belongs || (ofPoint && !same(equation.ri, contact.ri))) return [];
        next += 2;
        return [equation, frictionEquations[next - 1]];
    };
    return contacts.map((contact, k) => {
        const own = take(contact, true);
        const last = !ofOnePair(contacts[k + 1], contact);
        return own.length === 0 && last ? take(contact, false) : own;
    });
}

export function contactRows({ world, dt, owners, indexOf }) {
    const friction = frictionOf(world);
    return world.contacts.map((contact, k) => {
        const along = friction[k].reduce(
            (total, { t, multiplier }) => rg.sum(total, rg.scaled(dt * multiplier, fromCannon(t))),
            [0, 0, 0],
        );
        const onA = rg.sum(fromCannon(contact.bi.previousPosition), fromCannon(contact.ri));
        const onB = rg.sum(fromCannon(contact.bj.previousPosition), fromCannon(contact.rj));
        const normal = fromCannon(contact.ni);
        const depth = rg.dot(rg.difference(onA, onB), normal);
        const middle = rg.scaled(0.5, rg.sum(onA, onB));
        const offset = rg.scaled(0.5 * depth, normal);
        const [p, q] = [rg.sum(middle, offset), rg.difference(middle, offset)];
        const [a, b] = [indexOf.get(contact.bi), indexOf.get(contact.bj)];
        const shapes = [owners.get(contact.si) ?? 0, owners.get(contact.sj) ?? 0];
        const impulse = Math.max(0, dt * contact.multiplier);
        return rg.contact(a, b, p, q, normal, depth, impulse, along, shapes);
    });
}
