// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Frames that are all known: from a report's replay file or from a stored trajectory.
import { type Contacts, type Frame, type FrameSource, indexAt, type ReplayEvent } from './frames.ts';

/** Contacts of all frames, one after the other; `start` of frame i to `start` of frame i + 1, -1: not stored. */
export interface ContactTable {
  start: Int32Array; // start of each frame, -1: not stored
  count: Int32Array;
  ids: Int32Array; // bodyA, bodyB, shapeA, shapeB
  instantsKnown: boolean; // they belong to the poses of their frame
  numbers: Float32Array; // 14 each: point A, B - A, normal, depth, normal impulse, friction impulse
}
export const contactColumns = 14;
export const idColumns = 4;
/** Instant of contacts in a file of an older format. */
export const unknownInstant = 'at an instant that the stored file does not name';

/** All frames of a run, frame by frame. */
export interface FrameTable {
  times: Float64Array;
  steps: Float64Array;
  bodies: number;
  position: Float32Array | Float64Array;
  orientation: Float32Array | Float64Array;
  velocity: Float32Array | Float64Array | null;
  angularVelocity: Float32Array | Float64Array | null;
  contacts: ContactTable | null;
}

/** Name and colours of a source. */
export interface SourceLook {
  label: string;
  spec: string;
  colour: string;
  ghost: boolean;
  note: string;
  events: readonly ReplayEvent[];
}

export class StoredSource implements FrameSource {
  label: string;
  spec: string;
  colour: string;
  readonly ghost: boolean;
  readonly note: string;
  readonly events: readonly ReplayEvent[];
  readonly times: Float64Array;
  readonly #table: FrameTable;
  readonly #frames: (Frame | undefined)[] = [];

  constructor(look: SourceLook, table: FrameTable) {
    this.label = look.label;
    this.spec = look.spec;
    this.colour = look.colour;
    this.ghost = look.ghost;
    this.note = look.note;
    this.events = look.events;
    this.times = table.times;
    this.#table = table;
  }

  /** Throws RangeError beyond the last frame. */
  frame(index: number): Frame {
    if (index < 0 || index >= this.times.length) throw new RangeError(`no frame ${index}`);
    let frame = this.#frames[index];
    if (frame === undefined) {
      frame = this.#make(index);
      this.#frames[index] = frame;
    }
    return frame;
  }

  /** The last frame at or before t that has contacts. */
  lastWithContacts(t: number): number {
    const start = this.#table.contacts?.start;
    if (start === undefined) return -1;
    let i = indexAt(this.times, t);
    while (i >= 0 && (start[i] as number) < 0) --i;
    return i;
  }

  #make(index: number): Frame {
    const t = this.#table;
    const of = <T extends Float32Array | Float64Array | null>(all: T, columns: number): T =>
      (all === null ? null : all.subarray(index * t.bodies * columns, (index + 1) * t.bodies * columns)) as T;
    return {
      time: t.times[index] as number,
      step: t.steps[index] as number,
      position: of(t.position, 3),
      orientation: of(t.orientation, 4),
      velocity: of(t.velocity, 3),
      angularVelocity: of(t.angularVelocity, 3),
      contacts: this.#contacts(index),
    };
  }

  #contacts(index: number): Contacts | null {
    const table = this.#table.contacts;
    const start = table?.start[index] ?? -1;
    if (table === null || start < 0) return null;
    const count = table.count[index] as number;
    const column = (first: number, width: number, more?: number): Float32Array => {
      const out = new Float32Array(count * width);
      for (let i = 0; i < count; ++i)
        for (let k = 0; k < width; ++k) {
          const at = (start + i) * contactColumns;
          const added = more === undefined ? 0 : (table.numbers[at + more + k] as number);
          out[i * width + k] = (table.numbers[at + first + k] as number) + added;
        }
      return out;
    };
    const id = (k: number) =>
      Int32Array.from({ length: count }, (_, i) => table.ids[idColumns * (start + i) + k] as number);
    return {
      count,
      bodyA: id(0),
      bodyB: id(1),
      shapeA: id(2),
      shapeB: id(3),
      pointA: column(0, 3),
      pointB: column(0, 3, 3),
      normal: column(6, 3),
      depth: column(9, 1),
      normalImpulse: column(10, 1),
      frictionImpulse: column(11, 3),
      ...(table.instantsKnown ? {} : { instant: unknownInstant }),
    };
  }
}
