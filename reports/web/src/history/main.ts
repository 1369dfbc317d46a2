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
import { counted, duration, format, inShownUnit, shownUnit, timeStep, toNumber, words } from '../common/format.ts';
import type { Line } from '../report/charts/line.ts';
import { lineSample } from '../report/charts/line_sample.ts';
import { drawAllPlots, dropPlots } from '../report/charts/live_plots.ts';
import { plotCard } from '../report/charts/plot.ts';
import { themeButton } from '../report/theme.ts';
import type { Change, History, Series } from './data.ts';
import { type Mark, marksOf, weight } from './marks.ts';
import { caseKey, closeReplay, replayable, replayBox } from './replays.ts';

const data = JSON.parse(document.getElementById('history-data')?.textContent ?? '{}') as History;
const palette = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#8C6D1F'];
const dashes = [[], [6, 4], [2, 3], [10, 4]];
const dashOf = (index: number) => dashes[Math.floor(index / palette.length) % dashes.length] as number[];
const mostListed = 12; // changes of one kind
const mostCards = 12; // scenarios at once

const section = (id: string, title: string, ...content: Child[]) =>
  el('section', { class: 'panel', id }, el('h2', null, title), content);
/** A head over numbers stands to the right, as they do. */
function table(heads: Child[], rows: HTMLElement[]): HTMLElement {
  const kind = (i: number) => (rows[0]?.children[i]?.classList.contains('num') ? 'num' : null);
  const head = heads.map((h, i) => el('th', { scope: 'col', class: kind(i) }, h));
  return el(
    'div',
    { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table, scrolls sideways' },
    el('table', { class: 'full' }, el('thead', null, el('tr', null, head)), el('tbody', null, rows)),
  );
}

function runTable(): HTMLElement {
  const engines = [...new Set(data.runs.flatMap((r) => Object.keys(r.versions)))];
  const rows = data.runs.map((run, i) => {
    const before = data.runs[i - 1];
    const versions = engines.map((name) => {
      const changed = before !== undefined && before.versions[name] !== run.versions[name];
      return el('td', { class: changed ? 'changed' : null }, run.versions[name] ?? '—');
    });
    return el(
      'tr',
      null,
      el('th', { scope: 'row' }, String(i + 1)),
      el('td', null, run.name),
      el('td', null, run.started),
      el('td', { class: 'num' }, run.cases),
      versions,
    );
  });
  return table(['Run', 'Folder', 'Started', 'Cases', ...engines], rows);
}

const probability = (p: number) => (p < 1e-4 ? '< 0.0001' : String(Number(p.toPrecision(2))));
const sign = (worse: boolean) => el('span', { class: worse ? 'worse' : 'better' }, worse ? '▼ ' : '▲ ');
const factor = (ratio: number) => (Number.isFinite(ratio) ? `×${Number(ratio.toPrecision(3))}` : 'from nothing');

function specRow(s: Change['specs'][number]): HTMLElement {
  const interval = s.time_interval ? ` (${s.time_interval.map((x) => x.toPrecision(3)).join(' … ')})` : '';
  return el(
    'tr',
    { 'data-spec': s.name },
    el('th', { scope: 'row' }, s.name),
    el('td', { class: 'num' }, s.better),
    el('td', { class: 'num' }, s.worse),
    el('td', { class: 'num' }, s.same),
    el('td', { class: 'num' }, probability(s.p_errors)),
    el('td', { class: 'num' }, s.time_ratio === null ? '—' : `${factor(s.time_ratio)}${interval}`),
    el('td', { class: 'num' }, s.timed ? probability(s.p_time) : '—'),
  );
}

const withReplay = new Set(replayable(data.series).map(caseKey));
/** A link to the runs of a case side by side, where the page has them. */
const replayLink = (key: string): Child =>
  withReplay.has(key) ? [' ', el('a', { href: `#${new URLSearchParams({ replay: key })}` }, 'side by side')] : null;

const pairs =
  '`rigor compare --pair dt`, `spec` or `engine` compares runs with other time steps, settings and engines.';
const noCase = `They have no case in common. ${pairs}`;
const otherCases = (change: Change): string => (change.only_before.length && change.only_after.length ? pairs : '');

function changeNode(change: Change | null, index: number): HTMLElement {
  const title = `Run ${index + 1} to ${index + 2}: ${data.runs[index]?.name} → ${data.runs[index + 1]?.name}`;
  if (change === null) return el('div', null, el('h3', null, title), el('p', null, noCase));
  const listed = <T>(all: T[], line: (x: T) => Child): Child =>
    all.length === 0
      ? null
      : el(
          'ul',
          null,
          all.slice(0, mostListed).map((x) => el('li', null, line(x))),
          all.length > mostListed ? el('li', { class: 'muted' }, `and ${all.length - mostListed} more`) : null,
        );
  const where = (x: { scenario: string; spec: string; dt: number }) => `${x.scenario}, ${x.spec}, ${timeStep(x.dt)}`;
  const value = (v: Change['metrics'][number]['before'], unit: string) =>
    `${format(inShownUnit(v, unit))}${unit === '1' ? '' : ` ${shownUnit(unit)}`}`;
  const notes = [
    change.changed_scenarios.length ? `Physics differ in ${change.changed_scenarios.join(', ')}: not compared` : '',
    change.only_before.length ? `${counted(change.only_before.length, 'case')} gone` : '',
    change.only_after.length ? `${counted(change.only_after.length, 'case')} new` : '',
    ...change.environment,
  ].filter(Boolean);
  return el(
    'div',
    { class: 'change', 'data-to': index + 1 },
    el('h3', null, title),
    change.verdicts.length + change.metrics.length === 0
      ? el('p', null, `No ending and no error of the cases that both have changed. ${otherCases(change)}`)
      : null,
    listed(change.verdicts, (v) => [
      sign(v.worse),
      `${where(v)}: ${v.before} → ${v.after}`,
      v.reason ? `, ${v.reason}` : '',
      replayLink(caseKey(v)),
    ]),
    listed(change.metrics, (m) => [
      sign(m.worse),
      `${where(m)}: ${words(m.metric)} ${value(m.before, m.unit)} → ${value(m.after, m.unit)}`,
      replayLink(caseKey(m)),
    ]),
    table(
      ['Engine', 'Errors better', 'worse', 'same', 'p', 'Time of a step, after ÷ before', 'p'],
      change.specs.map(specRow),
    ),
    notes.length ? el('p', { class: 'muted small' }, `${notes.join('; ')}.`) : null,
  );
}

/** "error ×2.1 (worse)" at the samples where something changed. */
function notesOf(marks: Mark[], what: Mark['what'], runs: number): string[] {
  return Array.from({ length: runs }, (_, run) => {
    const mark = marks.find((m) => m.run === run && m.what === what);
    return mark ? `${factor(mark.ratio)} of the run before: ${mark.worse ? 'worse' : 'better'}` : '';
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
    notes: notesOf(marks, of, data.runs.length),
    marked: marks.filter((m) => m.what === of || (of === 'error' && m.what === 'ending')).map((m) => m.run),
  };
}

/** `replay`: the case whose runs are shown side by side; `changed` gets another one. */
function scenarioNode(all: Series[], replay: string | null, changed: (key: string | null) => void): HTMLElement {
  const first = all[0] as Series;
  const steps = new Set(all.map((s) => toNumber(s.dt))).size;
  const label = (s: Series) => s.label + (steps > 1 ? `, ${timeStep(s.dt)}` : '');
  const timed = all.filter((s) => s.time.some((t) => t !== null));
  const plot = (of: 'error' | 'time', list: Series[], title: string, unit: string) =>
    plotCard({
      title,
      name: `${first.scenario}: ${title}`,
      unit,
      xTitle: 'run',
      wholeX: true,
      xUnit: '',
      lines: list.map((s) => lineOf(s, all.indexOf(s), label(s), of)),
      zeroY: true,
    });
  const marks = all.flatMap((s) => marksOf(data, s).map((m) => ({ s, m })));
  const said = marks.slice(0, mostListed).map(({ s, m }) => {
    const numbers = m.what === 'time' ? ` (${duration(s.time[m.run - 1])} → ${duration(s.time[m.run])})` : '';
    const text =
      m.what === 'ending' ? `${s.outcome[m.run - 1]} → ${s.outcome[m.run]}` : `${m.what} ${factor(m.ratio)}${numbers}`;
    return el('li', null, sign(m.worse), `run ${m.run + 1}, ${label(s)}: ${text}`);
  });
  const key = all.map((s, i) =>
    el('span', null, lineSample(palette[i % palette.length] as string, dashOf(i), 2), label(s)),
  );
  return el(
    'article',
    { class: 'case', 'data-scenario': first.scenario },
    el('h3', null, first.scenario, ' ', el('span', { class: 'muted small' }, first.title)),
    said.length ? el('ul', { class: 'small' }, said) : null,
    marks.length > mostListed
      ? el('p', { class: 'muted small' }, `and ${marks.length - mostListed} more changes`)
      : null,
    replayBox(all, data.runs, palette, replay, changed),
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
    const changed = shown.filter((g) => g.weight > 0).length;
    status.textContent = `${counted(shown.length, 'scenario')}, ${changed} with a change, those first`;
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
      'A ring marks a change: of an error by more than 1 %, of a time by more than 10 % where also the 95 % intervals of the two medians have no value in common.',
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
  section('runs', `${data.runs.length} runs`, runTable()),
  section('changes', 'What changed', data.changes.map(changeNode)),
  scenarios(),
);
page.insertBefore(el('h1', { class: 'read-aloud' }, 'History of runs'), page.firstChild);
page.dataset.shown = '1';
