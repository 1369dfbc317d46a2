// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The live view by keyboard. Layers have the keys that they have in the replay.
import { el } from '../common/elements.ts';
import { keyList, layerKeys } from '../replay/key_list.ts';
import type { LayerName } from '../replay/layers.ts';

export interface KeyActions {
  send(command: string, steps?: number): void;
  toggle(): void;
  shiftSpeed(by: number): void;
  layer(name: LayerName): void;
  overlay(): void;
  frame(): void;
  help(): void;
}

const explained: [string, string][] = [
  ['space', 'play, pause'],
  ['← →', 'one step back, on; with shift ten'],
  ['s', 'one stage of the step'],
  ['Home', 'all instances back to the start'],
  ['+ −', 'faster, slower'],
  ['o', 'side by side, overlaid'],
  ['a', 'camera: whole scene'],
  [', . ↑ ↓', 'camera: turn, tilt (with the picture in focus)'],
  ['PgUp PgDn', 'camera: nearer, farther'],
  ['f l', 'faces, outlines'],
  ['c m p i', 'contacts, normals, penetration, impulses'],
  ['v w', 'velocities, angular velocities'],
  ['j b u t', 'joints, AABBs, islands, trails'],
  ['?', 'this list'],
];

export function helpDialog(): HTMLDialogElement {
  return el(
    'dialog',
    { class: 'keys' },
    el('h2', {}, 'Keys'),
    keyList(explained),
    el(
      'p',
      { class: 'hint' },
      'Drag a body to pull it along. Drag beside the bodies (or with shift) turns the picture, the right button moves it, the wheel zooms. Click a body to keep its numbers.',
    ),
    el('form', { method: 'dialog' }, el('button', {}, 'Close')),
  );
}

/** Action of a key; null: the key has none. */
export function keyAction(key: string, shift: boolean, actions: KeyActions): (() => void) | null {
  const steps = shift ? 10 : 1;
  const simple: Record<string, () => void> = {
    ' ': () => actions.toggle(),
    ArrowLeft: () => actions.send('back', steps),
    ArrowRight: () => actions.send('step', steps),
    s: () => actions.send('stage'),
    Home: () => actions.send('reset'),
    '+': () => actions.shiftSpeed(1),
    '-': () => actions.shiftSpeed(-1),
    o: () => actions.overlay(),
    a: () => actions.frame(),
    '?': () => actions.help(),
  };
  const layer = key === 'u' ? 'islands' : layerKeys[key];
  if (layer) return () => actions.layer(layer);
  return simple[key] ?? null;
}

/** Listens until what it returns is called. */
export function bindKeys(actions: KeyActions): () => void {
  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    if (target.closest('dialog') || target.matches('select, textarea, input:not([type=checkbox])')) return;
    if (event.key === ' ' && target.matches('button, summary, input')) return;
    const action = keyAction(event.key, event.shiftKey, actions);
    if (!action) return;
    action();
    event.preventDefault();
  };
  addEventListener('keydown', press);
  return () => removeEventListener('keydown', press);
}
