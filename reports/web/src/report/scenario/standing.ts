// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Whether what should rest does, in words: "stands for 3 s", "box_0_9_0 falls at 0.8 s".
import { format, toNumber } from '../../common/format.ts';
import { bodyReach } from '../../replay/framing.ts';
import { readScene, type Scene } from '../../replay/scene.ts';
import { unpack } from '../charts/samples.ts';
import type { Case } from '../data.ts';

const atRest = /^rest_/;
const away = 0.25; // part of its reach that a body has moved when it has left its place

interface Left {
  body: string;
  time: number; // [s]
  falls: boolean; // along gravity, else sideways
}

/** The first body that leaves its place; null where all stay. */
export function firstToLeave(c: Case, scene: Scene): Left | null {
  const times = unpack(c.curves?.t) ?? new Float32Array();
  const down = Math.hypot(...scene.gravity) || 1;
  let first: Left | null = null;
  for (const { name, position } of c.curves?.bodies ?? []) {
    const index = scene.bodies.findIndex((b) => b.name === name);
    const reach = index < 0 ? 0 : bodyReach(scene, index);
    const axes = position.map((packed) => unpack(packed));
    if (!(reach > 0) || !Number.isFinite(reach)) continue;
    for (let i = 0; i < times.length; ++i) {
      const time = times[i] as number;
      if (first && time >= first.time) break;
      const moved = axes.map((axis) => (axis ? (axis[i] as number) - (axis[0] as number) : 0));
      if (!(Math.hypot(...moved) > away * reach)) continue;
      const along = moved.reduce((sum, m, k) => sum + (m * (scene.gravity[k] ?? 0)) / down, 0);
      first = { body: name, time, falls: along > 0.5 * Math.hypot(...moved) };
    }
  }
  return first;
}

/** The body that moved farthest by the metric, which sees all bodies; null where it stayed. Curves have some of them. */
function farthest(c: Case, scene: Scene): { body: string; moved: number; time: number } | null {
  let worst: { body: string; moved: number; time: number } | null = null;
  for (const m of c.metrics) {
    const index = m.name === 'rest_motion' ? scene.bodies.findIndex((b) => b.name === m.subject) : -1;
    const moved = toNumber(m.value);
    const reach = index < 0 ? 0 : bodyReach(scene, index);
    if (!(reach > 0) || !Number.isFinite(reach) || !(moved > away * reach)) continue;
    if (!worst || moved > worst.moved) worst = { body: m.subject, moved, time: toNumber(m.at) };
  }
  return worst;
}

/** A sentence for a run of a scenario in which bodies should rest; "" for any other. */
export function standingText(c: Case, metrics: string[], duration: number, sceneText: string): string {
  if (!metrics.some((name) => atRest.test(name)) || !c.curves) return '';
  const scene = readScene(JSON.parse(sceneText));
  const left = firstToLeave(c, scene);
  const far = left ? null : farthest(c, scene);
  if (far) return `${far.body} leaves its place, by ${format(far.moved, 3)} m at ${format(far.time, 3)} s`;
  if (left === null) return `stands for ${format(duration)} s`;
  return `${left.body} ${left.falls ? 'falls' : 'leaves its place'} at ${format(left.time, 3)} s`;
}
