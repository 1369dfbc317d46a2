// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Samples of curves: unpacking, finding, and which axis suits them.

/** Packed little-endian singles of the page's data; null where the page has no such curve. */
export function unpack(text: string | null | undefined): Float32Array | null {
  if (!text) return null;
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

/** Values that are not finite are gaps. */
export const withGaps = (values: ArrayLike<number>): (number | null)[] =>
  Array.from(values, (v) => (Number.isFinite(v) ? v : null));

/** Index of the sample of ascending `x` that is nearest to a value, on a logarithmic axis by factors. */
export function nearest(x: ArrayLike<number>, value: number, logarithmic = false): number {
  let low = 0;
  let high = x.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((x[middle] as number) < value) low = middle + 1;
    else high = middle;
  }
  if (low === 0) return 0;
  const before = x[low - 1] as number;
  const after = x[low] as number;
  const isBefore = logarithmic ? value * value < before * after : value - before < after - value;
  return isBefore ? low - 1 : low;
}

/** Ends of an interval that an axis can show; null without. */
export function bandOf(low: number | null, high: number | null, logarithmic: boolean): [number, number] | null {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return null;
  return logarithmic && !(low > 0) ? null : [low, high];
}

/** Logarithmic where non-negative values spread over more than three decades. */
export function spreadsByDecades(values: (number | null)[], decades = 3): boolean {
  let least = Infinity;
  let most = 0;
  for (const v of values) {
    if (v === null || Number.isNaN(v)) continue;
    if (v < 0) return false;
    if (v > 0) {
      least = Math.min(least, v);
      most = Math.max(most, v);
    }
  }
  return most > least * 10 ** decades;
}

/** Ticks of a logarithmic axis, at most about eight: decades, or 1, 2 and 5 of each where there are few. */
export function logTicks(min: number, max: number): number[] {
  const first = Math.floor(Math.log10(min) + 1e-9);
  const last = Math.ceil(Math.log10(max) - 1e-9);
  const step = Math.max(1, Math.ceil((last - first) / 8));
  const factors = last - first <= 2 ? [1, 2, 5] : [1];
  const ticks: number[] = [];
  for (let decade = first; decade <= last; decade += step)
    for (const factor of factors) ticks.push(Number(`${factor}e${decade}`));
  return ticks.filter((v) => v >= min * (1 - 1e-9) && v <= max * (1 + 1e-9));
}

/** Ends of a logarithmic axis: a little beyond those of positive data. */
export function widened(min: number, max: number): [number, number] {
  const factor = max > min ? (max / min) ** 0.03 : 2;
  return [min / factor, max * factor];
}
