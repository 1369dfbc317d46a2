// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many copies of a geometry as one mesh. Poses and colours of the copies are in textures that the vertex shader reads.
// Instances would need less memory, but where the browser draws in software each of them costs as much as a mesh.
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

  /** The same matrices as an attribute, for rays. */
  attribute(): InstancedBufferAttribute {
    return new InstancedBufferAttribute(this.matrices, 16);
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

/** `n` copies; the attribute `which` says which one a vertex belongs to. */
export function repeated(geometry: BufferGeometry, n: number): BufferGeometry {
  const out = new BufferGeometry();
  const vertices = geometry.getAttribute('position').count;
  for (const name of ['position', 'normal']) {
    const from = geometry.getAttribute(name)?.array as TypedArray | undefined;
    if (!from) continue;
    const to = new Float32Array(n * from.length);
    for (let i = 0; i < n; ++i) to.set(from, i * from.length);
    out.setAttribute(name, new BufferAttribute(to, 3));
  }
  const which = Float32Array.from({ length: n * vertices }, (_, k) => Math.floor(k / vertices));
  out.setAttribute('which', new BufferAttribute(which, 1));
  const index = geometry.index?.array;
  if (!index) return out;
  const to = new Uint32Array(n * index.length);
  for (let k = 0; k < to.length; ++k)
    to[k] = (index[k % index.length] as number) + vertices * Math.floor(k / index.length);
  out.setIndex(new BufferAttribute(to, 1));
  return out;
}
