// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Ranking of engines by purpose, with reasons: a card for each task, then every mechanism in a table.
import { type Child, el } from '../../common/elements.ts';
import { duration, ratio, toNumber } from '../../common/format.ts';
import { isLost } from '../cells.ts';
import type { Mechanism } from '../data.ts';
import { gradable, type Placed, placed, placedEngines, worstPresets, wrongCount, wrongIn } from '../ranking.ts';
import { dimensionNote, engineLink, run, scenarioLink, scenarioOf, verdictText } from '../run.ts';
import { folded, gradeBar, gradeChip, headRow, looseHeadRow, panel, scroll } from '../widgets.ts';
import { filterScoreboard } from './filters.ts';

const mostNamed = 4;
const mostNext = 2; // engines after the first in the sentences of a task

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

/**
 * Median of a step in the scenarios that can be graded, in all where none can; "—" where an engine has none of these. It names their
 * number where other engines were timed in more.
 */
function stepText(s: Placed, most: number): Child {
  if (s.timed === 0) return '—';
  return [duration(s.cost), s.timed < most ? el('span', { class: 'sub' }, `in ${s.timed} of ${most}`) : null];
}

function line(m: Mechanism, s: Placed, mostTimed: number): HTMLElement[] {
  const wrong = wrongText(m, s);
  const row = el(
    'tr',
    { 'data-spec': s.column.spec },
    el('th', { scope: 'row' }, s.column.label),
    el('td', null, gradeBar(s.grades)),
    el('td', { class: 'num' }, ratio(s.toBest) || '—'),
    el('td', { class: 'num' }, ratio(s.toOurs) || '—'),
    el('td', { class: 'num' }, stepText(s, mostTimed)),
  );
  return wrong ? [row, el('tr', { class: 'why' }, el('td', { colspan: 5 }, wrong))] : [row];
}

/** The result in sentences: the first engine, and those that follow, each by its best preset. */
function answer(m: Mechanism): Child {
  const [best, ...others] = m.best >= 0 ? placedEngines(m, run.columns) : [];
  if (best === undefined) return el('p', { class: 'answer' }, 'No engine can be ranked here.');
  const error = Number.isFinite(toNumber(best.toBest)) ? `, typical error ${ratio(best.toBest)} the best one’s` : '';
  const cost = Number.isFinite(toNumber(best.cost)) ? `, ${duration(best.cost)} a step` : '';
  const next = others.slice(0, mostNext);
  return el(
    'p',
    { class: 'answer' },
    'First: ',
    el('b', null, best.column.label),
    `, within a hundredth of the scene’s own scale in ${best.within} of ${gradable(best)} that can be graded${error}${cost}.`,
    next.length ? ` Next, each engine by its best preset: ${next.map((s) => s.column.label).join(', ')}.` : '',
  );
}

/** "In none of these: box2d (2D only)": engines that the table leaves out; null where it has all. */
function absentText(list: Placed[]): Child {
  const present = new Set(list.map((s) => s.column.engine));
  const absent = [...new Set(run.columns.map((c) => c.engine))].filter((name) => !present.has(name));
  if (absent.length === 0) return null;
  const names = absent.map((name) => name + (dimensionNote(name) ? ` (${dimensionNote(name)})` : ''));
  return el('p', { class: 'muted small', 'data-absent': absent.join(' ') }, `In none of these: ${names.join(', ')}.`);
}

function card(task: Mechanism): HTMLElement {
  const list = placed(task, run.columns);
  const mostTimed = Math.max(...list.map((s) => s.timed));
  return el(
    'article',
    { class: 'task', 'data-task': task.name },
    el('h3', null, task.title),
    el('p', { class: 'muted small' }, task.about),
    answer(task),
    el(
      'table',
      { class: 'full ranking' },
      looseHeadRow(['Engine', 'Grades', '× best', '× ours', 'Step'], (i) => i > 1),
      el(
        'tbody',
        null,
        list.map((s) => line(task, s, mostTimed)),
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

const bestHead = 'First choices, each engine by its best preset';
const worstHead = 'Grade E or lost, each engine by its worst preset';

function mechanismRow(m: Mechanism): HTMLElement {
  const filter = () => filterScoreboard({ mechanism: m.name });
  const list = placedEngines(m, run.columns);
  const wrong = worstPresets(placed(m, run.columns));
  const nameOf = (s: Placed) =>
    gradeChip(
      '',
      [s.column.label, ' ', el('b', null, `${s.within}/${gradable(s)}`), ' ', ratio(s.toBest)],
      `${s.column.label}: ${s.within} of ${gradable(s)} that can be graded within a hundredth, error ${ratio(s.toBest) || 'unknown'} the best, ${ratio(s.toOurs) || 'unknown'} ours`,
    );
  return el(
    'tr',
    null,
    el('th', { scope: 'row' }, el('button', { class: 'tag', title: 'Show these scenarios', onclick: filter }, m.name)),
    el('td', { class: 'num', 'data-label': 'Scenarios' }, m.scenarios.length),
    el(
      'td',
      { 'data-label': bestHead },
      m.best >= 0 ? list.slice(0, mostNamed).map(nameOf) : el('span', { class: 'muted' }, 'no engine ranked'),
    ),
    el(
      'td',
      { 'data-label': worstHead },
      wrong.slice(0, mostNamed).map((s) => gradeChip('E', `${s.column.label} ${wrongCount(s)}/${s.scenarios}`)),
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
      headRow(['Mechanism', 'Scenarios', bestHead, worstHead], (i) => i === 1),
      el('tbody', null, run.mechanisms.map(mechanismRow)),
    );
  return panel(
    'trust',
    'Which engine for what',
    el(
      'p',
      { class: 'muted' },
      'In this order: engines that completed at least half as many scenarios as the one that completed most, and have an error to compare; among them, and among the others after them, those with the smallest share of scenarios lost or of grade E, then ',
      'with the largest share of those that can be graded within a hundredth of the scenario’s own scale (grade C or better), then with the smallest “× best”, then with the least time of a step by the same clock. ',
      'All is at the finest time step that any engine completed; lost is what was lost at any. Steps are timed in scenes that can be graded, in all where none can. “× best” is the typical error over the most accurate engine’s, “× ours” over that of ',
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
        'Beside each engine: scenarios within a hundredth of their own scale of those that can be graded, and the typical error over the best one’s.',
      ),
      scroll(table()),
    ]),
  );
}
