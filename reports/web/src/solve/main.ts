// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor solve`: of each contact problem the residual of the solvers over iterations and over time.
import '../report/style.css';
import '../report/board.css';
import '../report/charts.css';
import '../report/widths.css';
import { type Child, el } from '../common/elements.ts';
import { duration, format } from '../common/format.ts';
import { lineSample } from '../report/charts/line_sample.ts';
import { drawAllPlots } from '../report/charts/live_plots.ts';
import { plotCard } from '../report/charts/plot.ts';
import { themeButton } from '../report/theme.ts';
import type { SolveAnswer, SolveProblem } from './data.ts';
import { colourOf, dashOf, residualLine, solved } from './lines.ts';

const data = JSON.parse(document.getElementById('solve-data')?.textContent ?? '{}') as { problems: SolveProblem[] };
const least = 1e-16; // residuals below are shown there

function answerRow(answer: SolveAnswer): HTMLElement {
  const last = answer.steps.at(-1);
  const number = (v: Child) => el('td', { class: 'num' }, v);
  return el(
    'tr',
    { 'data-solver': answer.solver },
    el('th', { scope: 'row', class: 'sticky' }, answer.solver),
    el('td', null, answer.friction),
    number(last?.done ?? '—'),
    number(last ? format(last.residual) : '—'),
    number(last ? format(last.residual_own_model) : '—'),
    number(last ? `${format(last.penetration_velocity)} m/s` : '—'),
    number(last ? format(last.cone_violation) : '—'),
    number(last?.done ? duration(last.seconds) : '—'),
    el(
      'td',
      { class: 'small' },
      answer.outcome === 'solved' && !last?.gave_up
        ? ''
        : [answer.outcome, last?.gave_up ? ', gave up' : '', answer.message ? `: ${answer.message}` : ''],
    ),
  );
}

function problemNode(problem: SolveProblem, index: number): HTMLElement {
  const shown = solved(problem.answers);
  const name = problem.name ?? problem.file ?? `problem ${index + 1}`;
  const plot = (over: 'done' | 'seconds', xTitle: string, xUnit: string) =>
    plotCard({
      title: `Residual over ${over === 'done' ? 'iterations' : 'time'}`,
      name: `${name}: residual over ${over === 'done' ? 'iterations' : 'time'}`,
      yTitle: 'residual',
      unit: '1',
      xTitle,
      xUnit,
      lines: shown.map((a, i) => residualLine(a, i, over, least)),
      logX: true,
      logY: true,
      tall: true,
    });
  const key = shown.map((a, i) => el('span', null, lineSample(colourOf(i), dashOf(i), 2), a.solver));
  const heads = [
    'Solver',
    'Friction',
    'Iterations',
    'Residual',
    'of its own model',
    'Penetrating',
    'Out of the cone',
    'Time',
    '',
  ];
  const head = el(
    'tr',
    null,
    heads.map((h, i) => el(h ? 'th' : 'td', { scope: h ? 'col' : null, class: i > 1 && i < 8 ? 'num' : null }, h)),
  );
  const table = el(
    'table',
    { class: 'full' },
    el('thead', null, head),
    el('tbody', null, problem.answers.map(answerRow)),
  );
  const facts = [
    problem.contacts ? `${problem.contacts} contacts` : '',
    problem.velocities ? `${problem.velocities} velocities` : '',
  ];
  return el(
    'section',
    { class: 'panel problem' },
    el('h2', null, name, ' ', el('span', { class: 'muted small' }, facts.filter(Boolean).join(', '))),
    shown.length ? el('div', { class: 'lines' }, key) : null,
    shown.length
      ? el('div', { class: 'charts' }, plot('done', 'iterations', ''), plot('seconds', 'time [s]', 's'))
      : null,
    el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table, scrolls sideways' }, table),
  );
}

document
  .getElementById('top')
  ?.append(el('div', { class: 'bar' }, el('span', { class: 'brand' }, 'Rigor solve'), themeButton(drawAllPlots)));
const page = document.getElementById('page') as HTMLElement;
page.replaceChildren(
  el('h1', { class: 'read-aloud' }, 'Contact problems'),
  el(
    'p',
    { class: 'muted' },
    'The residual is that of the natural map with Coulomb’s cone, for all solvers alike, relative to the problem; beside it the same with the model of friction that the solver has. Both axes are logarithmic.',
  ),
  ...data.problems.map(problemNode),
);
page.dataset.shown = '1';
