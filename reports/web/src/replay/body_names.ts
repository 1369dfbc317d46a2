// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import type { Note } from './finding_overlay.ts';
import type { Frame } from './frames.ts';
import type { Scene } from './scene.ts';
import { type Quat, rotate, type Vec3 } from './vectors.ts';

const most = 120; // names; more cannot be read

/** Names of the bodies that are not static, at their centres of mass. */
export function bodyNames(scene: Scene, frame: Frame): Note[] {
  const notes: Note[] = [];
  scene.bodies.forEach((body, b) => {
    if (body.type === 'static' || notes.length === most) return;
    const q = [0, 1, 2, 3].map((k) => frame.orientation[4 * b + k] as number) as Quat;
    const center = rotate(q, body.center);
    const at = center.map((v, k) => v + (frame.position[3 * b + k] as number)) as Vec3;
    if (at.every(Number.isFinite)) notes.push({ at, text: body.name, kind: 'body' });
  });
  return notes;
}
