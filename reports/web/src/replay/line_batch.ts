// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Many coloured lines and arrows that change with every frame, in buffers that only grow.
import {
  BufferAttribute,
  BufferGeometry,
  type Color,
  ConeGeometry,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedInterleavedBuffer,
  InstancedMesh,
  InterleavedBufferAttribute,
  LineBasicMaterial,
  LineSegments,
  MeshBasicMaterial,
  Points,
  ShaderMaterial,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Vec3 } from './vectors.ts';

type Numbers = Float32Array<ArrayBuffer>;

const grown = (array: Numbers, needed: number): Numbers => {
  if (needed <= array.length) return array;
  const larger = new Float32Array(Math.max(needed, 2 * array.length));
  larger.set(array);
  return larger;
};

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

function setDynamic(geometry: BufferGeometry, name: string, array: Float32Array): void {
  let attribute = geometry.getAttribute(name) as BufferAttribute | undefined;
  if (attribute?.array !== array) {
    attribute = new BufferAttribute(array, 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, attribute);
  }
  attribute.needsUpdate = true;
}

export interface Arrow {
  from: Vec3;
  to: Vec3;
}

/** Lines and arrows a few pixels wide, seen through everything. */
export class FatLines {
  readonly object: LineSegments2;
  readonly heads: InstancedMesh;
  readonly #segments = new Segments(32);
  #headCount = 0;
  #stems: number[] = []; // line of each head
  #geometry = new LineSegmentsGeometry();
  readonly #lineMaterial: LineMaterial;

  constructor(order: number, width: number) {
    this.#lineMaterial = new LineMaterial({
      linewidth: width,
      vertexColors: true,
      depthTest: false,
      transparent: true,
    });
    this.object = new LineSegments2(this.#geometry, this.#lineMaterial);
    this.#bind();
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    const cone = new ConeGeometry(0.5, 1, 14);
    cone.translate(0, -0.5, 0); // its tip is the origin
    this.heads = new InstancedMesh(cone, new MeshBasicMaterial({ depthTest: false, transparent: true }), 64);
    this.heads.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * 64), 3);
    this.heads.frustumCulled = false;
    this.heads.renderOrder = order;
  }

  begin(): void {
    this.#segments.count = 0;
    this.#headCount = 0;
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
    this.#head(x + dx, y + dy, z + dz, dx / length, dy / length, dz / length, h, c);
  }

  /** Arrows as they stand in the buffers that are drawn: where each begins, and its tip [m]. */
  get arrows(): Arrow[] {
    const starts = this.object.geometry.getAttribute('instanceStart') as InterleavedBufferAttribute;
    const tips = this.heads.instanceMatrix.array;
    return this.#stems.map((stem, i) => ({
      from: [starts.getX(stem), starts.getY(stem), starts.getZ(stem)],
      to: [12, 13, 14].map((k) => tips[16 * i + k] as number) as Vec3,
    }));
  }

  end(): void {
    if (this.#geometry.getAttribute('instanceStart')?.array !== this.#segments.points) this.#bind();
    for (const name of ['instanceStart', 'instanceColorStart'])
      (this.#geometry.getAttribute(name) as InterleavedBufferAttribute).data.needsUpdate = true;
    this.#geometry.instanceCount = this.#segments.count;
    this.object.visible = this.#segments.count > 0;
    this.heads.count = this.#headCount;
    this.heads.visible = this.#headCount > 0;
    this.heads.instanceMatrix.needsUpdate = true;
    if (this.heads.instanceColor) this.heads.instanceColor.needsUpdate = true;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#lineMaterial.dispose();
    this.heads.geometry.dispose();
    (this.heads.material as MeshBasicMaterial).dispose();
    this.heads.dispose();
  }

  /** Buffers that have grown need a new geometry. */
  #bind(): void {
    this.#geometry.dispose();
    this.#geometry = new LineSegmentsGeometry();
    const set = (start: string, end: string, array: Float32Array) => {
      const buffer = new InstancedInterleavedBuffer(array, 6, 1).setUsage(DynamicDrawUsage);
      this.#geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
      this.#geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
    };
    set('instanceStart', 'instanceEnd', this.#segments.points);
    set('instanceColorStart', 'instanceColorEnd', this.#segments.colours);
    this.object.geometry = this.#geometry;
  }

  /** A cone whose axis y points along the unit vector d. */
  #head(x: number, y: number, z: number, dx: number, dy: number, dz: number, size: number, c: Color): void {
    const i = this.#headCount++;
    const heads = this.heads;
    if (16 * (i + 1) > heads.instanceMatrix.array.length) {
      const matrices = grown(heads.instanceMatrix.array as Numbers, 16 * (i + 1));
      heads.instanceMatrix = new InstancedBufferAttribute(matrices, 16);
      const colours = grown(heads.instanceColor?.array as Numbers, (3 * matrices.length) / 16);
      heads.instanceColor = new InstancedBufferAttribute(colours, 3);
    }
    const m = heads.instanceMatrix.array as Float32Array;
    const o = 16 * i;
    // any unit vector across d
    const across = Math.abs(dy) < 0.9;
    let ux = across ? dz : 0;
    let uy = across ? 0 : -dz;
    let uz = across ? -dx : dy;
    const norm = Math.sqrt(ux * ux + uy * uy + uz * uz);
    ux /= norm;
    uy /= norm;
    uz /= norm;
    const w = 0.62 * size;
    m[o] = ux * w;
    m[o + 1] = uy * w;
    m[o + 2] = uz * w;
    m[o + 4] = dx * size;
    m[o + 5] = dy * size;
    m[o + 6] = dz * size;
    m[o + 8] = (uy * dz - uz * dy) * w;
    m[o + 9] = (uz * dx - ux * dz) * w;
    m[o + 10] = (ux * dy - uy * dx) * w;
    m[o + 12] = x;
    m[o + 13] = y;
    m[o + 14] = z;
    m[o + 15] = 1;
    const q = heads.instanceColor?.array as Float32Array;
    q[3 * i] = c.r;
    q[3 * i + 1] = c.g;
    q[3 * i + 2] = c.b;
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
