// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Shapes of a scene as flat faces in the world, for a drawing: solids by their facets, round ones coarsely.
import type { Geometry, Pose, SceneBody } from '../replay/scene.ts';
import { add, type Quat, rotate, type Vec3 } from '../replay/vectors.ts';

export interface Face {
  corners: Vec3[];
  closed: boolean; // false: a line
}
/** Drawing of a shape: faces, or a sphere, which is a disc from everywhere. */
export type Solid = { faces: Face[] } | { ball: { center: Vec3; radius: number } };

const around = 24; // corners of a circle

const ring = (radius: number, y: number): Vec3[] =>
  Array.from({ length: around }, (_, i) => {
    const a = (2 * Math.PI * i) / around;
    return [radius * Math.cos(a), y, radius * Math.sin(a)];
  });

/** Quads between two rings of equal count. */
const between = (low: Vec3[], high: Vec3[]): Vec3[][] =>
  low.map((v, i) => {
    const k = (i + 1) % low.length;
    return [v, low[k] as Vec3, high[k] as Vec3, high[i] as Vec3];
  });

function box([x, y, z]: Vec3): Vec3[][] {
  const side = (f: (s: number, t: number) => Vec3): Vec3[] => [f(-1, -1), f(1, -1), f(1, 1), f(-1, 1)];
  return [-1, 1].flatMap((n) => [
    side((s, t) => [n * x, s * y, t * z]),
    side((s, t) => [s * x, n * y, t * z]),
    side((s, t) => [s * x, t * y, n * z]),
  ]);
}

function capsule(radius: number, halfLength: number): Vec3[][] {
  const rings: Vec3[][] = [];
  const cap = 5;
  for (let i = 0; i <= 2 * cap + 1; ++i) {
    const upper = i > cap;
    const a = ((i - (upper ? 1 : 0) - cap) / cap) * (Math.PI / 2);
    rings.push(ring(Math.max(1e-6, radius * Math.cos(a)), radius * Math.sin(a) + (upper ? halfLength : -halfLength)));
  }
  return rings.slice(1).flatMap((high, i) => between(rings[i] as Vec3[], high));
}

const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Triangles of the convex hull of a few points, by trying all planes: hulls have at most 64. */
function hull(points: Vec3[]): Vec3[][] {
  const size = Math.max(...points.map((p) => Math.hypot(...p)), 1e-9);
  const planes = new Map<string, { normal: Vec3; on: Vec3[] }>();
  for (let i = 0; i < points.length; ++i)
    for (let j = i + 1; j < points.length; ++j)
      for (let k = j + 1; k < points.length; ++k) {
        const [a, b, c] = [points[i], points[j], points[k]] as [Vec3, Vec3, Vec3];
        const n = cross(minus(b, a), minus(c, a));
        const length = Math.hypot(...n);
        if (length < 1e-9 * size * size) continue;
        const sides = points.map((p) => dot(n, minus(p, a)) / length);
        const outward = sides.every((s) => s < 1e-6 * size) ? 1 : sides.every((s) => s > -1e-6 * size) ? -1 : 0;
        if (outward === 0) continue;
        const normal = n.map((v) => (outward * v) / length) as Vec3;
        const key = [...normal, dot(normal, a) / size]
          .map((v) => v.toFixed(4))
          .join(' ')
          .replaceAll('-0.0000', '0.0000');
        if (!planes.has(key))
          planes.set(key, { normal, on: points.filter((_, m) => Math.abs(sides[m] as number) < 1e-6 * size) });
      }
  return [...planes.values()].map(({ normal, on }) => inOrder(on, normal));
}

/** Corners of a flat convex face, one after the other. */
function inOrder(corners: Vec3[], normal: Vec3): Vec3[] {
  const center = corners.reduce((s, v) => add(s, v), [0, 0, 0] as Vec3).map((v) => v / corners.length) as Vec3;
  const u = minus(corners[0] as Vec3, center);
  const v = cross(normal, u);
  const angle = (p: Vec3) => Math.atan2(dot(minus(p, center), v), dot(minus(p, center), u));
  return [...corners].sort((p, q) => angle(p) - angle(q));
}

function heightField(spacing: [number, number], heights: number[][]): Vec3[][] {
  const columns = heights[0]?.length ?? 0;
  const at = (r: number, c: number): Vec3 => [
    (c - (columns - 1) / 2) * spacing[0],
    heights[r]?.[c] ?? 0,
    (r - (heights.length - 1) / 2) * spacing[1],
  ];
  const faces: Vec3[][] = [];
  const step = Math.max(1, Math.ceil(Math.max(heights.length, columns) / 24));
  for (let r = 0; r + step < heights.length; r += step)
    for (let c = 0; c + step < columns; c += step)
      faces.push([at(r, c), at(r, c + step), at(r + step, c + step), at(r + step, c)]);
  return faces;
}

