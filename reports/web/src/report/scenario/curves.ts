// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Curves of one scenario at one time step: all engines and the reference over each other, with the switches that
// curves and replay share.

import { el } from '../../common/elements.ts';
import { format } from '../../common/format.ts';
import { Seldom } from '../../replay/seldom.ts';
import { lineSample } from '../charts/line_sample.ts';
import { dropPlots } from '../charts/live_plots.ts';
import { plotCard } from '../charts/plot.ts';
import { bodyNames, type CurvePlot, collectCurves, referenceLabel, wantsLog } from '../curves.ts';
import type { Column } from '../data.ts';
import { columnOf, columnsAmong, engineColour } from '../run.ts';
import { panel, select } from '../widgets.ts';
import { aboutOf, type Context, fileLinks } from './context.ts';

const lineStyle = (spec: string) => {
  const column = columnOf(spec);
  if (!column) return { label: spec, colour: '--reference', dash: [], width: 5 };
  return { label: column.label, colour: engineColour(column.engine), dash: column.dash, width: 1.5 };
};

const fewSamples = 50; // curves with at most so many samples have a mark at each

function card(context: Context, plot: CurvePlot): HTMLElement {
  const { cursor, cases, spec } = context;
  const lines = plot.curves.map((curve) => ({
    ...lineStyle(curve.spec),
    ...(curve.spec === '' ? { label: referenceLabel(cases) } : {}),
    key: curve.spec,
    x: curve.x,
    y: curve.y,
    points: curve.x.length < fewSamples,
  }));
  return plotCard({
    title: plot.title,
    name: plot.title,
    about: aboutOf(context),
    yTitle: plot.title,
    unit: plot.unit,
    xTitle: 't [s]',
    xUnit: 's',
    lines,
    logY: wantsLog(plot),
    cursor,
    focus: spec,
  });
}

/** Switches of all columns; returns the element and what ends its following. */
function switches(context: Context, columns: Column[]): HTMLElement {
  const { cursor, cases } = context;
  const boxes = columns.map((c) => {
    const flip = (e: Event) => {
      const hidden = new Set(cursor.hidden.value);
      if ((e.target as HTMLInputElement).checked) hidden.delete(c.spec);
      else hidden.add(c.spec);
      cursor.hidden.set(hidden);
    };
    return el('input', {
      type: 'checkbox',
      'data-spec': c.spec,
      checked: !cursor.hidden.value.has(c.spec),
      onchange: flip,
    });
  });
  cursor.hidden.follow((hidden) =>
    columns.forEach((c, i) => {
      (boxes[i] as HTMLInputElement).checked = !hidden.has(c.spec);
    }),
  );
  const only = (want: (c: Column) => boolean) => () =>
    cursor.hidden.set(new Set(columns.filter((c) => !want(c)).map((c) => c.spec)));
  const presets = [...new Set(columns.map((c) => c.preset))].filter(Boolean);
  const button = (text: string, want: (c: Column) => boolean) =>
    el('button', { class: 'button noprint', onclick: only(want) }, text);
  const hasReference = cases.some((c) => c.curves?.reference?.length);
  return el(
    'div',
    { class: 'lines', id: 'switches' },
    button('all', () => true),
    presets.map((p) => button(p, (c) => c.preset === p)),
    button('none', () => false),
    hasReference ? el('label', null, lineSample('var(--reference)', [], 5), referenceLabel(cases)) : null,
    columns.map((c, i) => el('label', null, boxes[i], lineSample(engineColour(c.engine), c.dash, 2), c.label)),
  );
}

function timeReadOut({ cursor, scenario }: Context): HTMLElement {
  const text = el('output', { class: 'time' });
  const slider = el('input', {
    type: 'range',
    min: 0,
    max: scenario.duration,
    step: 'any',
    'aria-label': 'Time',
    class: 'noprint',
  });
  const show = () => {
    text.textContent = `t = ${format(cursor.time.value)} s`;
    slider.value = String(cursor.time.value);
  };
  const shown = new Seldom(show);
  slider.addEventListener('input', () => cursor.time.set(Number(slider.value), slider));
  cursor.time.follow(() => shown.call(cursor.playing));
  show();
  return el('span', { class: 'seg' }, slider, text);
}

export function curves(context: Context): HTMLElement | null {
  const withCurves = context.cases.filter((c) => c.curves);
  if (withCurves.length === 0) return null;
  const names = bodyNames(context.cases);
  const grid = el('div', { class: 'charts' });
  const draw = (body: string) => {
    dropPlots(grid);
    const plots = collectCurves(context.cases, context.scenario.observed, body);
    grid.replaceChildren(...plots.map((plot) => card(context, plot)));
  };
  const body = names[0] ?? '';
  draw(body);
  return panel(
    'curves',
    'Curves',
    el(
      'div',
      { class: 'controls' },
      names.length > 1
        ? select(
            'Body',
            names.map((n) => [n, n]),
            body,
            draw,
          )
        : null,
      timeReadOut(context),
    ),
    switches(context, columnsAmong(withCurves)),
    grid,
    el(
      'p',
      { class: 'muted small' },
      'Drag to zoom, double click to see everything, click to set the time. Thinned for viewing to about 200 points that keep the ',
      'extremes; the full series are in the trajectory files.',
    ),
    fileLinks(context, 'plots', 'The main plot as a file'),
  );
}
