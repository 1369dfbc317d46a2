// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results over all time steps of a scenario: order of convergence, error against cost, and engines compared in four
// labelled ways. Shown from three time steps on.
import { el } from '../../common/elements.ts';
import { duration, format, full, timeStep, toNumber, unitText, words } from '../../common/format.ts';
import type { Line } from '../charts/line.ts';
import { dropPlots } from '../charts/live_plots.ts';
import { plotCard } from '../charts/plot.ts';
import type { Case, Column, Fairness, Order, ScenarioData } from '../data.ts';
import { byClock, clockOf, columnOf, engineColour, type Group, labelOf, run } from '../run.ts';
import { durationCell, headRow, numberCell, panel, scroll, select, stepCell } from '../widgets.ts';
import type { Context } from './context.ts';

const modes: [mode: string, title: string, meaning: string][] = [
  ['engine_defaults', 'Engine defaults', 'as each engine ships, at the first time step'],
  ['matched_settings', 'Matched settings', 'the same law as nearly as each library allows, at the first time step'],
  ['equal_time', 'Equal time', 'the least error of each within the budget'],
  ['equal_accuracy', 'Equal accuracy', 'the cheapest run of each within the target'],
];

/** Wall time of all steps [s]; NaN where it was not measured. */
const steppingTime = (c: Case) => toNumber(c.timings.find((x) => x.phase === 'step')?.median) * c.steps;

/** Clock of a spec's times. */
const clockOfSpec = (spec: string): string => {
  const column = columnOf(spec);
  return column ? clockOf(column) : '';
};

/** A line per column with two points at least, over the time step or over the cost. */
function refinementLines(data: ScenarioData, metric: string, columns: readonly Column[], overCost: boolean): Line[] {
  return columns.flatMap((column) => {
    const points = data.cases
      .filter((c) => c.spec === column.spec)
      .map((c) => {
        const m = c.metrics.find((x) => x.name === metric && x.subject === '');
        return { x: overCost ? steppingTime(c) : c.dt, y: toNumber(m?.value), note: `dt ${timeStep(c.dt)}` };
      })
      .filter((p) => p.x > 0 && p.y > 0 && Number.isFinite(p.x + p.y))
      .sort((a, b) => a.x - b.x);
    if (points.length < 2) return [];
    const style = { colour: engineColour(column.engine), dash: column.dash, width: 1.5, points: true };
    const samples = { x: points.map((p) => p.x), y: points.map((p) => p.y), notes: points.map((p) => p.note) };
    return [{ key: column.spec, label: column.label, ...style, ...samples }];
  });
}

function ordersTable(orders: Order[]): HTMLElement {
  const fixed = (v: Order['order']) => (v === null ? '—' : toNumber(v).toFixed(2));
  const rows = orders.map((o) =>
    el(
      'tr',
      { 'data-spec': o.spec },
      el('th', { class: 'sticky', scope: 'row' }, labelOf(o.spec)),
      el('td', null, words(o.metric)),
      el('td', { class: 'num', 'data-value': full(o.order) }, fixed(o.order)),
      el('td', { class: 'num' }, o.low === null ? '—' : `${fixed(o.low)} … ${fixed(o.high)}`),
      el('td', { class: 'num' }, o.points),
      el('td', { class: 'num' }, o.points ? `${timeStep(o.coarsest)} … ${timeStep(o.finest)}` : ''),
      el('td', { class: 'small' }, o.note),
    ),
  );
  const heads = headRow(
    ['Engine', 'Metric', 'Order', '95 % interval', 'Points', 'Time steps', ''],
    (i) => i > 1 && i < 6,
  );
  return scroll(el('table', { id: 'orders' }, heads, el('tbody', null, rows)));
}

