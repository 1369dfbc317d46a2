// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Curves of one scenario at one time step: all engines and the reference over each other. A chart is made
// when it scrolls into view.
'use strict';
Rigor.liveCharts = [];
Rigor.dropCharts = function () {
  for (const chart of Rigor.liveCharts) chart.destroy();
  Rigor.liveCharts = [];
};

/** [{title, unit, lines: [{spec | reference, points}]}] of the cases of one time step. */
Rigor.collectCurves = function (scenario, cases, body) {
  const plots = new Map();
  const add = function (key, title, unit, spec, times, values) {
    if (!values) return;
    if (!plots.has(key)) plots.set(key, {key, title, unit, lines: [], referenceLabel: Rigor.referenceLabel(cases)});
    plots.get(key).lines.push({spec, points: values.map((y, i) => ({x: times[i], y: Number.isFinite(y) ? y : null}))});
  };
  const axis = ['x', 'y', 'z'];
  for (const c of cases) {
    if (!c.curves) continue;
    const times = Rigor.unpack(c.curves.t);
    const bodies = (list, spec) => {
      const found = (list || []).find((b) => b.name === body);
      if (found) found.position.forEach((packed, k) => add(`p${k}`, `${body}: position ${axis[k]}`, 'm', spec, times, Rigor.unpack(packed)));
    };
    bodies(c.curves.reference, null);
    bodies(c.curves.bodies, c.spec);
    for (const s of c.curves.series) {
      if (s.subject && s.subject !== body && (scenario.observed.includes(s.subject) || Rigor.bodyNames(cases).includes(s.subject))) continue;
      add(`${s.name}/${s.subject}`, s.name.replaceAll('_', ' ') + (s.subject ? `: ${s.subject}` : ''), s.unit, c.spec, s.t ? Rigor.unpack(s.t) : times, Rigor.unpack(s.y));
    }
  }
  const moving = (plot) => plot.lines.some((l) => l.points.some((p) => p.y !== null && Math.abs(p.y) > 1e-12));
  return [...plots.values()].filter(moving);
};
/** A recording is not the exact solution, and is not called so. */
Rigor.referenceLabel = (cases) => (cases.some((c) => c.metrics.some((m) => m.kind === 'measured')) ? 'recorded motion' : 'exact reference');
Rigor.bodyNames = (cases) => [...new Set(cases.flatMap((c) => (c.curves ? c.curves.bodies.map((b) => b.name) : [])))];

/** Logarithmic where non-negative values spread over more than three decades. */
Rigor.wantsLog = function (plot) {
  const values = plot.lines.flatMap((l) => l.points.map((p) => p.y)).filter((y) => y !== null);
  const positive = values.filter((y) => y > 0);
  return /error|drift|residual/.test(plot.key) && values.every((y) => y >= 0) && positive.length > 1 && Math.max(...positive) / Math.min(...positive) > 1e3;
};

Rigor.lineSample = function (colour, dash, width) {
  const ns = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(ns, 'svg');
  svg.setAttribute('width', 26); svg.setAttribute('height', 10);
  const line = document.createElementNS(ns, 'line');
  for (const [k, v] of Object.entries({x1: 0, y1: 5, x2: 26, y2: 5, stroke: colour, 'stroke-width': width, 'stroke-dasharray': dash.join(' ')})) line.setAttribute(k, v);
  svg.append(line);
  return svg;
};

/**
 * A card with one chart, made when it comes into view; never once its page was left, though the browser may
 * tell of it that late. `shown` tells whether a spec is on; returns {node, refresh, draw}.
 */
