// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenario x engine: grade, change against the record, relative error and cost of a step in one cell; filters and order.
import { type Child, el } from '../../common/elements.ts';
import {
  counted,
  duration,
  format,
  inShownUnit,
  ratio,
  shownUnit,
  timeStep,
  toNumber,
  unitText,
  words,
} from '../../common/format.ts';
import { type Cell, cellOf, costOf, errorOf, gradeOf, isLost, logPlace, relativeOf } from '../cells.ts';
import type { Column, Scenario, Shown } from '../data.ts';
import { decidingText, mainText } from '../deciding.ts';
import {
  clockOf,
  dimensionNote,
  dimensionsOf,
  isFirstOfEngine,
  run,
  scenarioLink,
  subtitleOf,
  verdictText,
} from '../run.ts';
import { changeMark, chip, gradeBar, gradeChip, panel, select, specHead } from '../widgets.ts';
import { engineChoice } from './engine_choice.ts';
import {
  allScenarios,
  chosenColumns,
  type Filters,
  filters,
  type Group,
  grouped,
  matches,
  ordered,
  type RowScale,
  rowScale,
  scoreboardLink,
} from './filters.ts';
import { withPreview } from './preview.ts';

const meaning: Record<Shown, string> = {
  pass: 'ran, within the bounds that hold everywhere (contacts) or that its scenario sets',
  no_bound: 'ran',
  no_reference: 'ran, but its reference could not be computed',
  known_deviation: 'wrong physics, with a reason on file',
  fail: 'misses a bound that its scenario sets, or was not as requested',
  non_finite: 'NaN or infinity',
  timeout: 'over the time limit',
  crashed: 'the process died',
  unsupported: '“not yet”: not in the adapter yet, “n/a”: the library has none',
};

/** The fastest of the row among those whose times are of the same clock. */
const leastCost = (scale: RowScale, column: Column): number => scale.leastCost.get(clockOf(column)) ?? NaN;

/** Content of the cell in words, for its tooltip and for screen readers. */
function sentence(s: Scenario, column: Column, cell: Cell, scale: RowScale): string[] {
  const { at, worst, cases } = cell;
  const lines = [`${column.label}, ${s.name}: ${verdictText(worst.shown).word}`, at.judged.says];
  if (at.judged.orders) lines.push(at.judged.orders.says);
  if (at.judged.change) lines.push(at.judged.change);
  if (at.value !== null && !isLost(worst.shown)) {
    const times = [
      ratio(at.judged.toBest) ? `${ratio(at.judged.toBest)} the best` : '',
      ratio(at.judged.toOurs) ? `${ratio(at.judged.toOurs)} ours` : '',
    ].filter(Boolean);
    const beside = times.length ? ` (${times.join(', ')})` : '';
    lines.push(
      `${words(s.main.name)} ${format(inShownUnit(at.value, s.main.unit), 6)}${unitText(s.main.unit)} at ${timeStep(at.dt)}${beside}`,
    );
    if (at.range) lines.push(`${words(s.main.name)} ${at.range}`);
  }
  const cost = costOf(cell);
  if (cost > 0) {
    const clock = clockOf(column) ? ` (${clockOf(column)})` : '';
    lines.push(`${duration(cost)} a step${clock}, ${ratio(cost / leastCost(scale, column))} the fastest here`);
  }
  if (worst.miss) {
    const { name, subject, value, bound, boundMin } = worst.miss;
    const isBelow = toNumber(value) < toNumber(boundMin);
    const relation = isBelow ? `below ${format(boundMin)}` : `${ratio(toNumber(value) / toNumber(bound))} its bound`;
    lines.push(`furthest off: ${words(name)} ${subject} ${format(value)}, ${relation}`);
  }
  if (cases.length > 1) for (const c of cases) lines.push(`${timeStep(c.dt)}: ${verdictText(c.shown).word}`);
  if (worst.reason) lines.push(worst.reason);
  return lines;
}

