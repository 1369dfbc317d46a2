// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Parts of the page: sections, tables, lists of changes and their signs.
import { type Child, el } from '../common/elements.ts';
import type { State } from './marks.ts';

const mostListed = 12; // lines of a list at once

export const section = (id: string, title: string, ...content: Child[]) =>
  el('section', { class: 'panel', id }, el('h2', null, title), content);

/** A head over numbers stands to the right, as they do. */
export function table(heads: Child[], rows: HTMLElement[]): HTMLElement {
  const kind = (i: number) => (rows[0]?.children[i]?.classList.contains('num') ? 'num' : null);
  const head = heads.map((h, i) => el('th', { scope: 'col', class: kind(i) }, h));
  return el(
    'div',
    { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'Table, scrolls sideways' },
    el('table', { class: 'full' }, el('thead', null, el('tr', null, head)), el('tbody', null, rows)),
  );
}

/** A list of which the first lines are seen and the rest opens; null where it is empty. */
export function listOf<T>(all: readonly T[], line: (x: T) => Child): Child {
  const list = (some: readonly T[]) =>
    el(
      'ul',
      { class: 'small' },
      some.map((x) => el('li', null, line(x))),
    );
  if (all.length === 0) return null;
  const rest = all.slice(mostListed);
  if (rest.length === 0) return list(all);
  const more = el('details', { class: 'small' }, el('summary', null, `and ${rest.length} more`));
  more.addEventListener('toggle', () => more.append(list(rest)), { once: true });
  return [list(all.slice(0, mostListed)), more];
}

const glyphs: Record<State, string> = { worse: '▼', better: '▲', other: '◆' };
export const sign = (state: State): Child => [
  el('span', { class: state, role: 'img', 'aria-label': state }, glyphs[state]),
  ' ',
];

export const factor = (ratio: number): string =>
  Number.isFinite(ratio) ? `×${Number(ratio.toPrecision(3))}` : 'from nothing';
