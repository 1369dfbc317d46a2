// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ranking of engines by purpose, with reasons: a card for each task, then every mechanism in a table.
import { type Child, el } from '../../common/elements.ts';
import { duration, ratio, toNumber } from '../../common/format.ts';
import { isLost } from '../cells.ts';
import type { Mechanism } from '../data.ts';
import { type Placed, placed, wrongIn } from '../ranking.ts';
import { dimensionNote, engineLink, run, scenarioLink, scenarioOf, verdictText } from '../run.ts';
import { folded, gradeBar, gradeChip, headRow, looseHeadRow, panel, scroll } from '../widgets.ts';
import { filterScoreboard } from './filters.ts';

const mostNamed = 4;

/** "E or lost in: a, b and 3 more", with links; null where there is none. */
export function wrongText(m: Mechanism, s: Placed): Child {
  const scenarios = m.scenarios.flatMap((name) => scenarioOf(name) ?? []);
  const wrong = wrongIn(scenarios, s.column);
  if (wrong.length === 0) return null;
  const link = ({ scenario, at }: (typeof wrong)[number], i: number): Child => [
    i ? ', ' : '',
    el('a', { href: scenarioLink(scenario.name, { spec: at.spec, dt: at.dt }), title: at.judged.says }, scenario.name),
    isLost(at.shown) ? ` (${verdictText(at.shown).word})` : '',
  ];
  return [
    'grade E or lost in ',
    wrong.slice(0, mostNamed).map(link),
    wrong.length > mostNamed ? ` and ${wrong.length - mostNamed} more` : '',
  ];
}

function line(m: Mechanism, s: Placed): HTMLElement[] {
  const wrong = wrongText(m, s);
  const row = el(
    'tr',
    { 'data-spec': s.column.spec },
    el('th', { scope: 'row' }, s.column.label),
    el('td', null, gradeBar(s.grades)),
    el('td', { class: 'num' }, ratio(s.toBest) || '—'),
    el('td', { class: 'num' }, ratio(s.toOurs) || '—'),
    el('td', { class: 'num' }, duration(s.cost)),
  );
  return wrong ? [row, el('tr', { class: 'why' }, el('td', { colspan: 5 }, wrong))] : [row];
}

/** The result in a sentence. */
function answer(m: Mechanism, list: Placed[]): Child {
  const best = list.find((s) => run.columns[m.best] === s.column);
  if (best === undefined) return el('p', { class: 'answer' }, 'No engine can be ranked here.');
  const error = Number.isFinite(toNumber(best.toBest)) ? `, typical error ${ratio(best.toBest)} the best one’s` : '';
  const cost = Number.isFinite(toNumber(best.cost)) ? `, ${duration(best.cost)} a step` : '';
  return el(
    'p',
    { class: 'answer' },
    'Nearest to the exact solutions: ',
    el('b', null, best.column.label),
    `, within a hundredth of the scene’s own scale in ${best.within} of ${best.scenarios - best.ungraded} that can be graded${error}${cost}.`,
  );
}

/** "In none of these: box2d (2D only)": engines that the table leaves out; null where it has all. */
function absentText(list: Placed[]): Child {
  const placedEngines = new Set(list.map((s) => s.column.engine));
  const absent = [...new Set(run.columns.map((c) => c.engine))].filter((name) => !placedEngines.has(name));
  if (absent.length === 0) return null;
  const names = absent.map((name) => name + (dimensionNote(name) ? ` (${dimensionNote(name)})` : ''));
  return el('p', { class: 'muted small', 'data-absent': absent.join(' ') }, `In none of these: ${names.join(', ')}.`);
}

function card(task: Mechanism): HTMLElement {
  const list = placed(task, run.columns);
  return el(
    'article',
    { class: 'task', 'data-task': task.name },
    el('h3', null, task.title),
    el('p', { class: 'muted small' }, task.about),
    answer(task, list),
    el(
      'table',
      { class: 'full ranking' },
      looseHeadRow(['Engine', 'Grades', '× best', '× ours', 'Step'], (i) => i > 1),
      el(
        'tbody',
        null,
        list.map((s) => line(task, s)),
      ),
    ),
    absentText(list),
    el(
      'button',
      { class: 'button noprint', onclick: () => filterScoreboard({ task: task.name }) },
      task.scenarios.length === 1 ? 'Show this scenario' : `Show these ${task.scenarios.length} scenarios`,
    ),
  );
}

function mechanismRow(m: Mechanism): HTMLElement {
  const filter = () => filterScoreboard({ mechanism: m.name });
  const list = placed(m, run.columns);
  const wrong = list.filter((s) => s.lost + (s.grades[4] ?? 0) > 0);
  const nameOf = (s: Placed) =>
    gradeChip(
      '',
      [s.column.label, ' ', el('b', null, `${s.within}/${s.scenarios}`), ' ', ratio(s.toBest)],
      `${s.column.label}: ${s.within} of ${s.scenarios} within a hundredth, error ${ratio(s.toBest) || 'unknown'} the best, ${ratio(s.toOurs) || 'unknown'} ours`,
    );
  return el(
    'tr',
    null,
    el('th', { scope: 'row' }, el('button', { class: 'tag', title: 'Show these scenarios', onclick: filter }, m.name)),
    el('td', { class: 'num', 'data-label': 'Scenarios' }, m.scenarios.length),
    el(
      'td',
      { 'data-label': 'Nearest first' },
      m.best >= 0 ? list.slice(0, mostNamed).map(nameOf) : el('span', { class: 'muted' }, 'no engine ranked'),
    ),
    el(
      'td',
      { 'data-label': 'Grade E or lost' },
      wrong
        .slice(0, mostNamed)
        .map((s) => gradeChip('E', `${s.column.label} ${s.lost + (s.grades[4] ?? 0)}/${s.scenarios}`)),
      wrong.length > mostNamed ? el('span', { class: 'small muted' }, `and ${wrong.length - mostNamed} more`) : null,
      wrong.length ? null : el('span', { class: 'muted' }, '—'),
    ),
  );
}

export function trust(): HTMLElement | null {
  if (run.mechanisms.length === 0) return null;
  const table = () =>
    el(
      'table',
      { class: 'full stacked' },
      headRow(['Mechanism', 'Scenarios', 'Nearest first', 'Grade E or lost'], (i) => i === 1),
      el('tbody', null, run.mechanisms.map(mechanismRow)),
    );
  return panel(
    'trust',
    'Which engine for what',
    el(
      'p',
      { class: 'muted' },
      'In the order of: fewest runs lost or of grade E, then most within a hundredth of the scenario’s own scale (grade C or better), then the smallest error, then the least time of a step, all at the same ',
      'time step; steps are timed in scenes that can be graded. “× best” is the typical error over the most accurate engine’s, “× ours” over that of ',
      run.inHouse,
      ' in the same preset; errors within grade A, or within what a scenario calls negligible, count as equal. An engine by itself: ',
      [...new Set(run.columns.map((c) => c.engine))].map((e, i) => [
        i ? ', ' : '',
        el('a', { href: engineLink(e) }, e),
      ]),
      '.',
    ),
    el('div', { class: 'tasks' }, run.tasks.map(card)),
    folded(`By mechanism: ${run.mechanisms.length} of them`, () => [
      el(
        'p',
        { class: 'muted small' },
        'Beside each engine: scenarios within a hundredth of their own scale, and the typical error over the best one’s.',
      ),
      scroll(table()),
    ]),
  );
}