function said(s: Scenario, column: Column, cell: Cell, number: Filters['number'], digits: number): string {
  const { shown } = cell.worst;
  if (shown === 'unsupported' && !dimensionsOf(column.engine).includes(s.dimension)) {
    const note = dimensionNote(column.engine);
    if (note) return note;
  }
  if (shown === 'unsupported') return cell.worst.refusal === 'adapter' ? 'not yet' : 'n/a';
  if (isLost(shown)) return verdictText(shown).word;
  if (number === 'cost') return duration(costOf(cell));
  if (number === 'relative' && !Number.isNaN(relativeOf(cell))) return format(relativeOf(cell), digits);
  if (number === 'best') return ratio(cell.at.judged.toBest) || '—';
  if (number === 'ours') return ratio(cell.at.judged.toOurs) || '—';
  return cell.at.value === null ? verdictText(shown).word : format(inShownUnit(cell.at.value, s.main.unit), digits);
}

/** ⇅ where the orders of any time step disagree about the verdict, else what the time step shown has. */
function orderMark(cell: Cell): string {
  const marks = cell.cases.map((c) => c.judged.orders?.mark ?? '');
  return marks.includes('⇅') ? '⇅' : (marks.find(Boolean) ?? '');
}

const manyColumns = 10; // number of columns from which cells are narrow

const meter = (kind: string, place: number): HTMLElement | null =>
  Number.isNaN(place) ? null : el('i', { class: `meter ${kind}`, style: `--fill:${(100 * place).toFixed(1)}%` });

function cellNode(s: Scenario, column: Column, scale: RowScale, f: Filters, digits: number): Child {
  const cell = cellOf(s, column, f.step);
  if (cell === null) return el('span', { class: 'muted small', title: 'not in the plan' });
  const lines = sentence(s, column, cell, scale);
  const { shown } = cell.worst;
  const grade = gradeOf(cell);
  const best = f.number !== 'cost' && (f.number === 'error' ? errorOf : relativeOf)(cell) === scale.bestError;
  const sign = [
    grade || verdictText(shown).symbol,
    grade && shown !== 'pass' && shown !== 'no_bound' ? verdictText(shown).symbol : '',
    cell.cases.map((c) => changeMark(c.judged.regression)).find(Boolean) ?? '',
    orderMark(cell),
  ].join('');
  return el(
    'a',
    {
      class: `cell v ${grade ? `g-${grade}` : `v-${shown === 'pass' ? 'no_bound' : shown}`}${cell.cases.some((c) => c.judged.red) ? ' red' : ''}`,
      title: lines.join('\n'),
      'aria-label': [`${sign} ${said(s, column, cell, f.number, digits)}`, ...lines.slice(0, 3)].join('; '),
      tabindex: -1,
      href: scenarioLink(s.name, { spec: column.spec, dt: cell.worst.dt }),
    },
    el('span', { class: 'sym', 'aria-hidden': 'true' }, sign),
    ' ',
    el('span', { class: best ? 'value best' : 'value' }, said(s, column, cell, f.number, digits)),
    meter('error', logPlace(relativeOf(cell), 1e-6, 1)),
    meter('cost', logPlace(costOf(cell), leastCost(scale, column), 1000 * leastCost(scale, column))),
  );
}

/** Grades of a column over the scenarios that are shown, and how many runs were lost. */
function totalCell(list: Scenario[], column: Column, f: Filters, first: boolean): HTMLElement {
  const grades = [0, 0, 0, 0, 0];
  let [ran, gone] = [0, 0];
  for (const s of list) {
    const cell = cellOf(s, column, f.step);
    if (cell === null || cell.worst.shown === 'unsupported') continue;
    ++ran;
    if (isLost(cell.worst.shown)) ++gone;
    const place = 'ABCDE'.indexOf(gradeOf(cell) || '-');
    if (place >= 0) grades[place] = (grades[place] as number) + 1;
  }
  const graded = grades.reduce((sum, n) => sum + n, 0);
  const near = (grades[0] as number) + (grades[1] as number) + (grades[2] as number);
  const parts = graded ? [`${near} of ${graded}`, '≤ 1e-2'] : [`${ran} ran`]; // lines of a narrow column
  return el(
    'td',
    { class: `total${first ? ' first' : ''}`, 'data-spec': column.spec, 'data-ran': ran },
    gradeBar(grades),
    el(
      'span',
      { class: 'small' },
      parts.map((text) => [el('span', null, text), ' ']),
    ),
    gone ? el('span', { class: 'small bad' }, ` ${gone} lost`) : null,
  );
}

