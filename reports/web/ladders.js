// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Over all time steps of a scenario: order of convergence, error against cost, and engines compared in four
// labelled ways. There from three time steps on.
'use strict';
Rigor.fairnessModes = [
  ['engine_defaults', 'Engine defaults', 'as each engine ships, at the first time step'],
  ['matched_settings', 'Matched settings', 'the same law as nearly as each library allows, at the first time step'],
  ['equal_time', 'Equal time', 'the least error of each within the budget'],
  ['equal_accuracy', 'Equal accuracy', 'the cheapest run of each within the target']];

/** [{column, points: [{x, y}]}] of one metric, over the time step or over the cost. */
Rigor.ladderLines = function (data, metric, overCost) {
  const cost = (c) => { const t = c.timings.find((x) => x.phase === 'step'); return t ? Rigor.number(t.median) * c.steps : null; };
  const point = function (c) {
    const m = c.metrics.find((x) => x.name === metric && x.subject === '');
    return {x: overCost ? cost(c) : Rigor.number(c.dt), y: m ? Rigor.number(m.value) : null};
  };
  return Rigor.run.columns.map((column) => ({column, points: data.cases.filter((c) => c.spec === column.spec).sort((a, b) => a.dt - b.dt).map(point)
    .filter((p) => p.x > 0 && p.y > 0 && Number.isFinite(p.y))})).filter((line) => line.points.length > 1);
};

Rigor.ladderChart = function (title, xTitle, unit, lines) {
  const {el} = Rigor;
  const canvas = el('canvas', {role: 'img', 'aria-label': title});
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const tick = {color: style('--muted'), font: {size: 11}}, grid = {color: style('--line')};
  const axis = (text) => ({type: 'logarithmic', grid, ticks: {...tick, maxTicksLimit: 8, callback: (v) => Rigor.tick(v)}, title: {display: true, text, color: style('--muted'), font: {size: 11}}});
  const make = () => Rigor.liveCharts.push(new Chart(canvas, {type: 'line',
    data: {datasets: lines.map(({column, points}) => ({data: points, label: column.label, spec: column.spec, borderColor: Rigor.engineColour(column.engine), backgroundColor: 'transparent', pointBackgroundColor: Rigor.engineColour(column.engine),
      borderDash: Rigor.dashOf(column), borderWidth: 1.6, pointRadius: 3, tension: 0}))},
    options: {animation: false, responsive: true, maintainAspectRatio: false, scales: {x: axis(xTitle), y: axis(unit && unit !== '1' ? `[${unit}]` : '')},
      plugins: {legend: {display: true, position: 'bottom', labels: {color: style('--muted'), boxWidth: 24, font: {size: 11}}},
        tooltip: {callbacks: {label: (item) => `${item.dataset.label}: ${Rigor.format(item.parsed.y)}${Rigor.unit(unit)} at ${Rigor.format(item.parsed.x)} s`}}}}}));
  return {node: el('div', {class: 'chart'}, el('h4', {}, title), el('div', {class: 'box tall'}, canvas)), make};
};

Rigor.ordersTable = function (orders) {
  const {el} = Rigor;
  const label = (spec) => Rigor.run.columns.find((c) => c.spec === spec)?.label || spec;
  const rows = orders.map((o) => el('tr', {'data-spec': o.spec}, el('th', {class: 'sticky', scope: 'row'}, label(o.spec)), el('td', {}, o.metric.replaceAll('_', ' ')),
    el('td', {class: 'num', 'data-value': Rigor.full(o.order)}, o.order === null ? '—' : Rigor.number(o.order).toFixed(2)),
    el('td', {class: 'num'}, o.low === null ? '—' : `${Rigor.number(o.low).toFixed(2)} … ${Rigor.number(o.high).toFixed(2)}`),
    el('td', {class: 'num'}, o.points), el('td', {class: 'num'}, o.points ? `${Rigor.timeStep(Rigor.number(o.coarsest))} … ${Rigor.timeStep(Rigor.number(o.finest))}` : ''), el('td', {class: 'small'}, o.note)));
  return Rigor.scroll(el('table', {id: 'orders'}, el('thead', {}, el('tr', {}, ['Engine', 'Metric', 'Order', '95 % interval', 'Points', 'Time steps', ''].map((t, i) => el('th', {class: i > 1 && i < 6 ? 'num' : i ? null : 'sticky', scope: 'col'}, t)))), el('tbody', {}, rows)));
};

Rigor.fairnessTable = function (rows) {
  const {el} = Rigor;
  const limit = (mode, row) => mode === 'equal_time' ? `, ${Rigor.duration(row.limit)} of stepping` : mode === 'equal_accuracy' ? `, ${Rigor.format(row.limit)}${Rigor.unit(row.unit)}` : '';
  const part = function ([mode, title, text]) {
    const of = rows.filter((r) => r.mode === mode).sort((a, b) => (mode === 'equal_accuracy' ? Rigor.number(a.cost) - Rigor.number(b.cost) : Rigor.number(a.error) - Rigor.number(b.error)));
    if (!of.length) return null;
    return el('tbody', {'data-mode': mode}, el('tr', {class: 'sub'}, el('th', {colspan: 4}, title, el('span', {class: 'muted small'}, ` — ${text}${limit(mode, of[0])}`))),
      of.map((r) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, r.competitor), Rigor.numberCell(r.error, r.unit), el('td', {class: 'num', title: Rigor.full(r.cost) + ' s'}, Rigor.duration(r.cost)), el('td', {class: 'num'}, Rigor.timeStep(Rigor.number(r.dt))))));
  };
  return Rigor.scroll(el('table', {id: 'fairness'}, el('thead', {}, el('tr', {}, ['Engine', 'Error', 'Time of all steps', 'Time step'].map((t, i) => el('th', {class: i ? 'num' : 'sticky', scope: 'col'}, t)))), Rigor.fairnessModes.map(part)));
};

Rigor.ladderPanel = function (scenario, data) {
  const {el} = Rigor;
  if (!data.orders.length) return null;
  const names = [...new Set(data.orders.map((o) => o.metric))];
  const body = el('div');
  let metric = names.includes(scenario.main.name) ? scenario.main.name : names[0];
  const draw = function () {
    const orders = data.orders.filter((o) => o.metric === metric), fairness = data.fairness.filter((f) => f.metric === metric);
    const charts = [['Convergence: error over time step', 'time step [s]', false], ['Work and precision: error over time of all steps', 'wall time of all steps [s]', true]]
      .map(([title, x, overCost]) => [title, x, Rigor.ladderLines(data, metric, overCost)]).filter(([, , lines]) => lines.length)
      .map(([title, x, lines]) => Rigor.ladderChart(title, x, orders[0].unit, lines));
    body.replaceChildren(el('div', {class: 'charts'}, charts.map((c) => c.node)), Rigor.ordersTable(orders),
      el('p', {class: 'muted small'}, 'The order is the slope of ln error on ln dt; a wide interval says that no single power of dt describes the ladder.'),
      ...(fairness.length ? [el('h3', {}, 'Compared in four ways'), Rigor.fairnessTable(fairness)] : []));
    requestAnimationFrame(() => { if (body.isConnected) charts.forEach((c) => c.make()); });
  };
  draw();
  return Rigor.panel('ladder', 'Convergence, and error against cost',
    names.length > 1 ? el('div', {class: 'controls noprint'}, Rigor.select('Metric', names.map((n) => [n, n.replaceAll('_', ' ')]), metric, (value) => { metric = value; draw(); })) : null, body);
};
