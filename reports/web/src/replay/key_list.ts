// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Keys that the replay and the live view share, and how a list of keys is shown.
import { el } from '../common/elements.ts';
import type { LayerName } from './layers.ts';

export const layerKeys: Record<string, LayerName> = {
  f: 'faces',
  l: 'outlines',
  c: 'contacts',
  m: 'normals',
  p: 'penetration',
  i: 'impulses',
  v: 'velocities',
  w: 'spins',
  j: 'joints',
  b: 'bounds',
  t: 'trails',
  y: 'names',
};

/** A definition list of keys, divided by spaces, and what they do. */
export function keyList(explained: [keys: string, text: string][]): HTMLElement {
  const rows = explained.map(([keys, text]) => [
    el(
      'dt',
      {},
      keys.split(' ').map((key) => [el('kbd', {}, key), ' ']),
    ),
    el('dd', {}, text),
  ]);
  return el('dl', {}, rows);
}