function fairnessTable(rows: Fairness[]): HTMLElement {
  const limit = (mode: string, row: Fairness) =>
    mode === 'equal_time'
      ? `, ${duration(row.limit)} of stepping`
      : mode === 'equal_accuracy'
        ? `, ${format(row.limit)}${unitText(row.unit)}`
        : '';
  const part = ([mode, title, meaning]: (typeof modes)[number]) => {
    const by = (r: Fairness) => toNumber(mode === 'equal_accuracy' ? r.cost : r.error);
    const of = rows.filter((r) => r.mode === mode).sort((a, b) => by(a) - by(b));
    // limits hold among times of the same clock
    const chosen = mode === 'equal_time' || mode === 'equal_accuracy';
    return byClock(of, (r) => (chosen ? clockOfSpec(r.spec) : '')).map((group) => body(mode, title, meaning, group));
  };
  const body = (mode: string, title: string, meaning: string, { clock, items: of }: Group<Fairness>) => {
    const whose = clock ? `, times of the clock “${clock}”` : '';
    const about = el('span', { class: 'muted small' }, ` — ${meaning}${limit(mode, of[0] as Fairness)}${whose}`);
    return el(
      'tbody',
      { 'data-mode': mode },
      el('tr', { class: 'sub' }, el('th', { colspan: 4 }, title, about)),
      of.map((r) =>
        el(
          'tr',
          null,
          el('th', { class: 'sticky', scope: 'row' }, r.competitor),
          numberCell(r.error, r.unit),
          durationCell(r.cost),
          stepCell(r.dt),
        ),
      ),
    );
  };
  const heads = headRow(['Engine', 'Error', 'Time of all steps', 'Time step'], (i) => i > 0);
  return scroll(el('table', { id: 'fairness' }, heads, modes.flatMap(part)));
}

export function refinement({ scenario, data, cursor }: Context): HTMLElement | null {
  if (data.orders.length === 0) return null;
  const names = [...new Set(data.orders.map((o) => o.metric))];
  const body = el('div');
  const draw = (metric: string) => {
    dropPlots(body);
    const orders = data.orders.filter((o) => o.metric === metric);
    const fairness = data.fairness.filter((f) => f.metric === metric);
    const axes: [title: string, xTitle: string, columns: readonly Column[], overCost: boolean][] = [
      ['Convergence: error over time step', 'time step [s]', run.columns, false],
      ...byClock(run.columns, clockOf).map(({ clock, items }): (typeof axes)[number] => [
        `Work and precision: error over time of all steps${clock ? `, of the clock “${clock}”` : ''}`,
        'wall time of all steps [s]',
        items,
        true,
      ]),
    ];
    const cards = axes.flatMap(([title, xTitle, columns, overCost]) => {
      const lines = refinementLines(data, metric, columns, overCost);
      if (lines.length === 0) return [];
      const yTitle = words(metric);
      const about = `${scenario.name}, ${yTitle}`;
      const axes = {
        about,
        yTitle,
        xTitle,
        xUnit: 's',
        unit: orders[0]?.unit ?? '',
        logX: true,
        logY: true,
        tall: true,
      };
      return [plotCard({ title, name: title, ...axes, lines: lines.filter((l) => !cursor.hidden.value.has(l.key)) })];
    });
    body.replaceChildren(
      el('div', { class: 'charts' }, cards),
      ordersTable(orders),
      el(
        'p',
        { class: 'muted small' },
        'The order is the slope of ln error on ln dt; a wide interval says that no single power of dt describes the refinement.',
      ),
      ...(fairness.length ? [el('h3', null, 'Compared in four ways'), fairnessTable(fairness)] : []),
    );
  };
  const metric = names.includes(scenario.main.name) ? scenario.main.name : (names[0] as string);
  draw(metric);
  cursor.hidden.follow(() => draw(chosen));
  let chosen = metric;
  const choose = (name: string) => {
    chosen = name;
    draw(name);
  };
  const choice =
    names.length > 1
      ? el(
          'div',
          { class: 'controls noprint' },
          select(
            'Metric',
            names.map((n) => [n, words(n)]),
            metric,
            choose,
          ),
        )
      : null;
  return panel('refinement', 'Convergence, and error against cost', choice, body);
}