/** A piece of the boundary of a half-space around the point of the world that is looked at. */
function patch(normal: Vec3, offset: number, middle: Vec3, reach: number, planar: boolean): Face {
  const foot = add(middle, normal.map((v) => v * (offset - dot(normal, middle))) as Vec3);
  const first = planar
    ? ([-normal[1], normal[0], 0] as Vec3)
    : Math.abs(normal[1]) > 0.9
      ? cross([0, 0, 1], normal)
      : cross([0, 1, 0], normal);
  const length = Math.hypot(...first) || 1;
  const u = first.map((v) => (v * reach) / length) as Vec3;
  const w = cross(normal, u);
  const corner = (s: number, t: number): Vec3 =>
    foot.map((v, i) => v + s * (u[i] as number) + t * (w[i] as number)) as Vec3;
  return planar
    ? { corners: [corner(-1, 0), corner(1, 0)], closed: false }
    : { corners: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)], closed: true };
}

/** Faces in the shape's frame; null for what is handled by itself. */
function localFaces(g: Geometry, planar: boolean): Face[] {
  const closed = (faces: Vec3[][]): Face[] => faces.map((corners) => ({ corners, closed: true }));
  const outline = (corners: Vec3[]): Face[] => closed([corners]);
  switch (g.kind) {
    case 'box': {
      const [x, y] = g.half;
      return planar
        ? outline([
            [-x, -y, 0],
            [x, -y, 0],
            [x, y, 0],
            [-x, y, 0],
          ])
        : closed(box(g.half));
    }
    case 'capsule': {
      if (!planar) return closed(capsule(g.radius, g.halfLength));
      const half = (start: number, y: number): Vec3[] =>
        Array.from({ length: 13 }, (_, i) => {
          const a = start + (Math.PI * i) / 12;
          return [g.radius * Math.cos(a), y + g.radius * Math.sin(a), 0];
        });
      return outline([...half(0, g.halfLength), ...half(Math.PI, -g.halfLength)]);
    }
    case 'ellipsoid':
      return closed(capsule(1, 0).map((face) => face.map((p) => p.map((v, i) => v * (g.half[i] as number)) as Vec3)));
    case 'cylinder': {
      const [low, high] = [ring(g.radius, -g.halfLength), ring(g.radius, g.halfLength)];
      return closed([...between(low, high), low, high]);
    }
    case 'cone': {
      const low = ring(g.radius, -g.halfLength);
      return closed([...between(low, ring(1e-6, g.halfLength)), low]);
    }
    case 'hull':
      return planar ? outline(inOrder(g.vertices, [0, 0, 1])) : closed(hull(g.vertices));
    case 'segment':
    case 'chain':
      return [{ corners: g.loop ? [...g.vertices, g.vertices[0] as Vec3] : g.vertices, closed: false }];
    case 'triangle_mesh':
      return closed(g.triangles.map((t) => t.map((i) => g.vertices[i] as Vec3)));
    case 'height_field':
      return closed(heightField(g.spacing, g.heights));
    default:
      return [];
  }
}

const placed = (pose: Pose, p: Vec3): Vec3 => add(pose.position, rotate(pose.orientation, p));
export const composed = (a: Pose, b: Pose): Pose => ({
  position: placed(a, b.position),
  orientation: product(a.orientation, b.orientation),
});
const product = ([a, b, c, d]: Quat, [e, f, g, h]: Quat): Quat => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];

/** All shapes of a body at its first pose. `middle`, `reach`: what is looked at; half-spaces have no end of their own. */
export function solidsOf(body: SceneBody, planar: boolean, middle: Vec3, reach: number): Solid[] {
  return body.shapes.map(({ geometry, pose }) => {
    const frame = composed(body.first, pose);
    if (geometry.kind === 'sphere') return { ball: { center: frame.position, radius: geometry.radius } };
    if (geometry.kind === 'half_space') {
      const normal = rotate(frame.orientation, geometry.normal);
      return { faces: [patch(normal, geometry.offset + dot(normal, frame.position), middle, reach, planar)] };
    }
    const faces = localFaces(geometry, planar);
    return { faces: faces.map((f) => ({ ...f, corners: f.corners.map((c) => placed(frame, c)) })) };
  });
}
