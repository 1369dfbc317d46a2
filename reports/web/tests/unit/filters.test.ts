// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tests of the scenarios that the scoreboard shows, their order, and the page's data of its run.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import type { BriefCase, Column, Judged, Scenario } from '../../src/report/data.ts';
import type { Filters } from '../../src/report/overview/filters.ts';

const columns = ['bullet', 'bullet:preset=matched', 'ode'].map(
  (spec): Column => ({ spec, engine: spec.split(':')[0] ?? '', preset: '', options: '', label: spec, dash: [] }),
);
const data = {
  columns,
  engines: [{ name: 'ode' }, { name: 'spare' }],
  tasks: [{ name: 'walking', title: 'Walking', about: '', scenarios: ['stack'] }],
  symbols: { pass: { symbol: '✓', word: 'pass', count: 3 } },
};

interface Given {
  spec: string;
  value: number;
  relative: number;
  cost: number;
  grade: Judged['grade'];
  shown?: BriefCase['shown'];
  regression?: Judged['regression'];
}
const brief = ({ spec, value, relative, cost, grade, shown = 'pass', regression = 'unchanged' }: Given) =>
  ({ spec, value, shown, step: { median: cost }, judged: { grade, relative, regression } }) as unknown as BriefCase;
const scenario = (name: string, more: Partial<Scenario>, cases: Given[]): Scenario =>
  ({
    name,
    title: '',
    description: '',
    tags: [],
    isolates: [],
    dimension: 3,
    main: { name: 'energy', unit: 'J', kind: 'exact' },
    ...more,
    cases: cases.map(brief),
  }) as unknown as Scenario;

const list = [
  scenario('stack', { title: 'Ten boxes stand', isolates: ['friction'], tags: ['contact'] }, [
    { spec: 'bullet', value: 3, relative: 0.03, cost: 2e-5, grade: 'D' },
    { spec: 'ode', value: 1, relative: 0.01, cost: 4e-5, grade: 'D', regression: 'worse' },
    { spec: 'bullet:preset=matched', value: Number.NaN, relative: Number.NaN, cost: 5e-5, grade: 'C' },
  ]),
  scenario('pendulum', { dimension: 2, title: 'A rod swings', main: { name: 'angle', unit: 'rad', kind: 'exact' } }, [
    { spec: 'bullet', value: 5, relative: 1e-7, cost: 1e-6, grade: 'A' },
    { spec: 'ode', value: 7, relative: 2, cost: 3e-6, grade: 'E', shown: 'crashed' },
  ]),
  scenario('drop', { title: 'A ball falls', tags: ['contact'] }, [
    { spec: 'bullet', value: 4, relative: 1e-3, cost: 5e-7, grade: 'C' },
    { spec: 'bullet:preset=matched', value: 2, relative: 2e-3, cost: 1e-6, grade: 'C' },
  ]),
];

let all: Filters;
let of: typeof import('../../src/report/overview/filters.ts');
let run: typeof import('../../src/report/run.ts');

before(async () => {
  // The page's data stand in its document.
  Object.assign(globalThis, {
    document: { getElementById: (id: string) => (id === 'run-data' ? { textContent: JSON.stringify(data) } : null) },
  });
  of = await import('../../src/report/overview/filters.ts');
  run = await import('../../src/report/run.ts');
  all = of.allScenarios;
});

const shown = (changes: Partial<Filters>) =>
  list.filter((s) => of.matches(s, columns, { ...all, ...changes })).map((s) => s.name);
const sorted = (changes: Partial<Filters>) => of.ordered(list, columns, { ...all, ...changes }).map((s) => s.name);

