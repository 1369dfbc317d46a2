// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A scene or an isolated part at all its sizes: growth, times, and of the parts of one kind the fastest at a glance.
import { type Child, el } from '../../common/elements.ts';
import { duration, format, toNumber, words } from '../../common/format.ts';
import { lineSample } from '../charts/line_sample.ts';
import { plotCard } from '../charts/plot.ts';
import type { Bench, BenchCase } from '../data.ts';
import { engineColour } from '../run.ts';
import { folded, headRow, scroll } from '../widgets.ts';
import {
  byTime,
  dashesOf,
  engineOf,
  fastest,
  growthCurves,
  labelOf,
  leaders,
  type Subject,
  subjectsOf,
  workOf,
} from './groups.ts';
import { bars, interval, isWide, more, timesTable } from './times.ts';

const mostCurves = 8;

function growth(subject: Subject): HTMLElement | null {
  const all = growthCurves(subject);
  const curves = all.length > mostCurves ? leaders(all) : all;
  if (curves.length === 0) return null;
  const first = subject.sizes[0]?.cases[0] as BenchCase;
  const per = workOf(first) ? (toNumber(first.counts.contacts) > 0 ? 'contact point' : 'pair') : first.sizeUnit;
  const finite = (v: number) => (Number.isFinite(v) ? v : null);
  const which = curves.length < all.length ? ', of each engine the fastest at the largest size' : '';
  const title = `Time per ${per} over ${first.sizeUnit}${which}`;
  const dashes = dashesOf(curves.map((c) => c.of));
  const wide = isWide(curves.flatMap((c) => c.points.map((p) => p.y)));
  const card = plotCard({
    title,
    name: `${subject.name}: growth`,
    yTitle: `time per ${per}`,
    unit: 's',
    xTitle: first.sizeUnit,
    xUnit: '',
    logX: true,
    logY: wide,
    zeroY: !wide,
    tall: true,
    lines: curves.map(({ of, points }, i) => ({
      key: of.engine,
      label: labelOf(of),
      colour: engineColour(engineOf(of)),
      dash: dashes[i] as number[],
      width: 1.5,
      points: true,
      x: points.map((p) => p.x),
      y: points.map((p) => p.y),
      low: points.map((p) => finite(p.low)),
      high: points.map((p) => finite(p.high)),
    })),
  });
  const key = curves.map(({ of }, i) =>
    el('span', null, lineSample(engineColour(engineOf(of)), dashes[i] as number[], 2), labelOf(of)),
  );
  card.append(el('div', { class: 'lines' }, key));
  return card;
}

function subjectNode(subject: Subject): HTMLElement {
  const scene = subject.part === 'scene';
  const body = () => [
    growth(subject),
    subject.sizes.map(({ size, cases }) => {
      const first = cases[0] as BenchCase;
      const what = first.sizeUnit ? `${format(size)} ${first.sizeUnit}, ` : '';
      const shown = scene ? cases : byTime(cases);
      const scale = isWide(cases.map((c) => (c.valid ? toNumber(c.time) : NaN))) ? ', logarithmic' : '';
      return [
        el('div', { class: 'chart' }, el('h4', null, `${what}time of one ${first.operation}${scale}`), bars(shown)),
        timesTable(shown),
        more(shown),
      ];
    }),
  ];
  const attributes = { class: 'bench-subject', 'data-subject': subject.name };
  // The title of a scene's file may speak of one size.
  return scene
    ? el('div', attributes, el('h3', null, subject.name), body())
    : el('div', attributes, folded(subject.name, body));
}

/** The isolated parts of one kind: the fastest of each engine at a glance, each subject folded below. */
function partNode(part: string, subjects: Subject[]): HTMLElement {
  const rows = subjects.flatMap((s) => s.sizes.map(({ size, cases }) => ({ name: s.name, size, cases })));
  const engines = [...new Set(rows.flatMap((r) => r.cases.map(engineOf)))].sort();
  const first = rows[0]?.cases[0] as BenchCase;
  const row = ({ name, size, cases }: (typeof rows)[0]) => {
    const best = fastest(cases);
    const least = Math.min(...[...best].filter(([e]) => e !== 'interface').map(([, c]) => toNumber(c.time)));
    const cell = (engine: string) => {
      const c = best.get(engine);
      if (!c) return el('td', { class: 'num' }, cases.some((x) => engineOf(x) === engine) ? 'no timing' : '—');
      const time = duration(c.time);
      return el(
        'td',
        { class: 'num', title: `${labelOf(c)}: ${interval(c.low, c.high, duration)}` },
        toNumber(c.time) === least ? el('b', null, time) : time,
      );
    };
    const title = first.sizeUnit ? `${name}, ${format(size)} ${first.sizeUnit}` : name;
    return el('tr', null, el('th', { class: 'sticky', scope: 'row' }, title), engines.map(cell));
  };
  return el(
    'div',
    { 'data-part': part },
    el('h3', null, words(part)),
    el(
      'p',
      { class: 'muted' },
      `Time of one ${first.operation}, of each engine's fastest choice whose work was good (which: point at it).`,
    ),
    scroll(
      el(
        'table',
        { class: 'full' },
        headRow(['Subject', ...engines], (i) => i > 0),
        el('tbody', null, rows.map(row)),
      ),
    ),
    subjects.map(subjectNode),
  );
}

export function subjectsNode(bench: Bench): Child {
  const subjects = subjectsOf(bench.cases);
  const parts = [...new Set(subjects.map((s) => s.part))].filter((part) => part !== 'scene');
  return [
    subjects.filter((s) => s.part === 'scene').map(subjectNode),
    parts.map((part) =>
      partNode(
        part,
        subjects.filter((s) => s.part === part),
      ),
    ),
  ];
}
