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
  versions: Record<string, string>; // versions of the engines
}

/** A case through the runs: a value for each run, null where it has none. */
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
  relative: Maybe[];
  grade: string[];
  outcome: string[]; // "" where the run does not have the case
  time: Maybe[];
  low: Maybe[]; // 95 % interval of the median
  high: Maybe[];
  scene: string | null; // name of the data file of the scenario; null: no replays are beside the page
  replay: (string | null)[]; // name of the data file of a run's replay
}

/** Changes from a run to the next. */
export interface Change {
  worse: boolean;
  specs: {
    name: string;
    cases: number;
    better: number;
    worse: number;
    same: number;
    p_errors: number;
    timed: number;
    time_ratio: number | null;
    time_interval: [low: number, high: number] | null;
    p_time: number;
  }[];
  verdicts: {
    scenario: string;
    spec: string;
    dt: number;
    before: string;
    after: string;
    worse: boolean;
    reason: string;
  }[];
  metrics: {
    scenario: string;
    spec: string;
    dt: number;
    metric: string;
    unit: string;
    before: Maybe;
    after: Maybe;
    worse: boolean;
  }[];
  changed_scenarios: string[]; // scenarios whose physics differ
  only_before: string[];
  only_after: string[];
  environment: string[]; // "key: before -> after"
}

export interface History {
  runs: HistoryRun[];
  changes: (Change | null)[]; // changes from run i to i + 1; null: no case in common
  series: Series[];
}
