// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { newCursor } from '../../src/common/cursor.ts';
import {
  angle,
  boundsText,
  duration,
  format,
  median,
  ratio,
  shortCommand,
  timeStep,
  toNumber,
} from '../../src/common/format.ts';
import { fileOf, placeCases } from '../../src/report/case_files.ts';
import { cellOf, errorOf, gradeOf, logPlace, relativeOf, severity } from '../../src/report/cells.ts';
import { barScale } from '../../src/report/charts/bars.ts';
import { logTicks, nearest, spreadsByDecades, unpack, widened, withGaps } from '../../src/report/charts/samples.ts';
import type { BriefCase, Column, Judged, Mechanism, Ranking, Scenario } from '../../src/report/data.ts';
import { gradable, placed, placedEngines, worstPresets, wrongIn } from '../../src/report/ranking.ts';

test('numbers are read and written', () => {
  assert.equal(toNumber('inf'), Infinity);
  assert.ok(Number.isNaN(toNumber(null)) && Number.isNaN(toNumber('nan')));
  assert.deepEqual(
    [format(0.00012345), format(-12.3456), format(null), format('nan'), format(0)],
    ['1.23e-4', '−12.35', '—', 'NaN', '0'],
  );
  assert.deepEqual([duration(3.2e-7), duration(0.00123), duration(12)], ['320 ns', '1.23 ms', '12 s']);
  assert.deepEqual([timeStep(1 / 240), timeStep(0.0033)], ['1/240 s', '0.0033 s']);
  assert.equal(angle(Math.PI / 2), '90°');
  assert.deepEqual(
    [ratio(1.01), ratio(2.44), ratio(130.2), ratio(20000), ratio(null)],
    ['×1', '×2.4', '×130', '×2e4', ''],
  );
  assert.deepEqual([median([3, 1, 2]), median([4, 1, 2, 3])], [2, 2.5]);
});

test('a long command is shown by its first words', () => {
  assert.equal(shortCommand('./rigor validate standard'), './rigor validate standard');
  const files = Array.from({ length: 300 }, (_, i) => `scene_${String(i).padStart(5, '0')}.json`);
  const short = shortCommand(`./rigor validate ${files.join(' ')}`);
  assert.ok(short.startsWith('./rigor validate scene_00000.json ') && short.length < 180, short);
  const left = Number(/ … (\d+) more$/.exec(short)?.[1]);
  assert.equal(short.split(' ').filter((w) => w.endsWith('.json')).length + left, 300);
  assert.equal(shortCommand('x'.repeat(500)), 'x'.repeat(500));
});

test('the cases of a large run come to their scenarios', () => {
  const files = [0, 3, 4];
  assert.deepEqual(
    [0, 2, 3, 4, 9].map((s) => fileOf(files, s)),
    [0, 0, 1, 2, 2],
  );
  const scenarios = ['a', 'b', 'c'].map((name) => ({ name, cases: [] as BriefCase[] }) as Scenario);
  placeCases(scenarios, 1, [[brief('x', 1)], [brief('y', 2), brief('z', 3)], [brief('beyond', 4)]]);
  assert.deepEqual(
    scenarios.map((s) => s.cases.map((c) => c.spec)),
    [[], ['x'], ['y', 'z']],
  );
});

test('an observable reports changes alone, with their source', () => {
  const { time } = newCursor(1);
  const reported: unknown[] = [];
  const end = time.follow((value, source) => reported.push([value, source]));
  time.set(1);
  time.set(2, 'chart');
  end();
  time.set(3);
  assert.deepEqual(reported, [[2, 'chart']]);
});

const column = (spec: string): Column => ({ spec, engine: spec, preset: '', options: '', label: spec, dash: [] });
const judged = (more: Partial<Judged> = {}): Judged => ({
  grade: 'C',
  by: 'position_final',
  relative: 0.005,
  ideal: null,
  beside: 'unknown',
  toBest: 1,
  toOurs: null,
  regression: 'unchanged',
  red: false,
  says: '',
  change: '',
  ...more,
});
const brief = (spec: string, value: number, more: Partial<BriefCase> = {}): BriefCase => ({
  id: '',
  spec,
  dt: 0.01,
  outcome: 'completed',
  verdict: 'pass',
  shown: 'pass',
  reason: '',
  value,
  bound: 1,
  step: { median: 1e-6, p10: 1e-6, p90: 1e-6, samples: 9, contacts: 1 },
  inRun: null,
  judged: judged(),
  ...more,
});
const scenario = (name: string, cases: BriefCase[]) => ({ name, reference: 'exact', cases }) as unknown as Scenario;

test('bounds are shown on both sides', () => {
  assert.equal(boundsText(0.01, null, format), '≤ 0.01');
  assert.equal(boundsText(0.01, undefined, format), '≤ 0.01');
  assert.equal(boundsText(0.01, 0.009, format), '≥ 0.009, ≤ 0.01');
  assert.equal(boundsText('inf', 0, format), '≥ 0, ≤ ∞');
});

