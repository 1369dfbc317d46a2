// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shared by all parts of the page: elements, numbers, data. Text enters the document as text nodes only.
'use strict';
const Rigor = {};
Rigor.run = JSON.parse(document.getElementById('run-data').textContent);

/** el('td', {class: 'num', title: '...'}, child, 'text', ...): null children are left out, arrays flattened. */
Rigor.el = function (tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return node;
};

/** The stored number behind a JSON value; NaN for null. */
Rigor.number = function (value) {
  if (typeof value === 'number') return value;
  return {inf: Infinity, '-inf': -Infinity}[value] ?? NaN;
};

/** Four significant digits for reading. */
Rigor.format = function (value) {
  if (value === null || value === undefined) return '—';
  const v = Rigor.number(value);
  if (Number.isNaN(v)) return 'NaN';
  if (!Number.isFinite(v)) return v > 0 ? '∞' : '−∞';
  const size = Math.abs(v);
  if (size === 0) return '0';
  if (size < 1e-3 || size >= 1e5) return v.toExponential(2).replace('e+', 'e').replace('-', v < 0 ? '−' : '-');
  return String(Number(v.toPrecision(4))).replace(/^-/, '−');
};
/** Of an axis: as many digits as neighbouring ticks need, no more. */
Rigor.tick = function (value) {
  const short = Number(value.toPrecision(7));
  const far = short !== 0 && (Math.abs(short) < 1e-3 || Math.abs(short) >= 1e5);
  return (far ? short.toExponential().replace('e+', 'e') : String(short)).replace(/^-/, '−');
};
/** All digits: parses back to the stored bits. */
Rigor.full = (value) => (value === null || value === undefined ? 'no value' : String(value));
Rigor.unit = (unit) => (unit && unit !== '1' ? '\u202f' + unit : '');

Rigor.duration = function (seconds) {
  const s = Rigor.number(seconds);
  if (!Number.isFinite(s)) return '—';
  if (s < 1e-3) return Number((s * 1e6).toPrecision(3)) + ' µs';
  if (s < 1) return Number((s * 1e3).toPrecision(3)) + ' ms';
  return Number(s.toPrecision(3)) + ' s';
};

Rigor.timeStep = function (dt) {
  const rate = Math.round(1 / dt);
  if (rate >= 2 && Math.abs(1 / dt - rate) < 1e-9 * rate) return `1/${rate} s`;
  return Rigor.format(dt) + ' s';
};
Rigor.angle = (radians) => (radians === null || radians === undefined ? '—' : Rigor.format(Rigor.number(radians) * 180 / Math.PI) + '°');

/** A number in a table: short to read, all digits on hover. */
Rigor.numberCell = (value, unit, attributes) =>
  Rigor.el('td', {class: 'num', title: Rigor.full(value) + (unit ? ' ' + unit : ''), ...(attributes || {})}, Rigor.format(value));

/** Symbol and word of a verdict as shown. */
Rigor.verdict = (key) => Rigor.run.symbols[key] || {symbol: '?', word: key};
Rigor.metricShown = (verdict) => ({pass: 'pass', fail: 'fail', 'known deviation': 'known_deviation'}[verdict] || 'unsupported');
Rigor.chip = function (key, text, title) {
  const v = Rigor.verdict(key);
  return Rigor.el('span', {class: `chip v v-${key}`, title}, Rigor.el('span', {class: 'sym', 'aria-hidden': 'true'}, v.symbol), text ?? v.word);
};
/** How bad, for sorting and for the worst of several: unsupported is the mildest. */
Rigor.severity = (key) => ['unsupported', 'pass', 'no_bound', 'known_deviation', 'fail', 'non_finite', 'timeout', 'crashed'].indexOf(key);

Rigor.isLost = (key) => ['non_finite', 'timeout', 'crashed'].includes(key);

/** Okabe-Ito: told apart with every common colour vision; by place in the list of engines. */
Rigor.palette = ['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#7A5C00'];
Rigor.engineColour = function (engine) {
  const names = Rigor.run.engines.map((e) => e.name);
  const index = names.indexOf(engine);
  return Rigor.palette[(index < 0 ? names.length : index) % Rigor.palette.length];
};
/** Dashes tell presets and options of one engine apart. */
Rigor.dashOf = function (column) {
  const same = Rigor.run.columns.filter((c) => c.engine === column.engine);
  if (column.options) return [[2, 3], [8, 3, 2, 3], [10, 4]][same.indexOf(column) % 3];
  return column.preset === 'default' ? [6, 4] : [];
};

Rigor.scenarioLink = function (name, query) {
  const parts = Object.entries(query || {}).filter(([, v]) => v !== undefined && v !== null);
  return '#/scenario/' + encodeURIComponent(name) +
    (parts.length ? '?' + parts.map(([k, v]) => `${k}=${encodeURIComponent(v)}`).join('&') : '');
};

/** The details of one scenario: parsed when first asked for. */
Rigor.scenarioData = (function () {
  const cache = new Map();
  return function (index) {
    if (!cache.has(index)) cache.set(index, JSON.parse(document.getElementById('scenario-data-' + index).textContent));
    return cache.get(index);
  };
})();

/** Packed singles back to numbers; null where the page has no such curve. */
Rigor.unpack = function (text) {
  if (!text) return null;
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Array.from({length: bytes.length / 4}, (_, i) => view.getFloat32(4 * i, true));
};

/** Two head rows, engine above preset, for tables with a column per spec. */
Rigor.specHead = function (leading, columns, makeColumnHead) {
  const el = Rigor.el;
  const groups = [];
  for (const c of columns) {
    if (groups.length && groups[groups.length - 1].engine === c.engine) groups[groups.length - 1].count++;
    else groups.push({engine: c.engine, count: 1});
  }
  return el('thead', {},
    el('tr', {}, leading.map((node) => { node.setAttribute('rowspan', 2); return node; }),
      groups.map((g) => el('th', {class: 'group', colspan: g.count, scope: 'colgroup'}, g.engine))),
    el('tr', {}, columns.map((c, i) => makeColumnHead(c, i))));
};
Rigor.specSubtitle = (c) => [c.preset, c.options].filter(Boolean).join(' ') || c.spec;
Rigor.isFirstOfEngine = (columns, i) => i === 0 || columns[i - 1].engine !== columns[i].engine;

Rigor.panel = (id, title, ...children) => Rigor.el('section', {class: 'panel', id}, title ? Rigor.el('h2', {}, title) : null, children);
Rigor.scroll = (table) => Rigor.el('div', {class: 'scroll', tabindex: 0}, table);
Rigor.select = function (label, options, value, onchange) {
  const select = Rigor.el('select', {'aria-label': label, onchange: (e) => onchange(e.target.value)},
    options.map(([key, text]) => Rigor.el('option', {value: key, selected: key === value}, text)));
  return Rigor.el('label', {}, label, select);
};
