// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page's data as reports/page/history.cpp and validation/comparison/print_comparison.cpp write them. SI units.
import type { Maybe } from '../common/format.ts';

export interface HistoryRun {
  name: string; // name of its folder
  title: string;
  started: string;
  command: string;
  cases: number;
  steps: number[]; // time steps [s], coarsest first
  specs: string[]; // short names of its specs
  versions: Record<string, string>; // versions of the engines
}

/** The case of one run in a series of cases that differ on purpose. */
export interface OwnCase {
  spec: string;
  label: string; // name of its engine (engine), short name of its spec without the engine
  dt: Maybe;
}

/**
 * A case through the runs: a value for each run, null where it has none. With a `Pair` spec, engine and dt are those of the
 * newest run that has a case, and `label` names the preset (engine), the engine (spec) or the spec (dt).
 */
export interface Series {
  scenario: string;
  title: string;
  spec: string;
  engine: string;
  label: string;
  dt: Maybe;
  metric: string;
  unit: string;
  error: Maybe[];
  at: Maybe[]; // time of the largest contribution to the error [s]; null: not known
  relative: Maybe[];
  grade: string[];
  outcome: string[]; // "" where the run does not have the case
  time: Maybe[];
  low: Maybe[]; // 95 % interval of the median
  high: Maybe[];
  scene: string | null; // name of the data file of the scenario; null: no replays are beside the page
  replay: (string | null)[]; // name of the data file of a run's replay
  cases?: (OwnCase | null)[]; // cases of the runs, if there is a pair
}

/** Place of a change; with a `Pair` also that of the later run. */
export interface Place {
  scenario: string;
  spec: string;
  dt: number;
  spec_after?: string;
  dt_after?: number;
}

/** Neither worse nor better: of a case that an engine does not support, of a number that is no error. */
export interface Judged {
  worse: boolean;
  better: boolean;
}

/** Comparison of one spec over all cases that both runs have, or of one pair of specs or time steps. */
export interface SpecChange {
  name: string;
  spec?: string; // spec of the earlier run, if there is a pair
  spec_after?: string;
  dt?: number; // time step of the earlier run [s], if they differ on purpose
  dt_after?: number;
  cases: number;
  better: number; // errors
  worse: number;
  same: number;
  cases_better: number; // cases of which more errors are better than worse
  cases_worse: number;
  p_cases: number; // sign test of cases_better against cases_worse
  timed: number;
  time_ratio: number | null;
  time_interval: [low: number, high: number] | null; // 95 %, over the cases; null: fewer than six
  p_time: number;
}

/** Changes from a run to the next. */
export interface Change {
  worse: boolean;
  specs: SpecChange[];
  verdicts: (Place & Judged & { before: string; after: string; reason: string })[]; // the gravest first
  /** The largest first. `size`: logarithm of the ratio, null where a number is lost or new. */
  metrics: (Place & Judged & { metric: string; unit: string; before: Maybe; after: Maybe; size: number | null })[];
  changed_scenarios: string[]; // scenarios whose physics differ
  only_before: string[];
  only_after: string[];
  unpaired: string[]; // cases without another one, if there is a pair
  environment: string[]; // "key: before -> after"
}

/** Deliberate difference of the runs; "": none. */
export type Pair = '' | 'engine' | 'spec' | 'dt';

export interface History {
  pair: Pair;
  runs: HistoryRun[];
  changes: (Change | null)[]; // changes from run i to i + 1; null: nothing to compare
  series: Series[];
}
