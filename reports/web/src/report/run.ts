// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The run of this page, and the functions on it that are used everywhere: columns, verdicts, colours, links.
import type { Case, Column, Run, Scenario, Shown, Study } from './data.ts';

function embedded<T>(id: string): T | null {
  const node = document.getElementById(id);
  return node === null ? null : (JSON.parse(node.textContent ?? '') as T);
}

export const run = embedded<Run>('run-data') as Run;
export const study = embedded<Study>('study-data');

export const columnOf = (spec: string): Column | undefined => run.columns.find((c) => c.spec === spec);
export const labelOf = (spec: string): string => columnOf(spec)?.label ?? spec;
export const subtitleOf = (c: Column): string => [c.preset, c.options].filter(Boolean).join(' ') || c.spec;
export const scenarioOf = (name: string): Scenario | undefined => run.scenarios.find((s) => s.name === name);
export const caseOf = (cases: Case[], column: Column): Case | undefined => cases.find((c) => c.spec === column.spec);
/** Columns of the specs that are among the cases. */
export const columnsAmong = (cases: { spec: string }[]): Column[] =>
  run.columns.filter((c) => cases.some((x) => x.spec === c.spec));
export const clockOf = (column: Column): string => column.clock ?? '';
/** Columns of modules, then those of guests, as titles and lists; one without a title where there are modules alone. */
export function kinds(columns: Column[]): { title: string; columns: Column[] }[] {
  const guests = columns.filter((c) => clockOf(c) !== '');
  if (guests.length === 0) return [{ title: '', columns }];
  const modules = columns.filter((c) => clockOf(c) === '');
  return [
    { title: 'Modules', columns: modules },
    { title: 'Guests', columns: guests },
  ].filter((kind) => kind.columns.length > 0);
}
/** Items whose times are of one clock. */
export interface Group<T> {
  clock: string;
  items: T[];
}
/** Items by clock, those of modules first. */
export function byClock<T>(list: readonly T[], clock: (item: T) => string): Group<T>[] {
  const found = new Map<string, T[]>();
  for (const item of list) found.set(clock(item), [...(found.get(clock(item)) ?? []), item]);
  const groups = [...found].map(([name, items]) => ({ clock: name, items }));
  return groups.sort((a, b) => a.clock.localeCompare(b.clock));
}
export const isFirstOfEngine = (columns: Column[], i: number): boolean =>
  i === 0 || columns[i - 1]?.engine !== columns[i]?.engine;

/** Symbol and word of a verdict as shown. */
export const verdictText = (shown: Shown) => run.symbols[shown] ?? { symbol: '?', word: shown, count: 0 };
export function metricShown(verdict: string): Shown {
  if (verdict === 'pass' || verdict === 'fail') return verdict;
  return verdict === 'known deviation' ? 'known_deviation' : 'unsupported';
}

/** Okabe and Ito's palette, distinguishable with every common colour vision; by place in the list of engines. */
export const palette = [
  ...['#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#8C6D1F'],
  // Tol's muted ones, for more engines.
  ...['#332288', '#882255', '#44AA99', '#999933', '#661100', '#6699CC', '#7F7F7F'],
];
export function engineColour(engine: string): string {
  const taking = [...new Set(run.columns.map((c) => c.engine))];
  const names = [...taking, ...run.engines.map((e) => e.name).filter((name) => !taking.includes(name))];
  const index = names.indexOf(engine);
  return palette[(index < 0 ? names.length : index) % palette.length] as string;
}
/** Dimensions that an engine simulates; empty where it did not say so. */
export function dimensionsOf(engine: string): number[] {
  const given = run.engines.find((e) => e.name === engine)?.described?.capabilities.dimensions;
  return Array.isArray(given) ? given.filter((d): d is number => typeof d === 'number') : [];
}
/** "2D only", "3D only"; "3D and plane" for one that keeps bodies in a plane of its own space; "" for one that does both. */
export function dimensionNote(engine: string): string {
  const [only, more] = dimensionsOf(engine);
  if (only === undefined || more !== undefined) return '';
  const planar = run.engines.find((e) => e.name === engine)?.described?.capabilities.planar === true;
  return planar ? `${only}D and plane` : `${only}D only`;
}

type Query = Record<string, string | number | null | undefined>;
const withQuery = (path: string, query: Query): string => {
  const parts = Object.entries(query).filter(([, v]) => v !== undefined && v !== null && v !== '');
  return path + (parts.length ? `?${parts.map(([k, v]) => `${k}=${encodeURIComponent(String(v))}`).join('&')}` : '');
};
export const scenarioLink = (name: string, query: Query = {}): string =>
  withQuery(`#/scenario/${encodeURIComponent(name)}`, query);
export const engineLink = (name: string): string => `#/engine/${encodeURIComponent(name)}`;
