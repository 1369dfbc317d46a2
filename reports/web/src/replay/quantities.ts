// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Quantities of a body or of the contacts of two bodies, frame by frame.
import type { Frame, FrameSource } from './frames.ts';

export interface Quantity {
  key: string;
  title: string;
  unit: string;
  value: (frame: Frame, a: number, b: number) => number; // NaN where the frame does not have it
}

const component = (list: ArrayLike<number> | null, body: number, k: number): number =>
  list === null ? Number.NaN : (list[3 * body + k] as number);
const size = (list: ArrayLike<number> | null, body: number): number =>
  Math.hypot(component(list, body, 0), component(list, body, 1), component(list, body, 2));
const axes = ['x', 'y', 'z'];
const vector = (key: string, title: string, unit: string, of: (f: Frame) => ArrayLike<number> | null): Quantity[] =>
  axes.map((axis, k) => ({
    key: `${key}${axis}`,
    title: `${title} ${axis}`,
    unit,
    value: (f, body) => component(of(f), body, k),
  }));

/** Angle of the rotation from the axes of the world [°]. */
function turned({ orientation }: Frame, body: number): number {
  const [w, x, y, z] = [0, 1, 2, 3].map((k) => orientation[4 * body + k] as number) as [number, number, number, number];
  return (360 / Math.PI) * Math.atan2(Math.hypot(x, y, z), Math.abs(w));
}

export const bodyQuantities: Quantity[] = [
  ...vector('p', 'position', 'm', (f) => f.position),
  ...vector('v', 'velocity', 'm/s', (f) => f.velocity),
  { key: 'speed', title: 'speed', unit: 'm/s', value: (f, body) => size(f.velocity, body) },
  ...vector('w', 'angular velocity', 'rad/s', (f) => f.angularVelocity),
  { key: 'spin', title: 'angular speed', unit: 'rad/s', value: (f, body) => size(f.angularVelocity, body) },
  { key: 'angle', title: 'angle turned', unit: '°', value: turned },
];

/** Sum or largest over the contacts of two bodies; NaN in frames whose contacts are not stored. */
function overContacts(
  { contacts }: Frame,
  a: number,
  b: number,
  add: (so: number, i: number) => number,
  start: number,
): number {
  if (!contacts) return Number.NaN;
  let value = start;
  for (let i = 0; i < contacts.count; ++i) {
    const [p, q] = [contacts.bodyA[i], contacts.bodyB[i]];
    if ((p === a && q === b) || (p === b && q === a)) value = add(value, i);
  }
  return value;
}

export const pairQuantities: Quantity[] = [
  { key: 'points', title: 'contact points', unit: '', value: (f, a, b) => overContacts(f, a, b, (n) => n + 1, 0) },
  {
    key: 'depth',
    title: 'largest depth',
    unit: 'm',
    value: (f, a, b) => {
      const depth = f.contacts?.depth ?? [];
      const most = overContacts(f, a, b, (so, i) => Math.max(so, depth[i] as number), -Infinity);
      return most === -Infinity ? Number.NaN : most;
    },
  },
  {
    key: 'normal_impulse',
    title: 'normal impulse',
    unit: 'N s',
    value: (f, a, b) => overContacts(f, a, b, (so, i) => so + (f.contacts?.normalImpulse[i] as number), 0),
  },
  {
    key: 'friction_impulse',
    title: 'friction impulse',
    unit: 'N s',
    value: (f, a, b) => overContacts(f, a, b, (so, i) => so + size(f.contacts?.frictionImpulse ?? null, i), 0),
  },
];

/** Values over the frames of a source; null where there is none. */
export function samplesOf(source: FrameSource, quantity: Quantity, a: number, b: number): (number | null)[] {
  return Array.from({ length: source.times.length }, (_, i) => {
    const value = quantity.value(source.frame(i), a, b);
    return Number.isFinite(value) ? value : null;
  });
}
