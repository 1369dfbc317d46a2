// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Buttons that move all instances through time, and what is shown of them.
import { el } from '../common/elements.ts';
import { format, timeStep } from '../common/format.ts';
import { type Colouring, colourings, type LayerName, layerNames } from '../replay/layers.ts';
import { speeds } from '../replay/player.ts';
import type { ReplayView } from '../replay/view.ts';
import type { SessionView } from './session_view.ts';

const more = [...speeds, 8, 16];

const button = (text: string, title: string, action: () => void, name: string) =>
  el('button', { type: 'button', title, 'aria-label': title, onclick: action, 'data-action': name }, text);

export class Transport {
  readonly element: HTMLElement;
  readonly #session: SessionView;
  readonly #play: HTMLButtonElement;
  readonly #stage: HTMLButtonElement;
  readonly #clock = el('output', { class: 'clock' });
  readonly #pace = el('span', { class: 'pace', role: 'status' });
  readonly #speed = el('select', { title: 'Speed', 'aria-label': 'Speed' });
  readonly #layers = el('span', { class: 'chips', role: 'group', 'aria-label': 'Layers' });

  constructor(session: SessionView, change: (layer: LayerName) => void, help: () => void) {
    this.#session = session;
    const sender = (command: string, steps?: number) => () => {
      void session.send(steps === undefined ? { command } : { command, steps });
    };
    this.#play = button('▶', 'Play or pause (space)', () => this.toggle(), 'play');
    this.#stage = button('Stage', 'One stage of the step (s)', sender('stage'), 'stage');
    for (const s of more) this.#speed.append(el('option', { value: s }, s === 1 ? 'real time' : `${s} ×`));
    this.#speed.addEventListener('change', () => this.setSpeed(Number(this.#speed.value)));
    for (const name of Object.keys(layerNames) as LayerName[])
      if (name !== 'reference')
        this.#layers.append(
          el('button', { type: 'button', onclick: () => change(name), 'data-switch': name }, layerNames[name]),
        );
    this.element = el(
      'div',
      { class: 'replay-controls' },
      el(
        'div',
        { class: 'transport' },
        button('| ◀', 'All instances back to the start (Home)', sender('reset'), 'reset'),
        button('◀◀', 'Ten steps back (shift ←)', sender('back', 10), 'back10'),
        button('◀', 'One step back (←)', sender('back', 1), 'back'),
        this.#play,
        button('▶\u200a|', 'One step (→)', sender('step', 1), 'step'),
        button('▶▶', 'Ten steps (shift →)', sender('step', 10), 'step10'),
        this.#stage,
        this.#clock,
        this.#speed,
        this.#pace,
        el('span', { class: 'spring' }),
        button('?', 'Keys (?)', help, 'help'),
      ),
      el('div', { class: 'switches' }, this.#layers),
    );
  }

  toggle(): void {
    void this.#session.send({ command: this.#session.state?.playing ? 'pause' : 'play' });
  }

  setSpeed(factor: number): void {
    void this.#session.send({ command: 'speed', factor });
  }

  /** One faster or slower. */
  shiftSpeed(by: number): void {
    const now = this.#session.state?.speed ?? 1;
    const at = more.findIndex((s) => s >= now - 1e-9);
    this.setSpeed(more[Math.min(more.length - 1, Math.max(0, at + by))] as number);
  }

  refresh(view: ReplayView | null): void {
    const state = this.#session.state;
    if (!state) return;
    this.#play.textContent = state.playing ? '❙❙' : '▶';
    this.#play.setAttribute('aria-pressed', String(state.playing));
    const able = state.instances.some((instance) => instance.has_stages);
    this.#stage.disabled = !able;
    this.#clock.textContent = `${format(state.step * state.dt, 6)} s`;
    this.#clock.title = `step ${state.step} of ${timeStep(state.dt)}`;
    if (document.activeElement !== this.#speed) this.#speed.value = String(state.speed);
    const reached = state.reached_speed;
    const slow = state.playing && reached > 0 && reached < 0.8 * state.speed;
    this.#pace.textContent = slow ? `the instances allow ${format(reached, 2)} ×` : '';
    for (const chip of this.#layers.querySelectorAll('button'))
      chip.setAttribute('aria-pressed', String(view?.options.layers[chip.dataset.switch as LayerName] ?? false));
  }
}

/** Side by side or overlaid, and what colours mean. */
export class Arrangement {
  readonly element = el('span', { class: 'chips', role: 'group', 'aria-label': 'Arrangement' });

  constructor(change: (options: { overlaid?: boolean; colouring?: Colouring }) => void, frame: () => void) {
    const chip = (text: string, data: string, action: () => void) =>
      el('button', { type: 'button', onclick: action, 'data-mode': data }, text);
    this.element.append(
      chip('Side by side', 'beside', () => change({ overlaid: false })),
      chip('Overlaid', 'overlaid', () => change({ overlaid: true })),
      ...(Object.keys(colourings) as Colouring[]).map((colouring) =>
        chip(`Colours ${colourings[colouring]}`, colouring, () => change({ colouring })),
      ),
      button('Whole scene', 'Camera on everything (a)', frame, 'frame'),
    );
  }

  refresh({ options }: ReplayView): void {
    for (const chip of this.element.querySelectorAll<HTMLElement>('[data-mode]')) {
      const { mode } = chip.dataset;
      const on =
        mode === 'beside' ? !options.overlaid : mode === 'overlaid' ? options.overlaid : options.colouring === mode;
      chip.setAttribute('aria-pressed', String(on));
    }
  }
}
