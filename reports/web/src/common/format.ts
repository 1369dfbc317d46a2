// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers as people read them. Values that JSON lacks are stored as "nan", "inf" and "-inf"; absent values are null.

export type Stored = number | 'nan' | 'inf' | '-inf';
export type Maybe = Stored | null;

/** The stored number; NaN for what is absent. */
export function toNumber(value: Maybe | undefined): number {
  if (typeof value === 'number') return value;
  return value === 'inf' ? Infinity : value === '-inf' ? -Infinity : NaN;
}

/** Four significant digits for reading. */
export function format(value: Maybe | undefined, digits = 4): string {
  if (value === null || value === undefined) return '—';
  const v = toNumber(value);
  if (Number.isNaN(v)) return 'NaN';
  if (!Number.isFinite(v)) return v > 0 ? '∞' : '−∞';
  const size = Math.abs(v);
  if (size === 0) return '0';
  if (size < 1e-3 || size >= 1e5) return minus(v.toExponential(Math.min(2, digits - 1)).replace('e+', 'e'));
  return minus(String(Number(v.toPrecision(digits))));
}
const minus = (text: string) => text.replace(/^-/, '−');

/** Label of an axis, with as many digits as neighbouring ticks need. */
export function tick(value: number): string {
  const short = Number(value.toPrecision(7));
  const far = short !== 0 && (Math.abs(short) < 1e-3 || Math.abs(short) >= 1e5);
  return minus(far ? short.toExponential().replace('e+', 'e') : String(short));
}

/** "≤ 2", or with a lower bound "≥ 1, ≤ 2". */
export function boundsText(bound: Maybe, boundMin: Maybe | undefined, shown: (value: Maybe) => string): string {
  const lower = boundMin === null || boundMin === undefined ? '' : `≥ ${shown(boundMin)}, `;
  return `${lower}≤ ${shown(bound)}`;
}

/** All digits: parses back to the stored bits. */
export const full = (value: Maybe | undefined): string =>
  value === null || value === undefined ? 'no value' : String(value);

/** The unit shown behind a number; nothing for the unit 1. */
export const unitText = (unit: string): string => (unit === 'rad' ? '°' : unit && unit !== '1' ? `\u202f${unit}` : '');

/** Seconds with a fitting unit. */
export function duration(seconds: Maybe | undefined): string {
  const s = toNumber(seconds);
  if (!Number.isFinite(s)) return '—';
  if (s !== 0 && s < 1e-6) return `${Number((s * 1e9).toPrecision(3))} ns`;
  if (s < 1e-3) return `${Number((s * 1e6).toPrecision(3))} µs`;
  if (s < 1) return `${Number((s * 1e3).toPrecision(3))} ms`;
  return `${Number(s.toPrecision(3))} s`;
}

/** "1/240 s" where it is one. */
export function timeStep(dt: Maybe): string {
  const step = toNumber(dt);
  const rate = Math.round(1 / step);
  if (rate >= 2 && Math.abs(1 / step - rate) < 1e-9 * rate) return `1/${rate} s`;
  return `${format(step)} s`;
}

const degree = Math.PI / 180;

/** The unit that a stored one is shown in: angles are in degrees on all pages. */
export const shownUnit = (unit: string): string => (unit === 'rad' ? '°' : unit);
/** A stored value in the unit that it is shown in. */
export const inShownUnit = (value: Maybe | undefined, unit: string): Maybe =>
  unit === 'rad' && typeof value === 'number' ? value / degree : (value ?? null);

/** Radians in degrees. */
export const angle = (radians: Maybe): string =>
  radians === null ? '—' : `${format((toNumber(radians) * 180) / Math.PI)}°`;

/** Ratio to the best: "×1", "×2.4", "×130", "×2e4"; "" for a value that is no number. */
export function ratio(value: Maybe): string {
  const r = toNumber(value);
  if (!Number.isFinite(r)) return '';
  if (r < 1.05) return '×1';
  if (r < 10) return `×${r.toPrecision(2)}`;
  return `×${r < 1000 ? Math.round(r) : r.toExponential(0).replace('e+', 'e')}`;
}

/** snake_case as words. */
export const words = (name: string): string => name.replaceAll('_', ' ');

/** Median of finite values; NaN without any. */
export function median(values: number[]): number {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  const n = sorted.length;
  if (n === 0) return NaN;
  const high = sorted[n >> 1] as number;
  return n % 2 ? high : 0.5 * (high + (sorted[(n >> 1) - 1] as number));
}

/** "1 case", "2 cases"; for things whose plural has an s alone. */
export const counted = (n: number, thing: string): string => `${n} ${thing}${n === 1 ? '' : 's'}`;

/** The first words of a long command, up to 160 characters, and how many follow. */
export function shortCommand(text: string): string {
  const words = text.split(' ');
  let shown = words[0] ?? '';
  let count = 1;
  for (; count < words.length && shown.length + (words[count] ?? '').length < 160; ++count) shown += ` ${words[count]}`;
  return count < words.length ? `${shown} … ${words.length - count} more` : shown;
}