Rigor.chartCard = function (plot, shown, focus) {
  const {el} = Rigor;
  const canvas = el('canvas', {role: 'img', 'aria-label': plot.title});
  let chart = null, log = Rigor.wantsLog(plot);
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const dataset = function (line) {
    const column = Rigor.run.columns.find((c) => c.spec === line.spec);
    const data = log ? line.points.map((p) => ({x: p.x, y: p.y > 0 ? p.y : null})) : line.points;
    const base = {data, pointRadius: 0, pointHitRadius: 6, tension: 0, spanGaps: false};
    if (!column) return {...base, label: plot.referenceLabel, borderColor: style('--reference'), borderWidth: 6, order: 1};
    return {...base, label: column.label, spec: line.spec, borderColor: Rigor.engineColour(column.engine), borderDash: Rigor.dashOf(column),
      borderWidth: line.spec === focus ? 3 : 1.6, hidden: !shown(line.spec)};
  };
  const tick = {color: style('--muted'), font: {size: 11}};
  const make = function () {
    if (chart) { chart.destroy(); Rigor.liveCharts = Rigor.liveCharts.filter((c) => c !== chart); }
    const grid = {color: style('--line'), borderColor: style('--line')};
    chart = new Chart(canvas, {type: 'line', data: {datasets: plot.lines.map(dataset)}, options: {
      animation: false, parsing: false, normalized: true, responsive: true, maintainAspectRatio: false,
      interaction: {mode: 'nearest', axis: 'x', intersect: false},
      scales: {x: {type: 'linear', grid, ticks: {...tick, maxTicksLimit: 7}, title: {display: true, text: 't [s]', color: style('--muted'), font: {size: 11}}},
        y: {type: log ? 'logarithmic' : 'linear', grid, ticks: {...tick, maxTicksLimit: 7, callback: (v) => Rigor.tick(v)}}},
      plugins: {legend: {display: false}, tooltip: {callbacks: {title: (items) => items.length ? `t = ${Rigor.format(items[0].parsed.x)} s` : '',
        label: (item) => `${item.dataset.label}: ${Rigor.format(item.parsed.y)}${Rigor.unit(plot.unit)}`}}}}});
    Rigor.liveCharts.push(chart);
  };
  const button = el('button', {class: 'button noprint', 'aria-pressed': String(log), onclick: () => {
    log = !log; button.setAttribute('aria-pressed', String(log)); make();
  }}, 'log');
  const node = el('div', {class: 'chart'}, el('h4', {}, el('span', {}, plot.title, plot.unit && plot.unit !== '1' ? el('span', {class: 'muted'}, ` [${plot.unit}]`) : ''), button), el('div', {class: 'box'}, canvas));
  if ('IntersectionObserver' in window) {
    const watcher = new IntersectionObserver((entries) => {
      if (!chart && node.isConnected && entries.some((e) => e.isIntersecting)) { watcher.disconnect(); make(); }
    }, {rootMargin: '300px'});
    watcher.observe(node);
  } else requestAnimationFrame(() => { if (!chart && node.isConnected) make(); });
  const refresh = function () {
    if (!chart) return;
    for (const d of chart.data.datasets) if (d.spec) d.hidden = !shown(d.spec);
    chart.update('none');
  };
  return {node, refresh, draw: () => { if (!chart) make(); }};
};

/** Toggles, body choice and all charts of a scenario at one time step. */
Rigor.curvesPanel = function (scenario, cases, focus) {
  const {el} = Rigor;
  const withCurves = cases.filter((c) => c.curves);
  if (!withCurves.length) return null;
  const names = Rigor.bodyNames(cases);
  const hidden = Rigor.hiddenSpecs = Rigor.hiddenSpecs || new Set();
  const columns = Rigor.run.columns.filter((c) => withCurves.some((x) => x.spec === c.spec));
  const grid = el('div', {class: 'charts'});
  let cards = [], body = names[0];
  const draw = function () {
    Rigor.dropCharts();
    cards = Rigor.collectCurves(scenario, cases, body).map((plot) => Rigor.chartCard(plot, (spec) => !hidden.has(spec), focus));
    grid.replaceChildren(...cards.map((c) => c.node));
  };
  const boxes = columns.map((c) => el('input', {type: 'checkbox', 'data-spec': c.spec, checked: !hidden.has(c.spec), onchange: (e) => {
    e.target.checked ? hidden.delete(c.spec) : hidden.add(c.spec);
    cards.forEach((card) => card.refresh());
  }}));
  const setAll = (want) => () => {
    columns.forEach((c, i) => { boxes[i].checked = want(c); want(c) ? hidden.delete(c.spec) : hidden.add(c.spec); });
    cards.forEach((card) => card.refresh());
  };
  const presets = [...new Set(columns.map((c) => c.preset))].filter(Boolean);
  const hasReference = cases.some((c) => c.curves?.reference?.length);
  draw();
  Rigor.drawAllCharts = () => cards.forEach((c) => c.draw());
  return Rigor.panel('curves', 'Curves',
    el('div', {class: 'controls noprint'},
      names.length > 1 ? Rigor.select('Body', names.map((n) => [n, n]), body, (value) => { body = value; draw(); }) : null,
      el('span', {class: 'seg'}, el('button', {class: 'button', onclick: setAll(() => true)}, 'all'),
        presets.map((p) => el('button', {class: 'button', onclick: setAll((c) => c.preset === p)}, p)), el('button', {class: 'button', onclick: setAll(() => false)}, 'none'))),
    el('div', {class: 'lines'}, hasReference ? el('span', {class: 'lines'}, el('label', {}, Rigor.lineSample('var(--reference)', [], 6), Rigor.referenceLabel(cases))) : null,
      columns.map((c, i) => el('label', {}, boxes[i], Rigor.lineSample(Rigor.engineColour(c.engine), Rigor.dashOf(c), 2), c.label))),
    grid, el('p', {class: 'muted small'}, 'Thinned for viewing to about 200 points that keep the extremes; the full series are in the trajectory files.'));
};
