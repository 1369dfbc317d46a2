// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Faces and edges of the shapes of a scenario. Shapes that differ in size alone share one unit geometry and are drawn
// as copies of it. Spheres and discs carry lines, so that their turning is seen.
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  ConeGeometry,
  CylinderGeometry,
  EdgesGeometry,
  Shape,
  ShapeGeometry,
  SphereGeometry,
  Vector2,
  Vector3,
} from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';
import { type Copies, repeated } from './repeated.ts';
import type { Geometry } from './scene.ts';
import type { Vec3 } from './vectors.ts';

export interface Template {
  faces: BufferGeometry | null;
  edges: BufferGeometry;
}
/** A template and the size of this shape in its units; null for a half-space, which has no end. */
export interface Sized {
  template: Template;
  scale: Vec3;
}

/** Segments of a circle: fewer where there are many bodies, which are small then, and fewer still in software. */
export function roundOf(bodies: number, software = false): number {
  if (software) return bodies > 40 ? 10 : bodies > 20 ? 14 : 24;
  return bodies > 800 ? 14 : bodies > 150 ? 24 : 40;
}

const flatRound = 40; // segments of a circle in 2D, where it is an outline and cheap, and contacts are looked at from near

function lines(points: number[]): BufferGeometry {
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
}

type Place = (c: number, s: number) => Vec3;
/** A circle, or the part of it from one angle to another, as line segments. */
function arc(round: number, out: number[], place: Place, from = 0, to = 2 * Math.PI): number[] {
  const n = Math.max(4, Math.round((round * Math.abs(to - from)) / (2 * Math.PI)));
  for (let i = 0; i < n; ++i)
    for (const a of [from + ((to - from) * i) / n, from + ((to - from) * (i + 1)) / n])
      out.push(...place(Math.cos(a), Math.sin(a)));
  return out;
}

function outline(points: Vec3[], loop: boolean): number[] {
  const out: number[] = [];
  for (let i = 0; i + (loop ? 0 : 1) < points.length; ++i)
    out.push(...(points[i] as Vec3), ...(points[(i + 1) % points.length] as Vec3));
  return out;
}

function sphere(round: number): Template {
  const circles = arc(round, [], (c, s) => [c, s, 0]);
  arc(round, circles, (c, s) => [c, 0, s]);
  arc(round, circles, (c, s) => [0, c, s]);
  return { faces: new SphereGeometry(1, round, Math.round(0.6 * round)), edges: lines(circles) };
}

function disc(round: number): Template {
  const circle = arc(round, [], (c, s) => [c, s, 0]);
  circle.push(0, 0, 0, 1, 0, 0);
  const shape = new Shape().absarc(0, 0, 1, 0, 2 * Math.PI, false);
  return { faces: new ShapeGeometry(shape, round / 2), edges: lines(circle) };
}

function box(): Template {
  const faces = new BoxGeometry(2, 2, 2);
  return { faces, edges: new EdgesGeometry(faces, 1) };
}

function rectangle(): Template {
  const corners: Vec3[] = [
    [-1, -1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 1, 0],
  ];
  return { faces: fan(corners), edges: lines(outline(corners, true)) };
}

function cylinder(round: number): Template {
  const edges = arc(round, [], (c, s) => [c, 1, s]);
  arc(round, edges, (c, s) => [c, -1, s]);
  for (const [x, z] of [
    [1, 0],
    [0, 1],
    [-1, 0],
    [0, -1],
  ] as const)
    edges.push(x, 1, z, x, -1, z);
  edges.push(0, 1, 0, 1, 1, 0, 0, -1, 0, 1, -1, 0);
  return { faces: new CylinderGeometry(1, 1, 2, round), edges: lines(edges) };
}

function cone(round: number): Template {
  const edges = arc(round, [], (c, s) => [c, -1, s]);
  for (const [x, z] of [
    [1, 0],
    [0, 1],
    [-1, 0],
    [0, -1],
  ] as const)
    edges.push(0, 1, 0, x, -1, z);
  return { faces: new ConeGeometry(1, 2, round), edges: lines(edges) };
}

/** Capsule of radius 1. */
function capsule(round: number, ratio: number): Template {
  const edges: number[] = [];
  for (const y of [ratio, -ratio]) arc(round, edges, (c, s) => [c, y, s]);
  for (const [x, z] of [
    [1, 0],
    [0, 1],
    [-1, 0],
    [0, -1],
  ] as const)
    edges.push(x, ratio, z, x, -ratio, z);
  for (const end of [1, -1]) {
    arc(round, edges, (c, s) => [c, end * (ratio + s), 0], 0, Math.PI);
    arc(round, edges, (c, s) => [0, end * (ratio + s), c], 0, Math.PI);
  }
  return { faces: new CapsuleGeometry(1, 2 * ratio, Math.round(0.3 * round), round), edges: lines(edges) };
}

function stadium(round: number, ratio: number): Template {
  const points: Vec3[] = [];
  for (let i = 0; i <= round; ++i) {
    const a = (Math.PI * i) / (round / 2);
    const top = i <= round / 2;
    points.push([Math.cos(a), Math.sin(a) + (top ? ratio : -ratio), 0]);
    if (i === round / 2) points.push([Math.cos(a), Math.sin(a) - ratio, 0]);
  }
  const middle = [0, ratio, 0, 0, -ratio, 0];
  return { faces: fan(points), edges: lines([...outline(points, true), ...middle]) };
}

