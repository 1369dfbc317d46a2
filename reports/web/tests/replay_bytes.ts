// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Writes what the replay reads, for tests: the same rules as reports/replay/codec.cpp, said a second time.

function code(out: number[], difference: number | null): void {
  let rest = difference === null ? 0 : 1 + (difference >= 0 ? 2 * difference : -2 * difference - 1);
  while (rest >= 128) {
    out.push((rest % 128) + 128);
    rest = Math.floor(rest / 128);
  }
  out.push(rest);
}

export function seriesCodes(values: number[], quantum: number): number[] {
  const out: number[] = [];
  const known: number[] = [];
  for (const v of values) {
    if (!Number.isFinite(v)) {
      code(out, null);
      continue;
    }
    const rounded = Math.round(v / quantum);
    const [last, before] = [known.at(-1) ?? 0, known.at(-2) ?? 0];
    code(out, rounded - (known.length >= 2 ? 2 * last - before : last));
    known.push(rounded);
  }
  return out;
}

export function linkedCodes(values: number[], previous: number[], quantum: number): number[] {
  const out: number[] = [];
  const kept: number[] = [];
  values.forEach((v, i) => {
    const link = previous[i] as number;
    const predicted = link < 0 ? 0 : (kept[link] as number);
    const rounded = Math.round(v / quantum);
    code(out, Number.isFinite(v) ? rounded - predicted : null);
    kept.push(Number.isFinite(v) ? rounded : predicted);
  });
  return out;
}

type Arrays = Record<string, Float64Array | Int32Array | Uint8Array>;

/** Bundle as validation/results/array_bundle.cpp writes it. */
export function bundleOf(meta: unknown, arrays: Arrays): ArrayBuffer {
  const types = { Float64Array: 'f64', Int32Array: 'i32', Uint8Array: 'u8' } as Record<string, string>;
  const pad = (n: number) => Math.ceil(n / 8) * 8;
  let size = 0;
  const entries = Object.entries(arrays).map(([name, array]) => {
    const entry = { name, type: types[array.constructor.name], offset: size, count: array.length };
    size += pad(array.byteLength);
    return entry;
  });
  const head = new TextEncoder().encode(JSON.stringify({ meta, arrays: entries }));
  const start = pad(4 + head.length);
  const out = new Uint8Array(start + size);
  new DataView(out.buffer).setUint32(0, head.length, true);
  out.set(head, 4);
  Object.values(arrays).forEach((array, i) => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    out.set(bytes, start + (entries[i]?.offset ?? 0));
  });
  return out.buffer;
}
