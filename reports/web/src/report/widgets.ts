// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Elements of the sections: panels, chips, number cells, heads of tables with a column per engine.
import { type Attributes, type Child, el } from '../common/elements.ts';
import { duration, format, full, inShownUnit, type Maybe, shortCommand, timeStep, words } from '../common/format.ts';
import type { Column, Regression, Shown } from './data.ts';
import { meaningOf, metricTerms, termId } from './glossary_terms.ts';
import { dimensionNote, engineLink, subtitleOf, verdictText } from './run.ts';

export const panel = (id: string, title: string | null, ...children: Child[]): HTMLElement =>
  el('section', { class: 'panel', id }, title ? el('h2', null, title) : null, children);

export const scroll = (table: HTMLElement): HTMLElement =>
  el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table, scrolls sideways' }, table);

/** A verdict: its symbol, and a text that is its word unless something else is said. */
export function chip(shown: Shown, text?: Child, title?: string): HTMLElement {
  const v = verdictText(shown);
  const symbol = el('span', { class: 'sym', 'aria-hidden': 'true' }, v.symbol);
  return el('span', { class: `chip v v-${shown}`, title }, symbol, text ?? v.word);
}

/** A grade of accuracy: its letter, or what is said instead; how a case ended where it has none. */
export const gradeChip = (grade: string, text?: Child, title?: string): HTMLElement =>
  el('span', { class: `chip v g-${grade || 'none'}`, title }, text ?? (grade || 'not graded'));

/** ▼ worse, ▲ better than on record. */
export const changeMark = (regression: Regression): string =>
  regression === 'worse' ? '▼' : regression === 'better' ? '▲' : '';

/** Scenarios by grade, as a bar of five parts and in numbers. */
export function gradeBar(grades: number[]): HTMLElement {
  const names = ['A', 'B', 'C', 'D', 'E'];
  const text = names.map((name, i) => `${name} ${grades[i] ?? 0}`).join(', ');
  const all = grades.reduce((sum, n) => sum + n, 0);
  // a part that is too narrow for its text has the letter or nothing: the number is in the title
  const textOf = (name: string, n: number) => (n < 0.08 * all ? '' : n < 0.22 * all ? name : `${name} ${n}`);
  return el(
    'span',
    { class: 'gradebar', title: text, role: 'img', 'aria-label': text },
    names.map((name, i) =>
      grades[i] ? el('i', { class: `v g-${name}`, style: `flex-grow:${grades[i]}` }, textOf(name, grades[i])) : null,
    ),
  );
}

/** A number in a table: short to read, all digits on hover and in `data-value`. */
export const numberCell = (value: Maybe, unit = '', attributes: Attributes = {}): HTMLElement =>
  el('td', { class: 'num', title: `${full(value)} ${unit}`.trim(), ...attributes }, format(inShownUnit(value, unit)));
export const durationCell = (seconds: Maybe): HTMLElement =>
  el('td', { class: 'num', title: `${full(seconds)} s` }, duration(seconds));
export const stepCell = (dt: Maybe): HTMLElement => el('td', { class: 'num' }, timeStep(dt));

/** A word with its meaning on hover, where the glossary has one. */
export function term(text: string, name = text): Child {
  const meaning = meaningOf(name);
  return meaning === undefined ? text : el('abbr', { class: 'term', title: meaning }, text);
}
/** The name of a metric: its formula on hover, a link to its line in the glossary. */
export function metricName(name: string): Child {
  const text = words(name);
  if (!metricTerms.has(name)) return text;
  return el('a', { class: 'term', href: `#${termId(name)}`, title: meaningOf(name) }, text);
}
const explained = (child: Child): Child => (typeof child === 'string' ? term(child) : child);

const heads = (titles: Child[], kind: (index: number) => string | null): HTMLElement =>
  el(
    'thead',
    null,
    el(
      'tr',
      null,
      titles.map((t, i) => el('th', { class: kind(i), scope: 'col' }, explained(t))),
    ),
  );
/** A row of heads; `numeric` marks those over numbers, the first one sticks. */
export const headRow = (titles: Child[], numeric: (index: number) => boolean = () => false): HTMLElement =>
  heads(titles, (i) => (i === 0 ? 'sticky' : numeric(i) ? 'num' : null));
/** The same where nothing sticks. */
export const looseHeadRow = (titles: Child[], numeric: (index: number) => boolean = () => false): HTMLElement =>
  heads(titles, (i) => (numeric(i) ? 'num' : null));

/** Two head rows, engine above preset, for tables with a column per spec. */
export function specHead(
  leading: HTMLElement[],
  columns: Column[],
  columnHead: (column: Column, index: number) => HTMLElement = (c) =>
    el('th', { class: 'num', scope: 'col', title: c.spec }, subtitleOf(c)),
): HTMLElement {
  const groups: { engine: string; count: number }[] = [];
  for (const c of columns) {
    const last = groups.at(-1);
    if (last?.engine === c.engine) last.count++;
    else groups.push({ engine: c.engine, count: 1 });
  }
  for (const node of leading) node.setAttribute('rowspan', '2');
  const engines = groups.map((g) =>
    el(
      'th',
      { class: 'group', colspan: g.count, scope: 'colgroup' },
      el('a', { href: engineLink(g.engine) }, g.engine),
      dimensionNote(g.engine) ? el('span', { class: 'only' }, ` ${dimensionNote(g.engine)}`) : null,
    ),
  );
  return el('thead', null, el('tr', null, leading, engines), el('tr', null, columns.map(columnHead)));
}
export const stickyHead = (text: string): HTMLElement => el('th', { class: 'sticky', scope: 'col' }, text);

export function select(
  label: string,
  options: [key: string, text: string][],
  value: string,
  onchange: (value: string) => void,
): HTMLElement {
  const choices = options.map(([key, text]) => el('option', { value: key, selected: key === value }, text));
  const change = (e: Event) => onchange((e.target as HTMLSelectElement).value);
  return el('label', null, term(label), el('select', { 'aria-label': label, onchange: change }, choices));
}

export function copyButton(text: string): HTMLElement {
  const copied = (e: Event) => {
    const button = e.target as HTMLElement;
    navigator.clipboard?.writeText(text).then(
      () => {
        button.textContent = 'copied';
      },
      () => {},
    );
  };
  return el('button', { class: 'button noprint', 'aria-label': 'Copy the command', onclick: copied }, 'copy');
}

export const facts = (entries: [string, Child][]): HTMLElement =>
  el(
    'dl',
    { class: 'facts' },
    entries.map(([name, value]) => [el('dt', null, term(name)), el('dd', null, value)]),
  );

/** Folded content that is made when it is unfolded. */
export function folded(summary: Child, make: () => Child): HTMLElement {
  const node = el('details', null, el('summary', null, summary));
  node.addEventListener('toggle', () => node.append(el('div', null, make())), { once: true });
  return node;
}

/** A command at the end of a line of text; a long one, of hundreds of files, is unfolded by a click. */
export function commandInText(text: string): Child {
  const short = shortCommand(text);
  return short === text ? [' · ', el('code', null, text)] : folded(el('code', null, short), () => command(text));
}

/** A command that can be copied. */
export const command = (text: string): HTMLElement =>
  el('div', { class: 'command' }, el('code', null, text), copyButton(text));
