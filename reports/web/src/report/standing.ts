// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// How the columns did over a set of scenarios: failures, typical error relative to the best and to the bounds, typical
// cost. The same rules as reports/view_model.cpp: one time step, the finest; differences below single-precision
// rounding count as none; no reference, no ranking.
import { median, toNumber } from '../common/format.ts';
import { cellOf, costOf, errorInBounds, isBad, isLost } from './cells.ts';
import type { BriefCase, Column, Scenario } from './data.ts';

export interface Summary {
  column: Column;
  scenarios: number; // with a case that the engine can run
  bad: Scenario[]; // with a missed bound, crash, timeout or NaN at any time step
  known: Scenario[]; // that are off a bound as recorded
  ratio: number; // geometric mean of the error over the best one's; NaN without a number
  inBounds: number; // median of error over bound; NaN without bounds
  cost: number; // median wall time of a step [s]; NaN where not measured
  costRatio: number; // geometric mean of the cost over the cheapest one's
}

/** In SI units and scenes of about a metre: what single precision can hold. Below it errors count as equal. */
const roundingFloor = 1e-6;

/** Error over the best one's, with a floor under both: exact to rounding does not make the next one look 1e9 worse. */
export function ratiosToBest(errors: number[]): number[] {
  const finite = errors.filter(Number.isFinite);
  if (finite.length === 0) return errors.map(() => NaN);
  const floor = Math.max(1e-3 * median(finite), roundingFloor);
  const best = Math.min(...finite) + floor;
  return errors.map((e) => (Number.isFinite(e) ? (e + floor) / best : NaN));
}

const geometricMean = (values: number[]): number => {
  const logs = values.filter((v) => v > 0 && Number.isFinite(v)).map(Math.log);
  return logs.length ? Math.exp(logs.reduce((a, b) => a + b, 0) / logs.length) : NaN;
};

/** Cells of the finest time step that anybody completed. */
function atFinest(scenario: Scenario, columns: Column[]) {
  const finest = Math.min(...scenario.cases.filter((c) => c.outcome === 'completed').map((c) => c.dt));
  return columns.map((column) => {
    const cell = cellOf(scenario, column);
    const at = cell?.cases.find((c) => c.dt === finest);
    return at === undefined ? null : { cases: [at], worst: at, at };
  });
}

export function standings(scenarios: Scenario[], columns: Column[]): Summary[] {
  const ratios = columns.map(() => [] as number[]);
  const costs = columns.map(() => [] as number[]);
  const costRatios = columns.map(() => [] as number[]);
  const inBounds = columns.map(() => [] as number[]);
  for (const scenario of scenarios) {
    const cells = atFinest(scenario, columns);
    const errors = cells.map((cell) => (cell?.at.outcome === 'completed' ? Math.abs(toNumber(cell.at.value)) : NaN));
    const cheapest = Math.min(...cells.map(costOf).filter((c) => c > 0));
    ratiosToBest(
      scenario.reference ? errors.map((e) => (Number.isFinite(e) ? e : NaN)) : columns.map(() => NaN),
    ).forEach((r, i) => {
      ratios[i]?.push(r);
      inBounds[i]?.push(errorInBounds(cells[i] ?? null));
      costs[i]?.push(costOf(cells[i] ?? null));
      costRatios[i]?.push(costOf(cells[i] ?? null) / cheapest);
    });
  }
  return columns.map((column, i) => {
    const ran = scenarios.filter((s) => {
      const cell = cellOf(s, column);
      return cell !== null && cell.worst.shown !== 'unsupported';
    });
    const worst = (s: Scenario) => cellOf(s, column)?.worst.shown ?? 'unsupported';
    return {
      column,
      scenarios: ran.length,
      known: ran.filter((s) => worst(s) === 'known_deviation'),
      bad: ran.filter((s) => isBad(worst(s))),
      ratio: geometricMean(ratios[i] ?? []),
      inBounds: median((inBounds[i] ?? []).filter(Number.isFinite)),
      cost: median(costs[i] ?? []),
      costRatio: geometricMean(costRatios[i] ?? []),
    };
  });
}

/** Share of scenarios within every bound. */
export const within = (s: Summary): number => (s.scenarios - s.bad.length - s.known.length) / Math.max(1, s.scenarios);

/**
 * Least share of failures first, then most scenarios within their bounds, then the smallest error; who ran less than
 * half of what others ran comes last.
 */
export function ranked(list: Summary[]): Summary[] {
  const most = Math.max(0, ...list.map((s) => s.scenarios));
  const key = (s: Summary) => [
    2 * s.scenarios < most || !Number.isFinite(s.ratio) ? 1 : 0,
    s.bad.length / Math.max(1, s.scenarios),
    -within(s),
    Number.isFinite(s.ratio) ? s.ratio : Infinity,
  ];
  const compare = (a: number[], b: number[]) => {
    for (let i = 0; i < a.length; ++i) {
      const [x, y] = [a[i] as number, b[i] as number];
      if (x !== y) return x < y ? -1 : 1;
    }
    return 0;
  };
  return list.filter((s) => s.scenarios > 0).sort((a, b) => compare(key(a), key(b)));
}

export interface WorstMiss {
  scenario: Scenario;
  at: BriefCase;
  times: number; // value over bound; infinite where the run did not end, NaN where the bound is zero
}

const excess = (c: BriefCase): number =>
  isLost(c.shown) ? Infinity : toNumber(c.miss?.value) / toNumber(c.miss?.bound);

/** The worst of what a column missed, failures before recorded deviations. */
export function worstMiss({ bad, known, column }: Summary): WorstMiss | null {
  let worst: WorstMiss | null = null;
  for (const scenario of bad.length ? bad : known)
    for (const at of scenario.cases.filter((c) => c.spec === column.spec)) {
      const times = excess(at);
      if (times > 1 && (worst === null || times > worst.times)) worst = { scenario, at, times };
    }
  return worst;
}
