// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Series of cases through the runs: their names, and the case of each run.
import { timeStep, toNumber } from '../common/format.ts';
import type { OwnCase, Pair, Place, Series, SpecChange } from './data.ts';

/** The case of a run. */
export const caseAt = (s: Series, run: number): OwnCase => s.cases?.[run] ?? s;

/** Name of a series in the address. */
export const caseKey = (s: Pick<Series, 'scenario' | 'spec' | 'dt'>): string => `${s.scenario}~${s.spec}~${s.dt}`;

/** True for a change from the run before `run` to `run` in this series. */
export function isOf(s: Series, place: Place, run: number): boolean {
  const { spec, dt } = caseAt(s, run - 1);
  const after = caseAt(s, run);
  return (
    s.scenario === place.scenario &&
    spec === place.spec &&
    toNumber(dt) === place.dt &&
    after.spec === (place.spec_after ?? place.spec) &&
    toNumber(after.dt) === (place.dt_after ?? place.dt)
  );
}

/** True for the comparison of the specs of this series in the run before `run` and in `run`. */
export function isOfSpec(s: Series, change: SpecChange, run: number): boolean {
  const [before, after] = [caseAt(s, run - 1), caseAt(s, run)];
  const hasStep = (own: number | undefined, dt: OwnCase['dt']) => own === undefined || own === toNumber(dt);
  return (
    before.spec === (change.spec ?? change.name) &&
    after.spec === (change.spec_after ?? change.name) &&
    hasStep(change.dt, before.dt) &&
    hasStep(change.dt_after, after.dt)
  );
}

/** Name of what the case of a run has of its own: "1/240 s", "rigor tgs_soft"; "" where the runs do not differ on purpose. */
export function ownName(s: Series, run: number, pair: Pair): string {
  const own = s.cases?.[run];
  if (!own || pair === '') return '';
  return pair === 'dt' ? timeStep(own.dt) : own.label;
}

/** Names of what the cases of some runs have of their own, in the order of the runs: "1/60 s → 1/240 s". */
export function ownNames(s: Series, pair: Pair, runs: readonly number[]): string {
  const names = runs.map((run) => ownName(s, run, pair)).filter(Boolean);
  return names.filter((name, i) => name !== names[i - 1]).join(' → ');
}

/** Names of the series of one scenario over some runs; by default over all. */
export function seriesNames(all: readonly Series[], pair: Pair): (s: Series, runs?: readonly number[]) => string {
  const steps = pair === 'dt' ? 1 : new Set(all.map((s) => toNumber(s.dt))).size;
  return (s, runs = s.outcome.map((_, run) => run)) => {
    const own = ownNames(s, pair, runs);
    return s.label + (steps > 1 ? `, ${timeStep(s.dt)}` : '') + (own ? `: ${own}` : '');
  };
}

/**
 * Moment at which the runs are shown first [s]: that of the largest error among them whose time is known; else the end,
 * where runs that start alike have come farthest apart.
 */
export function firstMoment(s: Series, runs: readonly number[]): number {
  let worst = 0;
  let moment = Infinity;
  for (const run of runs) {
    const error = Math.abs(toNumber(s.error[run]));
    const at = toNumber(s.at[run]);
    if (!(error > worst) || !Number.isFinite(at)) continue;
    worst = error;
    moment = at;
  }
  return moment;
}
