// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Selection that the inspector goes on showing: a body, a contact of it, a finding of the audit.
import type { ContactFinding } from '../common/finding.ts';
import type { Frame } from './frames.ts';

export interface Pinned {
  spec: string;
  body: number;
  other?: number; // body, of a contact looked at
  contact?: { index: number; step: number }; // contact that is shown as long as the frame is that of its step
  finding?: { key: string; found: ContactFinding };
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
