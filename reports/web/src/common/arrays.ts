// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Named arrays of numbers with a JSON head in one piece of memory: validation/results/array_bundle.hpp writes
// it, replays and the live view read it. Little-endian:
//   uint32 length of the head | head (UTF-8 JSON) | padding to 8 | arrays, each padded to 8
// The head is {"meta": any, "arrays": [{"name", "type", "offset", "count"}]}; offsets count from the first array.

const constructors = {
  f64: Float64Array,
  f32: Float32Array,
  i32: Int32Array,
  i16: Int16Array,
  u8: Uint8Array,
} as const;

export type NumberArray = Float64Array | Float32Array | Int32Array | Int16Array | Uint8Array;

interface Head {
  meta: unknown;
  arrays: { name: string; type: keyof typeof constructors; offset: number; count: number }[];
}

export class ArrayBundle {
  readonly meta: unknown;
  readonly #arrays = new Map<string, NumberArray>();

  /** Arrays are views of `buffer`, not copies. Throws RangeError when it is too short for what its head says. */
  constructor(buffer: ArrayBuffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as Head;
    const start = padded(4 + length);
    this.meta = head.meta;
    for (const { name, type, offset, count } of head.arrays)
      this.#arrays.set(name, new constructors[type](buffer, start + offset, count));
  }

  has(name: string): boolean {
    return this.#arrays.has(name);
  }

  /** Throws RangeError when there is no array of this name. */
  get(name: string): NumberArray {
    const found = this.#arrays.get(name);
    if (found === undefined) throw new RangeError(`no array "${name}"`);
    return found;
  }
}

const padded = (bytes: number) => Math.ceil(bytes / 8) * 8;
