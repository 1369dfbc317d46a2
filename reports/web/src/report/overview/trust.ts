// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Which engine for what, and why: a card for each thing that people simulate, then every mechanism in a table.
import { el } from '../../common/elements.ts';
import { duration, format, ratio, toNumber } from '../../common/format.ts';
import type { Mechanism, Standing } from '../data.ts';
import { chip, headRow, panel, scroll } from '../parts.ts';
import { engineLink, run, scenarioLink, verdictText } from '../run.ts';
import { ranked, type Summary, standings, within, worstMiss } from '../standing.ts';
import { belongs, type Task, tasks } from '../tasks.ts';
import { filterScoreboard } from './filters.ts';

/** Typical error where bounds are: in bounds; else against the best. */
function errorText(s: Summary): string {
  const parts = [];
  if (Number.isFinite(s.inBounds))
    parts.push(
      s.inBounds < 0.01 ? 'typical error under 1 % of the bound' : `typical error ${percent(s.inBounds)} of the bound`,
    );
  const against = ratio(s.ratio);
  if (against) parts.push(against === '×1' ? 'as accurate as the best' : `error ${against} the best one’s`);
  return parts.join(', ');
}
const percent = (v: number) => (v < 10 ? `${format(100 * v, 2)} %` : `×${format(v, 2)}`);

function why(s: Summary): string {
  const met = s.scenarios - s.bad.length - s.known;
  const passed = `${met === s.scenarios && met > 1 ? 'all' : met} of ${s.scenarios} within all bounds`;
  const known = s.known ? `, ${s.known} off as recorded` : '';
  const cost = Number.isFinite(s.cost) ? `${duration(s.cost)} a step` : '';
  return [passed + known, errorText(s), cost].filter(Boolean).join('; ');
}
const shownOf = (s: Summary) => (s.bad.length ? 'fail' : s.known ? 'known_deviation' : 'pass');

function poorLine(s: Summary): HTMLElement {
  const miss = worstMiss(s);
  const how =
    miss === null
      ? ''
      : miss.word !== 'fail'
        ? `: ${verdictText(miss.scenario.cases.find((c) => c.spec === s.column.spec && c.shown === miss.word)?.shown ?? 'fail').word} in `
        : Number.isFinite(miss.times)
          ? `: ${ratio(miss.times)} the bound in `
          : ': misses a bound in ';
  const link = miss
    ? el('a', { href: scenarioLink(miss.scenario.name, { spec: s.column.spec }) }, miss.scenario.name)
    : null;
  return el('li', null, chip('fail', s.column.label), `fails ${s.bad.length} of ${s.scenarios}`, how, link);
}

function card(task: Task): HTMLElement | null {
  const scenarios = run.scenarios.filter((s) => belongs(task, s));
  if (scenarios.length === 0) return null;
  const list = ranked(standings(scenarios, run.columns));
  const share = (s: Summary) => s.bad.length / Math.max(1, s.scenarios);
  const best = list.find((s) => Number.isFinite(s.ratio));
  if (best === undefined) return null;
  // Differences below five per cent are no reason to prefer one of them: then the cheaper one is named first.
  const first = list
    .filter((s) => share(s) === share(best) && within(s) === within(best) && s.ratio < 1.05 * best.ratio)
    .sort((a, b) => (a.cost || Infinity) - (b.cost || Infinity));
  const next = list.filter((s) => !first.includes(s) && s.bad.length === 0 && Number.isFinite(s.ratio)).slice(0, 3);
  const poor = list.filter((s) => s.bad.length > 0 && !first.includes(s)).sort((a, b) => share(b) - share(a));
  return el(
    'article',
    { class: 'task', 'data-task': task.key },
    el('h3', null, task.title),
    el('p', { class: 'muted small' }, task.about),
    el('div', { class: 'muted small' }, best.bad.length ? 'Fewest failures' : 'Trust first'),
    el(
      'ul',
      { class: 'plain' },
      first.slice(0, 3).map((s) => el('li', null, chip(shownOf(s), el('b', null, s.column.label)), why(s))),
      first.length > 3
        ? el(
            'li',
            { class: 'small muted' },
            `and ${first
              .slice(3)
              .map((s) => s.column.label)
              .join(', ')}`,
          )
        : null,
    ),
    next.length
      ? [
          el('div', { class: 'muted small' }, 'Also without failure'),
          el(
            'ul',
            { class: 'plain' },
            next.map((s) => el('li', null, chip(shownOf(s), s.column.label), why(s))),
          ),
        ]
      : null,
    poor.length
      ? [
          el('div', { class: 'muted small' }, 'Be careful with'),
          el('ul', { class: 'plain' }, poor.slice(0, 3).map(poorLine)),
          poor.length > 3
            ? el(
                'p',
                { class: 'small muted' },
                `and ${poor
                  .slice(3)
                  .map((s) => `${s.column.label} (${s.bad.length})`)
                  .join(', ')}`,
              )
            : null,
        ]
      : null,
    el(
      'button',
      { class: 'button noprint', onclick: () => filterScoreboard({ task: task.key }) },
      scenarios.length === 1 ? 'Show this scenario' : `Show these ${scenarios.length} scenarios`,
    ),
  );
}

