// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Change, History, Series } from '../../src/history/data.ts';
import { marksOf, weight } from '../../src/history/marks.ts';

const series: Series = {
  scenario: 's',
  title: '',
  spec: 'x',
  engine: 'x',
  label: 'x',
  dt: 0.01,
  metric: 'position_max',
  unit: 'm',
  error: [1, 1, 2],
  relative: [],
  grade: [],
  outcome: ['completed', 'completed', 'completed'],
  time: [1, 1.05, 0.5],
  low: [0.9, 0.95, 0.45],
  high: [1.1, 1.15, 0.55],
  scene: null,
  replay: [null, null, null],
};
const nothing: Change = {
  worse: false,
  specs: [],
  verdicts: [],
  metrics: [],
  changed_scenarios: [],
  only_before: [],
  only_after: [],
  environment: [],
};
const place = { scenario: 's', spec: 'x', dt: 0.01 };
const error = { ...place, metric: 'position_max', unit: 'm', before: 1, after: 2, worse: true };
const historyOf = (...changes: (Change | null)[]): History => ({ runs: [], series: [series], changes });

test('times change where their intervals have no value in common', () => {
  const marks = marksOf(historyOf(null, nothing), series);
  assert.deepEqual(
    marks.map(({ run, what, worse }) => ({ run, what, worse })),
    [{ run: 2, what: 'time', worse: false }],
  );
  assert.ok(Math.abs((marks[0]?.ratio ?? 0) - 0.5 / 1.05) < 1e-12);
});

test('errors and endings change where the comparison of the runs says so', () => {
  const ended = { ...place, before: 'pass', after: 'crashed', worse: true, reason: '' };
  const others = { ...error, metric: 'energy_drift' };
  const change = { ...nothing, metrics: [others, { ...error, dt: 0.02 }, error], verdicts: [ended] };
  const marks = marksOf(historyOf(nothing, change), { ...series, low: [], high: [] });
  assert.deepEqual(marks, [
    { run: 2, what: 'ending', ratio: Number.NaN, worse: true },
    { run: 2, what: 'error', ratio: 2, worse: true },
  ]);
  const none = marksOf(historyOf(nothing, { ...nothing, metrics: [{ ...error, before: 0 }] }), { ...series, low: [] });
  assert.equal(none[0]?.ratio, Infinity, 'from nothing');
});

test('endings weigh more than errors, errors more than times', () => {
  const mark = (what: 'error' | 'time' | 'ending', ratio: number) => weight([{ run: 1, what, ratio, worse: true }]);
  assert.equal(weight([]), 0);
  assert.ok(mark('time', 1e9) < mark('error', 1.02));
  assert.ok(mark('error', 1.02) < mark('error', 5));
  assert.ok(mark('error', Infinity) < mark('ending', Number.NaN));
});
