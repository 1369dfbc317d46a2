// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Case } from '../../src/report/data.ts';
import { standingText } from '../../src/report/scenario/standing.ts';

const packed = (values: number[]): string => Buffer.from(Float32Array.from(values).buffer).toString('base64');
const file = JSON.stringify({
  dimension: 3,
  gravity: [0, -10, 0],
  bodies: ['low', 'high'].map((name) => ({ name, shapes: [{ sphere: { radius: 1 } }] })),
});
const times = [0, 1, 2, 3];
const run = (bodies: Record<string, [x: number[], y: number[]]>, metrics: object[] = []): Case =>
  ({
    metrics,
    curves: {
      t: packed(times),
      series: [],
      bodies: Object.entries(bodies).map(([name, [x, y]]) => ({ name, position: [packed(x), packed(y), null] })),
    },
  }) as unknown as Case;
const still: [number[], number[]] = [
  [0, 0, 0, 0.1],
  [5, 5, 5, 4.9],
];
const text = (bodies: Parameters<typeof run>[0], metrics = ['rest_motion']) =>
  standingText(run(bodies), metrics, 3, file);

test('what stays within a quarter of its reach stands', () => {
  assert.equal(text({ low: still, high: still }), 'stands for 3 s');
});

test('the first body to leave is named, and whether it falls', () => {
  const falls: [number[], number[]] = [
    [0, 0, 0, 1],
    [5, 5, 4, 0],
  ];
  const slides: [number[], number[]] = [
    [0, 0.5, 1, 2],
    [5, 5, 5, 5],
  ];
  assert.equal(text({ low: still, high: falls }), 'high falls at 2 s');
  assert.equal(text({ low: slides, high: falls }), 'low leaves its place at 1 s');
});

test('a body without a curve is known from the metric', () => {
  const metrics = [
    { name: 'rest_motion', subject: '', value: 0.5, at: 3 },
    { name: 'rest_motion', subject: 'low', value: 0.2, at: 1 },
    { name: 'rest_motion', subject: 'high', value: 0.5, at: 3 },
  ];
  assert.equal(
    standingText(run({ low: still }, metrics), ['rest_motion'], 3, file),
    'high leaves its place, by 0.5 m at 3 s',
  );
  assert.equal(standingText(run({ low: still }, metrics.slice(0, 2)), ['rest_motion'], 3, file), 'stands for 3 s');
});

test('nothing is said where nothing should rest', () => {
  assert.equal(text({ low: still }, ['position_max']), '');
});
