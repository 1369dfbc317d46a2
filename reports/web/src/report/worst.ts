// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import { type ContactFinding, findingKey } from '../common/finding.ts';
import type { WrongNormal } from './data.ts';

export interface Place {
  pair: string; // "block|floor"; "" where none is named
  bodies: string[];
  time: number; // [s], six digits
  step: number | null; // steps up to the frame; null where an older store names none
  contact: number | null; // index among the stored contacts of the frame, from 0; null: none of them, or not known
  dt: number | null; // [s] of the run; null where none is named
  what: string; // "missed", "spurious", "normal" or "point_normal"; "" if it is not known
  spec: string; // "" where none is named
}

const drawn = new Set(['missed', 'spurious', 'normal', 'point_normal']);
const kinds = new Set(['missed', 'spurious', 'spurious, far apart', 'normal']);

/**
 * Place of the worst result of an audit: "block|floor at t=0.25, step 15, contact 2 (normal)"; gathered over runs,
 * spec and time step of the run are in brackets of their own: "(bullet:preset=default) (dt=0.01)".
 */
export function worstPlace(text: string): Place | null {
  const match = /^(.*?)\s*at t=([-+0-9.eE]+)(?:, step (\d+))?(?:, contact (\d+))?((?: \([^()]*\))*)$/.exec(text.trim());
  const time = Number(match?.[2]);
  if (match === null || !Number.isFinite(time)) return null;
  const pair = match[1] ?? '';
  const notes = [...(match[5] ?? '').matchAll(/\(([^()]*)\)/g)].map((note) => note[1] as string);
  const step = match[3] === undefined ? null : Number(match[3]);
  const contact = match[4] === undefined ? null : Number(match[4]);
  const dtNote = notes.find((note) => note.startsWith('dt='));
  const dt = dtNote === undefined ? null : Number(dtNote.slice(3));
  const spec = notes.find((note) => !kinds.has(note) && note !== dtNote) ?? '';
  const what = notes.find((note) => kinds.has(note)) ?? '';
  return { pair, bodies: pair ? pair.split('|') : [], time, step, contact, dt, what, spec };
}

/** The place of a wrong normal. */
export const placeOfNormal = ({ what, pair, time, step, contact }: WrongNormal): Place => ({
  pair,
  bodies: pair.split('|'),
  time,
  step,
  contact: contact < 0 ? null : contact,
  dt: null,
  what,
  spec: '',
});

/** Place of a run's worst result where that is a normal; null where it is another one. */
export function worstNormalPlace(text: string): Place | null {
  const place = worstPlace(text);
  return place?.what === 'normal' ? place : null;
}

/** Key of the finding at the place; null where it is of no kind that can be drawn. */
export const findingAt = (place: Place | null, auditor: string): string | null =>
  place === null || !drawn.has(place.what) ? null : findingKey(auditor, place.what as ContactFinding['what']);

/** Query of a link to the place. The step identifies the exact frame, since the time has lost digits. */
export function placeQuery(place: Place | null, dt: number | undefined, auditor = 'in_run') {
  const { time, step, pair, contact } = place ?? {};
  return { dt: dt ?? place?.dt, t: time, step, pair, contact, finding: findingAt(place, auditor) };
}

/** The moment of the place in a run of this time step [s]. */
export const placeTime = (place: Place, dt: number): number => (place.step === null ? place.time : place.step * dt);
