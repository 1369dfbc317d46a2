// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many copies of some geometries as one mesh. Poses and colours of the copies are in textures that the vertex shader
// reads. Instances would need less memory, but where the browser draws in software each of them costs as much as a mesh.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  FloatType,
  InstancedBufferAttribute,
  RGBAFormat,
  type TypedArray,
} from 'three';

/** Copies in a row of a texture; the shader knows it too. */
const perRow = 256;

export class Places {
  readonly matrices: Float32Array<ArrayBuffer>; // 16 numbers a copy
  readonly colours: Float32Array<ArrayBuffer>; // 4 numbers a copy, linear
  readonly matrixTexture: DataTexture;
  readonly colourTexture: DataTexture;

  constructor(copies: number) {
    const rows = Math.ceil(copies / perRow);
    this.matrices = new Float32Array(16 * perRow * rows);
    this.colours = new Float32Array(4 * perRow * rows).fill(1);
    this.matrixTexture = new DataTexture(this.matrices, 4 * perRow, rows, RGBAFormat, FloatType);
    this.colourTexture = new DataTexture(this.colours, perRow, rows, RGBAFormat, FloatType);
    this.colourTexture.needsUpdate = true;
  }

  /** The same matrices from one copy on as an attribute, for rays. */
  attribute(first: number): InstancedBufferAttribute {
    return new InstancedBufferAttribute(this.matrices.subarray(16 * first), 16);
  }

  dispose(): void {
    this.matrixTexture.dispose();
    this.colourTexture.dispose();
  }
}

/** GLSL: pose and colour of the copy that a vertex belongs to. */
export const placesShader =
  'uniform highp sampler2D matrices; uniform highp sampler2D colours; attribute float which;' +
  'mat4 placeOf(int i) { ivec2 at = ivec2(4 * (i & 255), i >> 8); return mat4(texelFetch(matrices, at, 0),' +
  ' texelFetch(matrices, at + ivec2(1, 0), 0), texelFetch(matrices, at + ivec2(2, 0), 0),' +
  ' texelFetch(matrices, at + ivec2(3, 0), 0)); }' +
  'vec3 colourOf(int i) { return texelFetch(colours, ivec2(i & 255, i >> 8), 0).rgb; }';

/** A geometry and how often it is in a mesh. */
export interface Copies {
  geometry: BufferGeometry;
  count: number;
}

/** All copies of all geometries as one; the attribute `which` says which one a vertex belongs to, in their order. */
export function repeated(all: readonly Copies[]): BufferGeometry {
  const verticesOf = (geometry: BufferGeometry) => geometry.getAttribute('position').count;
  const sum = (of: (geometry: BufferGeometry) => number) => all.reduce((n, c) => n + c.count * of(c.geometry), 0);
  const vertices = sum(verticesOf);
  const out = new BufferGeometry();
  for (const name of ['position', 'normal']) {
    if (!all.every(({ geometry }) => geometry.hasAttribute(name))) continue;
    const to = new Float32Array(3 * vertices);
    let at = 0;
    for (const { geometry, count } of all)
      for (let i = 0; i < count; ++i) {
        const from = geometry.getAttribute(name).array as TypedArray;
        to.set(from, at);
        at += from.length;
      }
    out.setAttribute(name, new BufferAttribute(to, 3));
  }
  const which = new Float32Array(vertices);
  const indexed = all.some(({ geometry }) => geometry.index !== null);
  const index = new Uint32Array(indexed ? sum((g) => g.index?.count ?? verticesOf(g)) : 0);
  let [copy, first, at] = [0, 0, 0];
  for (const { geometry, count } of all)
    for (let i = 0; i < count; ++i) {
      const n = verticesOf(geometry);
      which.fill(copy++, first, first + n);
      const own = geometry.index?.array;
      for (let k = 0; indexed && k < (own?.length ?? n); ++k) index[at++] = first + (own?.[k] ?? k);
      first += n;
    }
  out.setAttribute('which', new BufferAttribute(which, 1));
  if (indexed) out.setIndex(new BufferAttribute(index, 1));
  return out;
}