function totalRow(list: Scenario[], columns: Column[], f: Filters): HTMLElement {
  const head = el('th', { class: 'sticky name', scope: 'row' }, `All ${list.length} shown`);
  head.append(el('span', { class: 'sub metric' }, 'scenarios by grade'));
  const cells = columns.map((c, i) => totalCell(list, c, f, isFirstOfEngine(columns, i)));
  return el('tr', { class: 'totals' }, head, cells);
}

function groupRow({ title, about, scenarios }: Group, columns: Column[]): HTMLElement {
  const head = el('th', { class: 'sticky', scope: 'rowgroup' }, `${title} `);
  head.append(el('span', { class: 'sub' }, `${counted(scenarios.length, 'scenario')}: ${about}`));
  return el('tr', { class: 'task-group', title: about }, head, el('td', { colspan: columns.length }));
}

function row(s: Scenario, columns: Column[], f: Filters): HTMLElement {
  const scale = rowScale(s, columns, f.step, f.number);
  const isGraded = s.cases.some((c) => c.judged.relative !== null);
  const metric =
    f.number === 'relative' && isGraded
      ? decidingText(s)
      : f.number === 'best'
        ? 'relative error ÷ best'
        : f.number === 'ours'
          ? 'relative error ÷ ours'
          : f.number === 'cost'
            ? 'time of a step'
            : s.main.name
              ? `${isGraded ? '' : 'not graded: '}${mainText(s)}${s.main.unit && s.main.unit !== '1' ? ` [${shownUnit(s.main.unit)}]` : ''}`
              : 'no metric';
  return el(
    'tr',
    { 'data-scenario': s.name },
    el(
      'th',
      { class: 'sticky name', scope: 'row' },
      withPreview(el('a', { href: scenarioLink(s.name), title: s.description }, s.name), s),
      el('span', { class: 'sub', title: s.title }, s.title),
      el('span', { class: 'sub metric', title: 'the number shown' }, metric),
    ),
    columns.map((c, i) =>
      el(
        'td',
        { class: `cell${isFirstOfEngine(columns, i) ? ' first' : ''}` },
        cellNode(s, c, scale, f, columns.length > manyColumns ? 2 : 3),
      ),
    ),
  );
}

function sortButton(f: Filters, key: string, text: string): HTMLElement {
  const active = f.sort === key;
  const next = active && f.descending ? { sort: '', descending: false } : { sort: key, descending: active };
  const mark = active ? (f.descending ? ' ▼' : ' ▲') : '';
  return el(
    'button',
    { 'aria-label': `Sort by ${text}`, title: 'Sort', onclick: () => filters.set({ ...f, ...next }) },
    text,
    mark,
  );
}
const ariaSort = (f: Filters, key: string) => (f.sort === key ? (f.descending ? 'descending' : 'ascending') : null);

/** Arrow keys go from cell to cell; one of them is in the order of the Tab key. */
function arrowKeys(body: HTMLElement): void {
  const links = (tr: Element | null) => [...(tr?.querySelectorAll<HTMLElement>('td.cell') ?? [])];
  body.addEventListener('keydown', (e) => {
    const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[e.key];
    const td = (e.target as Element).closest('td.cell');
    if (!step || !td) return;
    e.preventDefault();
    const tr = td.parentElement as HTMLElement;
    const rows = [...body.querySelectorAll('tr[data-scenario]')];
    const cells = links(rows[rows.indexOf(tr) + (step[0] as number)] ?? null);
    const next =
      cells[links(tr).indexOf(td as HTMLElement) + (step[1] as number)]?.querySelector<HTMLElement>('a.cell');
    if (!next) return;
    for (const old of body.querySelectorAll('a.cell[tabindex="0"]')) old.setAttribute('tabindex', '-1');
    next.setAttribute('tabindex', '0');
    next.focus();
  });
}

