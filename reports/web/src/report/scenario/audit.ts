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
import { chip, headRow, numberCell, panel, scroll } from '../widgets.ts';
import { placeTime, worstPlace } from '../worst.ts';
import { type Context, moment } from './context.ts';

const count = (n: number, bad = false) => el('td', { class: 'num' }, bad && n ? chip('fail', n) : n);
const angleCell = (value: Maybe) =>
  el('td', { class: 'num', title: `${full(value)} rad`, 'data-value': full(value) }, angle(value));

const kindWords: Record<ContactFinding['what'], string> = {
  normal: 'normal',
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
  const old = () =>
    place ? moment(context, c.spec, placeTime(place, context.dt), place.bodies, a.worst, place.contact) : a.worst;
  const found = a.findings ?? [];
  const links = found.map((f) => el('div', null, findingLink(context, c, a.auditor, f)));
  const isNamed = found.some((f) => f.what === place?.what);
  return el('td', { class: 'small worst' }, isNamed ? null : old(), links);
}

function auditorRow(context: Context, c: Case, a: Audit): HTMLElement {
  const ended =
    a.outcome === 'completed' ? null : el('span', { class: 'bound' }, a.outcome, a.note ? `: ${a.note}` : '');
  return el(
    'tr',
    { 'data-auditor': a.auditor, class: a.auditor === 'in_run' ? 'own' : null },
    el('th', { class: 'sticky', scope: 'row' }, a.auditor === 'in_run' ? 'the run itself' : a.auditor, ended),
    worstCell(context, c, a),
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
  'Worst',
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
  'Worst',
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
      'against the exact oracle. A link under “Worst” opens that moment and draws the engine’s normal, the exact ones, the angle between them and the witness points.',
    ),
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(heads, (i) => i > 1),
        bodies,
      ),
    ),
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
