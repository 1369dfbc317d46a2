// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Buttons under the picture: transport, jumps, engines, layers.
import { el } from '../common/elements.ts';
import type { ControlActions, ReplayActions, Saved } from './actions.ts';
import { helpOverlay } from './keys.ts';
import { type Colouring, colourings, type LayerName, layerNames } from './layers.ts';
import { legendNodes } from './legend.ts';
import { speeds } from './player.ts';
import { Timeline } from './timeline.ts';

const hints: Partial<Record<LayerName, string>> = {
  normals: 'Unit normals from A to B, all of the same length',
  penetration: 'Overlap along the normal, as deep as it is times the factor',
  impulses: 'Impulse of the step on B, normal and friction',
  bounds: 'Exact boxes of the shapes, without the margin of an engine',
  trails: 'Way of the bodies so far',
  reference: 'The exact solution as a ghost',
  names: 'Names of the bodies that move',
};

const saved: [what: Saved, text: string, title: string][] = [
  ['png', '⤓ PNG', 'Save the picture'],
  ['webm', '⤓ video', 'Save the run as a video (WebM), at the speed that is chosen'],
  ['csv', '⤓ CSV', 'Save the states of all bodies of the engines that are shown'],
];

/** The identity of a control, which outlasts its element. */
const keyOf = (e: Element) => ['data-switch', 'data-action', 'aria-label'].map((name) => e.getAttribute(name)).join();

/** Replaces the controls of a group; the one that has the focus gives it to the one that stands for it. */
function replaceKeepingFocus(group: HTMLElement, nodes: readonly HTMLElement[]): void {
  const focused = group.contains(document.activeElement) ? document.activeElement : null;
  group.replaceChildren(...nodes);
  if (!focused) return;
  const key = keyOf(focused);
  for (const e of group.querySelectorAll<HTMLElement>('button, input, select'))
    if (keyOf(e) === key) {
      e.focus({ preventScroll: true });
      return;
    }
}

export class Controls implements ControlActions {
  readonly element: HTMLElement;
  readonly #stage: ReplayActions;
  readonly #timeline: Timeline;
  readonly #play: HTMLButtonElement;
  readonly #clock = el('output', { class: 'clock' });
  readonly #speed: HTMLSelectElement;
  readonly #engines = el('span', { class: 'chips', role: 'group', 'aria-label': 'Engines shown' });
  readonly #layers = el('span', { class: 'chips', role: 'group', 'aria-label': 'Layers' });
  readonly #modes = el('span', { class: 'chips', role: 'group', 'aria-label': 'Arrangement' });
  readonly #said = el('p', { class: 'said', role: 'status' });
  readonly #legend = el('p', { class: 'colour-legend', 'aria-label': 'Colours' });
  readonly #help = helpOverlay();
  #entries = '';

