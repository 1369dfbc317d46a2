// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One table, engines as columns, metrics as rows under a heading per kind; a number with a time is a link to it.
import { type Child, el } from '../../common/elements.ts';
import { findingKey } from '../../common/finding.ts';
import { boundsText, format, full, inShownUnit, type Maybe, shownUnit, toNumber } from '../../common/format.ts';
import type { Case, Column, Metric } from '../data.ts';
import { caseOf, metricShown, run, verdictText } from '../run.ts';
import { chip, metricName, panel, scroll, specHead, stickyHead } from '../widgets.ts';
import { type Context, fileLinks, moment } from './context.ts';
import { bodiesOf } from './outcomes.ts';

const sameTime = 1e-9; // [s]
const sameAngle = 1e-6; // [rad]

/** Bodies of the worst value: those that it is of, or of the whole scene the one that has the same value then. */
function worstBodies(all: Metric[], m: Metric): string[] {
  if (m.subject) return bodiesOf(m.subject);
  const own = all.find((x) => x.subject && x.name === m.name && x.value === m.value && x.at === m.at);
  return own ? bodiesOf(own.subject) : [];
}

/** The finding of the audit at the contact point whose normal is the metric's worst: it has the exact one to draw. */
function normalThere(c: Case | undefined, m: Metric, dt: number): string | null {
  const own = c?.audit.find((a) => a.auditor === 'in_run')?.findings ?? [];
  if (m.name !== 'normal_error') return null;
  const found = own.find(
    ({ what, step, error }) =>
      what.endsWith('normal') &&
      Math.abs(step * dt - toNumber(m.at)) < sameTime &&
      Math.abs(error - toNumber(m.value)) < sameAngle,
  );
  return found ? findingKey('in_run', found.what) : null;
}

const kinds: [kind: string, title: string, meaning: string][] = [
  ['exact', 'Against the exact solution', 'accuracy: the distance from the physics'],
  [
    'scheme_exact',
    'Against the engine’s own scheme',
    'bugs: the distance from a perfect run of its own time-stepping formula',
  ],
  ['measured', 'Against the recorded motion', 'a real body: the errors of the model and of the instrument are in it'],
  ['invariant', 'Invariants', 'what physics conserves'],
  ['contact', 'Contacts', 'penetration, normals, contact law'],
  ['joint', 'Joints', 'anchor drift and limits'],
  ['rest', 'Rest', 'what should stand still'],
  [
    'pieces',
    'Short pieces',
    'bodies put back on the truth every so many steps: the error of one piece, which chaos cannot drown',
  ],
  ['outcome', 'Outcome', 'neither right nor wrong for one start: distributions over many are comparable'],
];

function cell(context: Context, column: Column, name: string, subject: string): HTMLElement {
  const c = caseOf(context.cases, column);
  const m = c?.metrics.find((x) => x.name === name && x.subject === subject);
  if (!c || !m) return el('td', { class: 'num muted' });
  const judged = m.bound !== null || m.verdict !== 'pass';
  const shown = metricShown(m.verdict);
  const shownValue = (value: Maybe | undefined, digits = 4) => format(inShownUnit(value, m.unit), digits);
  const at = toNumber(m.at);
  const finding = normalThere(c, m, context.dt);
  const text: Child =
    at >= 0
      ? moment(context, column.spec, at, worstBodies(c.metrics, m), shownValue(m.value), null, finding)
      : shownValue(m.value);
  const title = `${full(m.value)} ${m.unit}${at >= 0 ? ` at t = ${format(at)} s` : ''}${m.scale !== null ? `\nover its scale ${format(m.scale)} ${m.unit}: ${full(m.relative)}` : ''}${m.recorded !== null ? `\non record: ${full(m.recorded)}` : ''}${m.orderCount ? `\nover ${m.orderCount} orders of insertion: ${full(m.orderMin)} … ${full(m.orderMax)}` : ''}${m.note ? `\n${m.note}` : ''}`;
  const small = (line: string) => el('span', { class: 'bound' }, line);
  return el(
    'td',
    { class: 'num', title, 'data-value': full(m.value), 'data-spec': column.spec },
    judged ? chip(shown, text, verdictText(shown).word) : text,
    m.bound !== null ? small(boundsText(m.bound, m.boundMin, shownValue)) : null,
    m.grade && !m.subject ? small(`${m.grade} ${format(m.relative, 2)}`) : null,
    m.ideal !== null ? small(`scheme ${format(m.ideal, 2)}`) : null,
    m.dependsOnOrder
      ? small(`${shownValue(m.orderMin, 2)} … ${shownValue(m.orderMax, 2)} over ${m.orderCount} orders`)
      : null,
  );
}

function rowsOf(cases: Case[], kind: string, whole: boolean): Metric[] {
  const found = cases.flatMap((c) => c.metrics).filter((m) => m.kind === kind && (m.subject === '') === whole);
  return [...new Map(found.map((m) => [`${m.name}\n${m.subject}`, m])).values()];
}

function table(context: Context, columns: Column[], whole: boolean): HTMLElement | null {
  const unknown = context.cases
    .flatMap((c) => c.metrics.map((m) => m.kind))
    .filter((k) => !kinds.some(([kind]) => kind === k));
  const all = [...kinds, ...[...new Set(unknown)].map((k): [string, string, string] => [k, k, ''])];
  const parts = all
    .map(([kind, title, text]) => ({ rows: rowsOf(context.cases, kind, whole), title, text }))
    .filter((p) => p.rows.length);
  if (parts.length === 0) return null;
  const row = (m: Metric) =>
    el(
      'tr',
      { 'data-metric': m.name, 'data-subject': m.subject },
      el(
        'th',
        { class: 'sticky', scope: 'row' },
        metricName(m.name),
        m.subject ? el('span', { class: 'muted' }, ` ${m.subject}`) : '',
      ),
      el('td', { class: 'muted' }, m.unit === '1' ? '' : shownUnit(m.unit)),
      columns.map((c) => cell(context, c, m.name, m.subject)),
    );
  const body = ({ rows, title, text }: (typeof parts)[number]) =>
    el(
      'tbody',
      null,
      el(
        'tr',
        { class: 'sub' },
        el(
          'th',
          { colspan: columns.length + 2 },
          title,
          text ? el('span', { class: 'muted small' }, ` — ${text}`) : '',
        ),
      ),
      rows.map(row),
    );
  const heads = specHead([stickyHead('Metric'), el('th', { scope: 'col' }, 'Unit')], columns);
  return scroll(el('table', null, heads, parts.map(body)));
}

export function metrics(context: Context): HTMLElement {
  const columns = run.columns.filter((c) => caseOf(context.cases, c)?.metrics.length);
  if (columns.length === 0)
    return panel('metrics', 'Metrics', el('p', { class: 'empty' }, 'No case at this time step has numbers.'));
  const whole = table(context, columns, true);
  const single = table(context, columns, false);
  const about = el(
    'p',
    { class: 'muted small' },
    'All digits on hover. A number that is a link shows the moment where it was worst; the name of a metric leads to its formula.',
  );
  const files = fileLinks(context, 'tables', 'This table as a file');
  if (whole === null || single === null) return panel('metrics', 'Metrics', about, whole ?? single, files);
  return panel(
    'metrics',
    'Metrics',
    about,
    whole,
    files,
    el('details', null, el('summary', null, 'By body, joint and quantity'), single),
  );
}
