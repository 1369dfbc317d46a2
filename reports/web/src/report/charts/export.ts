// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A plot as a file: the samples as CSV, the drawing as SVG or PNG.
import type uPlot from 'uplot';
import { csvText, download, pngOf, saveText } from '../../common/download.ts';
import { cssValue, svg } from '../../common/elements.ts';
import { tick } from '../../common/format.ts';
import type { Line, Plot } from './line.ts';
import { logTicks } from './samples.ts';

const fileName = (plot: Plot) => plot.name.replaceAll(/[^\w.-]+/g, '-').toLowerCase();

/** A row for each sample: line, x, y. */
export function plotCsv(plot: Plot): string {
  const unit = plot.unit && plot.unit !== '1' ? ` [${plot.unit}]` : '';
  const rows: (string | number)[][] = [['line', plot.xTitle || 'x', `${plot.name}${unit}`]];
  for (const line of plot.lines)
    line.y.forEach((y, i) => {
      if (y !== null) rows.push([line.label, line.x[i] as number, y]);
    });
  return csvText(rows);
}

interface Axis {
  min: number;
  max: number;
  log: boolean;
}
const place = ({ min, max, log }: Axis, value: number): number =>
  log ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);

/** Round numbers on an axis. */
export function ticksOf({ min, max, log }: Axis): number[] {
  if (log) return logTicks(min, max);
  const rough = (max - min) / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((f) => f * power >= rough) ?? 10) * power;
  const first = Math.ceil(min / step);
  return Array.from({ length: Math.max(0, Math.floor(max / step) - first + 1) }, (_, i) => (first + i) * step);
}

const [width, height, left, right, top, bottom] = [720, 420, 70, 16, 34, 46];

/** The path of a line; a gap where it has no value. */
function pathOf(line: Line, x: Axis, y: Axis): string {
  const [xs, ys] = line.joined ? [line.joined.x, line.joined.y] : [line.x, line.y];
  let begun = false;
  let path = '';
  ys.forEach((value, i) => {
    const at = xs[i] as number;
    if (value === null || (y.log && !(value > 0)) || (x.log && !(at > 0))) {
      begun = false;
      return;
    }
    const px = left + place(x, at) * (width - left - right);
    const py = height - bottom - place(y, value) * (height - top - bottom);
    path += `${begun ? 'L' : 'M'}${px.toFixed(2)} ${py.toFixed(2)}`;
    begun = true;
  });
  return path;
}

/** The plot as it is zoomed, with a legend. */
export function plotSvg(plot: Plot, x: Axis, y: Axis, colourOf: (line: Line) => string): string {
  const axisLines = [
    ...ticksOf(x).map((v) => {
      const px = left + place(x, v) * (width - left - right);
      return [
        svg('path', { d: `M${px} ${top}V${height - bottom}`, stroke: '#dddddd' }),
        svg('text', { x: px, y: height - bottom + 16, 'text-anchor': 'middle' }, tick(v)),
      ];
    }),
    ...ticksOf(y).map((v) => {
      const py = height - bottom - place(y, v) * (height - top - bottom);
      return [
        svg('path', { d: `M${left} ${py}H${width - right}`, stroke: '#dddddd' }),
        svg('text', { x: left - 6, y: py + 4, 'text-anchor': 'end' }, tick(v)),
      ];
    }),
  ];
  const frame = { x: left, y: top, width: width - left - right, height: height - top - bottom };
  const lines = plot.lines.map((line) =>
    svg('path', {
      d: pathOf(line, x, y),
      stroke: colourOf(line),
      'stroke-width': line.width,
      'stroke-dasharray': line.dash.join(' ') || null,
      'clip-path': 'url(#frame)',
    }),
  );
  const key = plot.lines.map((line, i) => {
    const [kx, ky] = [left + 8, top + 14 + 15 * i];
    return [
      svg('path', { d: `M${kx} ${ky - 4}h18`, stroke: colourOf(line), 'stroke-width': 2 }),
      svg('text', { x: kx + 24, y: ky }, line.label),
    ];
  });
  const unit = plot.unit && plot.unit !== '1' ? ` [${plot.unit}]` : '';
  const drawing = svg(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      viewBox: `0 0 ${width} ${height}`,
      fill: 'none',
      'font-family': 'sans-serif',
      'font-size': 11,
    },
    svg('rect', { width, height, fill: '#ffffff' }),
    svg('clipPath', { id: 'frame' }, svg('rect', frame)),
    svg('g', { fill: '#333333' }, axisLines.flat()),
    svg('rect', { ...frame, stroke: '#888888' }),
    svg('g', null, lines),
    svg('g', { fill: '#333333' }, key.flat()),
    svg('text', { x: left, y: 20, fill: '#111111', 'font-size': 13 }, `${plot.name}${unit}`),
    svg(
      'text',
      { x: (left + width - right) / 2, y: height - 10, 'text-anchor': 'middle', fill: '#333333' },
      plot.xTitle,
    ),
  );
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(drawing)}\n`;
}

const axisOf = (u: uPlot, key: 'x' | 'y', log: boolean): Axis => ({
  min: u.scales[key]?.min ?? 0,
  max: u.scales[key]?.max ?? 1,
  log,
});

/** Saves a plot that is drawn: the lines that are shown, as it is zoomed. */
export async function savePlot(
  kind: 'csv' | 'svg' | 'png',
  plot: Plot,
  u: uPlot,
  log: boolean,
  colourOf: (line: Line) => string,
): Promise<void> {
  const shown = { ...plot, lines: plot.lines.filter((_, i) => u.series[i + 1]?.show) };
  const name = fileName(plot);
  if (kind === 'csv') saveText(`${name}.csv`, plotCsv(shown), 'text/csv');
  if (kind === 'svg') {
    const text = plotSvg(shown, axisOf(u, 'x', plot.logX ?? false), axisOf(u, 'y', log), colourOf);
    saveText(`${name}.svg`, text, 'image/svg+xml');
  }
  if (kind !== 'png') return;
  const canvas = document.createElement('canvas');
  canvas.width = u.ctx.canvas.width;
  canvas.height = u.ctx.canvas.height;
  const ctx = canvas.getContext('2d');
  if (!ctx) return;
  ctx.fillStyle = cssValue('--panel');
  ctx.fillRect(0, 0, canvas.width, canvas.height);
  ctx.drawImage(u.ctx.canvas, 0, 0);
  download(`${name}.png`, await pngOf(canvas));
}
