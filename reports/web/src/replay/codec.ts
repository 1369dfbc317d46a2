// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Reads what reports/replay/codec.hpp writes: rounded numbers, predicted from those before them, as bytes.

/** Variable-length codes of a byte array, one after the other. */
export class CodeReader {
  readonly #bytes: ArrayLike<number>;
  #at = 0;

  constructor(bytes: ArrayLike<number>) {
    this.#bytes = bytes;
  }

  /** The next difference, or NaN where the value is not finite. Throws RangeError at the end. */
  difference(): number {
    let code = 0;
    let weight = 1;
    for (;;) {
      const byte = this.#bytes[this.#at++];
      if (byte === undefined) throw new RangeError('replay: the data ends too early');
      code += (byte & 127) * weight;
      if (byte < 128) break;
      weight *= 128;
    }
    if (code === 0) return Number.NaN;
    const zigzag = code - 1;
    return zigzag % 2 === 0 ? zigzag / 2 : -(zigzag + 1) / 2;
  }

  /**
   * `samples` values of one column into out[first], out[first + stride], ...; each was predicted along the line
   * through the two finite ones before it.
   */
  series(samples: number, quantum: number, out: Float32Array | Float64Array, first = 0, stride = 1): void {
    let last = 0;
    let before = 0;
    let known = 0;
    for (let i = 0; i < samples; ++i) {
      const difference = this.difference();
      if (Number.isNaN(difference)) {
        out[first + i * stride] = Number.NaN;
        continue;
      }
      const value = difference + (known >= 2 ? 2 * last - before : last);
      before = last;
      last = value;
      ++known;
      out[first + i * stride] = value * quantum;
    }
  }

  /** One value for each of `previous`, predicted by the value at that index, or by 0 where it is -1. */
  linked(previous: ArrayLike<number>, quantum: number, out: Float32Array | Float64Array, first = 0, stride = 1): void {
    const kept = new Float64Array(previous.length);
    for (let i = 0; i < previous.length; ++i) {
      const link = previous[i] as number;
      const predicted = link < 0 ? 0 : (kept[link] as number);
      const difference = this.difference();
      const finite = !Number.isNaN(difference);
      kept[i] = finite ? predicted + difference : predicted;
      out[first + i * stride] = finite ? (kept[i] as number) * quantum : Number.NaN;
    }
  }
}
