// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Distances and angles between points that were clicked or chosen by keys. A point stays with its body, so that its distance
// can be followed over time: two points give a distance, three an angle at the second one.
import { angleBetween } from '../common/finding.ts';
import { degrees, lengthText, type Note } from './finding_overlay.ts';
import type { Frame, FrameSource } from './frames.ts';
import { add, conjugate, type Quat, rotate, sub, type Vec3 } from './vectors.ts';

const mostPoints = 3;

interface Mark {
  source: FrameSource;
  body: number; // -1: stays in the world
  local: Vec3; // [m] frame of the body
}

const poseOf = (frame: Frame, body: number): { p: Vec3; q: Quat } => ({
  p: [0, 1, 2].map((k) => frame.position[3 * body + k] as number) as Vec3,
  q: [0, 1, 2, 3].map((k) => frame.orientation[4 * body + k] as number) as Quat,
});

export class Measure {
  #marks: Mark[] = [];

  get count(): number {
    return this.#marks.length;
  }

  /** A point of a source's picture; one after the third begins anew. */
  add(source: FrameSource, frame: Frame, body: number, point: Vec3): void {
    if (this.#marks.length === mostPoints || this.#marks.some((m) => m.source !== source)) this.#marks = [];
    const { p, q } = body < 0 ? { p: [0, 0, 0] as Vec3, q: [1, 0, 0, 0] as Quat } : poseOf(frame, body);
    this.#marks.push({ source, body, local: rotate(conjugate(q), sub(point, p)) });
  }

  clear(): void {
    this.#marks = [];
  }

  /** Text of what is measured at a frame, for those who hear it: "point 3, 0.5 m, 90°". */
  said(frame: Frame): string {
    const notes = this.at(() => frame)?.notes ?? [];
    const texts = notes.filter(({ kind }) => kind === 'measure' || kind === 'angle').map(({ text }) => text);
    return [`point ${this.#marks.length}`, ...texts].join(', ');
  }

  /** Distances and angles at a frame of the source. */
  at(
    frameOf: (source: FrameSource) => Frame | null,
  ): { source: FrameSource; notes: Note[]; lines: [Vec3, Vec3][] } | null {
    const source = this.#marks[0]?.source;
    const frame = source && frameOf(source);
    if (!source || !frame) return null;
    const points = this.#marks.map(({ body, local }): Vec3 => {
      if (body < 0) return local;
      const { p, q } = poseOf(frame, body);
      return add(p, rotate(q, local));
    });
    const notes: Note[] = points.map((at, i) => ({ at, text: String(i + 1), kind: 'body' }));
    const lines: [Vec3, Vec3][] = [];
    for (let i = 1; i < points.length; ++i) {
      const [a, b] = [points[i - 1] as Vec3, points[i] as Vec3];
      lines.push([a, b]);
      const middle = a.map((v, k) => (v + (b[k] as number)) / 2) as Vec3;
      notes.push({ at: middle, text: lengthText(Math.hypot(...sub(b, a))), kind: 'measure' });
    }
    const [first, corner, last] = points;
    if (first && corner && last) {
      const angle = angleBetween(sub(first, corner), sub(last, corner));
      notes.push({ at: corner, text: degrees(angle), kind: 'angle' });
    }
    return { source, notes, lines };
  }
}
