// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Layers that can be switched on and off in the view, and their text in a link.

export const layerNames = {
  faces: 'Faces',
  outlines: 'Outlines',
  contacts: 'Contact points',
  normals: 'Normals, A to B',
  penetration: 'Penetration',
  impulses: 'Contact impulses',
  velocities: 'Velocities',
  spins: 'Angular velocities',
  joints: 'Joints',
  bounds: 'AABBs',
  islands: 'Islands',
  trails: 'Trails',
  reference: 'Reference',
  names: 'Names',
} as const;
export type LayerName = keyof typeof layerNames;
export type Layers = Record<LayerName, boolean>;

/** Layers whose lines the server of a live run draws, and the kinds of these. Replays have no islands. */
export const drawnKinds: Partial<Record<LayerName, string>> = {
  contacts: 'contact',
  normals: 'normal',
  impulses: 'impulse',
  velocities: 'velocity',
  joints: 'joint',
  bounds: 'box',
  islands: 'island',
};
export const layerOfKind = Object.fromEntries(
  Object.entries(drawnKinds).map(([layer, kind]) => [kind, layer]),
) as Record<string, LayerName>;

export const colourings = { engine: 'by engine', body: 'by body', island: 'by island' } as const;
export type Colouring = keyof typeof colourings;

export interface ViewOptions {
  layers: Layers;
  colouring: Colouring;
  overlaid: boolean; // all in one picture; else side by side
  exaggeration: number; // exaggeration of penetrations
  arrows: number; // length of arrows, 1: as framed
}

export const defaultOptions = (): ViewOptions => ({
  layers: {
    faces: true,
    outlines: true,
    contacts: true,
    normals: true,
    penetration: false,
    impulses: false,
    velocities: false,
    spins: false,
    joints: true,
    bounds: false,
    islands: false,
    trails: false,
    reference: true,
    names: false,
  },
  colouring: 'body',
  overlaid: false,
  exaggeration: 1,
  arrows: 1,
});