test('every filter leaves what it names, and without one all is shown', () => {
  assert.deepEqual(shown({}), ['stack', 'pendulum', 'drop']);
  assert.deepEqual(shown({ text: 'BALL falls' }), ['drop'], 'all words, in any case');
  assert.deepEqual(shown({ text: 'ten' }), ['stack']);
  assert.deepEqual(shown({ text: 'ball swings' }), []);
  assert.deepEqual(shown({ text: ' ' }), ['stack', 'pendulum', 'drop']);
  assert.deepEqual(shown({ mechanism: 'friction' }), ['stack']);
  assert.deepEqual(shown({ mechanism: 'contact' }), ['stack', 'drop'], 'a tag will do');
  assert.deepEqual(shown({ task: 'walking' }), ['stack']);
  assert.deepEqual(shown({ dimension: '2' }), ['pendulum']);
  assert.deepEqual(shown({ verdict: 'crashed' }), ['pendulum']);
  assert.deepEqual(shown({ change: 'worse' }), ['stack']);
  assert.deepEqual(shown({ mechanism: 'contact', dimension: '2' }), [], 'filters add up');
});

test('a grade is that of a cell which ran, never that of a crash', () => {
  assert.deepEqual(shown({ grade: 'A' }), ['pendulum']);
  assert.deepEqual(shown({ grade: 'E' }), []);
});

test('verdict and grade must be of the same cell', () => {
  assert.deepEqual(shown({ grade: 'A', verdict: 'crashed' }), []);
  assert.deepEqual(shown({ grade: 'A', verdict: 'pass' }), ['pendulum']);
});

test('scenarios are sorted by what the cells of a column say, those without a number last', () => {
  assert.deepEqual(sorted({ sort: 'name' }), ['drop', 'pendulum', 'stack']);
  assert.deepEqual(sorted({ sort: 'name', descending: true }), ['stack', 'pendulum', 'drop']);
  assert.deepEqual(sorted({ sort: 'metric' }), ['pendulum', 'stack', 'drop'], 'equal ones stay in their order');
  assert.deepEqual(sorted({ sort: 'bullet' }), ['pendulum', 'drop', 'stack'], 'by grade');
  assert.deepEqual(sorted({ sort: 'bullet', number: 'cost' }), ['drop', 'pendulum', 'stack']);
  assert.deepEqual(sorted({ sort: 'ode' }), ['stack', 'pendulum', 'drop'], 'a crash after what ran');
  assert.deepEqual(sorted({ sort: 'bullet:preset=matched' }), ['drop', 'stack', 'pendulum']);
  assert.deepEqual(list[0]?.name, 'stack', 'the list itself is left as it is');
});

test('what differs most between engines comes first', () => {
  const apart = list.map((s) => of.difference(s, columns, 'all'));
  const decades = (a: number, b: number) => Math.log10(a / b);
  assert.ok(Math.abs((apart[0] as number) - decades(0.03, 0.01)) < 1e-12);
  assert.equal(apart[1], 10, 'a crash is further off than any error');
  assert.ok(Math.abs((apart[2] as number) - decades(2e-3, 1e-3)) < 1e-12);
  assert.deepEqual(sorted({}), ['pendulum', 'stack', 'drop']);
  const alone = scenario('alone', {}, [{ spec: 'ode', value: 1, relative: 1, cost: 1, grade: 'E' }]);
  assert.equal(of.difference(alone, columns, 'all'), -1, 'one result cannot differ');
});

test('scenarios are grouped by their first task, unless an order was chosen', () => {
  const groups = (changes: Partial<Filters>) =>
    of.grouped(list, { ...all, ...changes }).map((g) => [g.title, ...g.scenarios.map((s) => s.name)]);
  assert.deepEqual(groups({}), [
    ['Walking', 'stack'],
    ['Other scenarios', 'pendulum', 'drop'],
  ]);
  assert.deepEqual(groups({ group: 'none' }), [['', 'stack', 'pendulum', 'drop']]);
  assert.deepEqual(groups({ sort: 'name' }), [['', 'stack', 'pendulum', 'drop']]);
});

