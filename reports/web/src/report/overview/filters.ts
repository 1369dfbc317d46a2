// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Filters and order of the scoreboard. The address holds those that differ from "all scenarios"; they are kept during a
// visit to another page of the report.

import { Observable } from '../../common/cursor.ts';
import { cellOf, costOf, errorOf, gradeOf, isLost, relativeOf, type StepChoice, severity } from '../cells.ts';
import type { Column, Scenario } from '../data.ts';
import { clockOf, kinds, run } from '../run.ts';

export interface Filters {
  text: string;
  task: string;
  mechanism: string; // mechanism or tag
  dimension: string;
  preset: string;
  hide: string; // names of engines that are hidden, with commas
  pin: string; // names of engines that come first, with commas
  grade: string;
  change: string; // change against the record
  verdict: string; // ending
  step: StepChoice;
  number: 'error' | 'relative' | 'best' | 'ours' | 'cost'; // number in the cells
  group: 'task' | 'none';
  sort: string; // "name", "metric", a spec; "": what differs most between engines first
  descending: boolean;
}
export const allScenarios: Filters = {
  text: '',
  task: '',
  mechanism: '',
  dimension: '',
  preset: '',
  hide: '',
  pin: '',
  grade: '',
  change: '',
  verdict: '',
  step: 'all',
  number: 'relative',
  group: 'task',
  sort: '',
  descending: false,
};
export const filters = new Observable<Filters>(allScenarios);

/** "#scoreboard?grade=E&descending=true": the address of the scoreboard with these filters. */
export function scoreboardLink(f: Filters): string {
  const query = new URLSearchParams();
  for (const [key, value] of Object.entries(f))
    if (value !== allScenarios[key as keyof Filters]) query.set(key, String(value));
  return query.size > 0 ? `#scoreboard?${query}` : '#scoreboard';
}

/** Sets the filters of an address; keys that are none are passed over. */
export function filtersOf(query: URLSearchParams): void {
  const given: Record<string, string | boolean> = {};
  for (const [key, value] of query)
    if (key in allScenarios) given[key] = key === 'descending' ? value === 'true' : value;
  filters.set({ ...allScenarios, ...given });
}

/** Opens the scoreboard with some filters set and the rest reset. */
export function filterScoreboard(changes: Partial<Filters>): void {
  location.hash = scoreboardLink({ ...allScenarios, ...changes });
}

export const namesIn = (list: string): string[] => list.split(',').filter(Boolean);
/** The list with a name in it, or without it where it is there. */
export function toggled(list: string, name: string): string {
  const names = namesIn(list);
  return (names.includes(name) ? names.filter((n) => n !== name) : [...names, name]).join(',');
}

/** Columns as shown: of the preset, without hidden engines, those of pinned ones first, then modules, then guests. */
export function chosenColumns(f: Filters): Column[] {
  const [hidden, pinned] = [namesIn(f.hide), namesIn(f.pin)];
  const shown = run.columns.filter((c) => (!f.preset || c.preset === f.preset) && !hidden.includes(c.engine));
  const first = pinned.flatMap((name) => shown.filter((c) => c.engine === name));
  const rest = shown.filter((c) => !pinned.includes(c.engine));
  return [...first, ...kinds(rest).flatMap((kind) => kind.columns)];
}

export function matches(s: Scenario, columns: Column[], f: Filters): boolean {
  const text = [s.name, s.title, s.description, ...s.tags, ...s.isolates].join(' ').toLowerCase();
  const wanted = f.text.toLowerCase().split(/\s+/);
  if (!wanted.every((word) => text.includes(word))) return false;
  if (f.mechanism && !s.isolates.includes(f.mechanism) && !s.tags.includes(f.mechanism)) return false;
  const task = run.tasks.find((t) => t.name === f.task);
  if (task && !task.scenarios.includes(s.name)) return false;
  if (f.dimension && String(s.dimension) !== f.dimension) return false;
  if (!f.verdict && !f.grade && !f.change) return true;
  return columns.some((c) => {
    const cell = cellOf(s, c, f.step);
    if (cell === null) return false;
    return (
      (!f.verdict || cell.worst.shown === f.verdict) &&
      (!f.grade || gradeOf(cell) === f.grade) &&
      (!f.change || cell.cases.some((x) => x.judged.regression === f.change))
    );
  });
}

