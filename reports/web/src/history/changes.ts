// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The runs, and what changed or differs from each to the next.
import { type Child, el } from '../common/elements.ts';
import { counted, format, inShownUnit, shownUnit, timeStep, words } from '../common/format.ts';
import type { Change, History, Pair, Place, SpecChange } from './data.ts';
import { type State, stateOf, timeState } from './marks.ts';
import { factor, listOf, sign, table } from './parts.ts';
import { replayable } from './replays.ts';
import { caseKey, isOf } from './series.ts';

const mostNamed = 4; // specs of a run in the table

/** Names of what runs differ in on purpose. */
export const differences: Record<Exclude<Pair, ''>, string> = { engine: 'engine', spec: 'spec', dt: 'time step' };

/** True where not all runs have the same list. */
const differ = (lists: unknown[][]) => new Set(lists.map((list) => JSON.stringify(list))).size > 1;

export function runTable({ runs }: History): HTMLElement {
  const engines = [...new Set(runs.flatMap((r) => Object.keys(r.versions)))];
  const withSteps = differ(runs.map((r) => r.steps));
  const withSpecs = differ(runs.map((r) => r.specs));
  const some = (names: string[]) =>
    names.slice(0, mostNamed).join(', ') + (names.length > mostNamed ? ` and ${names.length - mostNamed} more` : '');
  const rows = runs.map((run, i) => {
    const before = runs[i - 1];
    const versions = engines.map((name) => {
      const changed = before !== undefined && before.versions[name] !== run.versions[name];
      return el('td', { class: changed ? 'changed' : null }, run.versions[name] ?? '—');
    });
    return el(
      'tr',
      null,
      el('th', { scope: 'row' }, String(i + 1)),
      el('td', null, run.name),
      el('td', null, run.started),
      el('td', { class: 'num' }, run.cases),
      withSteps ? el('td', null, some(run.steps.map(timeStep))) : null,
      withSpecs ? el('td', null, some(run.specs)) : null,
      versions,
    );
  });
  const own = [withSteps ? 'Time steps' : '', withSpecs ? 'Specs' : ''].filter(Boolean);
  return table(['Run', 'Folder', 'Started', 'Cases', ...own, ...engines], rows);
}

const probability = (p: number) => (p < 1e-4 ? '< 0.0001' : String(Number(p.toPrecision(2))));

const arrow = (before: string, after: string) => (before === after ? before : `${before} → ${after}`);
const where = (x: Place) =>
  `${x.scenario}, ${arrow(x.spec, x.spec_after ?? x.spec)}, ${arrow(timeStep(x.dt), timeStep(x.dt_after ?? x.dt))}`;

/** "rigor:preset=default, 1/60 s → 1/240 s". */
function specName({ name, spec, spec_after, dt, dt_after }: SpecChange): string {
  if (spec === undefined || spec_after === undefined) return name;
  const steps = dt === undefined || dt_after === undefined ? '' : `, ${arrow(timeStep(dt), timeStep(dt_after))}`;
  return arrow(spec, spec_after) + steps;
}

/** Verdicts on the times of a spec, as `rigor compare` prints them. */
const timeWords: Record<State, string> = { worse: 'slower', better: 'faster', other: 'no difference shown' };

function specRow(s: SpecChange): HTMLElement {
  const interval = s.time_interval ? ` (${s.time_interval.map((x) => x.toPrecision(3)).join(' … ')})` : '';
  return el(
    'tr',
    { 'data-spec': s.name },
    el('th', { scope: 'row' }, specName(s)),
    el('td', { class: 'num' }, s.better),
    el('td', { class: 'num' }, s.worse),
    el('td', { class: 'num' }, s.same),
    el('td', { class: 'num' }, s.cases_better),
    el('td', { class: 'num' }, s.cases_worse),
    el('td', { class: 'num' }, probability(s.p_cases)),
    el('td', { class: 'num' }, s.time_ratio === null ? '—' : `${factor(s.time_ratio)}${interval}`),
    el(
      'td',
      { class: 'state' },
      s.time_ratio === null ? '—' : s.time_interval ? timeWords[timeState(s)] : 'too few cases',
    ),
    el('td', { class: 'num' }, s.timed ? probability(s.p_time) : '—'),
  );
}

