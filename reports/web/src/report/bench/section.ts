// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bench: what it means, the times of every scene and part as bars with intervals, growth with the size, quality, and
// what became of it since a baseline.
import { type Child, el } from '../../common/elements.ts';
import { duration, format, toNumber, unitText, words } from '../../common/format.ts';
import { barList } from '../charts/bars.ts';
import { plotCard } from '../charts/plot.ts';
import type { Bench, BenchCase, BenchChange } from '../data.ts';
import { command, facts, folded, headRow, panel, scroll } from '../parts.ts';
import { engineColour, run } from '../run.ts';
import { engineOf, growthCurves, labelOf, type Subject, speedUp, subjectsOf, workOf } from './groups.ts';

const interval = (low: BenchCase['low'], high: BenchCase['high'], text: (v: BenchCase['low']) => string): string =>
  low === null || high === null ? '—' : `${text(low)} … ${text(high)}`;

/** An invalid time is struck out. */
const timeOf = (c: BenchCase): Child =>
  c.time === null ? '—' : c.valid ? duration(c.time) : el('s', { title: c.reason }, duration(c.time));

function bars(cases: BenchCase[]): HTMLElement {
  const list = cases.map((c) => ({
    label: labelOf(c),
    value: c.valid ? toNumber(c.time) : NaN,
    low: toNumber(c.low),
    high: toNumber(c.high),
    text: c.valid ? duration(c.time) : 'no timing',
    title: c.valid ? interval(c.low, c.high, duration) : c.reason,
    colour: engineColour(engineOf(c)),
  }));
  return barList(
    list.map((b) => (Number.isFinite(b.value) ? b : { ...b, low: NaN, high: NaN })),
    false,
    'var(--accent)',
  );
}

function growth(subject: Subject): HTMLElement | null {
  const curves = growthCurves(subject);
  if (curves.length === 0) return null;
  const first = subject.sizes[0]?.cases[0] as BenchCase;
  const per = workOf(first) ? (toNumber(first.counts.contacts) > 0 ? 'contact point' : 'pair') : first.sizeUnit;
  const finite = (v: number) => (Number.isFinite(v) ? v : null);
  const title = `Time per ${per} over ${first.sizeUnit}`;
  const card = plotCard({
    title,
    name: `${subject.name}: growth`,
    unit: 's',
    xTitle: first.sizeUnit,
    xUnit: '',
    logX: true,
    zeroY: true,
    tall: true,
    lines: curves.map(({ of, points }) => ({
      key: of.engine,
      label: labelOf(of),
      colour: engineColour(engineOf(of)),
      dash: of.threads > 1 ? [6, 4] : [],
      width: 1.5,
      points: true,
      x: points.map((p) => p.x),
      y: points.map((p) => p.y),
      low: points.map((p) => finite(p.low)),
      high: points.map((p) => finite(p.high)),
    })),
  });
  const key = curves.map(({ of }) =>
    el('span', null, el('i', { class: 'swatch', style: `background:${engineColour(engineOf(of))}` }), labelOf(of)),
  );
  card.append(el('div', { class: 'lines' }, key));
  return card;
}

const heads = [
  'Engine',
  'Median',
  'Validity',
  '95 %',
  'Wall',
  'Ratio to the base',
  '95 %',
  'Contacts',
  'Time per contact',
  'Pairs in touch',
  'Memory',
  'Allocations',
  'Speed-up',
  'Repetitions',
];

function caseRow(c: BenchCase, all: BenchCase[]): HTMLElement {
  const contacts = toNumber(c.counts.contacts);
  const isBase = c.base === c.id;
  const faster = speedUp(c, all);
  const cells: Child[] = [
    c.valid ? interval(c.low, c.high, duration) : '—',
    c.repetitions ? duration(c.wall) : '—',
    isBase ? 'base' : c.ratio === null ? '—' : format(c.ratio, 3),
    isBase ? '' : interval(c.ratioLow, c.ratioHigh, (v) => format(v, 3)),
    contacts >= 0 ? format(contacts) : '—',
    c.valid && contacts > 0 ? duration(toNumber(c.time) / contacts) : '—',
    format(c.counts.touching_pairs ?? null),
    c.memoryKiB === null ? '—' : `${format(toNumber(c.memoryKiB) / 1024, 3)} MiB`,
    c.allocations === null ? '—' : format(c.allocations, 3),
    Number.isFinite(faster) ? `×${format(faster, 3)}` : '—',
    `${c.repetitions}${c.repetitions && !c.converged ? ' (wide)' : ''}`,
  ];
  return el(
    'tr',
    { 'data-case': c.id, class: c.valid ? '' : 'invalid' },
    el('th', { class: 'sticky', scope: 'row', title: c.engine }, labelOf(c)),
    el('td', { class: 'num' }, timeOf(c)),
    el('td', { class: 'small' }, c.valid ? 'valid' : `invalid: ${c.reason}`),
    cells.map((cell) => el('td', { class: 'num' }, cell)),
  );
}

const timesTable = (cases: BenchCase[]): HTMLElement =>
  scroll(
    el(
      'table',
      { class: 'full bench' },
      headRow(heads, (i) => i !== 2),
      el(
        'tbody',
        null,
        cases.map((c) => caseRow(c, cases)),
      ),
    ),
  );

