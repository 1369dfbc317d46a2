// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The grid of the ground as lines, for pictures that move where the browser draws in software: the surface that ground.ts
// shades fills the picture, and takes longer than all bodies on it.
import { BufferAttribute, BufferGeometry, Color, LineSegments, ShaderMaterial } from 'three';

const vertexShader =
  'attribute float strength; varying float cover; void main() { cover = strength;' +
  ' gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }';
const fragmentShader =
  'uniform vec3 colour; varying float cover; void main() { gl_FragColor = vec4(colour, cover);' +
  ' \n#include <colorspace_fragment>\n }';

const pieces = 4; // pieces of a line, between which its strength changes
const thick = 5; // each fifth line is a strong one

/** Strength at a distance from the middle, over that at which lines end: the shading's. */
export function fade(at: number): number {
  const t = Math.min(1, Math.max(0, (at - 0.25) / 0.75));
  return 1 - t * t * (3 - 2 * t);
}

export interface GridLines {
  position: number[]; // [m] on the surface, three numbers a point, two points a line
  strength: number[]; // strength of each point, 0 to 1
}

/** Lines `cell` metres from each other, to `near`, and strong ones five cells from each other, to `reach` from the middle. */
export function gridLines(cell: number, near: number, reach: number, shift: readonly [number, number]): GridLines {
  const out: GridLines = { position: [], strength: [] };
  for (const along of [0, 1] as const)
    for (const [size, strength, far] of [
      [cell, 0.45, near],
      [thick * cell, 0.9, reach],
    ] as const) {
      const from = shift[1 - along] as number;
      for (let k = Math.ceil((from - far) / size); k * size - from <= far; ++k) {
        if (size === cell && k % thick === 0) continue; // a strong line
        addLine(out, along, k * size - from, far, strength);
      }
    }
  return out;
}

/** The part of a line in the circle of radius `far`; `away` [m] from the middle. */
function addLine(out: GridLines, along: 0 | 1, away: number, far: number, strength: number): void {
  const half = Math.sqrt(Math.max(0, far * far - away * away));
  for (let i = 0; i < pieces; ++i)
    for (const end of [i, i + 1]) {
      const at = half * ((2 * end) / pieces - 1);
      out.position.push(...(along === 0 ? [at, away, 0] : [away, at, 0]));
      out.strength.push(strength * fade(Math.hypot(at, away) / far));
    }
}

export function groundLines(lines: GridLines, colour: string): LineSegments<BufferGeometry, ShaderMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(lines.position), 3));
  geometry.setAttribute('strength', new BufferAttribute(new Float32Array(lines.strength), 1));
  const uniforms = { colour: { value: new Color(colour) } };
  const material = new ShaderMaterial({ transparent: true, depthWrite: false, uniforms, vertexShader, fragmentShader });
  return new LineSegments(geometry, material);
}
