// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Timing: how the cost of a step grows with the scene, cost against accuracy, phases; the machine beside it.
import { el } from '../../common/elements.ts';
import { duration, format, type Maybe, median, ratio, toNumber } from '../../common/format.ts';
import { cellOf, costOf, relativeOf } from '../cells.ts';
import { barList } from '../charts/bars.ts';
import type { Line } from '../charts/line.ts';
import { plotCard } from '../charts/plot.ts';
import type { Column, Step } from '../data.ts';
import { placed } from '../ranking.ts';
import { byClock, clockOf, engineColour, run } from '../run.ts';
import { facts, folded, gradeBar, headRow, panel, scroll, select } from '../widgets.ts';
import { costTable } from './cost.ts';

interface Sample {
  x: number;
  y: number;
  low: number;
  high: number;
  note: string;
}

const lineOf = (column: Column, samples: Sample[], bare: boolean): Line => {
  const sorted = samples.filter((s) => s.x > 0 && s.y > 0 && Number.isFinite(s.x + s.y)).sort((a, b) => a.x - b.x);
  const finite = (v: number) => (Number.isFinite(v) ? v : null);
  return {
    key: column.spec,
    label: column.label,
    colour: engineColour(column.engine),
    dash: column.dash,
    width: 1.5,
    points: true,
    bare,
    x: sorted.map((s) => s.x),
    y: sorted.map((s) => s.y),
    low: sorted.map((s) => finite(s.low)),
    high: sorted.map((s) => finite(s.high)),
    notes: sorted.map((s) => s.note),
  };
};

const sampleOf = (step: Step, x: number, note: string): Sample => ({
  x,
  y: toNumber(step.median),
  low: toNumber(step.low),
  high: toNumber(step.high),
  note,
});

/** Cost of a step over bodies or contacts, a line per column, a point per scenario. */
function scalingLines(column: Column, over: (step: Step) => number): Line {
  const samples = run.scenarios.flatMap((s) => {
    const at = cellOf(s, column, 'finest')?.at;
    return at?.step && at.outcome === 'completed' ? [sampleOf(at.step, over(at.step), s.name)] : [];
  });
  return lineOf(column, samples, true);
}

/** Scenarios that differ in their size alone: equal names but for a number. */
export function families(names: string[]): Map<string, string[]> {
  const found = new Map<string, string[]>();
  for (const name of names) {
    const stem = name.replace(/\d+(?!d\b)/g, '#');
    if (stem !== name) found.set(stem, [...(found.get(stem) ?? []), name]);
  }
  return new Map([...found].filter(([, list]) => list.length > 1));
}

function accuracyLines(column: Column): Line {
  const samples = run.scenarios.flatMap((s) => {
    const cell = cellOf(s, column, 'finest');
    const error = relativeOf(cell);
    return cell && error > 0 ? [{ x: costOf(cell), y: error, low: NaN, high: NaN, note: s.name }] : [];
  });
  return lineOf(column, samples, true);
}

function toggled(plots: (columns: Column[]) => HTMLElement[]): HTMLElement {
  const presets = [...new Set(run.columns.map((c) => c.preset))].filter(Boolean);
  const grid = el('div', { class: 'charts' });
  const draw = (preset: string) =>
    grid.replaceChildren(...plots(run.columns.filter((c) => !preset || c.preset === preset)));
  const start = presets.includes(run.likeForLike) ? run.likeForLike : '';
  draw(start);
  const choice = select('Preset', [['', 'all'], ...presets.map((p): [string, string] => [p, p])], start, draw);
  return el('div', null, el('div', { class: 'filters' }, choice), keyOf(), grid);
}

/** Colours of the engines. */
export function keyOf(): HTMLElement {
  const engines = [...new Set(run.columns.map((c) => c.engine))];
  return el(
    'div',
    { class: 'lines' },
    engines.map((e) => el('span', null, el('i', { class: 'swatch', style: `background:${engineColour(e)}` }), e)),
  );
}

function scaling(columns: Column[]): HTMLElement[] {
  const has = (line: Line) => line.x.length > 1;
  const axes = [
    ['Cost of a step over moving bodies', 'moving bodies', (s: Step) => s.bodies ?? 0],
    ['Cost of a step over contacts', 'mean number of contacts', (s: Step) => toNumber(s.contacts)],
  ] as const;
  const common = { yTitle: 'time of a step', unit: 's', xUnit: '', logX: true, logY: true, tall: true };
  const cards = axes.flatMap(([title, xTitle, over]) => {
    const lines = columns.map((c) => scalingLines(c, over)).filter(has);
    return lines.length ? [plotCard({ ...common, title, name: title, xTitle, lines })] : [];
  });
  for (const [stem, names] of families(run.scenarios.map((s) => s.name))) {
    const lines = columns.map((c) => {
      const samples = names.flatMap((name) => {
        const at = run.scenarios.find((s) => s.name === name)?.cases.find((x) => x.spec === c.spec);
        return at?.step ? [sampleOf(at.step, at.step.bodies || Number(/\d+/.exec(name)?.[0]), name)] : [];
      });
      return lineOf(c, samples, false);
    });
    const title = `Family ${stem}`;
    if (lines.some(has))
      cards.push(plotCard({ ...common, title, name: title, xTitle: 'moving bodies', lines: lines.filter(has) }));
  }
  return cards;
}

