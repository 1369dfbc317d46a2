// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor history`: what changed from run to run with its statistics, and each error and each time of a step
// over the runs. Of two runs it is a comparison.
import '../report/style.css';
import '../report/board.css';
import '../report/charts.css';
import '../report/widths.css';
import './style.css';
import { type Child, el } from '../common/elements.ts';
import { counted, duration, inShownUnit, shownUnit, timeStep, toNumber, words } from '../common/format.ts';
import type { Line } from '../report/charts/line.ts';
import { lineSample } from '../report/charts/line_sample.ts';
import { drawAllPlots, dropPlots } from '../report/charts/live_plots.ts';
import { plotCard } from '../report/charts/plot.ts';
import { themeButton } from '../report/theme.ts';
import { changeNode, differences, runTable } from './changes.ts';
import type { History, Series } from './data.ts';
import { type Mark, marksOf, weight, weightOf } from './marks.ts';
import { factor, listOf, section, sign } from './parts.ts';
import { closeReplay, replayBox } from './replays.ts';
import { caseAt, caseKey, ownName, seriesNames } from './series.ts';

const data = JSON.parse(document.getElementById('history-data')?.textContent ?? '{}') as History;
const palette = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#8C6D1F'];
const dashes = [[], [6, 4], [2, 3], [10, 4]];
const dashOf = (index: number) => dashes[Math.floor(index / palette.length) % dashes.length] as number[];
const mostCards = 12; // scenarios at once

/** "1/240 s, ×2.1 of the run before: worse": what a sample has of its own, and its change. */
function notesOf(s: Series, marks: Mark[], what: Mark['what']): string[] {
  return s.outcome.map((_, run) => {
    const mark = marks.find((m) => m.run === run && m.what === what);
    const change = mark ? `${factor(mark.ratio)} of the run before: ${mark.state}` : '';
    return [ownName(s, run, data.pair), change].filter(Boolean).join(', ');
  });
}

const value = (v: Series['error'][number]) => (Number.isFinite(toNumber(v)) ? toNumber(v) : null);

function lineOf(s: Series, index: number, label: string, of: 'error' | 'time'): Line {
  const marks = marksOf(data, s);
  const unit = of === 'error' ? s.unit : 's';
  return {
    key: '',
    label,
    colour: palette[index % palette.length] as string,
    dash: dashOf(index),
    width: 1.5,
    points: true,
    x: data.runs.map((_, i) => i + 1),
    y: s[of].map((v) => value(inShownUnit(v, unit))),
    ...(of === 'time' ? { low: s.low.map(value), high: s.high.map(value) } : {}),
    notes: notesOf(s, marks, of),
    marked: marks.filter((m) => m.what === of || (of === 'error' && m.what === 'ending')).map((m) => m.run),
  };
}

/** The changes of a scenario, the gravest first. */
function said(all: Series[], nameOf: ReturnType<typeof seriesNames>): Child {
  const marks = all.flatMap((s) => marksOf(data, s).map((m) => ({ s, m })));
  marks.sort((a, b) => weightOf(b.m) - weightOf(a.m));
  return listOf(marks, ({ s, m }) => {
    const numbers = m.what === 'time' ? ` (${duration(s.time[m.run - 1])} → ${duration(s.time[m.run])})` : '';
    const text =
      m.what === 'ending' ? `${s.outcome[m.run - 1]} → ${s.outcome[m.run]}` : `${m.what} ${factor(m.ratio)}${numbers}`;
    return [sign(m.state), `run ${m.run + 1}, ${nameOf(s, [m.run - 1, m.run])}: ${text}`];
  });
}

/** `replay`: the case whose runs are shown side by side; `chosen` gets another one. */
function scenarioNode(all: Series[], replay: string | null, chosen: (key: string | null) => void): HTMLElement {
  const first = all[0] as Series;
  const nameOf = seriesNames(all, data.pair);
  const timed = all.filter((s) => s.time.some((t) => t !== null));
  const steps = new Set(all.flatMap((s) => s.outcome.map((_, run) => toNumber(caseAt(s, run).dt))));
  const plot = (of: 'error' | 'time', list: Series[], title: string, unit: string) =>
    plotCard({
      title,
      name: `${first.scenario}: ${title}`,
      about: steps.size === 1 ? `time step ${timeStep(first.dt)}` : '',
      yTitle: title,
      unit,
      xTitle: 'run',
      wholeX: true,
      xUnit: '',
      lines: list.map((s) => lineOf(s, all.indexOf(s), nameOf(s), of)),
      zeroY: true,
    });
  const key = all.map((s, i) =>
    el('span', null, lineSample(palette[i % palette.length] as string, dashOf(i), 2), nameOf(s)),
  );
  return el(
    'article',
    { class: 'case', 'data-scenario': first.scenario },
    el('h3', null, first.scenario, ' ', el('span', { class: 'muted small' }, first.title)),
    said(all, nameOf),
    replayBox(all, nameOf, { runs: data.runs, pair: data.pair, colours: palette }, replay, chosen),
    el('div', { class: 'lines' }, key),
    el(
      'div',
      { class: 'charts' },
      first.metric ? plot('error', all, words(first.metric), shownUnit(first.unit)) : null,
      timed.length ? plot('time', timed, 'time of a step', 's') : null,
    ),
  );
}

