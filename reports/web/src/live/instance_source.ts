// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An instance as the view shows it: its last frames, the newest at the end. Inside a step that is taken by stages the
// contacts are those that the stages have made so far.
import type { ArrayBundle, NumberArray } from '../common/arrays.ts';
import type { Contacts, DrawnLines, Frame, FrameSource, ReplayEvent } from '../replay/frames.ts';
import type { FrameHead } from './api.ts';
import { manifoldContacts } from './stage_data.ts';

const mostFrames = 240; // number of frames for trails
const mostBytes = 48 << 20;

export class InstanceSource implements FrameSource {
  readonly id: number;
  label: string;
  readonly spec: string;
  readonly colour: string;
  readonly ghost = false;
  note = '';
  readonly events: readonly ReplayEvent[] = [];
  times: number[] = [];
  /** Head and arrays of the newest frame. */
  head: FrameHead | null = null;
  arrays: ArrayBundle | null = null;
  #frames: Frame[] = [];
  #sizes: number[] = [];
  #bytes = 0;

  constructor(id: number, spec: string, label: string, colour: string) {
    this.id = id;
    this.spec = spec;
    this.label = label;
    this.colour = colour;
  }

  frame(index: number): Frame {
    return this.#frames[index] as Frame;
  }
  get newest(): Frame | null {
    return this.#frames[this.#frames.length - 1] ?? null;
  }

  /** Takes a frame; one that is not later than those before makes them void: the session has gone back. */
  push(head: FrameHead, arrays: ArrayBundle, kinds: readonly string[] = []): void {
    this.head = head;
    this.arrays = arrays;
    while (this.times.length > 0 && (this.times[this.times.length - 1] as number) >= head.time - 1e-12) this.#drop(-1);
    const newest = this.newest;
    if (newest) newest.lines = null; // only the newest frame is seen with its lines
    const frame = frameOf(head, arrays, kinds);
    const size = 8 * 13 * (frame.position.length / 3) + 8 * 22 * (frame.contacts?.count ?? 0);
    this.times.push(head.time);
    this.#frames.push(frame);
    this.#sizes.push(size);
    this.#bytes += size;
    while (this.times.length > mostFrames || (this.#bytes > mostBytes && this.times.length > 1)) this.#drop(0);
  }

  /** Drops the newest (-1) or the oldest (0). */
  #drop(which: 0 | -1): void {
    for (const list of [this.times, this.#frames] as unknown[][]) which === 0 ? list.shift() : list.pop();
    this.#bytes -= (which === 0 ? this.#sizes.shift() : this.#sizes.pop()) ?? 0;
  }
}

const doubles = (arrays: ArrayBundle, name: string): Float64Array => (arrays.get(name) as Float64Array).slice();
const integers = (arrays: ArrayBundle, name: string): Int32Array => (arrays.get(name) as Int32Array).slice();

/** Copies: frames are kept for trails, the bundle they came in (with what stages have made) is not. */
function frameOf(head: FrameHead, arrays: ArrayBundle, kinds: readonly string[]): Frame {
  const of = `${head.instance}/`;
  const staged = head.has_stages && head.stage.done !== '';
  return {
    time: head.time,
    step: head.step,
    position: doubles(arrays, `${of}position`),
    orientation: doubles(arrays, `${of}orientation`),
    velocity: doubles(arrays, `${of}velocity`),
    angularVelocity: doubles(arrays, `${of}angular_velocity`),
    contacts: staged && head.stage.in_step ? manifoldContacts(head, arrays) : contactsOf(head, arrays),
    lines: linesOf(of, arrays, kinds),
  };
}

/** Null where the server has drawn none. */
function linesOf(of: string, arrays: ArrayBundle, kinds: readonly string[]): DrawnLines | null {
  if (!arrays.has(`${of}lines/ends`)) return null;
  const copy = (name: string) => (arrays.get(of + name) as NumberArray).slice();
  return {
    kinds,
    ends: copy('lines/ends'),
    lineNames: copy('lines/names'),
    points: copy('points/at'),
    pointNames: copy('points/names'),
  };
}

function contactsOf(head: FrameHead, arrays: ArrayBundle): Contacts {
  const of = `${head.instance}/`;
  const bodyA = integers(arrays, `${of}contacts/body_a`);
  return {
    count: bodyA.length,
    bodyA,
    bodyB: integers(arrays, `${of}contacts/body_b`),
    shapeA: integers(arrays, `${of}contacts/shape_a`),
    shapeB: integers(arrays, `${of}contacts/shape_b`),
    pointA: doubles(arrays, `${of}contacts/point_a`),
    pointB: doubles(arrays, `${of}contacts/point_b`),
    normal: doubles(arrays, `${of}contacts/normal`),
    depth: doubles(arrays, `${of}contacts/depth`),
    normalImpulse: doubles(arrays, `${of}contacts/normal_impulse`),
    frictionImpulse: doubles(arrays, `${of}contacts/friction_impulse`),
    carriedA: doubles(arrays, `${of}contacts/carried_a`),
    carriedB: doubles(arrays, `${of}contacts/carried_b`),
    ...(head.contacts_at_step_end
      ? {}
      : { instant: 'where the last step began; drawn where the bodies have carried them' }),
  };
}