/** Scenarios in the selected order; by a column: by the numbers in its cells, those without a number last. */
export function ordered(list: Scenario[], columns: Column[], f: Filters): Scenario[] {
  if (!f.sort) {
    const keyed = list.map((s) => ({ s, key: difference(s, columns, f.step) }));
    keyed.sort((a, b) => b.key - a.key);
    return (f.descending ? keyed.reverse() : keyed).map((k) => k.s);
  }
  const column = columns.find((c) => c.spec === f.sort);
  const key = (s: Scenario): (string | number)[] => {
    if (f.sort === 'name') return [s.name];
    if (f.sort === 'metric') return [s.main.name];
    const cell = column ? cellOf(s, column, f.step) : null;
    if (cell === null) return [Infinity];
    const value = f.number === 'cost' ? costOf(cell) : f.number === 'error' ? errorOf(cell) : relativeOf(cell);
    const last = Number.isNaN(value) ? Infinity : value;
    return f.number === 'cost' ? [last] : [severity(cell.worst.shown), gradeOf(cell) || 'F', last];
  };
  const keyed = list.map((s) => ({ s, key: key(s) }));
  keyed.sort((a, b) => {
    for (let i = 0; i < Math.min(a.key.length, b.key.length); ++i) {
      const [x, y] = [a.key[i] as number, b.key[i] as number];
      if (x !== y) return x < y ? -1 : 1;
    }
    return 0;
  });
  if (f.descending) keyed.reverse();
  return keyed.map((k) => k.s);
}

const noDigits = 1e-6; // relative errors of grade A count as equal
const lost = 10; // decades: a run that ended early is further off than any error

/** Distance of the engines on a scenario, in decades of relative error; -1 where fewer than two have a result. */
export function difference(s: Scenario, columns: Column[], step: StepChoice): number {
  const places = columns.flatMap((c) => {
    const cell = cellOf(s, c, step);
    if (cell === null || cell.worst.shown === 'unsupported') return [];
    if (isLost(cell.worst.shown)) return [lost];
    const relative = relativeOf(cell);
    return Number.isNaN(relative) ? [] : [Math.min(lost - 1, Math.log10(Math.max(noDigits, relative) / noDigits))];
  });
  return places.length < 2 ? -1 : Math.max(...places) - Math.min(...places);
}

export interface Group {
  title: string; // "" where all are in one
  about: string;
  scenarios: Scenario[];
}

/** Scenarios by task, each in the first one that has it; all in one where an order was chosen. */
export function grouped(list: Scenario[], f: Filters): Group[] {
  if (f.group === 'none' || f.sort || run.tasks.length === 0) return [{ title: '', about: '', scenarios: list }];
  const left = new Set(list);
  const tasks = f.task ? run.tasks.filter((t) => t.name === f.task) : run.tasks;
  const groups = tasks.map(({ title, about, scenarios }): Group => {
    const own = list.filter((s) => left.has(s) && scenarios.includes(s.name));
    for (const s of own) left.delete(s);
    return { title, about, scenarios: own };
  });
  groups.push({ title: 'Other scenarios', about: 'in no task', scenarios: list.filter((s) => left.has(s)) });
  return groups.filter((g) => g.scenarios.length > 0);
}

/** Scale of the bars of a row. */
export interface RowScale {
  bestError: number; // smallest number in the row's cells; NaN if fewer than two have one
  leastCost: Map<string, number>; // the fastest of the row, by clock
}
export function rowScale(s: Scenario, columns: Column[], step: StepChoice, number: Filters['number']): RowScale {
  const cells = columns.map((c) => cellOf(s, c, step));
  const errors = cells.map(number === 'error' ? errorOf : relativeOf).filter(Number.isFinite);
  const leastCost = new Map<string, number>();
  columns.forEach((column, i) => {
    const cost = costOf(cells[i] ?? null);
    if (cost > 0) leastCost.set(clockOf(column), Math.min(cost, leastCost.get(clockOf(column)) ?? Infinity));
  });
  return {
    bestError: errors.length > 1 ? Math.min(...errors) : NaN,
    leastCost,
  };
}
