// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Which engine for what, and why: a card for each thing that people simulate, then every mechanism in a table.
import { type Child, el } from '../../common/elements.ts';
import { duration, format, ratio, toNumber, words } from '../../common/format.ts';
import { isLost } from '../cells.ts';
import type { Mechanism, Standing } from '../data.ts';
import { chip, folded, headRow, looseHeadRow, panel, scroll } from '../parts.ts';
import { engineLink, run, scenarioLink, verdictText } from '../run.ts';
import { ranked, type Summary, standings, within, worstMiss } from '../standing.ts';
import { belongs, type Task, tasks } from '../tasks.ts';
import { filterScoreboard } from './filters.ts';

/** "worst: coulomb residual ×10 its bound in slide_and_stop", with a link to that moment. */
export function missText(s: Summary): Child {
  const miss = worstMiss(s);
  if (miss === null) return null;
  const { scenario, at, times } = miss;
  const t = toNumber(at.miss?.at);
  const pair = at.miss?.subject ?? '';
  const href = scenarioLink(scenario.name, { spec: at.spec, dt: at.dt, t: t >= 0 ? t : null, pair });
  const what = isLost(at.shown)
    ? verdictText(at.shown).word
    : `${words(at.miss?.name ?? '')} ${ratio(times)} its bound`;
  return ['worst: ', what, ' in ', el('a', { href }, scenario.name)];
}

const shownOf = (s: Summary) => (s.bad.length ? 'fail' : s.known.length ? 'known_deviation' : 'pass');
const percent = (v: number) => (v < 0.01 ? '< 1 %' : v < 10 ? `${format(100 * v, 2)} %` : `×${format(v, 2)}`);

function line(s: Summary): HTMLElement[] {
  const met = s.scenarios - s.bad.length - s.known.length;
  const miss = missText(s);
  const row = el(
    'tr',
    { 'data-spec': s.column.spec },
    el('th', { scope: 'row' }, chip(shownOf(s), s.column.label)),
    el('td', { class: 'num' }, `${met} of ${s.scenarios}`),
    el('td', { class: 'num' }, Number.isFinite(s.inBounds) ? percent(s.inBounds) : '—'),
    el('td', { class: 'num' }, ratio(s.ratio) || '—'),
    el('td', { class: 'num' }, duration(s.cost)),
  );
  return miss ? [row, el('tr', { class: 'why' }, el('td', { colspan: 5 }, miss))] : [row];
}

/** The answer in a sentence. */
function answer(first: Summary[], total: number): Child {
  const [best] = first;
  if (best === undefined) return null;
  const met = best.scenarios - best.bad.length - best.known.length;
  const share =
    met === total ? `within all bounds in all ${total}` : `within all bounds in ${met} of ${best.scenarios}`;
  const others =
    first.length > 1
      ? `, as well as ${first
          .slice(1)
          .map((s) => s.column.label)
          .join(', ')}`
      : '';
  const error = Number.isFinite(best.inBounds) ? `, typical error ${percent(best.inBounds)} of the bound` : '';
  const cost = Number.isFinite(best.cost) ? `, ${duration(best.cost)} a step` : '';
  return el('p', { class: 'answer' }, 'Trust ', el('b', null, best.column.label), others, `: ${share}${error}${cost}.`);
}

function card(task: Task): HTMLElement | null {
  const scenarios = run.scenarios.filter((s) => belongs(task, s));
  if (scenarios.length === 0) return null;
  const list = ranked(standings(scenarios, run.columns));
  const share = (s: Summary) => s.bad.length / Math.max(1, s.scenarios);
  const best = list.find((s) => Number.isFinite(s.ratio));
  if (best === undefined) return null;
  const most = Math.max(...list.map((s) => s.scenarios));
  // Differences below five per cent are no reason to prefer one of them: then the cheaper one is named first.
  const equal = (s: Summary) =>
    2 * s.scenarios >= most && share(s) === share(best) && within(s) === within(best) && s.ratio < 1.05 * best.ratio;
  const first = list.filter(equal).sort((a, b) => (a.cost || Infinity) - (b.cost || Infinity));
  const rest = list.filter((s) => !first.includes(s));
  const heads = ['Engine', 'In bounds', 'Error / bound', '× best', 'Step'];
  return el(
    'article',
    { class: 'task', 'data-task': task.key },
    el('h3', null, task.title),
    el('p', { class: 'muted small' }, task.about),
    answer(first, scenarios.length),
    el(
      'table',
      { class: 'full ranking' },
      looseHeadRow(heads, (i) => i > 0),
      el('tbody', null, [...first, ...rest].map(line)),
    ),
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
  const table = () =>
    el(
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
      'Best first: fewest failures, then most scenarios within all their bounds, then the smallest error at the same time step; differences below 5 % ',
      'or below single-precision rounding (1e-6) count as none. △ is off as recorded and explained, ✗ a missed bound, crash, timeout or NaN. “Error/bound” ',
      'is the median of the main error over its bound, “× best” the typical error relative to the most accurate engine. An engine by itself: ',
      [...new Set(run.columns.map((c) => c.engine))].map((e, i) => [
        i ? ', ' : '',
        el('a', { href: engineLink(e) }, e),
      ]),
      '.',
    ),
    el('div', { class: 'tasks' }, cards),
    folded(`By mechanism: ${run.mechanisms.length} of them`, () => [
      el('p', { class: 'muted small' }, '×n is the typical error relative to the most accurate engine.'),
      scroll(table()),
    ]),
  );
}