test('bars of a row are measured against its best', () => {
  const scale = (i: number, number: Filters['number']) => of.rowScale(list[i] as Scenario, columns, 'all', number);
  assert.deepEqual(scale(0, 'error'), { bestError: 1, leastCost: new Map([['', 2e-5]]) });
  assert.deepEqual(scale(0, 'relative'), { bestError: 0.01, leastCost: new Map([['', 2e-5]]) });
  assert.ok(Number.isNaN(scale(1, 'error').bestError), 'one number alone has no best');
  assert.equal(scale(2, 'error').leastCost.get(''), 5e-7);
});

test('an engine has one colour, whichever of its columns is shown', () => {
  const colours = ['bullet', 'ode', 'spare', 'unknown'].map(run.engineColour);
  assert.equal(new Set(colours).size, 4, 'colours differ');
  assert.deepEqual(colours, run.palette.slice(0, 4), 'those that take part first');
  assert.deepEqual(
    [0, 1, 2].map((i) => run.isFirstOfEngine(columns, i)),
    [true, false, true],
  );
});

test('links keep what they are given, escaped, and leave out what is absent', () => {
  assert.equal(run.scenarioLink('a b'), '#/scenario/a%20b');
  const link = run.scenarioLink('pile', { dt: 0.01, spec: 'ode:stepper=quickstep,iterations=50', pair: null, t: '' });
  assert.equal(link, '#/scenario/pile?dt=0.01&spec=ode%3Astepper%3Dquickstep%2Citerations%3D50');
  const query = new URLSearchParams(link.slice(link.indexOf('?') + 1));
  assert.equal(query.get('spec'), 'ode:stepper=quickstep,iterations=50');
  assert.equal(run.engineLink('x/y'), '#/engine/x%2Fy');
});

test('labels and verdicts of what the run does not know are still readable', () => {
  assert.equal(run.labelOf('ode'), 'ode');
  assert.equal(run.labelOf('gone:preset=x'), 'gone:preset=x');
  assert.equal(run.verdictText('pass').symbol, '✓');
  assert.deepEqual(run.verdictText('timeout'), { symbol: '?', word: 'timeout', count: 0 });
  assert.deepEqual(['pass', 'fail', 'known deviation', 'skipped'].map(run.metricShown), [
    'pass',
    'fail',
    'known_deviation',
    'unsupported',
  ]);
});

test('times of guests are compared with those of the same clock alone', async () => {
  const { rowScale } = await import('../../src/report/overview/filters.ts');
  const [first, second, third] = columns as [Column, Column, Column];
  const mixed = [first, second, { ...third, clock: 'guest, wasm' }];
  const scale = rowScale(list[0] as Scenario, mixed, 'finest', 'error');
  assert.deepEqual(
    [...scale.leastCost],
    [
      ['', 2e-5],
      ['guest, wasm', 4e-5],
    ],
  );
});

test('hidden engines are left out, pinned ones come first, modules before guests', async () => {
  const { chosenColumns, toggled } = await import('../../src/report/overview/filters.ts');
  const { kinds } = await import('../../src/report/run.ts');
  const specs = (changes: Partial<Filters>) => chosenColumns({ ...all, ...changes }).map((c) => c.spec);
  assert.deepEqual(specs({}), ['bullet', 'bullet:preset=matched', 'ode']);
  assert.deepEqual(specs({ hide: 'bullet' }), ['ode']);
  assert.deepEqual(specs({ pin: 'ode' }), ['ode', 'bullet', 'bullet:preset=matched']);
  assert.equal(toggled('a,b', 'a'), 'b');
  assert.equal(toggled('', 'a'), 'a');
  const [first, , third] = columns as [Column, Column, Column];
  const guest = { ...first, engine: 'guest', clock: 'guest' };
  assert.deepEqual(
    kinds([guest, third]).map((kind) => [kind.title, kind.columns.length]),
    [
      ['Modules', 1],
      ['Guests', 1],
    ],
  );
  assert.deepEqual(
    kinds([third]).map((kind) => kind.title),
    [''],
  );
});
