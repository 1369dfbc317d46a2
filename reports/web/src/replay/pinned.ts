// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Selection that the inspector goes on showing: a body, a contact of it, a finding of the audit.
import type { ContactFinding } from '../common/finding.ts';
import type { Frame } from './frames.ts';
import type { Scene } from './scene.ts';

export interface Pinned {
  spec: string;
  body: number;
  other?: number; // body, of a contact looked at
  contact?: { index: number; step: number }; // contact that is shown as long as the frame is that of its step
  finding?: { key: string; found: ContactFinding };
}

/** Lists that keys go through: the bodies that may move, or the contacts of a frame. */
export type Choosable = 'body' | 'contact';

/** The one after or before the chosen one, from the first or the last on; null where the frame has none. */
export function chosenNext(
  what: Choosable,
  forward: boolean,
  pinned: Pinned | null,
  spec: string,
  { contacts, step }: Frame,
  { bodies }: Scene,
): Pinned | null {
  const isStatic = (b: number) => bodies[b]?.type === 'static';
  const next = (now: number, count: number) => (forward ? (now + 1) % count : now <= 0 ? count - 1 : now - 1);
  if (what === 'body') {
    const moving = bodies.map((_, b) => b).filter((b) => !isStatic(b));
    if (moving.length === 0) return null;
    return { spec, body: moving[next(pinned ? moving.indexOf(pinned.body) : -1, moving.length)] as number };
  }
  if (!contacts || contacts.count === 0) return null;
  const index = next(pinned?.contact?.step === step ? pinned.contact.index : -1, contacts.count);
  const [a, b] = [contacts.bodyA[index] as number, contacts.bodyB[index] as number];
  const [body, other] = isStatic(a) ? [b, a] : [a, b];
  return { spec, body, other, contact: { index, step } };
}

/** The contact that is looked at: the one that was named, else the deepest of the two bodies; -1 where there is none. */
export function contactOf(pinned: Pinned, { contacts, step }: Frame): number {
  const { body, other, contact } = pinned;
  let found = -1;
  if (!contacts) return found;
  if (contact && contact.step === step && contact.index < contacts.count) return contact.index;
  if (other === undefined) return found;
  for (let i = 0; i < contacts.count; ++i) {
    const [a, b] = [contacts.bodyA[i], contacts.bodyB[i]];
    if (!((a === body && b === other) || (a === other && b === body))) continue;
    if (found < 0 || (contacts.depth[i] as number) > (contacts.depth[found] as number)) found = i;
  }
  return found;
}
