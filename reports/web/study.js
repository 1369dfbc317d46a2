// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The study that a run was made for: what was found, and each part as charts and as a table.
'use strict';
Rigor.study = (function () {
  const node = document.getElementById('study-data');
  return node ? JSON.parse(node.textContent) : null;
})();

Rigor.studyTitle = (chart) => chart.metric.replaceAll('_', ' ') + (chart.unit && chart.unit !== '1' ? ` [${chart.unit}]` : '') + (chart.scenario ? `, ${chart.scenario}` : '');

/** [{label, points}] of a chart of lines. */
Rigor.studyLines = function (chart) {
  const lines = [];
  for (const p of chart.points) {
    if (!lines.length || lines[lines.length - 1].label !== p.label) lines.push({label: p.label, points: []});
    const y = p.value === null ? NaN : Rigor.number(p.value);
    if (!chart.logarithmic || y > 0) lines[lines.length - 1].points.push({x: Rigor.number(p.x), y});
  }
  return lines;
};

/** Lines over the bars from the low to the high end of their intervals. */
Rigor.intervals = (points, colour) => ({id: 'intervals', afterDatasetsDraw: (drawn) => {
  const {ctx, scales: {x, y}} = drawn;
  ctx.save();
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.5;
  points.forEach((p, i) => {
    if (p.low === null || p.high === null) return;
    const at = y.getPixelForValue(i), from = x.getPixelForValue(Rigor.number(p.low)), to = x.getPixelForValue(Rigor.number(p.high));
    ctx.beginPath();
    ctx.moveTo(from, at);
    ctx.lineTo(to, at);
    for (const end of [from, to]) { ctx.moveTo(end, at - 4); ctx.lineTo(end, at + 4); }
    ctx.stroke();
  });
  ctx.restore();
}});

Rigor.studyChart = function (chart) {
  const {el} = Rigor;
  const title = Rigor.studyTitle(chart);
  const canvas = el('canvas', {role: 'img', 'aria-label': title});
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const tick = {color: style('--muted'), font: {size: 11}}, grid = {color: style('--line')};
  const colour = (i) => Rigor.palette[i % Rigor.palette.length];
  const values = {type: chart.logarithmic ? 'logarithmic' : 'linear', grid, ticks: {...tick, maxTicksLimit: 8, callback: (v) => Rigor.tick(v)}, beginAtZero: !chart.logarithmic};
  const positive = chart.points.map((p) => Rigor.number(p.value)).filter((v) => v > 0 && Number.isFinite(v));
  if (chart.logarithmic && !chart.axis && positive.length) values.min = 10 ** (Math.ceil(Math.log10(Math.min(...positive))) - 1);
  const common = {animation: false, responsive: true, maintainAspectRatio: false};
  const lines = chart.axis ? Rigor.studyLines(chart) : [];
  const text = (value) => `${Rigor.format(value)}${Rigor.unit(chart.unit)}`;
  const told = (p) => (p.outcome !== 'completed' ? p.outcome : p.value === null ? 'no value' : text(p.value) + (p.note ? ` (${p.note})` : ''));
  const size = chart.axis ? 'box tall' : 'box';
  const make = () => Rigor.liveCharts.push(new Chart(canvas, chart.axis ? {type: 'line',
    data: {datasets: lines.map((line, i) => ({label: line.label, data: line.points, borderColor: colour(i), backgroundColor: 'transparent', pointBackgroundColor: colour(i), borderDash: i < Rigor.palette.length ? [] : [6, 4], borderWidth: 1.6, pointRadius: 3, tension: 0}))},
    options: {...common, scales: {x: {type: chart.logarithmicX ? 'logarithmic' : 'linear', grid, ticks: {...tick, maxTicksLimit: 8, callback: (v) => Rigor.tick(v)}, title: {display: true, text: chart.axis, color: style('--muted'), font: {size: 11}}}, y: values},
      plugins: {legend: {display: true, position: 'bottom', labels: {color: style('--muted'), boxWidth: 24, font: {size: 11}}}, tooltip: {callbacks: {label: (item) => `${item.dataset.label}: ${text(item.parsed.y)} at ${Rigor.format(item.parsed.x)}`}}}}}
    : {type: 'bar',
      data: {labels: chart.points.map((p) => p.label), datasets: [{data: chart.points.map((p) => (p.value === null || (chart.logarithmic && !(Rigor.number(p.value) > 0)) ? null : Rigor.number(p.value))), backgroundColor: colour(0), maxBarThickness: 18}]},
      plugins: [Rigor.intervals(chart.points, style('--text'))],
      options: {...common, indexAxis: 'y', scales: {x: values, y: {grid: {display: false}, ticks: {...tick, autoSkip: false}}}, plugins: {legend: {display: false}, tooltip: {callbacks: {label: (item) => told(chart.points[item.dataIndex])}}}}}));
  const height = chart.axis ? null : `height:${60 + 24 * chart.points.length}px`;
  return {node: el('div', {class: 'chart', 'data-metric': chart.metric, 'data-kind': chart.axis ? 'lines' : 'bars'}, el('h4', {}, title), el('div', {class: size, style: height}, canvas)), make};
};

