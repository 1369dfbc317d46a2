// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Filters of shapes as bits of categories and masks, for libraries that have nothing else: every different filter of the
// scenario is a category of its own, whose mask has the categories that it touches.
import * as rg from '../../sdk/rigor_guest.mjs';

export function mayTouch(a, b) {
    if (a.group !== 0 && a.group === b.group) return a.group > 0;
    return (a.collides_with & b.layers) !== 0 && (b.collides_with & a.layers) !== 0;
}

/** A function from a shape of the scenario to its {category, mask}. */
export function filterBits(scenario) {
    const keyOf = ({ layers, collides_with, group }) => `${layers} ${collides_with} ${group}`;
    const classes = new Map();
    for (const body of scenario.bodies)
        for (const { filter } of body.shapes)
            if (!classes.has(keyOf(filter))) classes.set(keyOf(filter), { filter, bit: 1 << classes.size });
    if (classes.size > 31) throw new rg.Unsupported(`${classes.size} different filters`);
    const all = [...classes.values()];
    for (const one of all)
        one.mask = all.reduce((bits, other) => (mayTouch(one.filter, other.filter) ? bits | other.bit : bits), 0);
    return (shape) => {
        const { bit, mask } = classes.get(keyOf(shape.filter));
        return { category: bit, mask };
    };
}