test('a cell is the worst of its time steps, with the numbers of the finest', () => {
  const s = scenario('a', [brief('x', 0.25), brief('x', 2, { dt: 0.1, shown: 'fail' }), brief('y', 1)]);
  const cell = cellOf(s, column('x'));
  assert.equal(cell?.worst.shown, 'fail');
  assert.equal(errorOf(cell), 0.25);
  assert.equal(relativeOf(cell), 0.005);
  assert.deepEqual([gradeOf(cell as NonNullable<typeof cell>)], ['C']);
  assert.equal(cellOf(s, column('z')), null);
  assert.ok(
    Number.isNaN(errorOf(cellOf(scenario('b', [brief('x', 1, { shown: 'crashed' })]), column('x')))),
    'no number beside a crash',
  );
  assert.ok(severity('crashed') > severity('fail') && severity('pass') > severity('unsupported'));
});

test('places on a logarithmic bar', () => {
  assert.deepEqual(
    [logPlace(1e-3, 1e-3, 1), logPlace(1, 1e-3, 1), logPlace(7, 1e-3, 1), logPlace(0, 1e-3, 1)],
    [0, 1, 1, 0],
  );
  assert.ok(Math.abs(logPlace(Math.sqrt(1e-3), 1e-3, 1) - 0.5) < 1e-12);
  assert.ok(Number.isNaN(logPlace(Number.NaN, 1e-3, 1)));
});

test('rankings meet their columns in the order that was counted', () => {
  const ranking = (within: number): Ranking => ({
    scenarios: 2,
    lost: 0,
    grades: [0, 0, within, 0, 2 - within],
    within,
    ungraded: 0,
    known: 0,
    farther: 0,
    red: 0,
    toBest: 1,
    toOurs: null,
    cost: null,
    costRatio: null,
    timed: 0,
  });
  const m: Mechanism = {
    name: 'm',
    title: '',
    about: '',
    scenarios: ['one', 'two'],
    order: [1, 0],
    engines: [1, 0],
    best: 1,
    rankings: [ranking(1), ranking(2)],
  };
  assert.deepEqual(
    placed(m, ['bad', 'good'].map(column)).map((s) => [s.column.spec, s.within]),
    [
      ['good', 2],
      ['bad', 1],
    ],
  );
  const lists = [
    scenario('one', [brief('bad', 0.1), brief('lost', 1, { shown: 'crashed' })]),
    scenario('two', [brief('bad', 5, { judged: judged({ grade: 'E' }) })]),
  ];
  const wrong = (spec: string) => wrongIn(lists, column(spec)).map((w) => w.scenario.name);
  assert.deepEqual([wrong('bad'), wrong('lost'), wrong('good')], [['two'], ['one'], []]);
  assert.equal(gradable({ ...ranking(1), ungraded: 1 }), 1);

  const presets = ['a fast', 'a default', 'b default', 'c default'].map((label) => ({
    ...column(label),
    engine: label.slice(0, 1),
  }));
  const four: Mechanism = { ...m, order: [3, 2, 1, 0], engines: [3, 2, 1], rankings: [0, 1, 1, 2].map(ranking) };
  assert.deepEqual(
    placedEngines(four, presets).map((s) => s.column.spec),
    ['c default', 'b default', 'a default'],
  );
  assert.deepEqual(
    worstPresets(placed(four, presets)).map((s) => s.column.spec),
    ['b default', 'a fast'],
    'each engine once, by the preset with most wrong',
  );
});

test('samples', () => {
  const packed = Buffer.from(new Float32Array([1, -2.5, Number.NaN]).buffer).toString('base64');
  assert.deepEqual(withGaps(unpack(packed) ?? []), [1, -2.5, null]);
  assert.equal(unpack(''), null);
  assert.deepEqual(
    [-1, 0.4, 0.6, 9].map((v) => nearest([0, 1, 2], v)),
    [0, 0, 1, 2],
  );
  assert.equal(nearest([1, 100], 11, true), 1);
  assert.equal(spreadsByDecades([1e-6, 1]), true);
  assert.equal(spreadsByDecades([-1, 1e-6, 1]), false);
  assert.deepEqual(logTicks(1e-18, 1).length <= 9, true);
  assert.deepEqual(logTicks(0.1, 2), [0.1, 0.2, 0.5, 1, 2]);
});

test('bars start at zero, logarithmic ones below the least', () => {
  const bar = (value: number) => ({ label: '', value, text: '' });
  assert.equal(barScale([bar(1), bar(4)], false)(1), 0.25);
  const logarithmic = barScale([bar(0.02), bar(1)], true);
  assert.ok(logarithmic(0.02) > 0 && logarithmic(1) === 1);
});

test('a logarithmic axis ends a little beyond its data', () => {
  const [low, high] = widened(91, 204);
  assert.ok(low < 91 && low > 80 && high > 204 && high < 220);
  assert.deepEqual(widened(10, 10), [5, 20]);
});
