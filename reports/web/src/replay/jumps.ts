// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Targets of "first divergence", "largest error", "next contact" and "worst normal" among the sources that are shown.
import { inShownUnit, unitText } from '../common/format.ts';
import type { FrameSource, ReplayEvent } from './frames.ts';

export interface Jump {
  source: FrameSource;
  event: ReplayEvent;
}

type Kinds = ReplayEvent['kind'][];
const contactKinds: Kinds = ['contact_begin', 'contact_end'];
const slack = 1e-9;

const all = (sources: readonly FrameSource[], kinds: Kinds): Jump[] =>
  sources.flatMap((source) =>
    source.events.filter((event) => kinds.includes(event.kind)).map((event) => ({ source, event })),
  );

const earliest = (jumps: Jump[]): Jump | null =>
  jumps.reduce<Jump | null>((best, j) => (best === null || j.event.time < best.event.time ? j : best), null);

/** First divergence from the reference, or from another engine if no run leaves the reference or there is none. */
export function firstDivergence(sources: readonly FrameSource[]): Jump | null {
  return earliest(all(sources, ['divergence'])) ?? earliest(all(sources, ['engine_divergence']));
}

/**
 * Largest error in the first metric of `metrics` that any case has; that of the whole scene before that of one body.
 */
export function largestError(sources: readonly FrameSource[], metrics: readonly string[]): Jump | null {
  const found = all(sources, ['largest']);
  const named = metrics.find((name) => found.some((j) => j.event.what === name));
  const same = found.filter((j) => j.event.what === (named ?? found[0]?.event.what));
  const whole = same.filter((j) => !j.event.subject);
  return (whole.length > 0 ? whole : same).reduce<Jump | null>(
    (best, j) => (best === null || (j.event.value ?? 0) > (best.event.value ?? 0) ? j : best),
    null,
  );
}

/** Nearest contact event after (`forward`) or before a time. */
export function contactEvent(sources: readonly FrameSource[], time: number, forward: boolean): Jump | null {
  const found = all(sources, contactKinds).filter((j) =>
    forward ? j.event.time > time + slack : j.event.time < time - slack,
  );
  if (forward) return earliest(found);
  return found.reduce<Jump | null>((best, j) => (best === null || j.event.time > best.event.time ? j : best), null);
}

/**
 * The frame where the audit found a normal furthest from the exact ones. Contacts that the run itself acted upon and
 * results of the engine come before the results of other engines for its frames.
 */
export function worstNormal(sources: readonly FrameSource[]): Jump | null {
  const rank = ({ source, event }: Jump) => {
    const own = event.what === 'in_run' || event.what === source.spec.split(':')[0];
    return (own ? 1e6 : 0) + (event.value ?? 0);
  };
  return all(sources, ['audit'])
    .filter((j) => (j.event.unit ?? 'rad') === 'rad' && j.event.what !== 'oracle' && !j.event.what?.includes('|'))
    .reduce<Jump | null>((best, j) => (best === null || rank(j) > rank(best) ? j : best), null);
}

/** Bodies that an event names. */
export const bodiesOf = (event: ReplayEvent): string[] => (event.subject ? event.subject.split('|') : []);

const kindWords: Record<ReplayEvent['kind'], string> = {
  divergence: 'leaves the reference',
  engine_divergence: 'leaves',
  largest: 'largest',
  audit: 'worst contact geometry by',
  contact_begin: 'contact begins',
  contact_end: 'contact ends',
  nonfinite: 'no longer finite',
};

const findingWords = new Set(['normal', 'depth', 'missed', 'spurious']);

/** One line: "largest position_max, ball: 0.12 m". */
export function describe(event: ReplayEvent): string {
  const digits = (x: number) => String(Number(x.toPrecision(4)));
  let text = kindWords[event.kind];
  if (event.kind === 'audit' && findingWords.has(event.text ?? ''))
    text = `worst ${event.text} ${event.what === 'in_run' ? 'of its own run' : `by ${event.what}`}`;
  else if (event.what === 'in_run') text = 'worst contact geometry of its own run';
  else if (event.what) text += ` ${event.what}`;
  if (event.subject) text += `, ${event.subject.replace('|', ' and ')}`;
  if (event.value !== undefined)
    text += `: ${digits(inShownUnit(event.value, event.unit ?? '') as number)}${unitText(event.unit ?? '').replace('\u202f', ' ')}`;
  if (event.threshold) text += ` (more than ${digits(event.threshold)} m)`;
  return text;
}

/** Time of the next stored frame of the shown sources after (`forward`) or before a time; null at the end. */
export function neighbourTime(sources: readonly FrameSource[], time: number, forward: boolean): number | null {
  let best: number | null = null;
  for (const { times } of sources)
    for (let low = 0, high = times.length - 1; low <= high; ) {
      const middle = (low + high) >> 1;
      const t = times[middle] as number;
      const beyond = forward ? t > time + slack : t < time - slack;
      if (beyond && (best === null || (forward ? t < best : t > best))) best = t;
      if (forward === beyond) high = middle - 1;
      else low = middle + 1;
    }
  return best;
}
