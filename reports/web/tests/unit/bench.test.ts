// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  byTime,
  dashesOf,
  fastest,
  growthCurves,
  labelOf,
  leaders,
  rate,
  specKey,
  speedUp,
  subjectsOf,
  workOf,
} from '../../src/report/bench/groups.ts';
import type { BenchCase } from '../../src/report/data.ts';

const made = (engine: string, size: number, time: number, more: Partial<BenchCase> = {}): BenchCase => ({
  id: `${engine}-${size}`,
  part: 'scene',
  name: 'pyramid',
  engine,
  label: engine.replace(':', ' '),
  size,
  sizeUnit: 'bodies',
  threads: 1,
  operation: 'step',
  command: '',
  repetitions: 6,
  clock: 'cpu',
  time,
  low: time,
  high: time,
  wall: time,
  cpu: time,
  converged: true,
  valid: true,
  reason: '',
  base: '',
  ratio: null,
  ratioLow: null,
  ratioHigh: null,
  memoryKiB: null,
  peakKiB: null,
  allocations: null,
  counts: { contacts: 4 * size },
  phases: {},
  quality: [],
  ...more,
});

test('cases of one name are one subject, its sizes rising', () => {
  const subjects = subjectsOf([
    made('a', 20, 1),
    made('a', 10, 1),
    made('b', 10, 1),
    made('a', 5, 1, { name: 'pile' }),
  ]);
  assert.deepEqual(
    subjects.map((s) => [s.name, s.sizes.map((z) => [z.size, z.cases.length])]),
    [
      [
        'pyramid',
        [
          [10, 2],
          [20, 1],
        ],
      ],
      ['pile', [[5, 1]]],
    ],
  );
});

test('growth is time per contact, without what is no timing', () => {
  const cases = [made('a', 10, 80), made('a', 20, 320), made('b', 10, 1), made('b', 20, 1, { valid: false })];
  const curves = growthCurves(subjectsOf(cases)[0] as ReturnType<typeof subjectsOf>[0]);
  assert.equal(curves.length, 1);
  assert.deepEqual(
    curves[0]?.points.map((p) => [p.x, p.y]),
    [
      [10, 2],
      [20, 4],
    ],
  );
});

test('where there are no contacts, another measure of the work counts', () => {
  assert.equal(workOf(made('a', 10, 1, { counts: { contacts: 0, pairs: 7 } })), 7);
  assert.equal(workOf(made('a', 10, 1, { counts: {} })), 0);
});

test('the speed-up is by the wall, of two timings', () => {
  const one = made('a', 10, 4);
  const two = made('a', 10, 1, { threads: 2, wall: 2 });
  assert.equal(speedUp(two, [one, two]), 2);
  assert.ok(Number.isNaN(speedUp(one, [one, two])));
  assert.ok(Number.isNaN(speedUp(two, [{ ...one, valid: false }, two])));
});

test('of each engine the fastest that counts, and the curve that ends lowest', () => {
  const cases = [
    made('a:x', 10, 4),
    made('a:y', 10, 3),
    made('a:z', 10, 1, { valid: false }),
    made('b', 10, 2),
    made('a:x', 20, 4),
    made('a:y', 20, 5),
    made('b', 20, 6),
  ];
  assert.deepEqual(
    [...fastest(cases.slice(0, 4))].map(([engine, c]) => [engine, c.engine]),
    [
      ['a', 'a:y'],
      ['b', 'b'],
    ],
  );
  assert.deepEqual(
    byTime(cases.slice(0, 4)).map((c) => c.engine),
    ['b', 'a:y', 'a:x', 'a:z'],
  );
  const subject = subjectsOf(cases)[0] as ReturnType<typeof subjectsOf>[0];
  assert.deepEqual(
    leaders(growthCurves(subject)).map((c) => c.of.engine),
    ['a:x', 'b'],
  );
  assert.deepEqual([rate(1e-7), rate(0.5), rate(1.2345e-3), rate(null)], ['10 M', '2', '810', '—']);
});

test('short names are explained once, where they leave something out', () => {
  const cases = [made('b:x=1', 10, 1), made('a', 10, 1), made('b:x=1', 20, 1), made('a:y', 10, 1, { threads: 2 })];
  assert.deepEqual(specKey(cases), [
    ['a y', 'a:y'],
    ['b x=1', 'b:x=1'],
  ]);
  assert.deepEqual(cases.map(labelOf), ['b x=1', 'a', 'b x=1', 'a y, 2 threads']);
});

test('curves of one engine differ in their dashes', () => {
  const dashes = dashesOf([made('a', 1, 1), made('b', 1, 1), made('a:x', 1, 1), made('a:x', 1, 1, { threads: 2 })]);
  assert.deepEqual([dashes[0], dashes[1]], [[], []]);
  assert.equal(new Set([dashes[0], dashes[2], dashes[3]].map(String)).size, 3);
});
