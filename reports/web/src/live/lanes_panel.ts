// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The lanes: how each is doing, and what can be done with it. A lane that has crashed, timed out or left the numbers
// says so in words and by its mark.
import { el } from '../common/elements.ts';
import type { Engine, LaneState } from './api.ts';
import { laneLine } from './labels.ts';
import type { SessionView } from './session_view.ts';

const marks: Record<LaneState['state'], string> = {
  loading: '…',
  ready: '●',
  non_finite: '∞',
  unsupported: '–',
  bad_input: '!',
  error: '!',
  crashed: '✕',
  timeout: '⌛',
};

export class LanesPanel {
  readonly element: HTMLElement;
  readonly #session: SessionView;
  readonly #list = el('ul', { class: 'lanes' });
  readonly #add: HTMLInputElement;
  readonly #known = el('datalist', { id: 'known-engines' });
  readonly #branch: (lane: LaneState) => void;
  readonly #save: (lane: LaneState) => void;
  #told = '';

  constructor(session: SessionView, branch: (lane: LaneState) => void, save: (lane: LaneState) => void) {
    this.#session = session;
    this.#branch = branch;
    this.#save = save;
    this.#add = el('input', {
      type: 'text',
      list: 'known-engines',
      placeholder: 'engine, or a spec',
      'aria-label': 'Spec of another lane',
    });
    const submit = (event: Event) => {
      event.preventDefault();
      const spec = this.#add.value.trim();
      if (spec === '') return;
      this.#add.value = '';
      void session.tell({ command: 'add', spec });
    };
    this.element = el(
      'section',
      { class: 'panel', 'data-panel': 'lanes' },
      el('h2', {}, 'Lanes'),
      this.#list,
      el('form', { class: 'line', onsubmit: submit }, this.#add, this.#known, el('button', {}, 'Add from the start')),
    );
  }

  setEngines(engines: Engine[]): void {
    this.#known.replaceChildren(
      ...engines.flatMap(({ name, presets }) => [
        el('option', { value: name }),
        ...presets.map((preset) => el('option', { value: `${name}:preset=${preset}` })),
      ]),
    );
  }

  refresh(): void {
    const lanes = this.#session.state?.lanes ?? [];
    const key = JSON.stringify(lanes.map((l) => [l.id, l.state, l.message, l.title]));
    if (key !== this.#told) {
      this.#told = key;
      this.#list.replaceChildren(...lanes.map((lane) => this.#row(lane)));
    }
    for (const lane of lanes) {
      const source = this.#session.sources.get(lane.id);
      const line = this.#list.querySelector(`[data-lane="${lane.id}"] .where`);
      if (line && source) line.textContent = laneLine(source, false);
    }
  }

  /** Does something with a lane as it is now, not as it was when its row was made. */
  #with(id: number, action: (lane: LaneState) => void): () => void {
    return () => {
      const now = this.#session.state?.lanes.find((lane) => lane.id === id);
      if (now) action(now);
    };
  }

  #row(lane: LaneState): HTMLElement {
    const alive = lane.state === 'ready' || lane.state === 'non_finite';
    const act = (text: string, title: string, name: string, action: () => void, able = true) =>
      el('button', { type: 'button', title, onclick: action, 'data-action': name, disabled: !able }, text);
    const colour = this.#session.sources.get(lane.id)?.colour ?? '';
    const from =
      lane.branch_of === undefined ? '' : ` · branch of lane ${lane.branch_of}, from step ${lane.start_step}`;
    const bad = lane.state !== 'ready' && lane.state !== 'loading';
    return el(
      'li',
      { 'data-lane': lane.id, 'data-state': lane.state },
      el('div', { class: 'who' }, el('i', { style: `background:${colour}` }), el('b', {}, lane.title)),
      el('div', { class: 'state' }, `${marks[lane.state]} ${lane.state.replaceAll('_', '-')} · lane ${lane.id}${from}`),
      bad ? el('p', { class: 'why' }, lane.message) : null,
      el('div', { class: 'where' }),
      el(
        'div',
        { class: 'line' },
        act(
          'Branch …',
          'Another lane from here, with other choices',
          'branch',
          this.#with(lane.id, this.#branch),
          alive,
        ),
        act('Save', 'What is seen here as a scenario file', 'save', this.#with(lane.id, this.#save), alive),
        act('Remove', 'End this lane', 'remove', () => {
          void this.#session.tell({ command: 'remove', lane: lane.id });
        }),
      ),
    );
  }
}
