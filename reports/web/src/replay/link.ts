// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// State of the view as text for the part of the address behind "#": time, engines, layers, camera. Unknown or damaged
// parts are left out, never an error: links live longer than pages.

import type { CameraState } from './camera_rig.ts';
import { colourings, defaultOptions, type LayerName, layerNames, type ViewOptions } from './layers.ts';
import type { Vec3 } from './vectors.ts';

export interface LinkState {
  time?: number; // [s]
  step?: number; // steps up to that time, where a step ends there: finds the frame where a time has lost digits
  shown?: string[]; // specs
  options?: ViewOptions;
  camera?: CameraState;
  speed?: number;
  body?: number; // pinned in the inspector
  of?: string; // spec whose body that is
  contact?: number; // contact of that frame, pinned in the inspector
  finding?: string; // key of a finding of the audit in the run of that spec
  follow?: boolean; // the camera goes along with the pinned body
}

/** Five digits are enough for a camera, nine for a time. */
const short = (x: number, digits = 5) => String(Number(x.toPrecision(digits)));

export function encodeLink(state: LinkState): string {
  const out = new URLSearchParams();
  if (state.time !== undefined) out.set('t', short(state.time, 9));
  if (state.step !== undefined) out.set('n', String(state.step));
  if (state.options) {
    const { layers, colouring, overlaid, exaggeration, arrows } = state.options;
    const on = (Object.keys(layerNames) as LayerName[]).filter((name) => layers[name]);
    out.set('on', on.join('.'));
    out.set('by', colouring);
    if (overlaid) out.set('over', '1');
    if (exaggeration !== 1) out.set('x', short(exaggeration));
    if (arrows !== 1) out.set('a', short(arrows));
  }
  for (const spec of state.shown ?? []) out.append('e', spec);
  if (state.speed !== undefined) out.set('s', short(state.speed));
  if (state.body !== undefined && state.body >= 0) out.set('b', String(state.body));
  if (state.of !== undefined) out.set('of', state.of);
  if (state.contact !== undefined) out.set('c', String(state.contact));
  if (state.finding !== undefined) out.set('f', state.finding);
  if (state.follow) out.set('go', '1');
  if (state.camera) {
    const { position, target, zoom } = state.camera;
    out.set('cam', [...position, ...target, zoom].map((v) => short(v)).join('_'));
  }
  return out.toString();
}

function numbers(text: string | null, count: number): number[] | null {
  const list = (text ?? '').split('_').map(Number);
  return text && list.length === count && list.every(Number.isFinite) ? list : null;
}

export function decodeLink(text: string): LinkState {
  const from = new URLSearchParams(text);
  const number = (key: string, least: number, most: number): number | undefined => {
    const value = from.has(key) ? Number(from.get(key)) : Number.NaN;
    return value >= least && value <= most ? value : undefined;
  };
  const state: LinkState = {};
  const time = number('t', 0, 1e9);
  if (time !== undefined) state.time = time;
  const step = number('n', 0, 1e12);
  if (step !== undefined && Number.isInteger(step)) state.step = step;
  const speed = number('s', 1e-4, 1e3);
  if (speed !== undefined) state.speed = speed;
  const body = number('b', 0, 1e6);
  if (body !== undefined) state.body = body;
  const contact = number('c', 0, 1e9);
  if (contact !== undefined && Number.isInteger(contact)) state.contact = contact;
  const of = from.get('of');
  if (of) state.of = of;
  const finding = from.get('f');
  if (finding) state.finding = finding;
  if (from.get('go') === '1') state.follow = true;
  if (from.has('e')) state.shown = from.getAll('e');
  if (from.has('on')) {
    const options = defaultOptions();
    const on = new Set((from.get('on') ?? '').split('.'));
    for (const name of Object.keys(layerNames) as LayerName[]) options.layers[name] = on.has(name);
    const by = from.get('by') ?? '';
    if (by in colourings) options.colouring = by as ViewOptions['colouring'];
    options.overlaid = from.get('over') === '1';
    options.exaggeration = number('x', 1, 1e6) ?? 1;
    options.arrows = number('a', 1e-3, 1e3) ?? 1;
    state.options = options;
  }
  const cam = numbers(from.get('cam'), 7);
  if (cam)
    state.camera = { position: cam.slice(0, 3) as Vec3, target: cam.slice(3, 6) as Vec3, zoom: cam[6] as number };
  return state;
}

/** The view of an address like "#/scenario/pile?dt=0.01&view=..."; "" without one. */
export function viewOfHash(hash: string): string {
  const at = hash.indexOf('?');
  return at < 0 ? '' : (new URLSearchParams(hash.slice(at + 1)).get('view') ?? '');
}

/** The same address with another view, which says more than the moment (time, step, pair, contact) of the link that led here. */
export function withView(hash: string, view: string): string {
  const at = hash.indexOf('?');
  const query = new URLSearchParams(at < 0 ? '' : hash.slice(at + 1));
  query.delete('t');
  query.delete('step');
  query.delete('pair');
  query.delete('contact');
  query.delete('finding');
  query.set('view', view);
  return `${(at < 0 ? hash : hash.slice(0, at)) || '#'}?${query}`;
}
