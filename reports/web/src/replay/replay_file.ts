// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A report's replay file (reports/FORMATS.md, "Replay files"): the thinned frames of all engines of one scenario at one
// time step. reports/replay/data.cpp writes it.
import { ArrayBundle } from '../common/arrays.ts';
import { CodeReader } from './codec.ts';
import type { ReplayEvent } from './frames.ts';
import {
  type ContactTable,
  contactColumns,
  type FrameTable,
  idColumns,
  StoredSource,
  unknownInstant,
} from './stored_source.ts';

interface FramesHead {
  frames: number;
  moving: number[];
  quantum: { position: number; orientation: number; velocity: number; angularVelocity: number };
  turns: boolean;
  velocities: boolean;
  contacts: number | null;
  contactInstants?: boolean; // true if contacts belong to the poses of their frames
  contactQuantum?: { point: number; offset: number; normal: number; depth: number; impulse: number };
  stride: number;
}

interface CaseHead extends FramesHead {
  id: string;
  spec: string;
  engine: string;
  label: string;
  outcome: string;
  reason: string;
  stored?: number; // frames of the whole trajectory
  events?: ReplayEvent[];
}

export interface ReplayHead {
  kind: 'replay';
  scenario: string;
  dt: number;
  bodies: string[];
  cases: CaseHead[];
  reference: FramesHead | null;
}

export interface Replay {
  head: ReplayHead;
  sources: StoredSource[]; // sources of all cases, in the order of the report's columns; without frames: times is empty
  reference: StoredSource | null;
}

/** Numbers of bodies that never move are those of `first` (7 each), or NaN where first is null. */
function spread(bodies: number, frames: number, first: ArrayLike<number> | null, from: number, columns: number) {
  const out = new Float32Array(bodies * frames * columns).fill(Number.NaN);
  if (first !== null)
    for (let f = 0; f < frames; ++f)
      for (let b = 0; b < bodies; ++b)
        for (let k = 0; k < columns; ++k) out[(f * bodies + b) * columns + k] = first[7 * b + from + k] as number;
  return out;
}

function readChannel(
  reader: CodeReader,
  head: FramesHead,
  bodies: number,
  columns: number,
  quantum: number,
  out: Float32Array,
): void {
  for (const body of head.moving)
    for (let k = 0; k < columns; ++k) reader.series(head.frames, quantum, out, body * columns + k, bodies * columns);
}

function readContacts(bundle: ArrayBundle, prefix: string, head: FramesHead): ContactTable | null {
  const quantum = head.contactQuantum;
  const total = head.contacts;
  if (!quantum || total === null || !bundle.has(`${prefix}.contactCounts`)) return null;
  const counts = new Float64Array(head.frames);
  new CodeReader(bundle.get(`${prefix}.contactCounts`)).series(head.frames, 1, counts);
  const table: ContactTable = {
    start: new Int32Array(head.frames).fill(-1),
    count: new Int32Array(head.frames),
    ids: new Int32Array(idColumns * total),
    instantsKnown: head.contactInstants !== false,
    numbers: new Float32Array(contactColumns * total),
  };
  let next = 0;
  for (let f = 0; f < head.frames; ++f) {
    const count = counts[f] as number;
    if (count < 0) continue;
    table.start[f] = next;
    table.count[f] = count;
    next += count;
  }
  if (total === 0) return table;
  const chain = Int32Array.from({ length: total }, (_, i) => i - 1);
  const ids = new CodeReader(bundle.get(`${prefix}.contactIds`));
  const column = new Float64Array(total);
  for (let k = 0; k < idColumns; ++k) {
    ids.linked(chain, 1, column);
    for (let i = 0; i < total; ++i) table.ids[idColumns * i + k] = column[i] as number;
  }
  const previous = predecessors(table, head.frames);
  const reader = new CodeReader(bundle.get(`${prefix}.contactNumbers`));
  const { point, offset, normal, depth, impulse } = quantum;
  const quanta = [point, point, point, offset, offset, offset, normal, normal, normal, depth];
  quanta.push(impulse, impulse, impulse, impulse);
  quanta.forEach((q, k) => {
    reader.linked(previous, q, table.numbers, k, contactColumns);
  });
  return table;
}