/** Columns: what varies, the variant, the metrics, and how the run ended where it did not end well. */
Rigor.studyTable = function (part) {
  const {el} = Rigor;
  const rows = part.rows, first = rows[0];
  const varies = (get) => new Set(rows.map((r) => JSON.stringify(get(r)))).size > 1;
  const ways = [...(varies((r) => r.base) ? [['Scenario', (r) => r.base]] : []),
    ...Object.keys(first.parameters).map((key) => [key, (r) => r.parameters[key]]), ...(varies((r) => r.dt) ? [['Time step', (r) => Rigor.timeStep(r.dt)]] : [])];
  const metrics = Object.keys(first.metrics), ended = rows.some((r) => !r.ran || r.outcome !== 'completed');
  const unitOf = (m) => rows.map((r) => r.metrics[m].unit).find((u) => u) || '';
  const known = new Set(Rigor.run.scenarios.map((s) => s.name));
  const variant = (r) => (known.has(r.scenario) ? el('a', {href: Rigor.scenarioLink(r.scenario, {dt: r.dt, spec: r.spec}), title: r.spec}, r.variant) : r.variant);
  const cell = function (value, unit) {
    const interval = value.note ? el('span', {class: 'bound'}, value.note) : null;
    return el('td', {class: 'num', title: Rigor.full(value.value) + (unit ? ' ' + unit : ''), 'data-value': Rigor.full(value.value)}, value.value === null ? '—' : Rigor.format(value.value), interval);
  };
  return Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, ['Variant', ...ways.map(([name]) => name)].map((t, i) => el('th', {class: i ? null : 'sticky', scope: 'col'}, t)),
    metrics.map((m) => el('th', {class: 'num', scope: 'col'}, m.replaceAll('_', ' '), unitOf(m) && unitOf(m) !== '1' ? ` [${unitOf(m)}]` : '')), ended ? el('th', {scope: 'col'}, 'Outcome') : null)),
    el('tbody', {}, rows.map((r) => el('tr', {}, el('th', {class: 'sticky', scope: 'row'}, variant(r)), ways.map(([, get]) => el('td', {}, get(r))),
      metrics.map((m) => cell(r.metrics[m], r.metrics[m].unit)), ended ? el('td', {class: 'small'}, r.ran ? r.outcome : 'not run') : null)))));
};

Rigor.studyJudged = function (study) {
  const {el} = Rigor;
  const range = (least, most) => (least === null && most === null ? '—' : least === null ? `≤ ${Rigor.format(most)}` : most === null ? `≥ ${Rigor.format(least)}` : least === most ? Rigor.format(least) : `${Rigor.format(least)} … ${Rigor.format(most)}`);
  const where = (f) => [f.variant, ...Object.entries(f.where).map(([k, v]) => (k === 'scenario' ? v : `${k}=${v}`))].join(', ');
  const table = (heads, rows) => Rigor.scroll(el('table', {class: 'full'}, el('thead', {}, el('tr', {}, heads.map((t) => el('th', {scope: 'col'}, t)))), el('tbody', {}, rows)));
  return [study.findings.length ? [el('h3', {}, 'Findings'), table(['Finding', 'Where', 'Column', 'Expected', 'Found', 'Verdict', 'Source'],
    study.findings.map((f) => el('tr', {}, el('th', {scope: 'row'}, f.statement), el('td', {}, where(f)), el('td', {}, f.metric), el('td', {}, range(f.at_least, f.at_most)), el('td', {}, range(f.least, f.greatest)),
      el('td', {}, Rigor.chip(f.holds ? 'pass' : 'fail', f.holds ? 'holds' : 'does not hold')), el('td', {class: 'small'}, f.source))))] : null,
  study.symptoms.length ? [el('h3', {}, 'Symptoms'), table(['Symptom', 'Column', 'Fault', 'Value', 'Cure', 'Value', 'Switched', 'Verdict'],
    study.symptoms.map((s) => el('tr', {}, el('th', {scope: 'row'}, s.name), el('td', {}, s.metric + (s.growth ? ' ~ N^p' : '')), el('td', {}, s.fault), Rigor.numberCell(s.fault_value), el('td', {}, s.cure), Rigor.numberCell(s.cure_value),
      el('td', {class: 'small'}, s.switched.join('; ')), el('td', {}, Rigor.chip(s.shown && s.cured ? 'pass' : 'fail', `${s.shown ? 'shown' : 'not shown'}, ${s.cured ? 'cured' : 'not cured'}`)))))] : null];
};

Rigor.studyPanel = function () {
  const {el, study} = Rigor;
  if (!study) return null;
  const part = function (p) {
    if (!p.rows.length) return null;
    const charts = study.charts.filter((c) => c.part === p.name).map(Rigor.studyChart);
    requestAnimationFrame(() => { for (const c of charts) if (c.node.isConnected) c.make(); });
    return el('div', {class: 'study-part', 'data-part': p.name}, el('h3', {}, p.title || p.name), p.description ? el('p', {class: 'muted'}, p.description) : null,
      el('div', {class: 'charts'}, charts.map((c) => c.node)), el('details', {open: charts.length === 0}, el('summary', {}, `Table: ${p.rows.length} runs`), Rigor.studyTable(p)));
  };
  return Rigor.panel('study', study.title || study.name, study.description ? el('p', {}, study.description) : null, Rigor.studyJudged(study), study.parts.map(part));
};
