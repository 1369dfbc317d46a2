// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Initial camera: it shows the moving bodies all the time, but one body that flies away does not make everything else
// small. Also the size that arrows are scaled by.
import { type Bounds, boundsOf, reachOf } from './bounds.ts';
import type { FrameSource } from './frames.ts';
import { composeInto } from './matrices.ts';
import type { ArrowScales } from './overlays.ts';
import type { Scene } from './scene.ts';
import type { Vec3 } from './vectors.ts';

export interface Framing {
  center: Vec3;
  radius: number; // [m] of the sphere to be seen
  low: Vec3; // corners of the box around what moves
  high: Vec3;
}

const sampledFrames = 48;

/** Indices of at most `most` frames, evenly over the run. */
export function sampled(count: number, most = sampledFrames): number[] {
  const n = Math.min(count, most);
  return Array.from({ length: n }, (_, i) => (n === 1 ? 0 : Math.round((i * (count - 1)) / (n - 1))));
}

const quantile = (sorted: number[], q: number) =>
  sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))] ?? 0;

/** Furthest extent of a body's shapes from its origin [m]. */
export function bodyReach(scene: Scene, body: number): number {
  let most = 0;
  for (const { geometry, pose } of scene.bodies[body]?.shapes ?? [])
    most = Math.max(most, Math.hypot(...pose.position) + reachOf(geometry));
  return most;
}

/** Boxes of a body's shapes at one frame, one after the other. */
class Boxes {
  readonly #scene: Scene;
  readonly #local: Float64Array[];
  readonly #rigid = new Float32Array(16);
  readonly #box: Bounds = [0, 0, 0, 0, 0, 0];

  constructor(scene: Scene) {
    this.#scene = scene;
    this.#local = scene.bodies.map((body) =>
      Float64Array.from(body.shapes.flatMap(({ pose }) => [...pose.position, ...pose.orientation])),
    );
  }

  add(position: ArrayLike<number>, orientation: ArrayLike<number>, b: number, out: Bounds[]): void {
    const shapes = this.#scene.bodies[b]?.shapes ?? [];
    const local = this.#local[b] as Float64Array;
    shapes.forEach(({ geometry }, s) => {
      if (!composeInto(this.#rigid, 0, position, orientation, b, local, 7 * s)) return;
      if (boundsOf(geometry, this.#rigid, 0, this.#box)) out.push([...this.#box]);
    });
    const at = [0, 1, 2].map((k) => position[3 * b + k] as number);
    if (shapes.length === 0 && at.every(Number.isFinite)) out.push([...at, ...at] as Bounds);
  }
}

export function frameScene(scene: Scene, sources: readonly FrameSource[]): Framing {
  const moving = scene.bodies.flatMap((body, b) => (body.type === 'static' ? [] : [b]));
  const shown = moving.length > 0 ? moving : scene.bodies.map((_, b) => b);
  const boxes: Bounds[] = [];
  const maker = new Boxes(scene);
  const most = scene.bodies.length > 200 ? 12 : sampledFrames;
  for (const source of sources)
    for (const i of sampled(source.times.length, most)) {
      const { position, orientation } = source.frame(i);
      for (const b of shown) maker.add(position, orientation, b, boxes);
    }
  if (boxes.length === 0) {
    const position = scene.bodies.flatMap((body) => body.first.position);
    const orientation = scene.bodies.flatMap((body) => body.first.orientation);
    for (const b of shown) maker.add(position, orientation, b, boxes);
  }
  for (const { a, anchorA } of scene.joints) if (a < 0) boxes.push([...anchorA, ...anchorA]);
  return around(boxes);
}

/** The box around nearly all boxes: those far outside the bulk are left out. */
function around(boxes: Bounds[]): Framing {
  const middleOf = (box: Bounds, k: number) => ((box[k] as number) + (box[3 + k] as number)) / 2;
  const middle = [0, 1, 2].map((k) =>
    quantile(
      boxes.map((box) => middleOf(box, k)).sort((a, b) => a - b),
      0.5,
    ),
  );
  const distance = (box: Bounds) => Math.hypot(...middle.map((m, k) => middleOf(box, k) - m));
  const size = (box: Bounds) => Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]) / 2;
  const sorted = boxes.map((box) => distance(box) + size(box)).sort((a, b) => a - b);
  const limit = 3 * quantile(sorted, 0.85) + 1e-9;
  const low: Vec3 = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high: Vec3 = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const box of boxes) {
    if (distance(box) > limit) continue;
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k] as number, box[k] as number);
      high[k] = Math.max(high[k] as number, box[3 + k] as number);
    }
  }
  if (!(low[0] <= high[0])) return { center: [0, 0, 0], radius: 1, low: [-1, -1, -1], high: [1, 1, 1] };
  const center = low.map((v, k) => (v + (high[k] as number)) / 2) as Vec3;
  const radius = Math.max(1e-3, Math.hypot(...high.map((v, k) => (v - (low[k] as number)) / 2)));
  return { center, radius, low, high };
}

/** Speeds and impulses that a full arrow stands for: those that nine of ten stay below. */
export function arrowScales(scene: Scene, sources: readonly FrameSource[], radius: number): ArrowScales {
  const speeds: number[] = [];
  const spins: number[] = [];
  const impulses: number[] = [];
  const collect = (out: number[], list: ArrayLike<number> | null) => {
    if (list === null) return;
    for (let i = 0; i + 2 < list.length; i += 3) {
      const size = Math.hypot(list[i] as number, list[i + 1] as number, list[i + 2] as number);
      if (size > 0 && Number.isFinite(size)) out.push(size);
    }
  };
  for (const source of sources)
    for (const i of sampled(source.times.length, scene.bodies.length > 200 ? 6 : 24)) {
      const frame = source.frame(i);
      collect(speeds, frame.velocity);
      collect(spins, frame.angularVelocity);
      for (let c = 0; frame.contacts && c < frame.contacts.count; ++c) {
        const size = Math.abs(frame.contacts.normalImpulse[c] as number);
        if (size > 0 && Number.isFinite(size)) impulses.push(size);
      }
    }
  const typical = (list: number[]) =>
    quantile(
      list.sort((a, b) => a - b),
      0.9,
    );
  const reaches = scene.bodies.flatMap((body, b) => (body.type === 'static' ? [] : [bodyReach(scene, b)]));
  const body = quantile(
    reaches.sort((a, b) => a - b),
    0.5,
  );
  return {
    size: radius,
    body: body > 0 ? body : radius,
    speed: typical(speeds),
    spin: typical(spins),
    impulse: typical(impulses),
  };
}
