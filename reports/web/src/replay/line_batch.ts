// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many coloured lines and arrows that change with every frame, in buffers that only grow.
import {
  BufferAttribute,
  BufferGeometry,
  type Color,
  DoubleSide,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  Points,
  ShaderMaterial,
  Vector4,
} from 'three';
import { Cones } from './cones.ts';
import { FatMaterial } from './fat_material.ts';
import { grown, type Numbers, setDynamic } from './growing.ts';
import { TintMaterial } from './tint_material.ts';
import type { Vec3 } from './vectors.ts';

/** Ends and colours of lines, six numbers each. */
class Segments {
  points: Numbers;
  colours: Numbers;
  count = 0;

  constructor(room: number) {
    this.points = new Float32Array(6 * room);
    this.colours = new Float32Array(6 * room);
  }

  /** `fade`: 0 the colour, 1 the background `to`. */
  add(ax: number, ay: number, az: number, bx: number, by: number, bz: number, c: Color, to: Color = c, fade = 0): void {
    const i = 6 * this.count++;
    this.points = grown(this.points, i + 6);
    this.colours = grown(this.colours, i + 6);
    const p = this.points;
    p[i] = ax;
    p[i + 1] = ay;
    p[i + 2] = az;
    p[i + 3] = bx;
    p[i + 4] = by;
    p[i + 5] = bz;
    const q = this.colours;
    q[i] = q[i + 3] = c.r + (to.r - c.r) * fade;
    q[i + 1] = q[i + 4] = c.g + (to.g - c.g) * fade;
    q[i + 2] = q[i + 5] = c.b + (to.b - c.b) * fade;
  }
}

/** Lines one pixel wide. */
export class ThinLines {
  readonly object: LineSegments<BufferGeometry, LineBasicMaterial>;
  readonly #segments = new Segments(64);