interface Placed extends Standing {
  label: string;
  index: number;
}
const share = (s: Placed) => s.bad / Math.max(1, s.scenarios);

function mechanismRow(m: Mechanism): HTMLElement {
  const all = m.standings.map((s, index): Placed => ({ ...s, label: run.columns[index]?.label ?? '', index }));
  const list = all.filter((s) => s.ran > 0);
  list.sort((a, b) => share(a) - share(b) || toNumber(a.ratio) - toNumber(b.ratio));
  const best = list.find((s) => s.index === m.best);
  const equal = (s: Placed) =>
    best !== undefined && share(s) === share(best) && toNumber(s.ratio) < 1.05 * toNumber(best.ratio);
  const first = best ? list.filter((s) => s === best || equal(s)) : [];
  const close = list.filter((s) => !first.includes(s) && s.bad === 0 && Number.isFinite(toNumber(s.ratio))).slice(0, 3);
  const poor = all.filter((s) => s.bad > 0).sort((a, b) => share(b) - share(a) || b.bad - a.bad);
  const title = (s: Placed) =>
    `${s.label}: ${s.good} of ${s.scenarios} scenarios without a failure; typical error ${ratio(s.ratio) || 'unknown'} of the best`;
  const none = (text: string) => el('span', { class: 'muted' }, text);
  const filter = () => filterScoreboard({ mechanism: m.name });
  return el(
    'tr',
    null,
    el('th', { scope: 'row' }, el('button', { class: 'tag', title: 'Show these scenarios', onclick: filter }, m.name)),
    el('td', { class: 'num', 'data-label': 'Scenarios' }, m.scenarios.length),
    el(
      'td',
      { 'data-label': 'Trust first' },
      first.length
        ? first.map((s) =>
            chip(
              s.bad ? 'fail' : 'pass',
              s.bad ? `${s.label}, fails in ${s.bad} of ${s.scenarios}` : s.label,
              title(s),
            ),
          )
        : none('nobody ranked'),
    ),
    el(
      'td',
      { 'data-label': 'Also without failure' },
      close.length
        ? close.map((s) =>
            el('span', { class: 'chip v', title: title(s) }, s.label, ' ', el('b', null, ratio(s.ratio))),
          )
        : none('—'),
    ),
    el(
      'td',
      { 'data-label': 'Fails' },
      poor.slice(0, 4).map((s) => chip('fail', `${s.label} ${s.bad}/${s.scenarios}`, title(s))),
      poor.length > 4 ? el('span', { class: 'small muted' }, `and ${poor.length - 4} more`) : null,
      poor.length ? null : none('—'),
    ),
  );
}

export function trust(): HTMLElement | null {
  if (run.mechanisms.length === 0) return null;
  const cards = tasks.map(card).filter((c) => c !== null);
  const table = el(
    'table',
    { class: 'full trust' },
    headRow(['Mechanism', 'Scenarios', 'Trust first', 'Also without failure', 'Fails'], (i) => i === 1),
    el('tbody', null, run.mechanisms.map(mechanismRow)),
  );
  return panel(
    'trust',
    'Which engine for what',
    el(
      'p',
      { class: 'muted' },
      'Fewest failures first, then most scenarios within all their bounds, then the smallest error at the same time step; several where they ',
      'agree within 5 %. A failure is a missed bound, crash, timeout or NaN; off as recorded: a bound is missed, as known and explained. Errors under 1e-6 (single-precision rounding) count as equal; ',
      'scenarios without a reference rank nobody. What is known of an engine over all scenarios: ',
      [...new Set(run.columns.map((c) => c.engine))].map((e, i) => [
        i ? ', ' : '',
        el('a', { href: engineLink(e) }, e),
      ]),
      '.',
    ),
    el('div', { class: 'tasks' }, cards),
    el(
      'details',
      { open: cards.length === 0 },
      el('summary', null, `By mechanism: ${run.mechanisms.length} of them`),
      el('p', { class: 'muted small' }, '×n is the typical error relative to the most accurate engine.'),
      scroll(table),
    ),
  );
}
