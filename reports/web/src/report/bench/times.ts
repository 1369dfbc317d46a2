// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Times of the cases that are compared with each other: bars, and tables with intervals, work, memory and quality.
import { type Child, el } from '../../common/elements.ts';
import { duration, format, toNumber, unitText, words } from '../../common/format.ts';
import { barList } from '../charts/bars.ts';
import { spreadsByDecades } from '../charts/samples.ts';
import type { BenchCase } from '../data.ts';
import { engineColour } from '../run.ts';
import { command, facts, folded, headRow, scroll } from '../widgets.ts';
import { engineOf, labelOf, rate, speedUp } from './groups.ts';

export const interval = (
  low: BenchCase['low'],
  high: BenchCase['high'],
  text: (v: BenchCase['low']) => string,
): string => (low === null || high === null ? '—' : `${text(low)} … ${text(high)}`);

/** An invalid time is struck out. */
const timeOf = (c: BenchCase): Child =>
  c.time === null ? '—' : c.valid ? duration(c.time) : el('s', { title: c.reason }, duration(c.time));

/** True if the values are too far apart for one linear scale. */
export const isWide = (values: number[]): boolean => spreadsByDecades(values, 2);

export function bars(cases: BenchCase[]): HTMLElement {
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
    isWide(list.map((b) => b.value)),
    'var(--accent)',
  );
}

interface Column {
  head: string;
  cell: (c: BenchCase) => string;
  below?: (c: BenchCase) => string; // text in small letters
}

/** Columns of scenes: cost of their contacts. */
const sceneWork: Column[] = [
  { head: 'Contacts', cell: (c) => (workIn(c, 'contacts') >= 0 ? format(workIn(c, 'contacts')) : '—') },
  {
    head: 'Time per contact',
    cell: (c) => (c.valid && workIn(c, 'contacts') > 0 ? duration(toNumber(c.time) / workIn(c, 'contacts')) : '—'),
  },
  { head: 'Pairs in touch', cell: (c) => format(c.counts.touching_pairs ?? null) },
];
const workIn = (c: BenchCase, name: string): number => toNumber(c.counts[name]);

/** Columns of isolated parts: work per operation and its quality. */
function partWork(cases: BenchCase[]): Column[] {
  const first = cases[0] as BenchCase;
  const counts = new Set(cases.flatMap((c) => Object.keys(c.counts)).filter((name) => name !== first.sizeUnit));
  const checks = new Set(cases.flatMap((c) => c.quality.map((q) => q.name)));
  const rated: Column = { head: `${first.operation}s a second`, cell: (c) => (c.valid ? rate(c.time) : '—') };
  const counted = [...counts].map((name) => ({ head: words(name), cell: (c: BenchCase) => format(c.counts[name]) }));
  const checked = [...checks].map((name) => ({
    head: words(name),
    cell: (c: BenchCase) => {
      const q = c.quality.find((x) => x.name === name);
      return q ? `${format(q.value, 3)}${unitText(q.unit)}` : '—';
    },
  }));
  return [rated, ...counted, ...checked];
}

/** All but the name, the median and whether it counts. */
function columnsOf(cases: BenchCase[]): Column[] {
  const isBase = (c: BenchCase) => c.base === c.id;
  const scene = cases[0]?.part === 'scene';
  const columns: Column[] = [
    { head: 'Wall', cell: (c) => (c.repetitions ? duration(c.wall) : '—') },
    {
      head: 'Ratio to the base',
      cell: (c) => (isBase(c) ? 'base' : c.ratio === null ? '—' : format(c.ratio, 3)),
      below: (c) => (isBase(c) || c.ratioLow === null ? '' : interval(c.ratioLow, c.ratioHigh, (v) => format(v, 3))),
    },
    ...(scene ? sceneWork : partWork(cases)),
    ...(scene && cases.some((c) => workIn(c, 'asleep') > 0)
      ? [{ head: 'Bodies asleep', cell: (c: BenchCase) => format(c.counts.asleep ?? null) }]
      : []),
    { head: 'Memory', cell: (c) => (c.memoryKiB === null ? '—' : `${format(toNumber(c.memoryKiB) / 1024, 3)} MiB`) },
    { head: 'Allocations', cell: (c) => (c.allocations === null ? '—' : format(c.allocations, 3)) },
    {
      head: 'Speed-up',
      cell: (c) => {
        const faster = speedUp(c, cases);
        return Number.isFinite(faster) ? `×${format(faster, 3)}` : '—';
      },
    },
    { head: 'Repetitions', cell: (c) => `${c.repetitions}${c.repetitions && !c.converged ? ' (wide)' : ''}` },
  ];
  return scene ? columns : columns.filter((column) => cases.some((c) => column.cell(c) !== '—'));
}

const small = (text: string): Child => (text ? el('span', { class: 'bound' }, text) : null);

function caseRow(c: BenchCase, columns: Column[]): HTMLElement {
  return el(
    'tr',
    { 'data-case': c.id, class: c.valid ? '' : 'invalid' },
    el('th', { class: 'sticky', scope: 'row', title: c.engine }, labelOf(c)),
    el('td', { class: 'num' }, timeOf(c), small(c.valid && c.low !== null ? interval(c.low, c.high, duration) : '')),
    el('td', { class: 'small' }, c.valid ? 'valid' : `invalid: ${c.reason}`),
    columns.map(({ cell, below }) => el('td', { class: 'num' }, cell(c), small(below?.(c) ?? ''))),
  );
}

export function timesTable(cases: BenchCase[]): HTMLElement {
  const columns = columnsOf(cases);
  const heads = ['Engine', 'Median, 95 %', 'Validity', ...columns.map((column) => column.head)];
  return scroll(
    el(
      'table',
      { class: 'full bench' },
      headRow(heads, (i) => i !== 2),
      el(
        'tbody',
        null,
        cases.map((c) => caseRow(c, columns)),
      ),
    ),
  );
}

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
  const phases = Object.entries(c.phases);
  return phases.map(([name, seconds]) => `${words(name)} ${duration(seconds)}`).join(', ');
}

export function more(cases: BenchCase[]): HTMLElement {
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
            el('h5', null, 'Phases, if the engine reports them (wall time)'),
            facts(phases.map((c): [string, Child] => [labelOf(c), phasesText(c)])),
          ]
        : null,
      el('h5', null, 'Each one again, alone'),
      cases.map((c) => command(c.command)),
    ),
  );
}
