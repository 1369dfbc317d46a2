// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Lines some pixels wide: rectangles that the vertex shader lays along the lines on the screen.
import { DoubleSide, ShaderMaterial, Vector2 } from 'three';
import { toSrgb } from './tint_material.ts';

/** `position` is one end of the line, `other` the other one, `side` on which side of the line a corner is. */
const vertexShader =
  `attribute vec3 other; attribute float side; uniform vec2 size; varying vec3 tint; ${toSrgb}` +
  'void main() { mat4 seen = projectionMatrix * viewMatrix * modelMatrix; tint = srgb(color);' +
  ' vec4 a = seen * vec4(position, 1.0); vec4 b = seen * vec4(other, 1.0);' +
  ' const float near = 1e-4;' + // an end behind the camera is moved along the line to before it
  ' if (a.w < near && b.w > near) a = mix(a, b, (near - a.w) / (b.w - a.w));' +
  ' if (b.w < near && a.w > near) b = mix(b, a, (near - b.w) / (a.w - b.w));' +
  ' vec2 along = (b.xy / b.w - a.xy / a.w) * size; float squared = dot(along, along);' +
  ' along = squared > 0.0 ? along * inversesqrt(squared) : vec2(1.0, 0.0);' +
  ' a.xy += side * vec2(-along.y, along.x) / size * a.w; gl_Position = a; }';
const fragmentShader = 'varying vec3 tint; void main() { gl_FragColor = vec4(tint, 1.0); }';

export class FatMaterial extends ShaderMaterial {
  readonly #size = new Vector2(1, 1);
  readonly #width: number;

  /** `width` [px] */
  constructor(width: number) {
    // transparent: drawn in the order of overlays
    super({ vertexShader, fragmentShader, vertexColors: true, depthTest: false, transparent: true, side: DoubleSide });
    this.#width = width;
    this.uniforms = { size: { value: this.#size } };
  }

  /** Size of the picture [px]. */
  fit(width: number, height: number): void {
    this.#size.set(width, height).divideScalar(this.#width);
    this.uniformsNeedUpdate = true;
  }
}
