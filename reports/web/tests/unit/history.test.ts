// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Change, History, Series, SpecChange } from '../../src/history/data.ts';
import { type Mark, marksOf, weight } from '../../src/history/marks.ts';
import { firstMoment, isOf, isOfSpec, ownName, ownNames, seriesNames } from '../../src/history/series.ts';

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
  at: [null, null, null],
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
  unpaired: [],
  environment: [],
};
const place = { scenario: 's', spec: 'x', dt: 0.01 };
const error = {
  ...place,
  metric: 'position_max',
  unit: 'm',
  before: 1,
  after: 2,
  worse: true,
  better: false,
  size: Math.log(2),
};
const historyOf = (...changes: (Change | null)[]): History => ({ pair: '', runs: [], series: [series], changes });

const spec: SpecChange = {
  name: 'x',
  cases: 8,
  better: 0,
  worse: 0,
  same: 8,
  cases_better: 0,
  cases_worse: 0,
  p_cases: 1,
  timed: 8,
  time_ratio: 0.5,
  time_interval: [0.4, 0.6],
  p_time: 0.01,
};
const timed = (...specs: SpecChange[]): Change => ({ ...nothing, specs });

test('times change where their intervals have no value in common and the spec differs over its cases', () => {
  const marks = marksOf(historyOf(null, timed({ ...spec, name: 'y' }, spec)), series);
  assert.deepEqual(
    marks.map(({ run, what, state }) => ({ run, what, state })),
    [{ run: 2, what: 'time', state: 'better' }],
  );
  assert.ok(Math.abs((marks[0]?.ratio ?? 0) - 0.5 / 1.05) < 1e-12);
});

test('no time is marked that the comparison of the spec over its cases does not show', () => {
  const none = (...specs: SpecChange[]) => assert.deepEqual(marksOf(historyOf(null, timed(...specs)), series), []);
  none({ ...spec, time_interval: [0.6, 1.1] });
  none({ ...spec, time_interval: [1.1, 1.6] });
  none({ ...spec, time_interval: null });
  none({ ...spec, name: 'y' });
  none();
  assert.deepEqual(marksOf(historyOf(null, null), series), []);
});

test('the comparison of a spec belongs to the series whose specs and time steps it names', () => {
  assert.ok(isOfSpec(series, spec, 2));
  const two: Series = { ...refined, cases: [refined.cases?.[0] ?? null, refined.cases?.[2] ?? null] };
  const steps = { ...spec, name: 'x dt=0.02 -> 0.005', spec: 'x', spec_after: 'x', dt: 0.02, dt_after: 0.005 };
  assert.ok(isOfSpec(two, steps, 1));
  assert.ok(!isOfSpec(two, { ...steps, dt_after: 0.01 }, 1));
  assert.ok(!isOfSpec(two, { ...steps, spec_after: 'y' }, 1));
});

test('errors and endings change where the comparison of the runs says so', () => {
  const ended = { ...place, before: 'pass', after: 'crashed', worse: true, better: false, reason: '' };
  const others = { ...error, metric: 'energy_drift' };
  const change = { ...nothing, metrics: [others, { ...error, dt: 0.02 }, error], verdicts: [ended] };
  const marks = marksOf(historyOf(nothing, change), { ...series, low: [], high: [] });
  assert.deepEqual(marks, [
    { run: 2, what: 'ending', ratio: Number.NaN, size: Infinity, state: 'worse' },
    { run: 2, what: 'error', ratio: 2, size: Math.log(2), state: 'worse' },
  ]);
  const none = marksOf(historyOf(nothing, { ...nothing, metrics: [{ ...error, before: 0 }] }), { ...series, low: [] });
  assert.equal(none[0]?.ratio, Infinity, 'from nothing');
});

test('what is neither worse nor better is a state of its own', () => {
  const refused = { ...place, before: 'pass', after: 'unsupported', worse: false, better: false, reason: '' };
  const states = (verdict: typeof refused) =>
    marksOf(historyOf(nothing, { ...nothing, verdicts: [verdict] }), { ...series, low: [] }).map((m) => m.state);
  assert.deepEqual(states(refused), ['other']);
  assert.deepEqual(states({ ...refused, better: true }), ['better']);
  assert.deepEqual(states({ ...refused, worse: true }), ['worse']);
});

test('endings weigh more than errors, errors more than other numbers and times, by their size', () => {
  const mark = (what: Mark['what'], size: number, state: Mark['state'] = 'worse') =>
    weight([{ run: 1, what, ratio: Math.exp(size), size, state }]);
  assert.equal(weight([]), 0);
  assert.ok(mark('time', 20) < mark('error', 0.02, 'other'));
  assert.ok(mark('error', 40, 'other') < mark('error', 0.02));
  assert.ok(mark('error', 0.02) < mark('error', 2));
  assert.ok(mark('error', Infinity) < mark('ending', Infinity, 'other'));
  assert.ok(mark('ending', Infinity, 'better') < mark('ending', Infinity));
});

const refined: Series = {
  ...series,
  dt: 0.005,
  cases: [{ spec: 'x', label: 'x', dt: 0.02 }, null, { spec: 'x', label: 'x', dt: 0.005 }],
};

test('a series of runs that differ on purpose finds its changes by both places', () => {
  const [coarse, none, fine] = [{ ...place, dt: 0.02 }, { spec_after: 'x' }, { spec_after: 'x', dt_after: 0.005 }];
  const two: Series = { ...refined, cases: [refined.cases?.[0] ?? null, refined.cases?.[2] ?? null] };
  assert.ok(isOf(two, { ...coarse, ...fine }, 1));
  assert.ok(!isOf(two, { ...coarse, ...none, dt_after: 0.01 }, 1));
  assert.ok(!isOf(two, { ...coarse, ...fine, spec_after: 'y' }, 1));
  assert.ok(isOf(series, place, 1), 'the same case of two runs');
});

test('lines are named by what the runs have in common and what each has of its own', () => {
  assert.equal(ownName(refined, 0, 'dt'), '1/50 s');
  assert.equal(ownName(refined, 1, 'dt'), '', 'no case');
  assert.equal(ownNames(refined, 'dt', [0, 1, 2]), '1/50 s → 1/200 s');
  assert.equal(seriesNames([refined], 'dt')(refined), 'x: 1/50 s → 1/200 s');
  const solvers = { ...series, cases: ['pgs', 'pgs', 'xpbd'].map((label) => ({ spec: label, label, dt: 0.01 })) };
  assert.equal(ownNames(solvers, 'spec', [0, 1, 2]), 'pgs → xpbd', 'the same of two runs is said once');
  assert.equal(seriesNames([solvers], 'spec')(solvers, [1, 2]), 'x: pgs → xpbd', 'one change');
  assert.equal(ownName(series, 0, ''), '');
  const finer = { ...series, dt: 0.005 };
  assert.equal(seriesNames([series, finer], '')(finer), 'x, 1/200 s');
});

test('runs are shown at the worst error whose time is known, else at the end', () => {
  const known = { ...series, error: [1, 5, 2], at: [0.1, 0.5, null] };
  assert.equal(firstMoment(known, [0, 1, 2]), 0.5);
  assert.equal(firstMoment(known, [0, 2]), 0.1, 'among the runs that are shown');
  assert.equal(firstMoment(series, [0, 1]), Infinity);
});