function scenarios(): HTMLElement {
  const groups = new Map<string, Series[]>();
  for (const s of data.series) groups.set(s.scenario, [...(groups.get(s.scenario) ?? []), s]);
  const weighed = [...groups].map(([name, all]) => ({
    name,
    all,
    weight: weight(all.flatMap((s) => marksOf(data, s))),
  }));
  weighed.sort((a, b) => b.weight - a.weight);
  const engines = [...new Set(data.series.map((s) => s.engine))];
  const list = el('div', null);
  const status = el('p', { class: 'muted small', role: 'status' });
  let most = mostCards;
  const text = el('input', {
    type: 'search',
    placeholder: 'scenario',
    'aria-label': 'Scenario',
  });
  const engine = el(
    'select',
    { 'aria-label': 'Engine' },
    ['', ...engines].map((e) => el('option', { value: e }, e || 'all engines')),
  );
  const more = el('button', { class: 'button' }, 'Show more');
  let replay: string | null = null;
  const keep = () => {
    const kept = new URLSearchParams();
    if (text.value) kept.set('text', text.value);
    if (engine.value) kept.set('engine', engine.value);
    if (replay) kept.set('replay', replay);
    history.replaceState(null, '', `#${kept}`);
  };
  const replayed = (key: string | null) => {
    replay = key;
    for (const other of list.querySelectorAll<HTMLSelectElement>('[aria-label="Case to replay"]'))
      if (other.value !== key) other.value = '';
    keep();
  };
  const draw = () => {
    const wanted = text.value.toLowerCase();
    const shown = weighed
      .map((g) => ({ ...g, all: g.all.filter((s) => !engine.value || s.engine === engine.value) }))
      .filter((g) => g.all.length > 0 && `${g.name} ${g.all[0]?.title}`.toLowerCase().includes(wanted));
    const own = (g: { all: Series[] }) => Number(g.all.some((s) => caseKey(s) === replay));
    shown.sort((a, b) => own(b) - own(a)); // the rest stays in its order
    dropPlots(list);
    closeReplay();
    list.replaceChildren(...shown.slice(0, most).map((g) => scenarioNode(g.all, replay, replayed)));
    const marked = shown.filter((g) => g.weight > 0).length;
    const thing = data.pair ? 'difference' : 'change';
    const which = marked ? `${marked} with a ${thing}, those first` : `none with a ${thing}`;
    status.textContent = `${counted(shown.length, 'scenario')}, ${which}`;
    more.hidden = shown.length <= most;
    keep();
  };
  text.addEventListener('input', draw);
  engine.addEventListener('change', draw);
  more.addEventListener('click', () => {
    most += mostCards;
    draw();
  });
  /** Filters and replay as the address says. */
  const restore = () => {
    const query = new URLSearchParams(location.hash.slice(1));
    text.value = query.get('text') ?? '';
    engine.value = query.get('engine') ?? '';
    replay = query.get('replay');
    draw();
    if (replay) requestAnimationFrame(() => list.firstElementChild?.scrollIntoView());
  };
  addEventListener('hashchange', restore);
  restore();
  return section(
    'scenarios',
    'Every scenario over the runs',
    el('div', { class: 'controls' }, text, engine),
    status,
    el(
      'p',
      { class: 'muted small' },
      `A ring marks a ${data.pair ? 'difference' : 'change'}: of an error by more than 1 %, of a time by more than 10 % where the 95 % intervals of the two medians have no value in common and the times of its engine over all cases (${data.pair ? 'What differs' : 'What changed'}) are slower or faster, too. The intervals of one case hold the spread within a run, not that between runs.`,
    ),
    list,
    more,
  );
}

document
  .getElementById('top')
  ?.append(el('div', { class: 'bar' }, el('span', { class: 'brand' }, 'Rigor history'), themeButton(drawAllPlots)));
const page = document.getElementById('page') as HTMLElement;
page.replaceChildren(
  section(
    'runs',
    `${data.runs.length} runs${data.pair ? ` that differ in the ${differences[data.pair]}` : ''}`,
    runTable(data),
  ),
  section(
    'changes',
    data.pair ? 'What differs' : 'What changed',
    data.changes.map((_, i) => changeNode(data, i)),
  ),
  scenarios(),
);
page.insertBefore(el('h1', { class: 'read-aloud' }, 'History of runs'), page.firstChild);
page.dataset.shown = '1';
