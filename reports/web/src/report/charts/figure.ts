// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A plot as a figure for a paper: SVG on white with a title, titles of the axes, and a legend beside the curves.
import { svg } from '../../common/elements.ts';
import { tick } from '../../common/format.ts';
import type { Line, Plot } from './line.ts';
import { bandOf, logTicks } from './samples.ts';

export interface Axis {
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

/** "residual", "position error [m]". */
export const yTitleOf = ({ yTitle, unit }: Plot): string => (unit && unit !== '1' ? `${yTitle} [${unit}]` : yTitle);

/** True for a line with a sample that the axes can show. */
export const hasSamples = (line: Line, logX: boolean, logY: boolean): boolean =>
  line.y.some((y, i) => y !== null && (!logY || y > 0) && (!logX || (line.x[i] as number) > 0));

// The plot is as wide as in a page; the legend is beside it.
const [left, top, right, bottom] = [70, 50, 640, 380];
const [below, legendAt, rowHeight, characterWidth, textSize] = [46, 14, 16, 6.3, 11];
const ink = '#333333';
const onPaper = (line: Line) => (line.colour.startsWith('--') ? '#a3aab4' : line.colour);

class Scales {
  constructor(
    readonly x: Axis,
    readonly y: Axis,
  ) {}
  readonly px = (value: number) => left + place(this.x, value) * (right - left);
  readonly py = (value: number) => bottom - place(this.y, value) * (bottom - top);
  shows(x: number, y: number | null): y is number {
    return y !== null && !(this.y.log && !(y > 0)) && !(this.x.log && !(x > 0));
  }
}

/** The path of a line; a gap where it has no value. */
function pathOf(line: Line, scales: Scales): string {
  const { x, y } = line.joined ?? line;
  let begun = false;
  let path = '';
  y.forEach((value, i) => {
    const at = x[i] as number;
    const isShown = scales.shows(at, value);
    if (isShown) path += `${begun ? 'L' : 'M'}${scales.px(at).toFixed(2)} ${scales.py(value).toFixed(2)}`;
    begun = isShown;
  });
  return path;
}

/** Bars of intervals, marks at samples, rings around marked ones. */
function marksOf(line: Line, scales: Scales): SVGElement[] {
  const stroke = onPaper(line);
  return line.y.flatMap((y, i) => {
    const x = line.x[i] as number;
    if (!scales.shows(x, y)) return [];
    const at = { cx: scales.px(x).toFixed(2), cy: scales.py(y).toFixed(2) };
    const band = bandOf(line.low?.[i] ?? null, line.high?.[i] ?? null, scales.y.log);
    const ends = band?.map((v) => scales.py(v).toFixed(2));
    return [
      ...(ends ? [svg('path', { d: `M${at.cx} ${ends[0]}V${ends[1]}`, stroke })] : []),
      ...(line.points || line.bare ? [svg('circle', { ...at, r: 3, fill: stroke })] : []),
      ...(line.marked?.includes(i) ? [svg('circle', { ...at, r: 8, stroke, 'stroke-width': 2 })] : []),
    ];
  });
}

function lineNode(line: Line, scales: Scales): SVGElement {
  const path = line.bare
    ? null
    : svg('path', {
        d: pathOf(line, scales),
        stroke: onPaper(line),
        'stroke-width': line.width,
        'stroke-dasharray': line.dash.join(' ') || null,
      });
  return svg('g', { 'data-line': line.label, 'clip-path': 'url(#frame)' }, path, marksOf(line, scales));
}

function axesNode(plot: Plot, scales: Scales): SVGElement {
  const grid = '#dddddd';
  const xTicks = ticksOf(scales.x).map((v) => [
    svg('path', { d: `M${scales.px(v)} ${top}V${bottom}`, stroke: grid }),
    svg('text', { x: scales.px(v), y: bottom + 16, 'text-anchor': 'middle' }, tick(v)),
  ]);
  const yTicks = ticksOf(scales.y).map((v) => [
    svg('path', { d: `M${left} ${scales.py(v)}H${right}`, stroke: grid }),
    svg('text', { x: left - 6, y: scales.py(v) + 4, 'text-anchor': 'end' }, tick(v)),
  ]);
  const [middle, height] = [(left + right) / 2, (top + bottom) / 2];
  const turn = `rotate(-90 14 ${height})`;
  return svg(
    'g',
    { fill: ink },
    xTicks.flat(),
    yTicks.flat(),
    svg('text', { x: middle, y: bottom + 36, 'text-anchor': 'middle' }, plot.xTitle),
    svg('text', { x: 14, y: height, 'text-anchor': 'middle', transform: turn }, yTitleOf(plot)),
  );
}

function legendNode(lines: Line[]): SVGElement {
  const rows = lines.map((line, i) => {
    const [x, y] = [right + legendAt, top + 8 + rowHeight * i];
    const [stroke, dash] = [onPaper(line), line.dash.join(' ') || null];
    const sample = { d: `M${x} ${y}h28`, stroke, 'stroke-width': Math.max(2, line.width), 'stroke-dasharray': dash };
    return [
      line.bare ? svg('circle', { cx: x + 14, cy: y, r: 3, fill: stroke }) : svg('path', sample),
      svg('text', { x: x + 34, y: y + 4, fill: ink }, line.label),
    ];
  });
  return svg('g', { class: 'legend' }, rows.flat());
}

/** Width and height: those of the curves, and room for the legend and the title. */
function sizeOf(plot: Plot): { width: number; height: number } {
  const longest = (texts: string[]) => characterWidth * Math.max(0, ...texts.map((text) => text.length));
  const legend = right + legendAt + 40 + longest(plot.lines.map((line) => line.label));
  const title = left + 1.3 * longest([plot.name]);
  return {
    width: Math.ceil(Math.max(legend, title, left + longest([plot.about ?? '']))),
    height: Math.max(bottom + below, top + rowHeight * (plot.lines.length + 1)),
  };
}

/** The figure of a plot over the part that its axes show. */
export function figureSvg(plot: Plot, x: Axis, y: Axis): string {
  const scales = new Scales(x, y);
  const frame = { x: left, y: top, width: right - left, height: bottom - top };
  const { width, height } = sizeOf(plot);
  const title = { x: left, y: 20, fill: '#111111', 'font-size': 14, 'font-weight': 'bold' };
  const drawing = svg(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      viewBox: `0 0 ${width} ${height}`,
      width,
      height,
      fill: 'none',
      'font-family': 'sans-serif',
      'font-size': textSize,
    },
    svg('rect', { width, height, fill: '#ffffff' }),
    svg('clipPath', { id: 'frame' }, svg('rect', frame)),
    axesNode(plot, scales),
    svg('rect', { ...frame, stroke: '#888888' }),
    plot.lines.map((line) => lineNode(line, scales)),
    legendNode(plot.lines),
    svg('text', title, plot.name),
    plot.about ? svg('text', { x: left, y: 38, fill: ink }, plot.about) : null,
  );
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(drawing)}\n`;
}