/** A convex polygon. */
function fan(points: Vec3[]): BufferGeometry {
  return new ShapeGeometry(new Shape(points.map((p) => new Vector2(p[0], p[1]))));
}

function polygon(vertices: Vec3[]): Template {
  const ordered = hull2d(vertices);
  return { faces: fan(ordered), edges: lines(outline(ordered, true)) };
}

/** Counter-clockwise hull (Andrew's monotone chain): files may list the points in any order. */
export function hull2d(points: Vec3[]): Vec3[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (o: Vec3, a: Vec3, b: Vec3) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (list: Vec3[]) => {
    const chain: Vec3[] = [];
    for (const p of list) {
      while (chain.length >= 2 && turn(chain.at(-2) as Vec3, chain.at(-1) as Vec3, p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function solid(vertices: Vec3[]): Template {
  const faces = new ConvexGeometry(vertices.map((v) => new Vector3(...v)));
  return { faces, edges: new EdgesGeometry(faces, 2) };
}

function surface(vertices: Vec3[], triangles: ArrayLike<number>[]): Template {
  const faces = new BufferGeometry();
  const corners = triangles.flatMap((t) => Array.from(t).flatMap((i) => vertices[i] as Vec3));
  faces.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  faces.computeVertexNormals(); // no shared corners: flat faces
  return { faces, edges: new EdgesGeometry(faces, 0.5) };
}

function heights(spacing: readonly number[], rows: number[][]): Template {
  const [columns, n] = [rows[0]?.length ?? 0, rows.length];
  const [dx, dz] = [spacing[0] as number, spacing[1] as number];
  const vertices = rows.flatMap((row, k) =>
    row.map((y, i): Vec3 => [(i - (columns - 1) / 2) * dx, y, (k - (n - 1) / 2) * dz]),
  );
  const triangles: number[][] = [];
  for (let k = 0; k + 1 < n; ++k)
    for (let i = 0; i + 1 < columns; ++i) {
      const a = k * columns + i;
      triangles.push([a, a + columns, a + 1], [a + 1, a + columns, a + columns + 1]);
    }
  return surface(vertices, triangles);
}

/** Templates of one view, each made once. */
export class TemplateCache {
  readonly #made = new Map<string, Template>();
  readonly #repeated = new Map<string, BufferGeometry>();
  readonly #round: number;

  constructor(bodies = 1, software = false) {
    this.#round = roundOf(bodies, software);
  }

  /** null for half-spaces. */
  of(geometry: Geometry, dimension: 2 | 3): Sized | null {
    const flat = dimension === 2;
    switch (geometry.kind) {
      case 'sphere': {
        const r = geometry.radius;
        return this.#sized(flat ? 'disc' : 'sphere', () => (flat ? disc(flatRound) : sphere(this.#round)), [r, r, r]);
      }
      case 'box':
        if (flat) return this.#sized('rectangle', rectangle, [geometry.half[0], geometry.half[1], 1]);
        return this.#sized('box', box, geometry.half);
      case 'ellipsoid':
        return this.#sized('sphere', () => sphere(this.#round), geometry.half);
      case 'cylinder':
      case 'cone': {
        const make = geometry.kind === 'cone' ? cone : cylinder;
        return this.#sized(geometry.kind, () => make(this.#round), [
          geometry.radius,
          geometry.halfLength,
          geometry.radius,
        ]);
      }
      case 'capsule': {
        const r = geometry.radius;
        const ratio = geometry.halfLength / r; // the ends stay round: each ratio has its own
        return this.#sized(`capsule ${ratio}`, () => (flat ? stadium(flatRound, ratio) : capsule(this.#round, ratio)), [
          r,
          r,
          r,
        ]);
      }
      case 'hull':
        return this.#own(geometry, () => (flat ? polygon(geometry.vertices) : solid(geometry.vertices)));
      case 'segment':
      case 'chain':
        return this.#own(geometry, () => ({ faces: null, edges: lines(outline(geometry.vertices, geometry.loop)) }));
      case 'triangle_mesh':
        return this.#own(geometry, () => surface(geometry.vertices, geometry.triangles));
      case 'height_field':
        return this.#own(geometry, () => heights(geometry.spacing, geometry.heights));
      case 'half_space':
        return null;
    }
  }

  /** All copies as one geometry; layers that show the same shapes share it. */
  repeated(all: readonly Copies[]): BufferGeometry {
    const key = all.map(({ geometry, count }) => `${geometry.id}*${count}`).join();
    let copies = this.#repeated.get(key);
    if (!copies) {
      copies = repeated(all);
      this.#repeated.set(key, copies);
    }
    return copies;
  }

  dispose(): void {
    for (const copies of this.#repeated.values()) copies.dispose();
    this.#repeated.clear();
    for (const template of this.#made.values()) {
      template.faces?.dispose();
      template.edges.dispose();
    }
    this.#made.clear();
  }

  #own(geometry: Geometry, make: () => Template): Sized {
    return this.#sized(JSON.stringify(geometry), make, [1, 1, 1]);
  }

  #sized(key: string, make: () => Template, scale: Vec3): Sized {
    let template = this.#made.get(key);
    if (template === undefined) {
      template = make();
      this.#made.set(key, template);
    }
    return { template, scale };
  }
}
