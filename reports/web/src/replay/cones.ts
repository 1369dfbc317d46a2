// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Heads of arrows: cones as triangles of one mesh, in buffers that only grow.
import { BufferAttribute, type BufferGeometry, type Color } from 'three';
import { grown, type Numbers, setDynamic } from './growing.ts';
import type { Vec3 } from './vectors.ts';

const corners = 8; // corners of the open end
const numbers = 3 * (corners + 1);
const turns = Array.from({ length: corners }, (_, i) => (2 * Math.PI * i) / corners);
const cosines = turns.map(Math.cos);
const sines = turns.map(Math.sin);
const slender = 0.31; // radius over length

export class Cones {
  count = 0;
  #points: Numbers;
  #colours: Numbers;

  constructor(room: number) {
    this.#points = new Float32Array(numbers * room);
    this.#colours = new Float32Array(numbers * room);
  }

  /** A cone of a length with its tip at a point, along the unit vector d. */
  add(x: number, y: number, z: number, dx: number, dy: number, dz: number, length: number, c: Color): void {
    const at = numbers * this.count++;
    this.#points = grown(this.#points, at + numbers);
    this.#colours = grown(this.#colours, at + numbers);
    // any unit vector across d
    const across = Math.abs(dy) < 0.9;
    let ux = across ? dz : 0;
    let uy = across ? 0 : -dz;
    let uz = across ? -dx : dy;
    const norm = Math.sqrt(ux * ux + uy * uy + uz * uz);
    ux /= norm;
    uy /= norm;
    uz /= norm;
    const r = slender * length;
    this.#point(at, x, y, z);
    for (let i = 0; i < corners; ++i) {
      const u = r * (cosines[i] as number);
      const v = r * (sines[i] as number);
      const px = x - dx * length + u * ux + v * (uy * dz - uz * dy);
      const py = y - dy * length + u * uy + v * (uz * dx - ux * dz);
      const pz = z - dz * length + u * uz + v * (ux * dy - uy * dx);
      this.#point(at + 3 + 3 * i, px, py, pz);
    }
    for (let i = at; i < at + numbers; i += 3) {
      this.#colours[i] = c.r;
      this.#colours[i + 1] = c.g;
      this.#colours[i + 2] = c.b;
    }
  }

  #point(at: number, x: number, y: number, z: number): void {
    this.#points[at] = x;
    this.#points[at + 1] = y;
    this.#points[at + 2] = z;
  }

  tip(i: number): Vec3 {
    return [0, 1, 2].map((k) => this.#points[numbers * i + k] as number) as Vec3;
  }

  /** Shows the cones. */
  give(geometry: BufferGeometry): void {
    const room = this.#points.length / numbers;
    if ((geometry.index?.count ?? 0) < 3 * corners * room) geometry.setIndex(indexOf(room));
    setDynamic(geometry, 'position', this.#points);
    setDynamic(geometry, 'color', this.#colours);
    geometry.setDrawRange(0, 3 * corners * this.count);
  }
}

function indexOf(cones: number): BufferAttribute {
  const index = new Uint32Array(3 * corners * cones);
  for (let cone = 0; cone < cones; ++cone)
    for (let i = 0; i < corners; ++i) {
      const first = (corners + 1) * cone;
      index.set([first, first + 1 + i, first + 1 + ((i + 1) % corners)], 3 * (corners * cone + i));
    }
  return new BufferAttribute(index, 1);
}
