// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A cell of the scoreboard: the cases of one scenario in one column, their grade, ending, error and cost.
import { toNumber } from '../common/format.ts';
import type { BriefCase, Column, Scenario, Shown } from './data.ts';

/** Time steps that a cell shows. */
export type StepChoice = 'all' | 'finest' | 'coarsest';

const order: Shown[] = [
  'unsupported',
  'pass',
  'no_bound',
  'no_reference',
  'known_deviation',
  'fail',
  'non_finite',
  'timeout',
  'crashed',
];
/** Severity, for sorting and for the worst of several: unsupported is the mildest. */
export const severity = (shown: Shown): number => order.indexOf(shown);
export const isLost = (shown: Shown): boolean => severity(shown) > severity('fail');
export const isBad = (shown: Shown): boolean => severity(shown) >= severity('fail');

export interface Cell {
  cases: BriefCase[]; // finest time step first
  worst: BriefCase;
  at: BriefCase; // case whose numbers are shown
}

export function cellOf(scenario: Scenario, column: Column, step: StepChoice = 'all'): Cell | null {
  let cases = scenario.cases.filter((c) => c.spec === column.spec);
  if (step === 'finest') cases = cases.slice(0, 1);
  if (step === 'coarsest') cases = cases.slice(-1);
  const at = cases[0];
  if (at === undefined) return null;
  const worst = cases.reduce((a, b) => (severity(b.shown) > severity(a.shown) ? b : a));
  return { cases, worst, at };
}

/** The main error; NaN beside a crash, where it would be that of another time step. */
export const errorOf = (cell: Cell | null): number =>
  cell === null || isLost(cell.worst.shown) ? NaN : Math.abs(toNumber(cell.at.value));

/** The error over the scenario's own scale that its grade rests on; NaN where it has none. */
export const relativeOf = (cell: Cell | null): number =>
  cell === null || isLost(cell.worst.shown) ? NaN : toNumber(cell.at.judged.relative);

/** Grade that a cell is marked with if it ran; otherwise it is marked with its ending. */
export const gradeOf = (cell: Cell): string => (isLost(cell.worst.shown) ? '' : cell.at.judged.grade);

export const costOf = (cell: Cell | null): number => toNumber(cell?.at.step?.median);

/**
 * Position of a value between `least` and `most` on a logarithmic scale, 0 to 1; NaN for a value that is no number.
 * Zero is at the least.
 */
export function logPlace(value: number, least: number, most: number): number {
  if (Number.isNaN(value)) return NaN;
  if (value <= least) return 0;
  return Math.min(1, Math.log(value / least) / Math.log(most / least));
}
