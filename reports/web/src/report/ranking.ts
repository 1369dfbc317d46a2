// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rankings as reports/model/rankings.cpp has counted and ordered them; here they only meet their columns.
import { isLost } from './cells.ts';
import type { BriefCase, Column, Mechanism, Ranking, Scenario } from './data.ts';

export interface Placed extends Ranking {
  column: Column;
}

/** Engines that took part, the best first. */
export const placed = (m: Mechanism, columns: Column[]): Placed[] =>
  m.order.flatMap((i) => {
    const [ranking, column] = [m.rankings[i], columns[i]];
    return ranking && column ? [{ ...ranking, column }] : [];
  });

/** The cases of a column that are of grade E or were lost, with their scenarios. */
export const wrongIn = (scenarios: Scenario[], column: Column): { scenario: Scenario; at: BriefCase }[] =>
  scenarios.flatMap((scenario) => {
    const at = scenario.cases.find((c) => c.spec === column.spec && (c.judged.grade === 'E' || isLost(c.shown)));
    return at ? [{ scenario, at }] : [];
  });