function controls(f: Filters): HTMLElement[] {
  const set = (changes: Partial<Filters>) => filters.set({ ...filters.value, ...changes });
  const named = [...new Set(run.scenarios.flatMap((s) => [...s.isolates, ...s.tags]))].sort();
  const presets = [...new Set(run.columns.map((c) => c.preset))].filter(Boolean);
  const verdicts = Object.entries(run.symbols).map(([k, v]): [string, string] => [k, `${v.symbol} ${v.word}`]);
  const grades = run.grades.filter((g) => g.name).map((g): [string, string] => [g.name, `${g.name}: ${g.meaning}`]);
  const changes = Object.keys(run.regressions).map((k): [string, string] => [k, k]);
  const all = (text: string): [string, string] => ['', text];
  const search = el('input', {
    type: 'search',
    placeholder: 'name, title, tag …',
    'aria-label': 'Search',
    value: f.text,
    oninput: (e: Event) => set({ text: (e.target as HTMLInputElement).value }),
  });
  return [
    el('label', null, 'Search', search),
    select('Task', [all('all'), ...run.tasks.map((t): [string, string] => [t.name, t.title])], f.task, (task) =>
      set({ task }),
    ),
    select('Mechanism or tag', [all('all'), ...named.map((w): [string, string] => [w, w])], f.mechanism, (mechanism) =>
      set({ mechanism }),
    ),
    select('Dimension', [all('2D and 3D'), ['2', '2D'], ['3', '3D']], f.dimension, (dimension) => set({ dimension })),
    select('Preset', [all('all'), ...presets.map((p): [string, string] => [p, p])], f.preset, (preset) =>
      set({ preset }),
    ),
    select('Grade', [all('all'), ...grades], f.grade, (grade) => set({ grade })),
    select('Record', [all('all'), ...changes], f.change, (change) => set({ change })),
    select('Ending', [all('all'), ...verdicts], f.verdict, (verdict) => set({ verdict })),
    select(
      'Time step',
      [
        ['all', 'all'],
        ['finest', 'finest'],
        ['coarsest', 'coarsest'],
      ],
      f.step,
      (step) => set({ step: step as Filters['step'] }),
    ),
    select(
      'Number',
      [
        ['relative', 'relative error'],
        ['error', 'main metric'],
        ['best', 'relative error ÷ best'],
        ['ours', 'relative error ÷ ours'],
        ['cost', 'time of a step'],
      ],
      f.number,
      (number) => set({ number: number as Filters['number'] }),
    ),
    select(
      'Groups',
      [
        ['task', 'by task'],
        ['none', 'none'],
      ],
      f.group,
      (group) => set({ group: group as Filters['group'] }),
    ),
    el('button', { class: 'button', onclick: () => filters.set({ ...allScenarios }) }, 'Reset'),
    engineChoice(f, set),
  ];
}

function legend(): HTMLElement {
  const sample = el(
    'span',
    { class: 'cell v g-C sample', 'aria-hidden': 'true' },
    el('span', { class: 'sym' }, 'C'),
    el('span', { class: 'value' }, '0.0012'),
    meter('error', 0.5),
    meter('cost', 0.3),
  );
  return el(
    'div',
    { class: 'legend' },
    sample,
    el(
      'span',
      { class: 'small muted' },
      'The letter is the grade of accuracy at the finest time step: the worst error over the metrics that the scenario names, each over the scenario’s own scale. ',
      'The number is that relative error; the best of a row is underlined. A scene without an exact solution has no letter: its cells are grey, with how the run ended and its main metric. ▼ ▲: worse or better than on record. ',
      run.scenarios.some((s) => s.cases.some((c) => c.judged.orders))
        ? '↕: depends on the order in which bodies, shapes, joints and forces are handed over; number and grade are of the order as written. ⇅: so does the verdict, or how the run ends. '
        : '',
      el('b', null, 'Upper bar: that relative error'),
      ', empty at 1e-6, full at 1. ',
      el('b', null, 'Lower bar: cost'),
      ' of a step, empty for the fastest engine of the row whose times are of the same clock, full at a thousand times that. Both logarithmic; short and short is good.',
    ),
    el(
      'div',
      null,
      run.grades.filter((g) => g.name).map((g) => gradeChip(g.name, `${g.name} ${g.meaning}`)),
      (Object.keys(run.symbols) as Shown[])
        .filter((key) => run.symbols[key].count > 0)
        .map((key) => chip(key, `${verdictText(key).word}: ${meaning[key]}`)),
    ),
  );
}

