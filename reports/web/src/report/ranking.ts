// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rankings as reports/model/rankings.cpp has counted and ordered them; here they only meet their columns.
import { isLost } from './cells.ts';
import type { BriefCase, Column, Mechanism, Ranking, Scenario } from './data.ts';

export interface Placed extends Ranking {
  column: Column;
}

const placedAt = (indices: number[], m: Mechanism, columns: Column[]): Placed[] =>
  indices.flatMap((i) => {
    const [ranking, column] = [m.rankings[i], columns[i]];
    return ranking && column ? [{ ...ranking, column }] : [];
  });

/** Presets that took part, the best first. */
export const placed = (m: Mechanism, columns: Column[]): Placed[] => placedAt(m.order, m, columns);

/** Engines that took part, each once by its best preset, the best first. */
export const placedEngines = (m: Mechanism, columns: Column[]): Placed[] => placedAt(m.engines, m, columns);

/** Number of scenarios of grade E or lost. */
export const wrongCount = (s: Ranking): number => s.lost + (s.grades[4] ?? 0);

/** Engines with scenarios of grade E or lost, each once by the preset with most of them; the order is that of `list`. */
export function worstPresets(list: Placed[]): Placed[] {
  const worst = new Map<string, Placed>();
  for (const s of list) {
    const before = worst.get(s.column.engine);
    if (wrongCount(s) > (before ? wrongCount(before) : 0)) worst.set(s.column.engine, s);
  }
  return [...worst.values()];
}

/** Number of scenarios that can be graded, with those that were lost. */
export const gradable = (s: Ranking): number => s.scenarios - s.ungraded;

/** The cases of a column that are of grade E or were lost, with their scenarios. */
export const wrongIn = (scenarios: Scenario[], column: Column): { scenario: Scenario; at: BriefCase }[] =>
  scenarios.flatMap((scenario) => {
    const at = scenario.cases.find((c) => c.spec === column.spec && (c.judged.grade === 'E' || isLost(c.shown)));
    return at ? [{ scenario, at }] : [];
  });
