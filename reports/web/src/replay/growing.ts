// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Arrays of numbers that only grow, and the attributes that show them.
import { BufferAttribute, type BufferGeometry, DynamicDrawUsage } from 'three';

export type Numbers = Float32Array<ArrayBuffer>;

/** The array, or a larger copy with room for so many numbers. */
export function grown(array: Numbers, needed: number): Numbers {
  if (needed <= array.length) return array;
  const larger = new Float32Array(Math.max(needed, 2 * array.length));
  larger.set(array);
  return larger;
}

/** Shows an array of vectors that has changed. */
export function setDynamic(geometry: BufferGeometry, name: string, array: Float32Array): void {
  let attribute = geometry.getAttribute(name) as BufferAttribute | undefined;
  if (attribute?.array !== array) {
    attribute = new BufferAttribute(array, 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, attribute);
  }
  attribute.needsUpdate = true;
}
