// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts of the runs, and of all collision engines at the same poses, against the exact oracle. The worst place of a
// row is a link to its moment.
import { el } from '../../common/elements.ts';
import { type ContactFinding, findingKey } from '../../common/finding.ts';
import { angle, format, full, type Maybe } from '../../common/format.ts';
import type { Audit, Case } from '../data.ts';
import { labelOf } from '../run.ts';
import { chip, headRow, metricName, numberCell, panel, scroll } from '../widgets.ts';
import { placeTime, worstPlace } from '../worst.ts';
import { type Context, moment } from './context.ts';

const count = (n: number, bad = false) => el('td', { class: 'num' }, bad && n ? chip('fail', n) : n);
const angleCell = (value: Maybe) =>
  el('td', { class: 'num', title: `${full(value)} rad`, 'data-value': full(value) }, angle(value));

const kindWords: Record<ContactFinding['what'], string> = {
  normal: 'normal',
  point_normal: 'normal of one point',
  depth: 'depth',
  missed: 'missed, overlap',
  spurious: 'false, gap',
};

/** "normal 2.9°: block and floor, t = 0.25 s", a link to its drawing. */
function findingLink(context: Context, c: Case, auditor: string, found: ContactFinding): HTMLElement {
  const error = found.unit === 'rad' ? angle(found.error) : `${format(found.error)} m`;
  const time = found.step * context.dt;
  const text = `${kindWords[found.what]} ${error}: ${found.names.join(' and ')}, t = ${format(time)} s`;
  const contact = found.contact < 0 ? null : found.contact;
  const link = moment(context, c.spec, time, found.names, text, contact, findingKey(auditor, found.what));
  link.dataset.finding = found.what;
  return link;
}

/** A link to the drawing of the worst of each kind; to the moment alone in runs that did not keep the exact solution. */
function worstCell(context: Context, c: Case, a: Audit): HTMLElement {
  const place = worstPlace(a.worst);
  const old = () => {
    if (!place) return a.worst;
    const time = placeTime(place, context.dt);
    const text = `${place.what || 'worst'}: ${place.bodies.join(' and ')}, t = ${format(time)} s`;
    return moment(context, c.spec, time, place.bodies, text, place.contact);
  };
  const found = a.findings ?? [];
  const links = found.map((f) => el('div', null, findingLink(context, c, a.auditor, f)));
  const isNamed = found.some((f) => f.what === place?.what);
  return el('td', { class: 'small worst' }, isNamed ? null : old(), links);
}

const lengthCell = (value: Maybe) => numberCell(value, 'm');
/** The largest, and below it the median. */
function withMedian(worst: HTMLElement, median: Maybe, text: string): HTMLElement {
  if (median !== null) worst.append(el('span', { class: 'bound', 'data-median': full(median) }, `median ${text}`));
  return worst;
}

interface AuditColumn {
  head: string;
  cell: (a: Audit, c: Case, context: Context) => HTMLElement;
  text?: boolean; // else a number
}

const normals: AuditColumn['cell'] = (a) =>
  withMedian(angleCell(a.normalErrorMax), a.normalErrorMedian, angle(a.normalErrorMedian));
const depths: AuditColumn['cell'] = (a) =>
  withMedian(lengthCell(a.depthErrorMax), a.depthErrorMedian, format(a.depthErrorMedian));

const columns: AuditColumn[] = [
  { head: 'Worst', text: true, cell: (a, c, context) => worstCell(context, c, a) },
  { head: 'Missed', cell: (a) => count(a.missed, true) },
  { head: 'Spurious', cell: (a) => count(a.spurious, true) },
  { head: 'Normal, worst', cell: normals },
  { head: 'Depth, worst [m]', cell: depths },
  { head: 'Point, worst [m]', cell: (a) => lengthCell(a.pointErrorMax) },
  { head: 'Pairs', cell: (a) => count(a.queries) },
  { head: 'Overlap', cell: (a) => count(a.overlapping) },
  { head: 'Undecided', cell: (a) => count(a.undecided) },
  { head: 'Frames', cell: (a) => count(a.frames) },
];
const pairColumns: AuditColumn[] = [
  { head: 'Poses of', text: true, cell: (_, c) => el('td', null, labelOf(c.spec)) },
  { head: 'Pairs', cell: (a) => count(a.queries) },
  { head: 'Overlap for both', cell: (a) => count(a.overlapping) },
  { head: 'For the first alone', cell: (a) => count(a.spurious) },
  { head: 'For the second alone', cell: (a) => count(a.missed) },
  { head: 'Normals apart, worst', cell: normals },
  { head: 'Depths apart, worst [m]', cell: depths },
  { head: 'Worst', text: true, cell: (a, c, context) => worstCell(context, c, a) },
];

function rowOf(list: AuditColumn[], context: Context, c: Case, a: Audit): HTMLElement {
  const name = a.auditor === 'in_run' ? 'the run itself' : a.auditor.replace('|', ' and ');
  const ended = a.outcome === 'completed' ? '' : a.note ? `${a.outcome}: ${a.note}` : a.outcome;
  const cells = list.map(({ head, cell }) => {
    const node = cell(a, c, context);
    node.dataset.label = head;
    return node;
  });
  return el(
    'tr',
    { 'data-auditor': a.auditor, class: a.auditor === 'in_run' ? 'own' : null },
    el('th', { class: 'sticky', scope: 'row' }, name, ended ? el('span', { class: 'bound' }, ended) : null),
    cells,
  );
}

const tableOf = (list: AuditColumn[], bodies: HTMLElement[]): HTMLElement =>
  scroll(
    el(
      'table',
      { class: 'full stacked in-lines' },
      headRow(['Queried', ...list.map((column) => column.head)], (i) => i > 0 && !list[i - 1]?.text),
      bodies,
    ),
  );

export function caseAudit(context: Context): HTMLElement | null {
  const audited = context.cases.filter((c) => c.audit.length);
  if (audited.length === 0) return null;
  const isPair = (a: Audit) => a.auditor.includes('|');
  const bodies = audited.map((c) =>
    el(
      'tbody',
      null,
      el('tr', { class: 'sub' }, el('th', { colspan: columns.length + 1 }, `Poses of ${labelOf(c.spec)}`)),
      c.audit.filter((a) => !isPair(a)).map((a) => rowOf(columns, context, c, a)),
    ),
  );
  const pairs = audited.flatMap((c) => c.audit.filter(isPair).map((a) => rowOf(pairColumns, context, c, a)));
  return panel(
    'case-audit',
    'Contact audit',
    el(
      'p',
      { class: 'muted' },
      'Sampled poses of the run named in the grey rows: the contacts that the run itself acted upon, and every collision engine queried at the same poses, ',
      'against the exact oracle. A link under “Worst” opens that moment and draws the engine’s normal, the exact ones, the angle between them and the witness points. The metric ',
      metricName('normal_error'),
      ' is the worst over all points and frames, by closed forms alone; the columns here look at the deepest point of a pair in sampled frames.',
    ),
    tableOf(columns, bodies),
    pairs.length
      ? el(
          'details',
          { id: 'audit-pairs' },
          el('summary', null, 'Collision engines against each other'),
          el('p', { class: 'muted' }, 'Normals that are both among the exact ones count as the same.'),
          tableOf(pairColumns, [el('tbody', null, pairs)]),
        )
      : null,
  );
}
