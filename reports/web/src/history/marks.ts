// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Changes of a case and their size: errors by the comparison of the runs, times by more than a tenth where the
// intervals of the two medians have no value in common: a median varies from run to run by more than within one.
import { toNumber } from '../common/format.ts';
import type { History, Series } from './data.ts';

export interface Mark {
  run: number; // index of the later run
  what: 'error' | 'time' | 'ending';
  ratio: number; // after over before; NaN where there is none
  worse: boolean;
}

const small = 1e-12;
const leastFactor = 1.1; // least factor of times

/** Ratio of two errors; of one that was nothing, infinity. */
const ratioOf = (before: number, after: number): number =>
  Math.abs(before) < small ? (Math.abs(after) < small ? 1 : Infinity) : Math.abs(after) / Math.abs(before);

export function marksOf({ changes }: History, s: Series): Mark[] {
  const marks: Mark[] = [];
  for (let run = 1; run < s.outcome.length; ++run) {
    const change = changes[run - 1];
    const same = (x: { scenario: string; spec: string; dt: number }) =>
      x.scenario === s.scenario && x.spec === s.spec && x.dt === toNumber(s.dt);
    const ended = change?.verdicts.find(same);
    if (ended) marks.push({ run, what: 'ending', ratio: Number.NaN, worse: ended.worse });
    const error = change?.metrics.find((m) => same(m) && m.metric === s.metric);
    if (error) {
      const ratio = ratioOf(toNumber(error.before), toNumber(error.after));
      marks.push({ run, what: 'error', ratio, worse: error.worse });
    }
    const [low, high] = [toNumber(s.low[run]), toNumber(s.high[run])];
    const [lowBefore, highBefore] = [toNumber(s.low[run - 1]), toNumber(s.high[run - 1])];
    const ratio = toNumber(s.time[run]) / toNumber(s.time[run - 1]);
    const isApart = low > highBefore || high < lowBefore;
    if (isApart && Math.abs(Math.log(ratio)) > Math.log(leastFactor)) {
      marks.push({ run, what: 'time', ratio, worse: ratio > 1 });
    }
  }
  return marks;
}

/** Weight of the changes of a scenario: endings before errors before times, by factors. */
export function weight(marks: Mark[]): number {
  const of = ({ what, ratio }: Mark) => {
    const factor = Number.isFinite(ratio) && ratio > 0 ? Math.abs(Math.log(ratio)) : 20;
    return what === 'ending' ? 1000 : what === 'error' ? 30 + factor : Math.min(20, factor);
  };
  return Math.max(0, ...marks.map(of));
}