  constructor(stage: ReplayActions) {
    this.#stage = stage;
    this.#timeline = new Timeline((time) => {
      stage.player.pause();
      stage.setTime(time);
    });
    const button = (text: string, title: string, action: () => void, name?: string) =>
      el('button', { type: 'button', title, 'aria-label': title, onclick: action, 'data-action': name ?? null }, text);
    this.#play = button('▶', 'Play or pause (space)', () => stage.player.toggle(), 'play');
    this.#speed = el('select', { title: 'Speed', 'aria-label': 'Speed' });
    for (const s of speeds) this.#speed.append(el('option', { value: s }, s === 1 ? 'real time' : `${s} ×`));
    this.#speed.addEventListener('change', () => {
      stage.player.speed = Number(this.#speed.value);
    });
    const transport = el(
      'div',
      { class: 'transport' },
      button('| ◀', 'To the start (Home)', () => stage.setTime(0), 'start'),
      button('◀', 'One frame back (←)', () => stage.step(false), 'back'),
      this.#play,
      button('▶\u200a|', 'One frame on (→)', () => stage.step(true), 'forward'),
      this.#clock,
      this.#speed,
      el('span', { class: 'spring' }),
      button(
        'First divergence',
        'Where a run leaves the reference, or another engine (d)',
        () => stage.jump('divergence'),
        'divergence',
      ),
      button('Largest error', 'Of the main metric (e)', () => stage.jump('largest'), 'largest'),
      button('‹ contact', 'Previous contact event ([)', () => stage.jump('previous'), 'previous'),
      button('contact ›', 'Next contact event (])', () => stage.jump('next'), 'next'),
      button(
        'Worst normal',
        'Where the audit found the worst contact geometry (n)',
        () => stage.jump('normal'),
        'normal',
      ),
      button('?', 'Keys (?)', () => this.toggleHelp(), 'help'),
    );
    this.element = el(
      'div',
      { class: 'replay-controls' },
      this.#legend,
      this.#timeline.element,
      transport,
      el('div', { class: 'switches' }, this.#engines, this.#modes),
      el('div', { class: 'switches' }, this.#layers),
      this.#said,
      this.#help,
    );
  }

  toggleHelp(): void {
    this.#help.hidden = !this.#help.hidden;
    if (!this.#help.hidden) this.#help.scrollIntoView({ block: 'nearest' });
  }

  say(text: string): void {
    this.#said.textContent = text;
  }

  set time(seconds: number) {
    this.#timeline.time = seconds;
    const { playing, rate } = this.#stage.player;
    const real = Math.abs(rate - 1) < 0.07;
    const text = `${seconds.toFixed(4)} s`;
    this.#clock.textContent = playing && !real ? `${text}, ×${Number(rate.toPrecision(2))} real time` : text;
  }

  /** Shows what the colours mean, when that is something else than before. */
  refreshLegend(): void {
    const entries = this.#stage.view.legend;
    const text = JSON.stringify(entries);
    if (text === this.#entries) return;
    this.#entries = text;
    this.#legend.replaceChildren(...(legendNodes(entries) as Node[]));
  }

  /** Shows what is on. */
  refresh(): void {
    const stage = this.#stage;
    const playing = stage.player.playing;
    this.#play.textContent = playing ? '❙❙' : '▶';
    this.#play.setAttribute('aria-pressed', String(playing));
    const speed = String(stage.player.speed);
    if (![...this.#speed.options].some((o) => o.value === speed))
      this.#speed.append(el('option', { value: speed }, `${speed} ×`));
    this.#speed.value = speed;
    this.#timeline.show(stage.shown, stage.player.end);
    this.time = stage.time;
    this.#refreshEngines();
    this.#refreshLayers();
    this.#refreshModes();
  }

  #chip(text: string, on: boolean, title: string, action: () => void, data: string, swatch?: string): HTMLElement {
    const mark = swatch ? el('i', { style: `background:${swatch}` }) : null;
    return el(
      'button',
      { type: 'button', 'aria-pressed': String(on), title, onclick: action, 'data-switch': data },
      mark,
      text,
    );
  }

  #refreshEngines(): void {
    const stage = this.#stage;
    replaceKeepingFocus(
      this.#engines,
      stage.engines.map((source) => {
        const able = source.times.length > 0;
        const chip = this.#chip(
          source.label,
          stage.isShown(source),
          able ? source.note : `no frames: ${source.note}`,
          () => stage.toggleEngine(source),
          source.spec,
          source.colour,
        );
        if (!able) chip.setAttribute('disabled', '');
        return chip;
      }),
    );
  }

  #refreshLayers(): void {
    const stage = this.#stage;
    const { layers, exaggeration, arrows } = stage.view.options;
    const chips = (Object.keys(layerNames) as LayerName[])
      .filter((name) => name !== 'islands' && (name !== 'reference' || stage.hasReference))
      .map((name) => this.#chip(layerNames[name], layers[name], hints[name] ?? '', () => this.toggle(name), name));
    const slider = (text: string, value: number, least: number, most: number, set: (v: number) => void) => {
      const input = el('input', {
        type: 'range',
        min: least,
        max: most,
        step: 0.25,
        value: Math.log2(value),
        'aria-label': text,
      });
      input.addEventListener('change', () => set(2 ** Number(input.value)));
      return el('label', { class: 'slider' }, text, input, `×${Number(value.toPrecision(3))}`);
    };
    if (layers.penetration)
      chips.push(slider('depth', exaggeration, 0, 12, (v) => stage.setOptions({ exaggeration: v })));
    if (layers.velocities || layers.spins || layers.impulses)
      chips.push(slider('arrows', arrows, -4, 4, (v) => stage.setOptions({ arrows: v })));
    replaceKeepingFocus(this.#layers, chips);
  }

  #refreshModes(): void {
    const stage = this.#stage;
    const { overlaid, colouring } = stage.view.options;
    const select = el('select', { 'aria-label': 'Colours', title: 'Colours' });
    for (const [name, text] of Object.entries(colourings))
      select.append(el('option', { value: name }, `colours ${text}`));
    select.value = colouring;
    select.addEventListener('change', () => stage.setOptions({ colouring: select.value as Colouring }));
    const more = this.#chip(
      'all frames',
      false,
      'Frames were thinned for the report; load those of the HDF5 files',
      () => void stage.loadAll(),
      'all',
    );
    replaceKeepingFocus(this.#modes, [
      this.#chip('side by side', !overlaid, 'One picture each (o)', () => this.overlay(false), 'side'),
      this.#chip('overlaid', overlaid, 'All in one picture (o)', () => this.overlay(true), 'overlaid'),
      select,
      this.#chip(
        'whole scene',
        false,
        'Camera back to everything that moves (a)',
        () => stage.view.frameAll(),
        'frame',
      ),
      this.#chip(
        'follow',
        stage.following,
        'The camera goes along with the chosen body (g)',
        () => stage.toggleFollow(),
        'follow',
      ),
      this.#chip(
        'measure',
        stage.measuring,
        'Click points: distance of two, angle of three (x)',
        () => stage.toggleMeasure(),
        'measure',
      ),
      ...(stage.canLoadMore ? [more] : []),
      el(
        'span',
        { class: 'chips', role: 'group', 'aria-label': 'Save' },
        saved.map(([what, text, title]) =>
          el(
            'button',
            { type: 'button', title, 'data-action': `save-${what}`, onclick: () => void stage.save(what) },
            text,
          ),
        ),
      ),
    ]);
  }

  toggle(name: LayerName): void {
    const { layers } = this.#stage.view.options;
    this.#stage.setOptions({ layers: { ...layers, [name]: !layers[name] } });
  }

  /** Engines are distinguished by colour where they share a picture. */
  overlay(on: boolean): void {
    const { colouring } = this.#stage.view.options;
    this.#stage.setOptions({ overlaid: on, colouring: on ? 'engine' : colouring === 'engine' ? 'body' : colouring });
  }
}
