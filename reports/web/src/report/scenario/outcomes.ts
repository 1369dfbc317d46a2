// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type Child, el } from '../../common/elements.ts';
import { format, inShownUnit, type Maybe, ratio, toNumber, unitText, words } from '../../common/format.ts';
import type { Case, Metric } from '../data.ts';
import { labelOf, run } from '../run.ts';
import { changeMark, chip, gradeChip, headRow, panel, scroll } from '../widgets.ts';
import { type Context, moment } from './context.ts';
import { standingText } from './standing.ts';

const most = 6; // metrics of one case

/** Settings that the engine does not have as the scenario requests them, of a run that is far off without a known reason. */
function inexactText(c: Case): Child {
  if (!['D', 'E'].includes(c.judged.grade) || c.shown === 'known_deviation') return null;
  const inexact = c.ledger.filter((line) => line.realisation !== 'exact');
  if (inexact.length === 0) return null;
  const topic = ({ topic, resolved, reason }: (typeof inexact)[number], i: number): Child => [
    i ? ', ' : '',
    el('abbr', { class: 'term', title: `${resolved}${reason ? `: ${reason}` : ''}` }, words(topic)),
  ];
  return el('div', { class: 'muted', 'data-inexact': '' }, 'Not as requested in its ledger: ', inexact.map(topic));
}

/** Statements about every run, on accuracy and on the record, and its error compared with the others'. */
export function verdicts(context: Context): HTMLElement | null {
  const ran = context.cases.filter((c) => c.shown !== 'unsupported');
  if (ran.length === 0) return null;
  const { scenario, data } = context;
  const standing = (c: Case) => {
    const text = standingText(c, scenario.metrics, scenario.duration, data.text);
    return text ? el('div', { class: 'small standing' }, text) : null;
  };
  const row = (c: Case) =>
    el(
      'tr',
      { class: c.spec === context.spec ? 'focus' : null, 'data-spec': c.spec },
      el('th', { class: 'sticky', scope: 'row' }, labelOf(c.spec)),
      el('td', { 'data-label': 'Accuracy' }, gradeChip(c.judged.grade)),
      el(
        'td',
        { class: 'small claim' },
        c.judged.says,
        c.judged.orders ? el('div', null, c.judged.orders.says) : null,
        inexactText(c),
      ),
      el('td', { class: 'num', 'data-label': '× best' }, ratio(c.judged.toBest) || '—'),
      el('td', { class: 'num', 'data-label': '× ours' }, ratio(c.judged.toOurs) || '—'),
      el(
        'td',
        { class: 'small claim', 'data-label': 'Against the record' },
        changeMark(c.judged.regression),
        ' ',
        c.judged.change || '—',
      ),
      el('td', { 'data-label': 'Ending' }, chip(c.shown), standing(c)),
    );
  const heads = headRow(
    ['Engine', 'Accuracy', 'What is claimed', '× best', '× ours', 'Against the record', 'Ending'],
    (i) => i === 3 || i === 4,
  );
  const about = [
    'Three questions that are never mixed. Accuracy: how near is it to the physics? The error over the scenario’s own scale, also over the best engine’s and over ',
    `${run.inHouse}’s in the same preset. Record: did it change against this version’s? Ending: did it run, and keep the bounds that hold everywhere or that its scenario sets? A run that keeps its bounds may be far from the physics, and its grade says so.`,
  ];
  return panel(
    'verdicts',
    'Verdicts',
    el('p', { class: 'muted small' }, about),
    scroll(el('table', { class: 'full stacked' }, heads, el('tbody', null, ran.map(row)))),
  );
}

/** Runs that did not complete or have wrong physics, with the reason and the moment of the worst error. */
export function outcomes(context: Context): HTMLElement | null {
  const odd = context.cases.filter((c) => !['pass', 'no_bound', 'unsupported'].includes(c.shown));
  const unable = context.cases.filter((c) => c.shown === 'unsupported');
  if (odd.length + unable.length === 0) return null;
  const limits = (m: Metric): string => {
    const shown = (value: Maybe) => format(inShownUnit(value, m.unit));
    return m.boundMin == null ? `a bound of ${shown(m.bound)}` : `bounds of ${shown(m.boundMin)} to ${shown(m.bound)}`;
  };
  const said = (c: Case, m: Metric): Child => {
    const at = toNumber(m.at);
    return [
      `${words(m.name)}${m.subject ? ` of ${m.subject}` : ''} ${format(inShownUnit(m.value, m.unit))}${unitText(m.unit)}`,
      m.bound === null ? '' : ` against ${limits(m)}${unitText(m.unit)}`,
      at >= 0 ? [' (worst ', moment(context, c.spec, at, bodiesOf(m.subject), `at t = ${format(at)} s`), ')'] : null,
    ];
  };
  /** Metrics with one reason are one line: the reason, then what it explains. */
  const lines = (c: Case, list: Metric[]): Child[] =>
    [...new Set(list.map((m) => m.note))].map((note) =>
      el(
        'div',
        null,
        note ? `${note}: ` : '',
        list.filter((m) => m.note === note).map((m, i) => [i ? ', ' : '', said(c, m)]),
      ),
    );
  const why = (c: Case): Child => {
    const missed = c.metrics.filter((m) => m.verdict !== 'pass');
    const whole = missed.filter((m) => !m.subject);
    const shown = (whole.length ? whole : missed).slice(0, most);
    const isShown = shown.some((m) => m.note && c.reason.endsWith(m.note));
    return [c.reason && !isShown ? el('div', null, c.reason) : null, lines(c, shown)];
  };
  const rows = odd.map((c) =>
    el(
      'tr',
      { class: c.spec === context.spec ? 'focus' : null },
      el('th', { scope: 'row' }, labelOf(c.spec)),
      el('td', null, chip(c.shown)),
      el('td', null, why(c)),
    ),
  );
  const reasons = [...new Set(unable.map((c) => c.reason))].map((reason) => {
    const labels = unable.filter((c) => c.reason === reason).map((c) => labelOf(c.spec));
    return el('p', null, chip('unsupported', `unsupported by ${labels.join(', ')}`), reason);
  });
  const table = rows.length ? scroll(el('table', { class: 'full' }, el('tbody', null, rows))) : null;
  return panel('outcomes', 'Wrong physics, bounds missed, and what did not run', reasons, table);
}

/** Bodies that a subject speaks of: "block", "block|floor"; a joint's or quantity's name is none, and does no harm. */
export const bodiesOf = (subject: string): string[] => (subject ? subject.split('|') : []);