/** The filters stand in the address while the scoreboard is on the page. */
function keepInAddress(f: Filters): void {
  if (!location.hash.startsWith('#/')) history.replaceState(history.state, '', scoreboardLink(f));
}

const phone = 700; // [px] narrower pages show the table first

/** Open where there is room. */
const fold = (title: string, content: HTMLElement): HTMLElement =>
  el('details', { class: 'fold', open: innerWidth > phone }, el('summary', null, title), content);

let unfollow = () => {};

export function scoreboard(): HTMLElement {
  const table = el('table', { class: 'board' });
  const count = el('span', { class: 'muted small', role: 'status' });
  const bar = el('div', { class: 'filters' });
  const draw = (f: Filters) => {
    const columns = chosenColumns(f);
    const list = ordered(
      run.scenarios.filter((s) => matches(s, columns, f)),
      run.columns,
      f,
    );
    const name = el(
      'th',
      { class: 'sticky sort', scope: 'col', 'aria-sort': ariaSort(f, 'name') },
      sortButton(f, 'name', 'Scenario'),
    );
    const head = specHead([name], columns, (c, i) =>
      el(
        'th',
        {
          class: `sort${isFirstOfEngine(columns, i) ? ' first' : ''}`,
          scope: 'col',
          'aria-sort': ariaSort(f, c.spec),
          title: c.spec,
        },
        sortButton(f, c.spec, subtitleOf(c)),
      ),
    );
    const body = el(
      'tbody',
      null,
      list.length > 1 ? totalRow(list, columns, f) : null,
      grouped(list, f).map((group) => [
        group.title ? groupRow(group, columns) : null,
        group.scenarios.map((s) => row(s, columns, f)),
      ]),
    );
    if (list.length === 0)
      body.append(
        el('tr', null, el('td', { colspan: columns.length + 1, class: 'empty' }, 'No scenario matches these filters.')),
      );
    body.querySelector('a.cell')?.setAttribute('tabindex', '0');
    arrowKeys(body);
    table.replaceChildren(head, body);
    table.classList.toggle('dense', columns.length > manyColumns);
    count.textContent =
      list.length === run.scenarios.length
        ? counted(list.length, 'scenario')
        : `${list.length} of ${counted(run.scenarios.length, 'scenario')}`;
  };
  const redraw = (f: Filters) => {
    // The search field keeps its focus while one types.
    if (!bar.contains(document.activeElement)) bar.replaceChildren(...controls(f), count);
    else if (f === allScenarios || Object.entries(allScenarios).every(([k, v]) => f[k as keyof Filters] === v))
      bar.replaceChildren(...controls(f), count);
    draw(f);
    keepInAddress(f);
  };
  keepInAddress(filters.value);
  bar.replaceChildren(...controls(filters.value), count);
  draw(filters.value);
  unfollow();
  unfollow = filters.follow(redraw);
  return panel(
    'scoreboard',
    'Scoreboard',
    el(
      'p',
      { class: 'muted' },
      'Every cell is one engine in one preset, and opens its case. Accuracy and regression are two questions: how near a run is to the physics, ',
      'and whether it changed against the record of its version. In each task the scenarios on which engines differ most come first.',
    ),
    fold('How to read a cell', legend()),
    fold('Filters', bar),
    el('div', { class: 'scroll wide' }, table),
  );
}
