// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data of the 3D view from every source: a report's replay file, a stored trajectory, a live run. World frame, SI
// units; quaternions w x y z; bodies by their place in the scenario.

/**
 * Contacts of one frame, `count` of each; vectors have three numbers a contact. They belong to the poses of the frame:
 * they are those of the step that begins there, or, with engines that say so, ends there. In a live run they are those of
 * the step that led there: where they belong to the poses at which that began, `carriedA` and `carriedB` are their points
 * carried along with the bodies since.
 */
export interface Contacts {
  count: number;
  bodyA: ArrayLike<number>;
  bodyB: ArrayLike<number>;
  shapeA: ArrayLike<number>; // place among the shapes of A
  shapeB: ArrayLike<number>;
  pointA: ArrayLike<number>; // [m] on A
  pointB: ArrayLike<number>; // [m] on B
  normal: ArrayLike<number>; // unit, from A to B
  depth: ArrayLike<number>; // [m], > 0: overlap
  normalImpulse: ArrayLike<number>; // [N s]; NaN if the engine does not report it
  frictionImpulse: ArrayLike<number>; // [N s] on B
  instant?: string; // note on the poses that they belong to
  carriedA?: ArrayLike<number>; // [m] where points on A are drawn
  carriedB?: ArrayLike<number>;
}

/** Lines and points that an engine's debug drawing has made of a frame; arrows have 1 m for 1 m/s or 1 N s. */
export interface DrawnLines {
  kinds: readonly string[]; // "contact", "velocity", ...
  ends: ArrayLike<number>; // 6 a line [m]
  lineNames: ArrayLike<number>; // kind and body of each line
  points: ArrayLike<number>; // 3 a point [m]
  pointNames: ArrayLike<number>;
}

/** State of all bodies at one time. */
export interface Frame {
  time: number; // [s]
  step: number; // steps since the start
  position: ArrayLike<number>; // 3 a body [m]; NaN where unknown
  orientation: ArrayLike<number>; // 4 a body
  velocity: ArrayLike<number> | null; // 3 a body [m/s]
  angularVelocity: ArrayLike<number> | null; // 3 a body [rad/s]
  contacts: Contacts | null; // null: not stored for this frame
  /** Given by live runs: contacts, arrows, joints, boxes and islands are these, and not reckoned here. */
  lines?: DrawnLines | null;
}

/** Event that the view can jump to. */
export interface ReplayEvent {
  time: number; // [s]
  kind: 'divergence' | 'engine_divergence' | 'largest' | 'audit' | 'contact_begin' | 'contact_end' | 'nonfinite';
  what?: string; // metric, auditor or other engine's spec
  subject?: string; // body, "a|b"
  value?: number;
  unit?: string;
  threshold?: number; // divergence, engine_divergence: the distance that was passed [m]
  text?: string;
  contact?: number; // audit: which of the contacts of the frame
}

/** A sequence of frames with a time axis: one engine's run, or the reference. */
export interface FrameSource {
  label: string; // "bullet matched", "reference"
  spec: string; // engine spec, "" for the reference
  colour: string; // CSS
  ghost: boolean; // drawn translucent over the others
  note: string; // note on missing frames: "every 4 steps", "crashed: SIGSEGV"; "" nothing
  events: readonly ReplayEvent[]; // events in time order
  times: ArrayLike<number>; // [s], ascending; of a live run: those known so far; empty: nothing to show
  /** The frame at an index of `times`. May reuse memory: valid until the next call. */
  frame(index: number): Frame;
}

/** Index of the last time <= t (with a tolerance of a millionth of a step), at least 0. */
export function indexAt(times: ArrayLike<number>, t: number): number {
  let low = 0;
  let high = times.length - 1;
  const slack = 1e-9 + 1e-6 * Math.abs((times[1] ?? 0) - (times[0] ?? 0));
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((times[middle] as number) <= t + slack) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Point at which a contact is drawn: the middle between its points [m]. */
export function middleOf(contacts: Contacts, i: number): [number, number, number] {
  const { pointA, pointB, carriedA = pointA, carriedB = pointB } = contacts;
  const middle = (k: number) => ((carriedA[3 * i + k] as number) + (carriedB[3 * i + k] as number)) / 2;
  return [middle(0), middle(1), middle(2)];
}
