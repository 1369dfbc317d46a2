// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Where the camera stands at first: so that what moves is seen all the time, without one body that flies away making
// everything else small; and what arrows are measured against.
import { reachOf } from './bounds.ts';
import type { FrameSource } from './frames.ts';
import type { ArrowScales } from './overlays.ts';
import type { Scene } from './scene.ts';
import type { Vec3 } from './vectors.ts';

export interface Framing {
  centre: Vec3;
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

export function frameScene(scene: Scene, sources: readonly FrameSource[]): Framing {
  const moving = scene.bodies.flatMap((body, b) => (body.type === 'static' ? [] : [b]));
  const shown = moving.length > 0 ? moving : scene.bodies.map((_, b) => b);
  const points: { at: Vec3; reach: number }[] = [];
  const addFrame = (position: ArrayLike<number>) => {
    for (const b of shown) {
      const at: Vec3 = [0, 1, 2].map((k) => position[3 * b + k] as number) as Vec3;
      if (Number.isFinite(at[0] + at[1] + at[2])) points.push({ at, reach: bodyReach(scene, b) });
    }
  };
  for (const source of sources) for (const i of sampled(source.times.length)) addFrame(source.frame(i).position);
  if (points.length === 0) addFrame(scene.bodies.flatMap((body) => body.first.position));
  for (const joint of scene.joints) if (joint.a < 0) points.push({ at: joint.anchorA, reach: 0 });
  return around(points);
}

/** The box around nearly all points: those far outside the bulk are left out. */
function around(points: { at: Vec3; reach: number }[]): Framing {
  const middle = [0, 1, 2].map((k) =>
    quantile(
      points.map((p) => p.at[k] as number).sort((a, b) => a - b),
      0.5,
    ),
  ) as Vec3;
  const distance = (p: Vec3) => Math.hypot(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]);
  const sorted = points.map((p) => distance(p.at) + p.reach).sort((a, b) => a - b);
  const limit = 3 * quantile(sorted, 0.85) + 1e-9;
  const low: Vec3 = [1, 1, 1].map(() => Number.POSITIVE_INFINITY) as Vec3;
  const high: Vec3 = [1, 1, 1].map(() => Number.NEGATIVE_INFINITY) as Vec3;
  for (const { at, reach } of points) {
    if (distance(at) > limit) continue;
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k] as number, (at[k] as number) - reach);
      high[k] = Math.max(high[k] as number, (at[k] as number) + reach);
    }
  }
  if (!(low[0] <= high[0])) return { centre: [0, 0, 0], radius: 1, low: [-1, -1, -1], high: [1, 1, 1] };
  const centre = low.map((v, k) => (v + (high[k] as number)) / 2) as Vec3;
  const radius = Math.max(1e-3, Math.hypot(...high.map((v, k) => (v - (low[k] as number)) / 2)));
  return { centre, radius, low, high };
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
  return { size: radius, speed: typical(speeds), spin: typical(spins), impulse: typical(impulses) };
}
