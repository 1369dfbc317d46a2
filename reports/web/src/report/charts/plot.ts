// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One plot in a card: lines over time or over anything else. Drag zooms, double click shows everything again, the
// pointer reads values out. Over time, a click sets the shared time and a bar follows it.
import { Seldom } from '../../replay/seldom.ts';
import 'uplot/dist/uPlot.min.css';
import uPlot from 'uplot';
import { cssValue, el } from '../../common/elements.ts';
import { format, tick, unitText } from '../../common/format.ts';
import { savePlot } from './export.ts';
import type { Line, Plot } from './line.ts';
import { addPlot } from './live_plots.ts';
import { bandOf, logTicks, nearest, widened } from './samples.ts';

const colourOf = (line: Line) => (line.colour.startsWith('--') ? cssValue(line.colour) : line.colour);

export function plotCard(plot: Plot): HTMLElement {
  const box = el('div', { class: plot.tall ? 'box tall' : 'box' });
  let log = plot.logY ?? false;
  let drawn: uPlot | null = null;
  let ends: (() => void)[] = [];
  const drop = () => {
    for (const end of ends) end();
    ends = [];
    drawn?.destroy();
    drawn = null;
  };
  const make = () => {
    if (drawn) return;
    drawn = draw(plot, log, box);
    drawn.ctx.canvas.setAttribute('role', 'img');
    drawn.ctx.canvas.setAttribute('aria-label', `${plot.title}: ${plot.lines.map((line) => line.label).join(', ')}`);
    const size = new ResizeObserver(() => drawn?.setSize(sizeOf(box)));
    size.observe(box);
    ends = [() => size.disconnect(), ...connect(plot, drawn)];
  };
  const toggle = () => {
    log = !log;
    button.setAttribute('aria-pressed', String(log));
    drop();
    make();
  };
  const button = el(
    'button',
    {
      class: 'button noprint',
      'aria-label': `log scale of ${plot.title}`,
      'aria-pressed': String(log),
      onclick: toggle,
    },
    'log',
  );
  const save = (e: Event) => {
    const menu = e.target as HTMLSelectElement;
    const kind = menu.value as 'csv' | 'svg' | 'png';
    menu.value = '';
    make();
    if (drawn) void savePlot(kind, plot, drawn, log);
  };
  const menu = el(
    'select',
    { class: 'save noprint', 'aria-label': `Save ${plot.name}`, title: 'Save this plot', onchange: save },
    ['⤓', 'CSV', 'SVG', 'PNG'].map((text, i) => el('option', { value: i === 0 ? '' : text.toLowerCase() }, text)),
  );
  const unit = plot.unit && plot.unit !== '1' ? el('span', { class: 'muted' }, ` [${plot.unit}]`) : null;
  const mayBeLog = plot.lines.every((line) => line.y.every((y) => y === null || y >= 0));
  const head = el(
    'h3',
    null,
    el('span', null, plot.title, unit),
    el('span', { class: 'tools' }, mayBeLog ? button : null, menu),
  );
  const attributes = { class: 'chart', 'data-plot': plot.name, role: 'group', 'aria-label': plot.name };
  return addPlot({ node: el('div', attributes, head, box), make, drop });
}

const sizeOf = (box: HTMLElement) => ({ width: box.clientWidth || 420, height: box.clientHeight || 240 });

/** No wider than the data: uPlot's own range would go on to the next power of ten. */
const logRange = (_: uPlot, min: number, max: number): [number, number] => widened(min, max);

function draw(plot: Plot, log: boolean, box: HTMLElement): uPlot {
  const positive = (y: number | null, x: number) =>
    y === null || (log && !(y > 0)) || (plot.logX && !(x > 0)) ? null : y;
  const tables = plot.lines.map((line): uPlot.AlignedData => {
    const x = Array.from(line.x);
    return [x, line.y.map((y, i) => positive(y, x[i] as number))];
  });
  const data = tables.length > 1 ? uPlot.join(tables) : (tables[0] ?? [[], []]);
  return new uPlot(optionsOf(plot, log, box), data, box);
}

