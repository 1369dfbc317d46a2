// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Keyboard control of a replay, while it has the focus, and the overlay that explains it.
import { el } from '../common/elements.ts';
import type { ControlActions, ReplayActions } from './actions.ts';
import { keyList, layerKeys } from './key_list.ts';
import type { LayerName } from './layers.ts';

const layers: Record<string, LayerName> = { ...layerKeys, r: 'reference' };

const explained: [string, string][] = [
  ['space', 'play, pause'],
  ['← →', 'one frame back, on; with shift ten'],
  ['Home End', 'start, end'],
  ['+ −', 'faster, slower'],
  ['d', 'first divergence'],
  ['e', 'largest error'],
  ['[ ]', 'previous, next contact event'],
  ['n', 'worst contact normal'],
  ['s S', 'next body, the one before: its numbers'],
  ['k K', 'next contact of the frame, the one before'],
  ['1 … 9', 'engine on, off'],
  ['o', 'side by side, overlaid'],
  ['a', 'camera: whole scene'],
  [', . ↑ ↓', 'camera: turn, tilt (with the picture in focus)'],
  ['PgUp PgDn', 'camera: nearer, farther'],
  ['f l', 'faces, outlines'],
  ['c m p i', 'contacts, normals, penetration, impulses'],
  ['v w', 'velocities, angular velocities'],
  ['j b t r', 'joints, AABBs, trails, reference'],
  ['y', 'names of bodies'],
  ['g', 'camera goes along with the chosen body'],
  ['x', 'measure: click two points, or three for an angle'],
  ['Enter', 'measure: take what s or k has chosen as the next point'],
  ['?', 'this list'],
];

export function helpOverlay(): HTMLElement {
  return el(
    'div',
    { class: 'help', hidden: true, role: 'note', tabindex: 0 },
    keyList(explained),
    el(
      'p',
      {},
      'Drag turns the picture, with the right button it moves, the wheel zooms. Click a body to keep its numbers.',
    ),
  );
}

/** Binds the keys of `root`. The function that is returned unbinds them. */
export function bindKeys(root: HTMLElement, stage: ReplayActions, controls: ControlActions): () => void {
  const simple: Record<string, () => void> = {
    ' ': () => stage.player.toggle(),
    Home: () => stage.setTime(0),
    End: () => {
      stage.player.pause();
      stage.setTime(stage.player.end);
    },
    '+': () => stage.player.shift(1),
    '-': () => stage.player.shift(-1),
    d: () => stage.jump('divergence'),
    e: () => stage.jump('largest'),
    n: () => stage.jump('normal'),
    '[': () => stage.jump('previous'),
    ']': () => stage.jump('next'),
    s: () => stage.choose('body', true),
    S: () => stage.choose('body', false),
    k: () => stage.choose('contact', true),
    K: () => stage.choose('contact', false),
    a: () => stage.view.frameAll(),
    o: () => controls.overlay(!stage.view.options.overlaid),
    g: () => stage.toggleFollow(),
    x: () => stage.toggleMeasure(),
    '?': () => controls.toggleHelp(),
  };
  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    if (target.matches('select, input:not([type=range])')) return;
    const { key } = event;
    const layer = layers[key];
    if (key === 'ArrowLeft' || key === 'ArrowRight') stage.step(key === 'ArrowRight', event.shiftKey ? 10 : 1);
    else if ((key === ' ' || key === 'Enter') && target.matches('button')) return;
    else if (key === 'Enter' && stage.measuring) stage.measureChosen();
    else if (simple[key]) simple[key]?.();
    else if (layer) controls.toggle(layer);
    else if (/^[1-9]$/.test(key)) {
      const source = stage.engines[Number(key) - 1];
      if (source && source.times.length > 0) stage.toggleEngine(source);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
  root.addEventListener('keydown', press);
  return () => root.removeEventListener('keydown', press);
}
