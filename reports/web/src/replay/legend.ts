// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Meaning of the colours of the picture, for the layers that are on, and how long an arrow of full length is.
import { type Child, el } from '../common/elements.ts';
import { type ContactFinding, speaker } from '../common/finding.ts';
import type { Theme } from './colours.ts';
import type { ViewOptions } from './layers.ts';
import type { ArrowScales } from './overlays.ts';

interface Entry {
  colour: string;
  text: string;
}

const digits = (x: number) => Number(x.toPrecision(2));
const full = (value: number, unit: string, arrows: number) =>
  value > 0 && Number.isFinite(value) ? `, full length ${digits(value / arrows)} ${unit}` : '';

/** Entries of the layers that are on. */
export function legendOf(
  { layers, overlaid, arrows, exaggeration }: ViewOptions,
  theme: Theme,
  scales: ArrowScales,
  has: { finding: ContactFinding | null; contacts: boolean; joints: boolean; reference: boolean },
): Entry[] {
  const entries: [on: boolean, colour: string, text: string][] = [
    [has.finding !== null, theme.normal, `normal and points of ${speaker(has.finding)}`],
    [has.finding !== null, theme.exact, 'exact normals and points'],
    [layers.contacts && has.contacts && !overlaid && !has.finding, theme.contact, 'contact point'],
    [layers.normals && has.contacts && !overlaid && !has.finding, theme.normal, 'normal, from A to B'],
    [
      layers.penetration && has.contacts,
      theme.penetration,
      `penetration${exaggeration > 1 ? `, ×${digits(exaggeration)}` : ''}`,
    ],
    [layers.impulses && has.contacts, theme.impulse, `impulse on B${full(scales.impulse, 'N s', arrows)}`],
    [layers.velocities, theme.velocity, `velocity${full(scales.speed, 'm/s', arrows)}`],
    [layers.spins, theme.spin, `angular velocity${full(scales.spin, 'rad/s', arrows)}`],
    [layers.joints && has.joints, theme.joint, 'joint'],
    [layers.bounds, theme.bounds, 'AABB'],
    [layers.reference && has.reference && !has.finding, theme.ghost, 'exact solution'],
  ];
  return entries.filter(([on]) => on).map(([, colour, text]) => ({ colour, text }));
}

export const legendNodes = (entries: Entry[]): Child[] =>
  entries.map(({ colour, text }) => el('span', {}, el('i', { style: `background:${colour}` }), text));