function optionsOf(plot: Plot, log: boolean, box: HTMLElement): uPlot.Options {
  const shown = (line: Line) => line.key === '' || !plot.cursor?.hidden.value.has(line.key);
  const series = plot.lines.map(
    (line): uPlot.Series => ({
      label: line.label,
      stroke: line.bare || line.joined ? 'transparent' : colourOf(line),
      width: line.key !== '' && line.key === plot.focus ? line.width + 1.5 : line.width,
      dash: line.dash,
      show: shown(line),
      points: line.points ? { show: true, size: 6, fill: colourOf(line), stroke: colourOf(line) } : { show: false },
    }),
  );
  const axis = (label: string, logarithmic: boolean): uPlot.Axis => ({
    ...(logarithmic ? { splits: (_u, _i, min, max) => logTicks(min, max), filter: (_u, splits) => splits } : {}),
    stroke: cssValue('--muted'),
    grid: { stroke: cssValue('--line'), width: 1 },
    ticks: { stroke: cssValue('--line'), width: 1, size: 4 },
    font: '11px system-ui, sans-serif',
    labelFont: '11px system-ui, sans-serif',
    values: (_, splits) => splits.map((v) => (v === null || v === undefined ? '' : tick(v))),
    ...(label ? { label, labelSize: 16 } : {}),
  });
  return {
    ...sizeOf(box),
    legend: { show: false },
    scales: {
      x: { time: false, distr: plot.logX ? 3 : 1, ...(plot.logX ? { range: logRange } : {}) },
      y: {
        distr: log ? 3 : 1,
        ...(plot.zeroY && !log ? { range: { min: { soft: 0, mode: 1 }, max: { pad: 0.1 } } } : {}),
      },
    },
    axes: [
      {
        ...axis(plot.xTitle, plot.logX ?? false),
        ...(plot.wholeX ? { incrs: [1, 2, 5, 10, 20, 50, 100] } : {}),
        size: 26,
        gap: 2,
      },
      { ...axis('', log), size: 58, gap: 3 },
    ],
    series: [{}, ...series],
    cursor: {
      drag: plot.cursor ? { x: true, y: false } : { x: true, y: true, uni: 30 },
      points: { show: false },
      ...(plot.cursor ? { sync: { key: 'time', setSeries: false, scales: ['x', null] } } : {}),
    },
    hooks: {
      draw: [(u) => drawJoined(u, plot), (u) => drawIntervals(u, plot), (u) => drawRings(u, plot)],
      setSeries: [],
    },
  };
}

/** Lines through samples in an order of their own. */
function drawJoined(u: uPlot, plot: Plot): void {
  const { ctx } = u;
  plot.lines.forEach((line, i) => {
    if (!line.joined || !u.series[i + 1]?.show) return;
    ctx.save();
    ctx.strokeStyle = colourOf(line);
    ctx.lineWidth = line.width * uPlot.pxRatio;
    ctx.setLineDash(line.dash.map((d) => d * uPlot.pxRatio));
    ctx.beginPath();
    let begun = false;
    line.joined.x.forEach((x, k) => {
      const y = line.joined?.y[k] ?? null;
      if (y === null || (plot.logX && !(x > 0)) || (u.scales.y?.distr === 3 && !(y > 0))) {
        begun = false;
        return;
      }
      const at = [u.valToPos(x, 'x', true), u.valToPos(y, 'y', true)] as const;
      if (begun) ctx.lineTo(...at);
      else ctx.moveTo(...at);
      begun = true;
    });
    ctx.stroke();
    ctx.restore();
  });
}

/** Rings around marked samples. */
function drawRings(u: uPlot, plot: Plot): void {
  const { ctx } = u;
  plot.lines.forEach((line, i) => {
    if (!u.series[i + 1]?.show) return;
    ctx.save();
    ctx.strokeStyle = colourOf(line);
    ctx.lineWidth = 2 * uPlot.pxRatio;
    for (const k of line.marked ?? []) {
      const y = line.y[k] ?? null;
      if (y === null) continue;
      ctx.beginPath();
      ctx.arc(u.valToPos(line.x[k] as number, 'x', true), u.valToPos(y, 'y', true), 8 * uPlot.pxRatio, 0, 2 * Math.PI);
      ctx.stroke();
    }
    ctx.restore();
  });
}