const accuracy = (columns: Column[]): HTMLElement[] => {
  const lines = columns.map(accuracyLines).filter((line) => line.x.length > 0);
  const title = 'Relative error over the cost of a step: each point a scenario; lower left is better';
  if (lines.length === 0) return [];
  return [
    plotCard({
      title,
      name: 'accuracy over cost',
      yTitle: 'relative error',
      unit: '',
      xTitle: 'time of a step [s]',
      xUnit: 's',
      logX: true,
      logY: true,
      tall: true,
      lines,
    }),
  ];
};

const costs = (column: Column) => run.costs?.[run.columns.indexOf(column)];
const finite = (value: Maybe | undefined): string => (Number.isFinite(toNumber(value)) ? format(value, 3) : '—');

/** Medians over the scenarios; the phases that an engine reports, as fractions of its step. */
function summaryTable(): HTMLElement {
  const costly = placed(run.overall, run.columns).filter((s) => toNumber(s.costRatio) > 0);
  const list = byClock(costly, (s) => clockOf(s.column)).flatMap((group) => group.items);
  const phases = (spec: string) => {
    const shares = new Map<string, number[]>();
    for (const s of run.scenarios) {
      const step = s.cases.find((c) => c.spec === spec)?.step;
      for (const [phase, cost] of Object.entries(step?.phases ?? {}))
        shares.set(phase, [...(shares.get(phase) ?? []), toNumber(cost) / toNumber(step?.median)]);
    }
    return [...shares].map(([phase, values]) => `${phase} ${(100 * median(values)).toFixed(0)} %`).join(', ');
  };
  const shownPhases = list.map((s) => phases(s.column.spec));
  return scroll(
    el(
      'table',
      { class: 'full' },
      headRow(
        [
          'Engine',
          'Median of a step',
          'Mean',
          'First step',
          '95 %',
          '99 %',
          'Worst',
          '× real time',
          'Median × the fastest',
          'Mean × the fastest',
          'Error × the best',
          'Error × ours',
          'C or better',
          'Grades',
          'Phases, share of a step',
        ],
        (i) => i < 13,
      ),
      el(
        'tbody',
        null,
        list.map((s, i) =>
          el(
            'tr',
            null,
            el(
              'th',
              { class: 'sticky', scope: 'row' },
              s.column.label,
              clockOf(s.column) ? el('span', { class: 'sub' }, clockOf(s.column)) : null,
            ),
            (['median', 'mean', 'first', 'p95', 'p99', 'worst'] as const).map((key) =>
              el('td', { class: 'num' }, duration(costs(s.column)?.[key])),
            ),
            el('td', { class: 'num' }, finite(costs(s.column)?.realTimeFactor)),
            el('td', { class: 'num' }, format(s.costRatio, 3)),
            el('td', { class: 'num' }, finite(costs(s.column)?.meanRatio)),
            el('td', { class: 'num' }, ratio(s.toBest) || '—'),
            el('td', { class: 'num' }, ratio(s.toOurs) || '—'),
            el('td', { class: 'num' }, `${s.within} of ${s.scenarios}`),
            el('td', null, gradeBar(s.grades)),
            el('td', { class: 'small claim' }, shownPhases[i] || '—'),
          ),
        ),
      ),
    ),
  );
}

/** Ratios to the fastest, those of each clock apart. */
function costBars(columns: Column[]): HTMLElement[] {
  const costly = placed(run.overall, run.columns)
    .filter((s) => columns.includes(s.column) && toNumber(s.costRatio) > 0)
    .sort((a, b) => toNumber(a.costRatio) - toNumber(b.costRatio));
  return byClock(costly, (s) => clockOf(s.column)).map(({ clock, items }) => {
    const bars = items.map((s) => ({
      label: s.column.label,
      value: toNumber(s.costRatio),
      text: `×${format(s.costRatio, 3)}`,
      colour: engineColour(s.column.engine),
    }));
    const title = 'Time of a step, typically × the fastest engine of the same scenario';
    return el(
      'div',
      { class: 'chart' },
      el('h4', null, clock ? `${title}, among those of the clock “${clock}”` : title),
      barList(bars, false, 'var(--accent)'),
    );
  });
}

export function timing(): HTMLElement | null {
  if (!run.scenarios.some((s) => s.cases.some((c) => c.step))) return null;
  const { environment } = run;
  const machine = Object.entries(environment).filter(([k]) => !/^engine_|^date$|^rigor$/.test(k));
  const precision = run.engines
    .filter((e) => run.columns.some((c) => c.engine === e.name))
    .map((e): [string, string] => [e.name, [e.version, e.precision, e.buildNotes].filter(Boolean).join(', ')]);
  return panel(
    'timing',
    'Cost, beside accuracy',
    el(
      'p',
      { class: 'muted' },
      'Wall time of one step by the monotonic clock, medians over the scenarios. The first step stands apart: mean, 95 %, 99 %, worst and × real time (time step ',
      'over the mean) are of all others. Plots show the median, with its 95 % interval where there are enough samples (else from the 10th to the 90th percentile), always beside the errors of the same runs. Times hold for the machine below, and for cases that may have run beside others: ',
      el('code', null, 'rigor bench'),
      ' measures alone and interleaved. Guests’ times are by their own clocks, and stand in no ratio with those of modules: × the fastest is among those of the same clock.',
    ),
    el('div', { class: 'split' }, facts(machine), facts(precision)),
    summaryTable(),
    el('h3', null, 'Scaling, and cost against accuracy'),
    toggled((columns) => [...costBars(columns), ...accuracy(columns), ...scaling(columns)]),
    folded('Every scenario: time of a step, below it the grade and the main error of the same run', () =>
      scroll(costTable()),
    ),
  );
}