/** Sentence on how runs that differ on purpose are compared. */
const pairHint = (): Child => [
  el('code', null, 'rigor history RUN RUN --pair dt'),
  ', ',
  el('code', null, 'spec'),
  ' or ',
  el('code', null, 'engine'),
  ' shows runs with other time steps, settings or engines.',
];

function notesOf(change: Change, pair: Pair): string[] {
  return [
    change.changed_scenarios.length ? `Physics differ in ${change.changed_scenarios.join(', ')}: not compared` : '',
    change.only_before.length ? `${counted(change.only_before.length, 'case')} gone` : '',
    change.only_after.length ? `${counted(change.only_after.length, 'case')} new` : '',
    change.unpaired.length && pair
      ? `${counted(change.unpaired.length, 'case')} without one that differs in the ${differences[pair]} alone`
      : '',
    ...change.environment,
  ].filter(Boolean);
}

/** Sentence for two runs of which no ending and no error differs; null where one does. */
function sameNote(change: Change, pair: Pair): Child {
  if (change.verdicts.length + change.metrics.length > 0) return null;
  if (pair) return el('p', null, 'No ending and no error differs.');
  const isPart = change.only_before.length > 0 && change.only_after.length > 0;
  return el('p', null, 'No ending and no error of the cases that both have changed. ', isPart ? pairHint() : null);
}

/** Changes from a run to the next. */
export function changeNode(data: History, index: number): HTMLElement {
  const { pair, runs } = data;
  const change = data.changes[index];
  const title = `Run ${index + 1} to ${index + 2}: ${runs[index]?.name} → ${runs[index + 1]?.name}`;
  if (!change) {
    const none = pair
      ? `No case of one differs from a case of the other in the ${differences[pair]} alone.`
      : ['They have no case in common. ', pairHint()];
    return el('div', null, el('h3', null, title), el('p', null, none));
  }
  const withReplay = replayable(data.series);
  /** A link to the runs of a case side by side, where the page has them. */
  const replayLink = (place: Place): Child => {
    const found = withReplay.find((s) => isOf(s, place, index + 1));
    if (!found) return null;
    return [
      ' ',
      el('a', { class: 'to-replay', href: `#${new URLSearchParams({ replay: caseKey(found) })}` }, 'side by side'),
    ];
  };
  const value = (v: Change['metrics'][number]['before'], unit: string) =>
    `${format(inShownUnit(v, unit))}${unit === '1' ? '' : ` ${shownUnit(unit)}`}`;
  const notes = notesOf(change, pair);
  return el(
    'div',
    { class: 'change', 'data-to': index + 1 },
    el('h3', null, title),
    sameNote(change, pair),
    listOf(change.verdicts, (v) => [
      sign(stateOf(v)),
      `${where(v)}: ${v.before} → ${v.after}`,
      v.reason ? `, ${v.reason}` : '',
      replayLink(v),
    ]),
    listOf(change.metrics, (m) => [
      sign(stateOf(m)),
      `${where(m)}: ${words(m.metric)} ${value(m.before, m.unit)} → ${value(m.after, m.unit)}`,
      replayLink(m),
    ]),
    table(
      [
        'Engine',
        'Errors better',
        'worse',
        'same',
        el('span', { title: 'cases of which more errors are better than worse' }, 'Cases better'),
        el('span', { title: 'cases of which more errors are worse than better' }, 'worse'),
        el(
          'span',
          { title: 'two-sided sign test of the cases that are better against those that are worse' },
          'p of cases',
        ),
        `Time of a step, run ${index + 2} ÷ ${index + 1} (95 %)`,
        el('span', { title: 'slower or faster where the 95 % interval over the cases excludes 1' }, 'Time'),
        el(
          'span',
          { title: 'two-sided sign test of the cases that are slower against those that are faster' },
          'p of times',
        ),
      ],
      change.specs.map(specRow),
    ),
    notes.length ? el('p', { class: 'muted small' }, `${notes.join('; ')}.`) : null,
  );
}
