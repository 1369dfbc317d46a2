// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Changes of a case and their size: errors by the comparison of the runs, times by more than a tenth where the
// intervals of the two medians have no value in common and the comparison of the spec over its cases shows a difference
// in the same direction. The intervals of one case alone do not suffice: they hold the spread within a run, and a
// median varies by more from run to run.
import { toNumber } from '../common/format.ts';
import type { Change, History, Judged, Series, SpecChange } from './data.ts';
import { isOf, isOfSpec } from './series.ts';

export type State = 'worse' | 'better' | 'other';

export interface Mark {
  run: number; // index of the later run
  what: 'error' | 'time' | 'ending';
  ratio: number; // after over before; NaN where there is none
  size: number; // |ln ratio|, of errors with rounding as the least value; infinite for a number that is lost or new
  state: State;
}

const small = 1e-12;
const leastFactor = 1.1; // least factor of times

export const stateOf = ({ worse, better }: Judged): State => (worse ? 'worse' : better ? 'better' : 'other');

/** Ratio of two errors; of one that was nothing, infinity. */
const ratioOf = (before: number, after: number): number =>
  Math.abs(before) < small ? (Math.abs(after) < small ? 1 : Infinity) : Math.abs(after) / Math.abs(before);

/** Result of the comparison of times over the cases of a spec: its 95 % interval without 1; 'other' if none is shown. */
export function timeState({ time_interval }: SpecChange): State {
  if (!time_interval) return 'other';
  return time_interval[0] > 1 ? 'worse' : time_interval[1] < 1 ? 'better' : 'other';
}

function timeMark(s: Series, run: number, change: Change | null | undefined): Mark | null {
  const [low, high] = [toNumber(s.low[run]), toNumber(s.high[run])];
  const [lowBefore, highBefore] = [toNumber(s.low[run - 1]), toNumber(s.high[run - 1])];
  const ratio = toNumber(s.time[run]) / toNumber(s.time[run - 1]);
  const size = Math.abs(Math.log(ratio));
  if (!(low > highBefore || high < lowBefore) || !(size > Math.log(leastFactor))) return null;
  const state = ratio > 1 ? 'worse' : 'better';
  const spec = change?.specs.find((c) => isOfSpec(s, c, run));
  return spec && timeState(spec) === state ? { run, what: 'time', ratio, size, state } : null;
}

export function marksOf({ changes }: History, s: Series): Mark[] {
  const marks: Mark[] = [];
  for (let run = 1; run < s.outcome.length; ++run) {
    const change = changes[run - 1];
    const ended = change?.verdicts.find((v) => isOf(s, v, run));
    if (ended) marks.push({ run, what: 'ending', ratio: Number.NaN, size: Infinity, state: stateOf(ended) });
    const error = change?.metrics.find((m) => m.metric === s.metric && isOf(s, m, run));
    if (error) {
      const ratio = ratioOf(toNumber(error.before), toNumber(error.after));
      marks.push({ run, what: 'error', ratio, size: error.size ?? Infinity, state: stateOf(error) });
    }
    const time = timeMark(s, run, change);
    if (time) marks.push(time);
  }
  return marks;
}

const gravity: Record<State, number> = { worse: 2, better: 1, other: 0 };

/** Weight of one change: endings before errors before other numbers before times, each by its size. */
export function weightOf({ what, state, size }: Mark): number {
  if (what === 'ending') return 1000 + gravity[state];
  if (what === 'time') return Math.min(20, size);
  return Math.min(50, size) + (state === 'other' ? 30 : 100);
}

/** Weight of the gravest change of a scenario; 0 for none. */
export const weight = (marks: readonly Mark[]): number => Math.max(0, ...marks.map(weightOf));
