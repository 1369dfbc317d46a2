// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Scenario x engine: verdict and main metric; filters and sorting.
'use strict';
Rigor.filters = {text: '', mechanism: '', dimension: '', preset: '', verdict: '', step: 'all', sort: '', descending: false};

/** Cases of a scenario on a spec, finest step first, after the choice of time steps. */
Rigor.cellCases = function (scenario, column, step) {
  const cases = scenario.cases.filter((c) => c.spec === column.spec);
  if (step === 'finest') return cases.slice(0, 1);
  if (step === 'coarsest') return cases.slice(-1);
  return cases;
};
Rigor.cellSummary = function (scenario, column, step) {
  const cases = Rigor.cellCases(scenario, column, step);
  if (!cases.length) return null;
  const worst = cases.reduce((a, b) => (Rigor.severity(b.shown) > Rigor.severity(a.shown) ? b : a));
  return {cases, worst, shown: worst.shown, at: cases[0]};
};

Rigor.scoreboard = function () {
  const {el, run, filters} = Rigor;
  const body = el('tbody');
  const count = el('span', {class: 'muted small'});
  const headHolder = el('table', {class: 'board'});

  const visibleColumns = () => run.columns.filter((c) => !filters.preset || c.preset === filters.preset);
  const matches = function (s, columns) {
    const text = [s.name, s.title, s.description, ...s.tags, ...s.isolates].join(' ').toLowerCase();
    if (filters.text && !filters.text.toLowerCase().split(/\s+/).every((word) => text.includes(word))) return false;
    if (filters.mechanism && !s.isolates.includes(filters.mechanism) && !s.tags.includes(filters.mechanism)) return false;
    if (filters.dimension && String(s.dimension) !== filters.dimension) return false;
    return !filters.verdict || columns.some((c) => Rigor.cellSummary(s, c, filters.step)?.shown === filters.verdict);
  };
  const sortKey = function (s) {
    if (filters.sort === 'name') return [0, s.name];
    if (filters.sort === 'metric') return [0, s.main.name];
    const column = run.columns.find((c) => c.spec === filters.sort);
    const cell = column && Rigor.cellSummary(s, column, filters.step);
    const value = cell ? Math.abs(Rigor.number(cell.at.value)) : NaN;
    return [cell ? Rigor.severity(cell.shown) : -1, Number.isNaN(value) ? Infinity : value];
  };
  const sorted = function (list) {
    if (!filters.sort) return list;
    const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
    const keyed = list.map((s) => [sortKey(s), s]);
    keyed.sort(([a], [b]) => compare(a[0], b[0]) || compare(a[1], b[1]));
    if (filters.descending) keyed.reverse();
    return keyed.map(([, s]) => s);
  };

  const cellNode = function (s, column, best) {
    const cell = Rigor.cellSummary(s, column, filters.step);
    if (!cell) return el('span', {class: 'muted small', title: 'not in the plan'}, '');
    const v = Rigor.verdict(cell.shown);
    const value = Rigor.number(cell.at.value);
    // A number beside a crash would be that of another time step: the word stands there instead.
    const hasValue = cell.at.value !== null && !Rigor.isLost(cell.shown);
    const words = [column.label, s.name, v.word];
    if (hasValue) words.push(`${s.main.name} ${Rigor.full(cell.at.value)} ${s.main.unit} at ${Rigor.timeStep(cell.at.dt)}`);
    if (hasValue && cell.at.bound !== null) words.push(`bound ${Rigor.format(cell.at.bound)}`);
    for (const c of cell.cases) if (cell.cases.length > 1) words.push(`${Rigor.timeStep(c.dt)}: ${Rigor.verdict(c.shown).word}`);
    if (cell.worst.reason) words.push(cell.worst.reason);
    const text = hasValue ? Rigor.format(cell.at.value) : cell.shown === 'unsupported' ? 'n/a' : v.word;
    return el('a', {class: `cell v v-${cell.shown}`, title: words.join('\n'), 'aria-label': words.slice(0, 4).join(', '),
      href: Rigor.scenarioLink(s.name, {spec: column.spec, dt: cell.worst.dt})},
      el('span', {class: 'sym', 'aria-hidden': 'true'}, v.symbol),
      el('span', {class: hasValue && value === best ? 'best' : null}, text));
  };
  const row = function (s, columns) {
    const values = columns.map((c) => Rigor.cellSummary(s, c, filters.step)).filter((cell) => cell && !Rigor.isLost(cell.shown))
      .map((cell) => Rigor.number(cell.at.value)).filter(Number.isFinite);
    const best = values.length > 1 ? Math.min(...values) : NaN;
    return el('tr', {'data-scenario': s.name},
      el('th', {class: 'sticky name', scope: 'row'}, el('a', {href: Rigor.scenarioLink(s.name)}, s.name),
        el('span', {class: 'sub'}, s.title)),
      el('td', {class: 'small'}, s.main.name ? [s.main.name, el('span', {class: 'bound'}, s.main.unit && s.main.unit !== '1' ? `in ${s.main.unit}` : '')] : '—'),
      columns.map((c, i) => el('td', {class: 'cell' + (Rigor.isFirstOfEngine(columns, i) ? ' first' : '')}, cellNode(s, c, best))));
  };
  const sortButton = function (key, ...text) {
    const active = filters.sort === key;
    return el('button', {title: 'Sort', onclick: () => {
      if (active && filters.descending) { filters.sort = ''; filters.descending = false; }
      else { filters.descending = active; filters.sort = key; }
      draw();
    }}, text, active ? (filters.descending ? ' ▼' : ' ▲') : '');
  };
  const draw = function () {
    const columns = visibleColumns();
    const list = sorted(run.scenarios.filter((s) => matches(s, columns)));
    const ariaSort = (key) => (filters.sort === key ? (filters.descending ? 'descending' : 'ascending') : null);
    headHolder.replaceChildren(
      Rigor.specHead([el('th', {class: 'sticky sort', scope: 'col', 'aria-sort': ariaSort('name')}, sortButton('name', 'Scenario')),
        el('th', {class: 'sort', scope: 'col', 'aria-sort': ariaSort('metric')}, sortButton('metric', 'Number shown'))], columns,
        (c) => el('th', {class: 'sort', scope: 'col', 'aria-sort': ariaSort(c.spec), title: c.spec}, sortButton(c.spec, Rigor.specSubtitle(c)))), body);
    body.replaceChildren(...list.map((s) => row(s, columns)));
    if (!list.length) body.append(el('tr', {}, el('td', {colspan: columns.length + 2, class: 'empty'}, 'No scenario matches these filters.')));
    count.textContent = list.length === run.scenarios.length ? `${list.length} scenarios` : `${list.length} of ${run.scenarios.length} scenarios`;
  };
  const controls = el('div', {class: 'filters'});
  const drawControls = function () {
    const set = (key) => (value) => { filters[key] = value; draw(); };
    const words = [...new Set(run.scenarios.flatMap((s) => [...s.isolates, ...s.tags]))].sort();
    const presets = [...new Set(run.columns.map((c) => c.preset))].filter(Boolean);
    const search = el('input', {type: 'search', placeholder: 'name, title, tag …', 'aria-label': 'Search', value: filters.text, oninput: (e) => set('text')(e.target.value)});
    controls.replaceChildren(el('label', {}, 'Search', search),
      Rigor.select('Mechanism or tag', [['', 'all'], ...words.map((w) => [w, w])], filters.mechanism, set('mechanism')),
      Rigor.select('Dimension', [['', '2D and 3D'], ['2', '2D'], ['3', '3D']], filters.dimension, set('dimension')),
      Rigor.select('Preset', [['', 'all'], ...presets.map((p) => [p, p])], filters.preset, set('preset')),
      Rigor.select('Verdict', [['', 'all'], ...Object.entries(run.symbols).map(([k, v]) => [k, `${v.symbol} ${v.word}`])], filters.verdict, set('verdict')),
      Rigor.select('Time step', [['all', 'worst verdict of all'], ['finest', 'finest'], ['coarsest', 'coarsest']], filters.step, set('step')),
      el('button', {class: 'button', onclick: () => {
        Object.assign(filters, {text: '', mechanism: '', dimension: '', preset: '', verdict: '', step: 'all', sort: '', descending: false});
        drawControls(); draw();
      }}, 'Reset'), count);
  };
  Rigor.filterScoreboard = function (changes) {
    Object.assign(filters, changes);
    drawControls(); draw();
    document.getElementById('scoreboard')?.scrollIntoView();
  };
  drawControls(); draw();
  const meaning = {pass: 'within its bound', no_bound: 'ran, nothing was demanded', known_deviation: 'off, as recorded and explained', fail: 'misses its bound',
    non_finite: 'NaN or infinity', timeout: 'over the time limit', crashed: 'the process died', unsupported: 'the engine cannot do it'};
  return Rigor.panel('scoreboard', 'Scoreboard',
    el('p', {class: 'muted'}, 'Every cell is one engine in one preset: the worst verdict over the time steps, and the number at the finest step. ',
      'Smaller is better; the best of a row is underlined. Every cell opens its case.'),
    el('div', {class: 'legend'}, Object.entries(run.symbols).map(([key, v]) => Rigor.chip(key, `${v.word}: ${meaning[key]}`))),
    controls, Rigor.scroll(headHolder));
};