  constructor(order: number, xray: boolean) {
    const material = new LineBasicMaterial({ vertexColors: true, transparent: true, depthTest: !xray });
    this.object = new LineSegments(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
  }

  /** Ends of the lines, as they stand in the buffer that is drawn. */
  get ends(): number[] {
    return Array.from(this.#segments.points.subarray(0, 6 * this.#segments.count));
  }

  begin(): void {
    this.#segments.count = 0;
  }

  /** `fade`: 0 the colour, 1 the background `to`. */
  line(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    c: Color,
    to: Color = c,
    fade = 0,
  ): void {
    this.#segments.add(ax, ay, az, bx, by, bz, c, to, fade);
  }

  end(): void {
    const { geometry } = this.object;
    setDynamic(geometry, 'position', this.#segments.points);
    setDynamic(geometry, 'color', this.#segments.colours);
    geometry.setDrawRange(0, 2 * this.#segments.count);
    this.object.visible = this.#segments.count > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}

export interface Arrow {
  from: Vec3;
  to: Vec3;
}

/** Lines and arrows a few pixels wide, seen through everything. */
export class FatLines {
  readonly object: Mesh<BufferGeometry, FatMaterial>;
  readonly heads: Mesh<BufferGeometry, TintMaterial>;
  readonly #segments = new Segments(32);
  readonly #cones = new Cones(32);
  readonly #size = new Vector4();
  #stems: number[] = []; // line of each head
  #ends: Numbers = new Float32Array(0); // corners of the rectangles, three numbers each
  #others: Numbers = new Float32Array(0);
  #tones: Numbers = new Float32Array(0);

  constructor(order: number, width: number) {
    this.object = new Mesh(new BufferGeometry(), new FatMaterial(width));
    this.object.onBeforeRender = (renderer) => {
      renderer.getViewport(this.#size);
      this.object.material.fit(this.#size.z, this.#size.w);
    };
    const tint = new TintMaterial(false, null);
    tint.vertexColors = true;
    tint.depthTest = false;
    tint.transparent = true; // drawn in the order of overlays
    tint.side = DoubleSide; // cones are open below
    this.heads = new Mesh(new BufferGeometry(), tint);
    for (const mesh of [this.object, this.heads]) {
      mesh.frustumCulled = false;
      mesh.renderOrder = order;
    }
  }

  begin(): void {
    this.#segments.count = 0;
    this.#cones.count = 0;
    this.#stems = [];
  }

  line(ax: number, ay: number, az: number, bx: number, by: number, bz: number, c: Color): void {
    this.#segments.add(ax, ay, az, bx, by, bz, c);
  }

  /** Arrow from a point along a vector; the head is `head` long, at most half of the arrow. */
  arrow(x: number, y: number, z: number, dx: number, dy: number, dz: number, head: number, c: Color): void {
    const length = Math.sqrt(dx * dx + dy * dy + dz * dz);
    if (!(length > 0) || !Number.isFinite(length + x + y + z)) return;
    const h = Math.min(head, length / 2);
    const s = (length - h) / length;
    this.#stems.push(this.#segments.count);
    this.line(x, y, z, x + dx * s, y + dy * s, z + dz * s, c);
    this.#cones.add(x + dx, y + dy, z + dz, dx / length, dy / length, dz / length, h, c);
  }

  /** Arrows as they stand in the buffers that are drawn: where each begins, and its tip [m]. */
  get arrows(): Arrow[] {
    const three = (array: Numbers, at: number) => [0, 1, 2].map((k) => array[at + k] as number) as Vec3;
    return this.#stems.map((stem, i) => ({ from: three(this.#ends, 12 * stem), to: this.#cones.tip(i) }));
  }

  end(): void {
    this.#layOut();
    const { geometry } = this.object;
    setDynamic(geometry, 'position', this.#ends);
    setDynamic(geometry, 'other', this.#others);
    setDynamic(geometry, 'color', this.#tones);
    geometry.setDrawRange(0, 6 * this.#segments.count);
    this.object.visible = this.#segments.count > 0;
    this.#cones.give(this.heads.geometry);
    this.heads.visible = this.#cones.count > 0;
  }

  /** Four corners for each line: two at its first end, two at its second one. */
  #layOut(): void {
    const { points, colours, count } = this.#segments;
    if (this.#ends.length < 2 * points.length) this.#makeRoom(points.length / 6);
    for (let i = 0; i < count; ++i)
      for (let corner = 0; corner < 4; ++corner) {
        const near = 6 * i + (corner < 2 ? 0 : 3);
        const far = 6 * i + (corner < 2 ? 3 : 0);
        for (let k = 0; k < 3; ++k) {
          const to = 12 * i + 3 * corner + k;
          this.#ends[to] = points[near + k] as number;
          this.#others[to] = points[far + k] as number;
          this.#tones[to] = colours[near + k] as number;
        }
      }
  }

  #makeRoom(lines: number): void {
    this.#ends = new Float32Array(12 * lines);
    this.#others = new Float32Array(12 * lines);
    this.#tones = new Float32Array(12 * lines);
    // seen from its own end, the left side of a line is the right one of its other end
    const sides = Float32Array.from({ length: 4 * lines }, (_, i) => [-1, 1, 1, -1][i % 4] as number);
    const corners = [0, 1, 2, 2, 1, 3];
    const index = Uint32Array.from({ length: 6 * lines }, (_, i) => 4 * Math.floor(i / 6) + (corners[i % 6] as number));
    const geometry = new BufferGeometry();
    geometry.setAttribute('side', new BufferAttribute(sides, 1));
    geometry.setIndex(new BufferAttribute(index, 1));
    this.object.geometry.dispose();
    this.object.geometry = geometry;
  }

  dispose(): void {
    for (const mesh of [this.object, this.heads]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}

/** Round dots of the same size on the screen however far they are. */
export class Dots {
  readonly object: Points<BufferGeometry, ShaderMaterial>;
  #points = new Float32Array(3 * 64);
  #colours = new Float32Array(3 * 64);
  #count = 0;

  constructor(order: number, pixels: number) {
    const material = new ShaderMaterial({
      transparent: true,
      depthTest: false,
      vertexColors: true,
      uniforms: { pixels: { value: pixels } },
      vertexShader:
        'uniform float pixels; varying vec3 tint; void main() { tint = color; gl_PointSize = pixels;' +
        ' gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
      fragmentShader:
        'varying vec3 tint; void main() { float r = length(gl_PointCoord - 0.5) * 2.0; float w = fwidth(r);' +
        ' gl_FragColor = vec4(mix(tint, vec3(1.0), smoothstep(0.62 - w, 0.62, r)), 1.0 - smoothstep(1.0 - w, 1.0, r));' +
        ' \n#include <colorspace_fragment>\n }',
    });
    this.object = new Points(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
  }

  set pixels(value: number) {
    (this.object.material.uniforms.pixels as { value: number }).value = value;
  }

  get points(): number[] {
    return Array.from(this.#points.subarray(0, 3 * this.#count));
  }

  /** Dots as they stand in the buffer that is drawn [m]. */
  get places(): Vec3[] {
    return Array.from({ length: this.#count }, (_, i) => [...this.#points.slice(3 * i, 3 * i + 3)] as Vec3);
  }

  begin(): void {
    this.#count = 0;
  }

  dot(x: number, y: number, z: number, c: Color): void {
    const i = 3 * this.#count++;
    this.#points = grown(this.#points, i + 3);
    this.#colours = grown(this.#colours, i + 3);
    this.#points[i] = x;
    this.#points[i + 1] = y;
    this.#points[i + 2] = z;
    this.#colours[i] = c.r;
    this.#colours[i + 1] = c.g;
    this.#colours[i + 2] = c.b;
  }

  end(): void {
    setDynamic(this.object.geometry, 'position', this.#points);
    setDynamic(this.object.geometry, 'color', this.#colours);
    this.object.geometry.setDrawRange(0, this.#count);
    this.object.visible = this.#count > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
