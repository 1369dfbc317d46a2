// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Convergence of the solver: the impulse of each row after every iteration, and the residual on a logarithmic axis. If
// there are many rows those with the largest impulses are drawn.
import uPlot from 'uplot';
import { cssValue, el } from '../common/elements.ts';
import { tick } from '../common/format.ts';
import type { Row, StageData } from './stage_data.ts';
import 'uplot/dist/uPlot.min.css';

export const mostCurves = 8;
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8a6fd1', '#a0791a'];

export interface Curves {
  rows: number[]; // drawn rows by their place
  data: (number | null)[][]; // iterations from 0, the start; one list for each row; the residuals
}

/** Curves of the rows with the largest last impulses. */
export function curves(data: StageData): Curves {
  const { iterations } = data;
  const last = iterations[iterations.length - 1]?.impulses ?? new Float64Array();
  const rows = Array.from(last.keys())
    .sort((i, j) => Math.abs(last[j] as number) - Math.abs(last[i] as number))
    .slice(0, mostCurves)
    .sort((i, j) => i - j);
  const of = (row: number) => [data.start[row] ?? null, ...iterations.map(({ impulses }) => impulses[row] ?? null)];
  const residuals = [null, ...iterations.map(({ residual }) => (residual > 0 ? residual : null))];
  return { rows, data: [[0, ...iterations.map((_, i) => i + 1)], ...rows.map(of), residuals] };
}

export class ImpulsePlot {
  readonly element = el('figure', { class: 'impulses', hidden: true });
  readonly #caption = el('figcaption');
  readonly #box = el('div');
  #plot: uPlot | null = null;

  constructor() {
    this.element.append(this.#box, this.#caption);
  }

  show(data: StageData | null, name: (row: Row) => string): void {
    this.#plot?.destroy();
    this.#plot = null;
    this.element.hidden = !data || data.iterations.length === 0 || data.rows.length === 0;
    if (!data || this.element.hidden) return;
    const { rows, data: lists } = curves(data);
    const ink = cssValue('--muted');
    const grid = { stroke: cssValue('--line'), width: 1 };
    const axis = { stroke: ink, grid, ticks: grid, font: '11px system-ui', size: 44 };
    const impulses = rows.map((row, i) => ({
      label: `${row} ${name(data.rows[row] as Row)}`,
      stroke: colours[i % colours.length] as string,
      width: 1.5,
      scale: 'y',
      value: (_: uPlot, v: number | null) => (v === null ? '—' : tick(Number(v.toPrecision(5)))),
    }));
    const residual = {
      label: 'residual',
      stroke: ink,
      dash: [4, 3],
      width: 1.5,
      scale: 'residual',
      value: (_: uPlot, v: number | null) => (v === null ? '—' : v.toExponential(2)),
    };
    this.#plot = new uPlot(
      {
        width: Math.max(260, this.#box.clientWidth || 340),
        height: 190,
        cursor: { drag: { x: false, y: false } },
        legend: { live: true },
        scales: { x: { time: false }, residual: { distr: 3 } },
        axes: [
          { ...axis, size: 28, label: 'iteration', labelSize: 18, labelFont: '11px system-ui' },
          { ...axis, scale: 'y', values: (_, ticks) => ticks.map(tick) },
          {
            ...axis,
            scale: 'residual',
            side: 1,
            grid: { show: false },
            values: (_, t) => t.map((v) => (v === null ? '' : v.toExponential(0))),
          },
        ],
        series: [{ label: 'iteration' }, ...impulses, residual],
      },
      lists as uPlot.AlignedData,
      this.#box,
    );
    const hidden = data.rows.length - rows.length;
    this.#caption.textContent =
      'Impulse of each row [N s or N m s] after every iteration, 0: what it starts with; dashed, on the right: residual.' +
      (hidden > 0 ? ` The ${rows.length} largest of ${data.rows.length} rows.` : '');
  }
}
