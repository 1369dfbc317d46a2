// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Material of faces and edges: light and the conversion to sRGB are computed at vertices, so that a pixel costs a copy
// of its colour. Where the browser draws in software, pixels are most of a picture's time. The light is the sum of a sun
// and of a sky that is darker below; flat faces get the same colour as with light computed at each pixel.
import { Color, ShaderMaterial } from 'three';
import { type Places, placesShader } from './repeated.ts';

/** Conversion of linear colours, in GLSL. */
export const toSrgb =
  'vec3 srgb(vec3 c) { return mix(1.055 * pow(c, vec3(0.41666)) - 0.055, 12.92 * c,' +
  ' vec3(lessThanEqual(c, vec3(0.0031308)))); }';
const vertexShader =
  `uniform vec3 colour; uniform float own; uniform float sky; varying vec3 tint; ${toSrgb}` +
  `\n#ifdef REPEATED\n ${placesShader} \n#endif\n` +
  'void main() { vec3 c = colour; mat4 place = modelMatrix;' +
  '\n#ifdef REPEATED\n c *= mix(vec3(1.0), colourOf(int(which)), own); place = place * placeOf(int(which));\n#endif\n' +
  '\n#ifdef USE_COLOR\n c *= color;\n#endif\n' +
  // columns over their squared lengths: the inverse transpose of a rotation and a stretch
  '\n#ifdef LIT\n vec3 n = normalize(place[0].xyz * (normal.x / dot(place[0].xyz, place[0].xyz)) +' +
  ' place[1].xyz * (normal.y / dot(place[1].xyz, place[1].xyz)) +' +
  ' place[2].xyz * (normal.z / dot(place[2].xyz, place[2].xyz)));' +
  ' float sun = 2.1 * max(dot(n, normalize(vec3(0.45, 1.0, 0.7))), 0.0);' +
  ' vec3 below = vec3(0.2541, 0.2747, 0.3139);' +
  ' c *= (sun + sky * mix(below, vec3(1.0), 0.5 * n.y + 0.5)) / 3.14159265;\n#endif\n' +
  ' tint = srgb(c); gl_Position = projectionMatrix * viewMatrix * place * vec4(position, 1.0); }';
const fragmentShader = 'uniform float opacity; varying vec3 tint; void main() { gl_FragColor = vec4(tint, opacity); }';

export class TintMaterial extends ShaderMaterial {
  readonly color = new Color('#ffffff');

  /** `lit`: shaded by the light; else as it is coloured. `places`: those of the copies of a repeated geometry. */
  constructor(lit: boolean, places: Places | null) {
    super({
      vertexShader,
      fragmentShader,
      defines: { ...(lit ? { LIT: '' } : {}), ...(places ? { REPEATED: '' } : {}) },
    });
    this.uniforms = {
      colour: { value: this.color },
      own: { value: 1 },
      sky: { value: 1 },
      opacity: { value: 1 },
      matrices: { value: places?.matrixTexture ?? null },
      colours: { value: places?.colourTexture ?? null },
    };
  }

  #set(name: string, value: number): void {
    (this.uniforms[name] as { value: number }).value = value;
  }

  /** Brightness of the sky. */
  set sky(value: number) {
    this.#set('sky', value);
  }

  /** 1: nothing behind it is seen. */
  set cover(value: number) {
    this.#set('opacity', value);
  }

  /** Copies have colours of their own. */
  set own(value: boolean) {
    this.#set('own', value ? 1 : 0);
  }
}
