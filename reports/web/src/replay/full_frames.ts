// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// All frames of a stored trajectory, as `rigor view RUN` gives them: /trajectory/<case id>?from=N&count=M responds with
// an ArrayBundle of as many frames as it likes to send at once. Their numbers are those of the HDF5 file.
import { ArrayBundle } from '../common/arrays.ts';
import {
  type ContactTable,
  contactColumns,
  type FrameTable,
  idColumns,
  type SourceLook,
  StoredSource,
} from './stored_source.ts';

interface Part {
  dt: number;
  stride: number;
  contact_stride: number;
  contact_instants: boolean; // true if contacts belong to the poses of their frames
  contacts_at_step_end: boolean; // they are those of the step that ends there, not of the one that begins
  frames: number; // frames of the whole trajectory
  from: number;
  count: number;
  bodies: string[];
}

/** Bundle of the frames from one on. */
export type FetchFrames = (from: number) => Promise<ArrayBuffer>;

/** Requests it from the server that the page came from. */
export const fetchFrames =
  (id: string): FetchFrames =>
  async (from) => {
    const answer = await fetch(`/trajectory/${encodeURIComponent(id)}?from=${from}`);
    if (!answer.ok) throw new Error(`the server has no frames of case ${id} (${answer.status})`);
    return answer.arrayBuffer();
  };

const channels = [
  ['position', 3],
  ['orientation', 4],
  ['velocity', 3],
  ['angular_velocity', 3],
] as const;

/** Throws Error where the server breaks off. */
export async function fullSource(look: SourceLook, get: FetchFrames): Promise<StoredSource> {
  const parts: ArrayBundle[] = [];
  let head: Part | null = null;
  for (let next = 0; head === null || next < head.frames; ) {
    const bundle = new ArrayBundle(await get(next));
    const part = bundle.meta as Part;
    if (part.count <= 0 && part.frames > next) throw new Error('the server breaks off in the middle of a trajectory');
    parts.push(bundle);
    head = part;
    next = part.from + Math.max(part.count, 1);
  }
  const table = tableOf(parts, head);
  const notes = [look.note.replace(/(, )?every \d+ steps/, ''), head.stride > 1 ? `every ${head.stride} steps` : ''];
  return new StoredSource({ ...look, note: notes.filter(Boolean).join(', ') }, table);
}

function tableOf(parts: ArrayBundle[], head: Part): FrameTable {
  const n = head.frames;
  const bodies = head.bodies.length;
  const join = (name: string, columns: number) => {
    const out = new Float64Array(n * columns);
    for (const bundle of parts) out.set(bundle.get(name) as Float64Array, (bundle.meta as Part).from * columns);
    return out;
  };
  const [position, orientation, velocity, angularVelocity] = channels.map(([name, columns]) =>
    join(name, bodies * columns),
  ) as [Float64Array, Float64Array, Float64Array, Float64Array];
  return {
    times: join('time', 1),
    steps: Float64Array.from({ length: n }, (_, i) => i * head.stride),
    bodies,
    position,
    orientation,
    velocity,
    angularVelocity,
    contacts: contactsOf(parts, head),
  };
}

function contactsOf(parts: ArrayBundle[], head: Part): ContactTable {
  const total = parts.reduce((sum, bundle) => sum + bundle.get('contacts/frame').length, 0);
  const table: ContactTable = {
    start: new Int32Array(head.frames).fill(-1),
    count: new Int32Array(head.frames),
    ids: new Int32Array(idColumns * total),
    instantsKnown: head.contact_instants,
    numbers: new Float32Array(contactColumns * total),
  };
  let next = 0;
  for (const bundle of parts) {
    const get = (name: string) => bundle.get(`contacts/${name}`);
    const frames = get('frame');
    const [a, b, impulse] = [get('point_a'), get('point_b'), get('friction_impulse')];
    const normal = get('normal');
    for (let i = 0; i < frames.length; ++i, ++next) {
      const f = frames[i] as number;
      if (table.count[f] === 0) table.start[f] = next;
      table.count[f] = (table.count[f] as number) + 1;
      ['body_a', 'body_b', 'shape_a', 'shape_b'].forEach((name, k) => {
        table.ids[idColumns * next + k] = get(name)[i] as number;
      });
      for (let k = 0; k < 3; ++k) {
        const [to, from] = [contactColumns * next + k, 3 * i + k];
        table.numbers[to] = a[from] as number;
        table.numbers[to + 3] = (b[from] as number) - (a[from] as number);
        table.numbers[to + 6] = normal[from] as number;
        table.numbers[to + 11] = impulse[from] as number;
      }
      table.numbers[contactColumns * next + 9] = get('depth')[i] as number;
      table.numbers[contactColumns * next + 10] = get('normal_impulse')[i] as number;
    }
  }
  // frames whose contacts are stored, but that have none; no step begins at the last one, or ends at the first one
  const start = head.contacts_at_step_end ? Math.max(1, head.contact_stride) : 0;
  const end = head.contact_instants && !head.contacts_at_step_end ? head.frames - 1 : head.frames;
  for (let f = start; f < end; f += Math.max(1, head.contact_stride))
    if ((table.start[f] as number) < 0) table.start[f] = 0;
  return table;
}
