// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Finds the walls between the camera and the moving bodies: they are drawn as glass.
import type { Framing } from './framing.ts';
import type { Pose, Scene } from './scene.ts';
import { add, conjugate, rotate, sub, type Vec3 } from './vectors.ts';

/**
 * True if the segment from a to b passes through a box of these half extents around the origin. Its ends may lie
 * outside.
 */
export function crossesBox(a: Vec3, b: Vec3, half: Vec3): boolean {
  let [enter, leave] = [0, 1];
  for (let k = 0; k < 3; ++k) {
    const [from, way, h] = [a[k] as number, (b[k] as number) - (a[k] as number), half[k] as number];
    if (Math.abs(way) < 1e-12) {
      if (Math.abs(from) > h) return false;
      continue;
    }
    const [s, t] = [(-h - from) / way, (h - from) / way];
    enter = Math.max(enter, Math.min(s, t));
    leave = Math.min(leave, Math.max(s, t));
  }
  return enter < leave;
}

const into = (pose: Pose, point: Vec3): Vec3 => rotate(conjugate(pose.orientation), sub(point, pose.position));

/** Static boxes that hide at least two of the middle and eight points around it; bodies by index. */
export function occludingBodies(scene: Scene, framing: Framing, camera: Vec3): Set<number> {
  const { center, low, high } = framing;
  const points: Vec3[] = [center];
  for (let i = 0; i < 8; ++i)
    points.push(
      add(
        center,
        [0, 1, 2].map((k) => ((i >> k) & 1 ? 0.35 : -0.35) * ((high[k] as number) - (low[k] as number))) as Vec3,
      ),
    );
  const out = new Set<number>();
  scene.bodies.forEach((body, b) => {
    if (body.type !== 'static') return;
    for (const { geometry, pose } of body.shapes) {
      if (geometry.kind !== 'box') continue;
      const local = (p: Vec3) => into(pose, into(body.first, p));
      const eye = local(camera);
      if (points.filter((p) => crossesBox(eye, local(p), geometry.half)).length >= 2) out.add(b);
    }
  });
  return out;
}
