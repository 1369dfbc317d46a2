// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A branch: another instance from where one is now, with other algorithm choices, another engine, or other values of the
// scenario. The options are those that the engine describes itself with.
import { el } from '../common/elements.ts';
import type { Engine, InstanceState, Option } from './api.ts';
import type { SessionView } from './session_view.ts';

/** Values of options in the resolved settings of an instance, or their defaults. */
export type Settings = Record<string, string>;

/** Options of the form that differ from what the instance has. */
export function changes(now: Settings, form: Settings): Settings {
  return Object.fromEntries(Object.entries(form).filter(([key, value]) => value !== '' && value !== now[key]));
}

/** Lines "KEY=VALUE" of a text field. */
export const overrides = (text: string): string[] =>
  text
    .split('\n')
    .map((line) => line.trim())
    .filter((line) => line !== '');

/** Value of an option in a spec that names no preset. */
const presetValue = (engine: Engine | undefined, option: Option): string =>
  option.presets[engine?.presets[0] ?? ''] ?? '';

function field(option: Option, now: string): HTMLElement {
  const title = option.help;
  if (option.values.length > 0) {
    const select = el('select', { name: option.key, title });
    for (const value of option.values) select.append(el('option', { value, selected: value === now }, value));
    return select;
  }
  const range = `${option.min ?? 'any'} to ${option.max ?? 'any'}${option.integer ? ', whole' : ''}`;
  return el('input', { name: option.key, value: now, inputmode: 'decimal', title: `${title} (${range})` });
}

export class BranchForm {
  readonly element = el('dialog', { class: 'branch' });
  readonly #session: SessionView;
  #engines: Engine[] = [];

  constructor(session: SessionView) {
    this.#session = session;
  }

  setEngines(engines: Engine[]): void {
    this.#engines = engines;
  }

  /** `settings`: what the instance really runs with. */
  open(instance: InstanceState, settings: Settings): void {
    const engine = this.#engines.find((e) => e.name === instance.engine);
    const choice = el('select', { name: '', 'aria-label': 'Engine' });
    choice.append(el('option', { value: '' }, `${instance.engine}, with what is chosen below`));
    for (const other of this.#engines)
      for (const preset of other.presets)
        choice.append(el('option', { value: `${other.name}:preset=${preset}` }, `${other.title}, ${preset}`));
    const choices = (engine?.options ?? []).filter((o) => o.values.length > 0);
    const numbers = (engine?.options ?? []).filter((o) => o.values.length === 0);
    const labelled = (o: Option) =>
      el('label', {}, el('span', {}, o.key.replaceAll('_', ' ')), field(o, settings[o.key] ?? presetValue(engine, o)));
    const own = el(
      'div',
      { class: 'own' },
      el('fieldset', {}, el('legend', {}, 'Algorithms'), choices.map(labelled)),
      el('details', {}, el('summary', {}, `Numbers (${numbers.length})`), el('fieldset', {}, numbers.map(labelled))),
    );
    choice.addEventListener('change', () => {
      own.hidden = choice.value !== '';
    });
    const values = el('textarea', {
      rows: 3,
      placeholder: 'gravity=[0,-1.6,0]\nbodies.block.mass=5',
      'aria-label': 'Values of the scenario, KEY=VALUE a line',
    });
    const refused = el('p', { class: 'refused', role: 'alert' });
    const form = el(
      'form',
      { method: 'dialog' },
      el('h2', {}, `Branch from ${instance.title}, step ${instance.step}`),
      el('p', { class: 'hint' }, 'The instance goes on as it is; the branch starts from what is seen now.'),
      el('label', {}, el('span', {}, 'engine'), choice),
      own,
      el('label', { class: 'wide' }, el('span', {}, 'values of the scenario'), values),
      refused,
      el(
        'div',
        { class: 'line' },
        el('button', { type: 'submit', 'data-action': 'branch-now' }, 'Branch from here'),
        el('button', { type: 'button', onclick: () => this.element.close() }, 'Cancel'),
      ),
    );
    form.addEventListener('submit', async (event) => {
      event.preventDefault(); // it closes when the server has taken it: what was typed stays otherwise
      const set = overrides(values.value);
      const request: Record<string, unknown> = { instance: instance.id, set };
      if (choice.value !== '') request.spec = choice.value;
      else request.options = changes(settings, Object.fromEntries(this.#chosen(own)));
      const say = (text: string) => {
        refused.textContent = text;
      };
      if (await this.#session.send({ command: 'branch', ...request }, say)) this.element.close();
    });
    this.element.replaceChildren(form);
    this.element.showModal();
  }

  #chosen(own: HTMLElement): [string, string][] {
    return [...own.querySelectorAll<HTMLInputElement | HTMLSelectElement>('select, input')].map((input) => [
      input.name,
      input.value.trim(),
    ]);
  }
}
