// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Cases that were run in several orders of insertion: which results are the order's as much as the engine's.
import { type Child, el } from '../../common/elements.ts';
import { format, full, shownUnit, timeStep, toNumber, words } from '../../common/format.ts';
import type { OrderDependent } from '../data.ts';
import { labelOf, run, scenarioLink } from '../run.ts';
import { gradeChip, headRow, numberCell, panel, scroll } from '../widgets.ts';

/** Position of the value as written between least and greatest. */
function strip(d: OrderDependent): Child {
  const [least, greatest, value] = [d.least, d.greatest, d.value].map(toNumber) as [number, number, number];
  const place = (value - least) / (greatest - least);
  if (!Number.isFinite(place)) return null;
  const where = `${(100 * Math.min(1, Math.max(0, place))).toFixed(0)}%`;
  const text = `as written ${format(d.value)}, least ${format(d.least)}, greatest ${format(d.greatest)}`;
  return el('span', { class: 'range', role: 'img', 'aria-label': text, style: `--at:${where}` });
}

function row(d: OrderDependent): HTMLElement {
  const grades = d.best === d.worst ? [gradeChip(d.grade)] : [gradeChip(d.best), ' … ', gradeChip(d.worst)];
  return el(
    'tr',
    { 'data-scenario': d.scenario, 'data-spec': d.spec },
    el(
      'th',
      { class: 'sticky', scope: 'row' },
      el('a', { href: scenarioLink(d.scenario, { spec: d.spec, dt: d.dt }) }, d.scenario),
    ),
    el('td', null, labelOf(d.spec)),
    el('td', { class: 'num' }, timeStep(d.dt)),
    el('td', null, d.metric ? `${words(d.metric)}${d.unit && d.unit !== '1' ? ` [${shownUnit(d.unit)}]` : ''}` : '—'),
    numberCell(d.metric ? d.value : null, d.unit),
    el(
      'td',
      { class: 'num', title: `${full(d.least)} … ${full(d.greatest)} ${d.unit}` },
      d.metric ? `${format(d.least)} … ${format(d.greatest)}` : '—',
      strip(d),
    ),
    el('td', null, grades),
    el('td', null, `${d.dependence === 'verdict' ? '⇅' : '↕'} ${d.dependence}`),
    el(
      'td',
      { class: 'small' },
      d.completed < d.run ? `${d.completed} of ${d.run} orders completed. ` : '',
      d.verdicts ? `${d.verdicts}. ` : '',
      d.note,
    ),
  );
}

export function insertionOrders(): HTMLElement | null {
  const found = run.insertionOrders;
  if (!found) return null;
  const heads = headRow(
    ['Scenario', 'Engine', 'Time step', 'What varies most', 'As written', 'Over the orders', 'Grade', 'Depends', ''],
    (i) => i === 2 || i === 4 || i === 5,
  );
  return panel(
    'insertion-orders',
    'Order of insertion',
    el(
      'p',
      { class: 'muted' },
      'The same scene is handed to every engine several times, with its bodies, shapes, joints and forces in other orders, and physics is the same in each. ',
      'Where the numbers are not, a single run shows one draw out of a range: both ends are here. All other tables have the order as written in the scenario. ',
      'What differs by rounding alone (up to 1e-6 of the scene’s own scale) does not count.',
    ),
    el('p', null, el('b', null, found.heading), '.'),
    found.rows.length ? scroll(el('table', { class: 'full' }, heads, el('tbody', null, found.rows.map(row)))) : null,
  );
}