/** Predecessor of each contact: the one before with the same bodies and the same place among theirs, or -1. */
function predecessors(table: ContactTable, frames: number): Int32Array {
  const out = new Int32Array(table.ids.length / idColumns);
  const latest = new Map<string, number>();
  for (let f = 0; f < frames; ++f) {
    const seen = new Map<string, number>();
    const start = table.start[f] as number;
    for (let i = start; i >= 0 && i < start + (table.count[f] as number); ++i) {
      const pair = `${table.ids[idColumns * i]} ${table.ids[idColumns * i + 1]}`;
      const place = seen.get(pair) ?? 0;
      seen.set(pair, place + 1);
      out[i] = latest.get(`${pair} ${place}`) ?? -1;
      latest.set(`${pair} ${place}`, i);
    }
  }
  return out;
}

function readFrames(
  bundle: ArrayBundle,
  prefix: string,
  head: FramesHead,
  bodies: number,
  first: ArrayLike<number> | null,
  dt: number,
): FrameTable {
  const n = head.frames;
  const steps = new Float64Array(n);
  if (n > 0) new CodeReader(bundle.get(`${prefix}.steps`)).series(n, 1, steps);
  const channel = (name: string, columns: number, quantum: number, out: Float32Array) => {
    const key = `${prefix}.${name}`;
    if (bundle.has(key)) readChannel(new CodeReader(bundle.get(key)), head, bodies, columns, quantum, out);
    return out;
  };
  const zero = new Float32Array(7 * bodies);
  const still = first === null ? null : zero;
  const upright = new Float32Array(7 * bodies);
  for (let b = 0; b < bodies; ++b) upright[7 * b + 3] = 1;
  const q = head.quantum;
  return {
    times: steps.map((step) => step * dt),
    steps,
    bodies,
    position: channel('position', 3, q?.position, spread(bodies, n, first, 0, 3)),
    orientation: channel('orientation', 4, q?.orientation, spread(bodies, n, first ?? upright, 3, 4)),
    velocity: head.velocities ? channel('velocity', 3, q.velocity, spread(bodies, n, still, 0, 3)) : null,
    angularVelocity: head.velocities
      ? channel('angularVelocity', 3, q.angularVelocity, spread(bodies, n, still, 0, 3))
      : null,
    contacts: readContacts(bundle, prefix, head),
  };
}

/** "every 4 steps": the usual distance of neighbouring frames. */
export function spacing(steps: ArrayLike<number>): number {
  const counts = new Map<number, number>();
  for (let i = 1; i < steps.length; ++i) {
    const gap = (steps[i] as number) - (steps[i - 1] as number);
    counts.set(gap, (counts.get(gap) ?? 0) + 1);
  }
  return [...counts].sort((a, b) => b[1] - a[1] || b[0] - a[0])[0]?.[0] ?? 1;
}

function noteOf(head: CaseHead, table: FrameTable): string {
  const parts: string[] = [];
  if (head.outcome !== 'completed')
    parts.push(head.outcome.replaceAll('_', ' ') + (head.reason ? `: ${head.reason}` : ''));
  if (table.steps.length === 0) return parts.join(', ') || 'no frames are stored';
  const every = spacing(table.steps);
  if (every > 1) parts.push(`every ${every} steps`);
  if (head.contactInstants === false) parts.push(`contacts ${unknownInstant}`);
  return parts.join(', ');
}

/** Colours are the caller's: by spec. Throws RangeError when the file is damaged. */
export function readReplay(buffer: ArrayBuffer, colourOf: (spec: string, index: number) => string): Replay {
  const bundle = new ArrayBundle(buffer);
  const head = bundle.meta as ReplayHead;
  const first = bundle.get('first');
  const bodies = head.bodies.length;
  const sources = head.cases.map((c, i) => {
    const empty = { ...c, moving: [], velocities: false, contacts: null };
    const table = readFrames(bundle, String(i), c.frames > 0 ? c : empty, bodies, first, head.dt);
    const look = { label: c.label, spec: c.spec, colour: colourOf(c.spec, i), ghost: false };
    return new StoredSource({ ...look, note: noteOf(c, table), events: c.events ?? [] }, table);
  });
  const known = head.reference;
  const reference =
    known === null
      ? null
      : new StoredSource(
          { label: 'reference', spec: '', colour: colourOf('', -1), ghost: true, note: '', events: [] },
          readFrames(bundle, 'reference', known, bodies, null, head.dt),
        );
  return { head, sources, reference };
}
