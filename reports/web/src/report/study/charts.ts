// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Charts of a study: lines over what its grid varies most, or a bar for each row.
import { el } from '../../common/elements.ts';
import { format, inShownUnit, shownUnit, toNumber, unitText, words } from '../../common/format.ts';
import { barList } from '../charts/bars.ts';
import type { Line } from '../charts/line.ts';
import { plotCard } from '../charts/plot.ts';
import type { StudyChart, StudyPoint } from '../data.ts';
import { palette } from '../run.ts';

const titleOf = (chart: StudyChart) => words(chart.metric) + (chart.scenario ? `, ${chart.scenario}` : '');

/** A line per label, points in the order of the axis. */
export function studyLines(chart: StudyChart): { label: string; points: StudyPoint[] }[] {
  const lines: { label: string; points: StudyPoint[] }[] = [];
  for (const p of chart.points) {
    const last = lines.at(-1);
    if (last?.label === p.label) last.points.push(p);
    else lines.push({ label: p.label, points: [p] });
  }
  return lines;
}

const dashes = [[], [6, 4], [2, 3], [10, 4]];

function lineOf(label: string, points: StudyPoint[], index: number, unit: string): Line {
  const placed = points.filter((p) => Number.isFinite(toNumber(p.x)));
  const sorted = [...placed].sort((a, b) => toNumber(a.x) - toNumber(b.x));
  const inOrder = placed.every((p, i) => p === sorted[i]);
  const value = (v: StudyPoint['value']) => {
    const shown = toNumber(inShownUnit(v, unit));
    return Number.isFinite(shown) ? shown : null;
  };
  return {
    key: '',
    label,
    colour: palette[index % palette.length] as string,
    dash: dashes[Math.floor(index / palette.length) % dashes.length] as number[],
    width: 1.5,
    points: true,
    ...(inOrder ? {} : { joined: { x: placed.map((p) => toNumber(p.x)), y: placed.map((p) => value(p.value)) } }),
    x: sorted.map((p) => toNumber(p.x)),
    y: sorted.map((p) => value(p.value)),
    low: sorted.map((p) => value(p.low)),
    high: sorted.map((p) => value(p.high)),
    notes: sorted.map((p) => p.note),
  };
}

export function studyChart(chart: StudyChart): HTMLElement {
  const title = titleOf(chart);
  const unit = chart.unit && chart.unit !== '1' ? shownUnit(chart.unit) : '';
  const attributes = { 'data-metric': chart.metric, 'data-kind': chart.axis ? 'lines' : 'bars' };
  if (chart.axis) {
    const lines = studyLines(chart).map((line, i) => lineOf(line.label, line.points, i, chart.unit));
    const axes = {
      yTitle: chart.metric,
      xTitle: chart.axis,
      xUnit: '',
      logX: chart.logarithmicX,
      logY: chart.logarithmic,
      zeroY: true,
    };
    const card = plotCard({ title, name: title, unit, ...axes, tall: true, lines });
    const key = lines.map((l) =>
      el('span', null, el('i', { class: 'swatch', style: `background:${l.colour}` }), l.label),
    );
    card.append(el('div', { class: 'lines' }, key));
    for (const [k, v] of Object.entries(attributes)) card.setAttribute(k, v);
    return card;
  }
  const textOf = (p: StudyPoint) =>
    p.outcome !== 'completed'
      ? p.outcome
      : p.value === null
        ? 'no value'
        : format(inShownUnit(p.value, chart.unit)) + unitText(chart.unit);
  const bars = chart.points.map((p) => ({
    label: p.label,
    value: toNumber(p.value),
    low: toNumber(p.low),
    high: toNumber(p.high),
    text: textOf(p),
    title: p.note,
  }));
  return el(
    'div',
    { class: 'chart', ...attributes },
    el(
      'h4',
      null,
      title,
      unit ? ` [${unit}]` : '',
      chart.logarithmic ? el('span', { class: 'muted small' }, ' bars are logarithmic') : null,
    ),
    barList(bars, chart.logarithmic, palette[0] as string),
  );
}
