// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of the curves that a scenario's page plots, and of moments as numbers of steps.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { stepAt } from '../../src/common/steps.ts';
import { bodyNames, collectCurves, referenceLabel, wantsLog } from '../../src/report/curves.ts';
import type { Case, Curves } from '../../src/report/data.ts';

const packed = (...values: number[]) => Buffer.from(new Float32Array(values).buffer).toString('base64');
const flat = packed(0, 0);
const curves = (more: Partial<Curves>): Curves => ({ samples: 2, t: packed(0, 1), bodies: [], series: [], ...more });
const caseOf = (spec: string, given: Curves | null, kind = 'exact'): Case =>
  ({ spec, curves: given, metrics: [{ kind }] }) as unknown as Case;

const ball = { name: 'ball', position: [packed(1, 2), flat, packed(0.5, Number.NaN)] };
const cases = [
  caseOf(
    'ode',
    curves({
      reference: [{ name: 'ball', position: [packed(1, 3), flat, flat] }],
      bodies: [ball, { name: 'box', position: [packed(7, 8), flat, flat] }],
      series: [
        { name: 'contact_count', subject: '', unit: '1', y: packed(4, 40000) },
        { name: 'position_error', subject: 'ball', unit: 'm', t: packed(0.25, 0.75), y: packed(1e-6, 1) },
        { name: 'position_error', subject: 'box', unit: 'm', y: packed(1, 1) },
        { name: 'normal_error', subject: '', unit: 'rad', y: packed(0.5, 0.25) },
        { name: 'penetration', subject: '', unit: 'm', y: flat },
      ],
    }),
  ),
  caseOf('crashed', null),
  caseOf('bullet', curves({ bodies: [{ name: 'ball', position: [packed(1, 4), flat, flat] }] })),
];
const plots = collectCurves(cases, ['ball', 'box'], 'ball');
const plot = (key: string) => plots.find((p) => p.key === key);

test('the motion comes first, then the curves that are used most', () => {
  assert.deepEqual(
    plots.map((p) => p.key),
    ['p0', 'p2', 'position_error/ball', 'normal_error/', 'contact_count/'],
  );
});

test('a plot has the curve of every engine and of the reference', () => {
  const x = plot('p0');
  assert.deepEqual(
    x?.curves.map((c) => [c.spec, ...c.y]),
    [
      ['', 1, 3],
      ['ode', 1, 2],
      ['bullet', 1, 4],
    ],
  );
  assert.equal(x?.title, 'ball: position x');
  assert.deepEqual(plot('p2')?.curves.find((c) => c.spec === 'ode')?.y, [0.5, null], 'what is not finite is a gap');
});

test('curves of other bodies, and those that stay at zero, are left out', () => {
  assert.equal(plot('position_error/box'), undefined);
  assert.equal(plot('p1'), undefined);
  assert.equal(plot('penetration/'), undefined);
});

test('a series may have times of its own', () => {
  assert.deepEqual(Array.from(plot('position_error/ball')?.curves[0]?.x ?? []), [0.25, 0.75]);
  assert.deepEqual(Array.from(plot('normal_error/')?.curves[0]?.x ?? []), [0, 1]);
});

test('errors over decades want a logarithmic axis, counts do not', () => {
  assert.deepEqual(
    plots.map((p) => [p.key, wantsLog(p)]),
    [
      ['p0', false],
      ['p2', false],
      ['position_error/ball', true],
      ['normal_error/', false],
      ['contact_count/', false],
    ],
  );
});

test('a recording is not called exact', () => {
  assert.equal(referenceLabel(cases), 'exact reference');
  assert.equal(referenceLabel([...cases, caseOf('x', null, 'measured')]), 'recorded motion');
  assert.deepEqual(bodyNames(cases), ['ball', 'box']);
});

test('a moment is a number of steps where a step ends', () => {
  for (let n = 0; n <= 5000; ++n) assert.equal(stepAt(n / 240, 1 / 240), n);
  let summed = 0;
  for (let n = 1; n <= 1000; ++n) {
    summed += 0.1; // a time with the rounding of a sum
    assert.equal(stepAt(summed, 0.1), n);
  }
  assert.equal(stepAt(0.015, 0.01), null, 'within a step');
  assert.equal(stepAt(-0.01, 0.01), null, 'before the start');
  assert.equal(stepAt(1, 0), null, 'without a step');
});