function qualityTable(cases: BenchCase[]): HTMLElement {
  const names = [...new Set(cases.flatMap((c) => c.quality.map((q) => q.name)))];
  const cell = (c: BenchCase, name: string) => {
    const q = c.quality.find((x) => x.name === name);
    if (!q) return el('td', { class: 'num' }, '—');
    const bounds = [
      q.min === null ? '' : `at least ${format(q.min)}`,
      q.max === null ? '' : `at most ${format(q.max)}`,
    ];
    const said = bounds.filter(Boolean).join(', ') || 'not judged';
    const text = `${format(q.value)}${unitText(q.unit)}`;
    return el('td', { class: 'num', title: said }, q.ok ? text : el('b', null, `${text} (${said})`));
  };
  return scroll(
    el(
      'table',
      { class: 'full' },
      headRow(['Engine', ...names.map(words)], (i) => i > 0),
      el(
        'tbody',
        null,
        cases.map((c) =>
          el(
            'tr',
            null,
            el('th', { class: 'sticky', scope: 'row' }, labelOf(c)),
            names.map((name) => cell(c, name)),
          ),
        ),
      ),
    ),
  );
}

function phasesText(c: BenchCase): string {
  const told = Object.entries(c.phases);
  return told.map(([name, seconds]) => `${words(name)} ${duration(seconds)}`).join(', ');
}

function more(cases: BenchCase[]): HTMLElement {
  const phases = cases.filter((c) => Object.keys(c.phases).length > 0);
  return folded('Quality, phases, commands', () =>
    el(
      'div',
      null,
      cases.some((c) => c.quality.length > 0)
        ? [el('h5', null, 'Quality of the timed runs'), qualityTable(cases)]
        : null,
      phases.length
        ? [
            el('h5', null, 'Phases, where the engine tells (wall time)'),
            facts(phases.map((c): [string, Child] => [labelOf(c), phasesText(c)])),
          ]
        : null,
      el('h5', null, 'Each one again, alone'),
      cases.map((c) => command(c.command)),
    ),
  );
}

function subjectNode(subject: Subject): HTMLElement {
  const scene = subject.part === 'scene';
  const title = subject.name; // the title of its file may speak of one size
  return el(
    'div',
    { class: 'bench-subject', 'data-subject': subject.name },
    el('h3', null, scene ? '' : `${words(subject.part)}: `, title),
    growth(subject),
    subject.sizes.map(({ size, cases }) => {
      const first = cases[0] as BenchCase;
      const what = first.sizeUnit ? `${format(size)} ${first.sizeUnit}, ` : '';
      return [
        el('div', { class: 'chart' }, el('h4', null, `${what}time of one ${first.operation}`), bars(cases)),
        timesTable(cases),
        more(cases),
      ];
    }),
  );
}

function changes(bench: Bench): Child {
  if (bench.changes.length === 0) return null;
  const order = ['slower', 'faster', 'same', 'not compared'];
  const sorted = [...bench.changes].sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict));
  const row = (change: BenchChange) => {
    const c = bench.cases.find((x) => x.id === change.id);
    const compared = change.verdict !== 'not compared';
    const cells = compared
      ? [
          duration(change.before),
          duration(change.after),
          format(change.ratio, 4),
          `${format(change.low, 4)} … ${format(change.high, 4)}`,
          format(change.p, 2),
        ]
      : ['—', '—', '—', '—', '—'];
    return el(
      'tr',
      { class: `change-${change.verdict.replace(' ', '-')}` },
      el('th', { class: 'sticky', scope: 'row' }, c ? `${c.name}, ${format(c.size)}: ${labelOf(c)}` : change.id),
      cells.map((text) => el('td', { class: 'num' }, text)),
      el('td', null, change.verdict + (change.reason ? `: ${change.reason}` : '')),
    );
  };
  return [
    el('h3', null, 'Since ', el('code', null, bench.settings.baseline ?? 'the baseline')),
    el(
      'p',
      { class: 'muted' },
      'Ratio of the medians, after / before, with its 95 % interval by bootstrap; p of Mann and Whitney’s test, corrected for the number of cases (Holm).',
    ),
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(['What', 'Before', 'After', 'Ratio', '95 %', 'p', 'Verdict'], (i) => i > 0 && i < 6),
        el('tbody', null, sorted.map(row)),
      ),
    ),
  ];
}

function meaning(bench: Bench): Child {
  const { settings } = bench;
  const width = format(100 * Number(settings.width ?? NaN), 3);
  const slow = settings.build && settings.build !== 'optimised';
  return [
    slow
      ? el('p', { class: 'notice' }, `This program was ${settings.build}: these times say nothing about the engines.`)
      : null,
    el(
      'p',
      { class: 'notice small' },
      'The authors of this bench wrote one of the engines in it, rigor. Every time comes with the command that takes it again, and is struck out where the run it was taken from was not good enough.',
    ),
    el(
      'p',
      null,
      'Every repetition is a process of its own, and no other one runs beside it. In each round every engine runs once, in an order drawn by lot (seed ',
      settings.seed ?? '?',
      `); rounds go on until the 95 % interval of each median is narrower than ${width} % of it, or the budget is used up (then: wide). `,
      'Median: over the repetitions, of the median step of each. CPU time of all threads for one thread, wall time for more. ',
      'Ratio: time over the base’s time in the same round, the median over rounds with its interval; invalid times enter none. ',
      'Memory: what the process grew by since the engine began to build its world. Allocations: calls of the C library’s allocator in a step, counted in a repetition of its own; ',
      'pools inside an engine are not seen. Contacts and pairs are what the engine reports for the timed steps: engines that keep fewer points for the same scene do less work.',
    ),
  ];
}

export function benchSection(): HTMLElement | null {
  const { bench } = run;
  if (!bench) return null;
  const machine = Object.entries(run.environment).filter(([k]) => !/^rigor$|^jobs$/.test(k));
  return panel(
    'bench',
    'Bench',
    run.command ? el('p', { class: 'muted' }, run.started, ' · ', el('code', null, run.command)) : null,
    meaning(bench),
    changes(bench),
    subjectsOf(bench.cases).map(subjectNode),
    el('h3', null, 'Machine and builds'),
    facts(machine),
  );
}