/** Bars from the low to the high end of the samples that have both. */
function drawIntervals(u: uPlot, plot: Plot): void {
  const { ctx } = u;
  plot.lines.forEach((line, i) => {
    const series = u.series[i + 1];
    if (!line.low || !line.high || !series?.show) return;
    ctx.save();
    ctx.strokeStyle = colourOf(line);
    ctx.lineWidth = uPlot.pxRatio;
    ctx.beginPath();
    for (let k = 0; k < line.x.length; ++k) {
      const ends = bandOf(line.low[k] ?? null, line.high[k] ?? null, u.scales.y?.distr === 3);
      if (ends === null) continue;
      const x = u.valToPos(line.x[k] as number, 'x', true);
      const [from, to] = ends.map((v) => u.valToPos(v, 'y', true)) as [number, number];
      ctx.moveTo(x, from);
      ctx.lineTo(x, to);
    }
    ctx.stroke();
    ctx.restore();
  });
}

/** The read-out, and what a plot over time shares with the others; returns what ends it. */
function connect(plot: Plot, u: uPlot): (() => void)[] {
  const readOut = el('div', { class: 'readout' });
  readOut.hidden = true;
  u.over.append(readOut);
  const leave = () => {
    readOut.hidden = true;
  };
  u.over.addEventListener('mouseleave', leave);
  u.over.addEventListener('mousemove', () => showReadOut(plot, u, readOut));
  const cursor = plot.cursor;
  if (cursor === undefined) return [];

  const bar = el('div', { class: 'timebar' });
  u.over.append(bar);
  const place = () => {
    const left = u.valToPos(cursor.time.value, 'x');
    bar.hidden = !(left >= 0 && left <= u.bbox.width / uPlot.pxRatio);
    bar.style.transform = `translateX(${left}px)`; // needs no layout: it moves with every frame of a replay
  };
  (u.hooks.draw as ((u: uPlot) => void)[]).push(place);
  let pressed = 0;
  u.over.addEventListener('mousedown', (e) => {
    pressed = e.clientX;
  });
  u.over.addEventListener('click', (e) => {
    if (Math.abs(e.clientX - pressed) < 3) cursor.time.set(Math.max(0, u.posToVal(u.cursor.left ?? 0, 'x')), u);
  });
  place();
  const show = () =>
    plot.lines.forEach((line, i) => {
      const wanted = line.key === '' || !cursor.hidden.value.has(line.key);
      if (u.series[i + 1]?.show !== wanted) u.setSeries(i + 1, { show: wanted });
    });
  const placed = new Seldom(place);
  return [cursor.time.follow(() => placed.call(cursor.playing)), cursor.hidden.follow(show), () => placed.end()];
}

function showReadOut(plot: Plot, u: uPlot, readOut: HTMLElement): void {
  const { left = -1, top = 0 } = u.cursor;
  const shown = plot.lines.filter((_, i) => u.series[i + 1]?.show);
  if (left < 0 || shown.length === 0) {
    readOut.hidden = true;
    return;
  }
  const at = u.posToVal(left, 'x');
  const rows = shown.map((line) => {
    const i = nearest(line.x, at, plot.logX ?? false);
    const value = `${format(line.y[i] ?? null)}${unitText(plot.unit)}`;
    const own = plot.cursor ? '' : ` at ${format(line.x[i] ?? null)}${unitText(plot.xUnit)}`;
    const mark = el('i', { style: `background:${colourOf(line)}` });
    const note = line.notes?.[i];
    return el('div', null, mark, `${line.label}: ${value}${own}${note ? `, ${note}` : ''}`);
  });
  const head = plot.cursor ? el('b', null, `t = ${format(at)} s`) : null;
  readOut.replaceChildren(...(head ? [head] : []), ...rows);
  readOut.hidden = false;
  const flip = left > u.over.clientWidth / 2;
  readOut.style.left = flip ? '' : `${left + 12}px`;
  readOut.style.right = flip ? `${u.over.clientWidth - left + 12}px` : '';
  readOut.style.top = `${Math.max(0, Math.min(top, u.over.clientHeight - readOut.clientHeight))}px`;
}
