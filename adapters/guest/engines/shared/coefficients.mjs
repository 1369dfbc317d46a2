// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Coefficients of pairs for engines whose shapes have a coefficient each, which a rule combines: numbers x of the
// materials with rule(x_a, x_b) = value_ab for every pair that can touch, under one of the rules that the engine has.

/** Pairs of materials that can touch, a <= b: of different bodies that collide, one of which is dynamic. */
export function touchingPairs(scenario) {
    const all = Array.from({ length: scenario.materials }, () => new Set());
    const dynamic = Array.from({ length: scenario.materials }, () => new Set());
    scenario.bodies.forEach((body, i) => {
        if (!body.collides) return;
        for (const shape of body.shapes) {
            all[shape.material].add(i);
            if (body.type === 'dynamic') dynamic[shape.material].add(i);
        }
    });
    const others = (some, any) => some.size > 1 || any.size > 1 || [...some].some((i) => !any.has(i));
    const meet = (some, any) => some.size > 0 && any.size > 0 && others(some, any);
    return scenario.pairs.filter(({ a, b }) => meet(dynamic[a], all[b]) || meet(dynamic[b], all[a]));
}

const near = (x, y) => Math.abs(x - y) <= 1e-12 * Math.max(1, Math.abs(x), Math.abs(y));

/** min and max: every material takes the extreme of what its pairs need, and the pairs must agree. */
function extreme(count, pairs, outer, inner) {
    const x = new Array(count).fill(0);
    const seen = new Array(count).fill(false);
    for (const { a, b, value } of pairs)
        for (const m of [a, b]) {
            x[m] = seen[m] ? outer(x[m], value) : value;
            seen[m] = true;
        }
    return pairs.every(({ a, b, value }) => inner(x[a], x[b]) === value) ? x : null;
}

/**
 * average and multiply: x_a + x_b = 2 value, or log x_a + log x_b = log value, along the graph of the pairs. Every x of
 * a connected part is c + s t with s = 1 or -1 and one unknown t, which an odd cycle fixes.
 */
function linear(count, pairs, least) {
    const edges = Array.from({ length: count }, () => []);
    for (const pair of pairs) {
        edges[pair.a].push({ to: pair.b, value: pair.value });
        if (pair.a !== pair.b) edges[pair.b].push({ to: pair.a, value: pair.value });
    }
    const x = new Array(count).fill(null);
    for (let root = 0; root < count; ++root) {
        if (x[root] !== null || edges[root].length === 0) continue;
        const part = [{ node: root, c: 0, s: 1 }];
        const place = new Map([[root, part[0]]]);
        let t = null;
        for (let k = 0; k < part.length; ++k)
            for (const { to, value } of edges[part[k].node]) {
                const from = part[k];
                const other = place.get(to);
                if (other === undefined) {
                    const next = { node: to, c: value - from.c, s: -from.s };
                    place.set(to, next);
                    part.push(next);
                } else if (other.s !== from.s) {
                    if (!near(other.c + from.c, value)) return null;
                } else {
                    const fixed = (value - other.c - from.c) / (2 * from.s);
                    if (t !== null && !near(t, fixed)) return null;
                    t = fixed;
                }
            }
        if (t === null) t = 0.5 * edges[root][0].value;
        for (const { node, c, s } of part) x[node] = c + s * t;
    }
    return x.every((v) => v === null || v >= least) ? x.map((v) => v ?? 0) : null;
}

const rules = {
    min: (count, pairs) => extreme(count, pairs, Math.max, Math.min),
    max: (count, pairs) => extreme(count, pairs, Math.min, Math.max),
    average: (count, pairs) =>
        linear(
            count,
            pairs.map((p) => ({ ...p, value: 2 * p.value })),
            0,
        ),
    multiply(count, pairs) {
        if (pairs.every((p) => p.value === 0)) return new Array(count).fill(0);
        // A material all of whose pairs are zero is zero; the others' logarithms are linear.
        const zero = new Array(count).fill(true);
        for (const { a, b, value } of pairs) if (value > 0) zero[a] = zero[b] = false;
        if (pairs.some(({ a, b, value }) => value === 0 && !zero[a] && !zero[b])) return null;
        const positive = pairs.filter((p) => p.value > 0).map((p) => ({ ...p, value: Math.log(p.value) }));
        const logarithms = linear(count, positive, Number.NEGATIVE_INFINITY);
        return logarithms?.map((v, m) => (zero[m] ? 0 : Math.exp(v))) ?? null;
    },
};

/** {rule, values} with the first of these rules that gives every pair its value, or null. `pairs`: a, b, value. */
export function solveCoefficients(count, pairs, names) {
    for (const rule of names) {
        const values = rules[rule](count, pairs);
        if (values) return { rule, values };
    }
    return null;
}

export const combine = {
    min: Math.min,
    max: Math.max,
    average: (x, y) => 0.5 * (x + y),
    multiply: (x, y) => x * y,
};
