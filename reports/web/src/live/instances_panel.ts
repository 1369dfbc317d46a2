// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The instances: how each is doing, and what can be done with it. An instance that has crashed, timed out or left the numbers
// says so in words and by its mark.
import { el } from '../common/elements.ts';
import type { Engine, InstanceState } from './api.ts';
import { historyLine, instanceParts, writeParts } from './labels.ts';
import type { SessionView } from './session_view.ts';

const marks: Record<InstanceState['state'], string> = {
  loading: '…',
  ready: '●',
  non_finite: '∞',
  unsupported: '–',
  bad_input: '!',
  error: '!',
  crashed: '✕',
  timeout: '⌛',
};

export class InstancesPanel {
  readonly element: HTMLElement;
  readonly #session: SessionView;
  readonly #list = el('ul', { class: 'instances' });
  readonly #add: HTMLInputElement;
  readonly #known = el('datalist', { id: 'known-engines' });
  readonly #branch: (instance: InstanceState) => void;
  readonly #save: (instance: InstanceState) => void;
  #shownKey = '';

  constructor(
    session: SessionView,
    branch: (instance: InstanceState) => void,
    save: (instance: InstanceState) => void,
  ) {
    this.#session = session;
    this.#branch = branch;
    this.#save = save;
    this.#add = el('input', {
      type: 'text',
      list: 'known-engines',
      placeholder: 'engine, or a spec',
      'aria-label': 'Spec of another instance',
    });
    const refused = el('p', { class: 'refused', role: 'alert' });
    const say = (text: string) => {
      refused.textContent = text;
    };
    const submit = async (event: Event) => {
      event.preventDefault();
      const spec = this.#add.value.trim();
      if (spec !== '' && (await session.send({ command: 'add', spec }, say))) this.#add.value = '';
    };
    this.element = el(
      'section',
      { class: 'panel', 'data-panel': 'instances' },
      el('h2', {}, 'Instances'),
      this.#list,
      el('form', { class: 'line', onsubmit: submit }, this.#add, this.#known, el('button', {}, 'Add from the start')),
      refused,
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
    const instances = this.#session.state?.instances ?? [];
    const key = JSON.stringify(instances.map((l) => [l.id, l.state, l.message, l.title]));
    if (key !== this.#shownKey) {
      this.#shownKey = key;
      this.#list.replaceChildren(...instances.map((instance) => this.#row(instance)));
    }
    for (const instance of instances) {
      const source = this.#session.sources.get(instance.id);
      const line = this.#list.querySelector(`[data-instance="${instance.id}"] .where`);
      if (!line || !source) continue;
      const history = historyLine(source);
      writeParts(line, [...instanceParts(source), ...(history ? [{ text: history }] : [])]);
    }
  }

  /** Calls `action` with the current state of an instance, not with that of when its row was made. */
  #with(id: number, action: (instance: InstanceState) => void): () => void {
    return () => {
      const now = this.#session.state?.instances.find((instance) => instance.id === id);
      if (now) action(now);
    };
  }

  #row(instance: InstanceState): HTMLElement {
    const alive = instance.state === 'ready' || instance.state === 'non_finite';
    const ended = !alive && instance.state !== 'loading';
    const act = (text: string, title: string, name: string, action: () => void, able = true) =>
      el('button', { type: 'button', title, onclick: action, 'data-action': name, disabled: !able }, text);
    const colour = this.#session.sources.get(instance.id)?.colour ?? '';
    const from =
      instance.branch_of === undefined
        ? ''
        : ` · branch of instance ${instance.branch_of}, from step ${instance.start_step}`;
    const bad = instance.state !== 'ready' && instance.state !== 'loading';
    return el(
      'li',
      { 'data-instance': instance.id, 'data-state': instance.state },
      el('div', { class: 'who' }, el('i', { style: `background:${colour}` }), el('b', {}, instance.title)),
      el(
        'div',
        { class: 'state' },
        `${marks[instance.state]} ${instance.state.replaceAll('_', '-')} · instance ${instance.id}${from}`,
      ),
      bad ? el('p', { class: 'why' }, instance.message) : null,
      el('div', { class: 'where' }),
      el(
        'div',
        { class: 'line' },
        act(
          'Branch …',
          'Another instance from here, with other choices',
          'branch',
          this.#with(instance.id, this.#branch),
          alive,
        ),
        act('Save', 'What is seen here as a scenario file', 'save', this.#with(instance.id, this.#save), alive),
        ended
          ? act(
              'Start again',
              'A new process for this instance, up to the time of the others; after a crash all go back to its last frame. Home begins anew with all',
              'restart',
              () => {
                void this.#session.send({ command: 'restart', instance: instance.id });
              },
            )
          : null,
        act('Remove', 'End this instance', 'remove', () => {
          void this.#session.send({ command: 'remove', instance: instance.id });
        }),
      ),
    );
  }
}
