// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts of the runs, and of all collision engines at the same poses, against the exact oracle. The worst place of a
// row is a link to its moment.
import { type Child, el } from '../../common/elements.ts';
import { angle, full, type Maybe } from '../../common/format.ts';
import type { Audit, Case } from '../data.ts';
import { labelOf } from '../run.ts';
import { chip, headRow, numberCell, panel, scroll } from '../widgets.ts';
import { placeTime, worstPlace } from '../worst.ts';
import { type Context, moment } from './context.ts';

const count = (n: number, bad = false) => el('td', { class: 'num' }, bad && n ? chip('fail', n) : n);
const angleCell = (value: Maybe) =>
  el('td', { class: 'num', title: `${full(value)} rad`, 'data-value': full(value) }, angle(value));

function worstCell(context: Context, c: Case, a: Audit): Child {
  const place = worstPlace(a.worst);
  return el(
    'td',
    { class: 'small' },
    place ? moment(context, c.spec, placeTime(place, context.dt), place.bodies, a.worst, place.contact) : a.worst,
  );
}

function auditorRow(context: Context, c: Case, a: Audit): HTMLElement {
  const ended =
    a.outcome === 'completed' ? null : el('span', { class: 'bound' }, a.outcome, a.note ? `: ${a.note}` : '');
  return el(
    'tr',
    { 'data-auditor': a.auditor, class: a.auditor === 'in_run' ? 'own' : null },
    el('th', { class: 'sticky', scope: 'row' }, a.auditor === 'in_run' ? 'the run itself' : a.auditor, ended),
    count(a.frames),
    count(a.queries),
    count(a.overlapping),
    count(a.missed, true),
    count(a.spurious, true),
    count(a.undecided),
    angleCell(a.normalErrorMax),
    angleCell(a.normalErrorMedian),
    numberCell(a.depthErrorMax, 'm'),
    numberCell(a.depthErrorMedian, 'm'),
    numberCell(a.pointErrorMax, 'm'),
    worstCell(context, c, a),
  );
}

function pairRow(context: Context, c: Case, a: Audit): HTMLElement {
  return el(
    'tr',
    null,
    el('th', { class: 'sticky', scope: 'row' }, a.auditor.replace('|', ' and ')),
    el('td', null, labelOf(c.spec)),
    count(a.queries),
    count(a.overlapping),
    count(a.spurious),
    count(a.missed),
    angleCell(a.normalErrorMax),
    angleCell(a.normalErrorMedian),
    numberCell(a.depthErrorMax, 'm'),
    numberCell(a.depthErrorMedian, 'm'),
    worstCell(context, c, a),
  );
}

const heads = [
  'Queried',
  'Frames',
  'Pairs',
  'Overlap',
  'Missed',
  'Spurious',
  'Undecided',
  'Normal, worst',
  'median',
  'Depth, worst [m]',
  'median [m]',
  'Point, worst [m]',
  'Worst at',
];
const pairHeads = [
  'Queried',
  'Poses of',
  'Pairs',
  'Overlap for both',
  'For the first alone',
  'For the second alone',
  'Normals apart, worst',
  'median',
  'Depths apart, worst [m]',
  'median [m]',
  'Worst at',
];

export function caseAudit(context: Context): HTMLElement | null {
  const audited = context.cases.filter((c) => c.audit.length);
  if (audited.length === 0) return null;
  const isPair = (a: Audit) => a.auditor.includes('|');
  const bodies = audited.map((c) =>
    el(
      'tbody',
      null,
      el('tr', { class: 'sub' }, el('th', { colspan: heads.length }, `Poses of ${labelOf(c.spec)}`)),
      c.audit.filter((a) => !isPair(a)).map((a) => auditorRow(context, c, a)),
    ),
  );
  const pairs = audited.flatMap((c) => c.audit.filter(isPair).map((a) => pairRow(context, c, a)));
  const last = (list: string[]) => (i: number) => i > 0 && i < list.length - 1;
  return panel(
    'case-audit',
    'Contact audit',
    el(
      'p',
      { class: 'muted' },
      'Sampled poses of the run named in the grey rows: the contacts that the run itself acted upon, and every collision engine queried at the same poses, ',
      'against the exact oracle. “Worst at” shows that moment.',
    ),
    scroll(el('table', { class: 'full' }, headRow(heads, last(heads)), bodies)),
    pairs.length
      ? el(
          'details',
          { id: 'audit-pairs' },
          el('summary', null, 'Collision engines against each other'),
          el('p', { class: 'muted' }, 'Normals that are both among the exact ones count as the same.'),
          scroll(el('table', { class: 'full' }, headRow(pairHeads, last(pairHeads)), el('tbody', null, pairs))),
        )
      : null,
  );
}
