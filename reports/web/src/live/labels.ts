// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Labels over each picture: the instance, its time, and its state.
import { el } from '../common/elements.ts';
import { counted, duration, format } from '../common/format.ts';
import type { ReplayView } from '../replay/view.ts';
import type { InstanceSource } from './instance_source.ts';

const mebibytes = (bytes: number) => format(bytes / 2 ** 20, 2);

/** Memory of the snapshots that steps back begin at, "history 3.1 of 64 MiB, every 2 steps"; "" without them. */
export function historyLine(source: InstanceSource): string {
  const history = source.head?.history;
  if (!history) return '';
  const every = history.every > 1 ? `, every ${history.every} steps` : '';
  return `history ${mebibytes(history.bytes)} of ${mebibytes(history.most)} MiB${every}`;
}

/** A statement about an instance; `title` explains it. */
export interface Part {
  text: string;
  title?: string;
}

const residualTitle =
  'What the velocity solver has left at the end of the step, by the engine’s own measure: not comparable between engines or solvers. `rigor solve` holds solvers against one measure.';
const timeTitle =
  'Mean wall time of a step of the last advance, measured in the live process with all that the view reads and keeps of a step: not the cost of a step that a report states.';

/** "t = 0.5 s", "step 60", "12 contacts", "8 iterations", "residual 1e-5", "0.3 ms a step". */
export function instanceParts(source: InstanceSource): Part[] {
  const head = source.head;
  if (!head) return [{ text: source.note || 'no frames yet' }];
  const { contacts, iterations, residual } = head.counters;
  const parts: Part[] = [{ text: `t = ${format(head.time, 6)} s` }, { text: `step ${head.step}` }];
  if (head.stage.in_step) parts.push({ text: `inside the next step, after ${head.stage.done.replaceAll('_', ' ')}` });
  else {
    if (contacts !== undefined) parts.push({ text: counted(contacts, 'contact') });
    if (iterations !== undefined) parts.push({ text: counted(iterations, 'iteration') });
    if (residual !== undefined) parts.push({ text: `residual ${format(residual, 2)}`, title: residualTitle });
  }
  if (head.step_seconds) parts.push({ text: `${duration(head.step_seconds)} a step`, title: timeTitle });
  return parts;
}

/** The statements in one line, with the note of an instance. */
function instanceLine(source: InstanceSource): string {
  const texts = instanceParts(source).map((part) => part.text);
  if (source.head && source.note) texts.push(source.note);
  return texts.join(' · ');
}

/** Writes the statements into a line. Elements that stay are kept, so that a title stays open while numbers change. */
export function writeParts(line: Element, parts: Part[]): void {
  while (line.children.length > parts.length) line.lastElementChild?.remove();
  parts.forEach(({ text, title }, i) => {
    const node = line.children[i] ?? line.appendChild(el('span'));
    const shown = (i ? ' · ' : '') + text;
    if (node.textContent !== shown) node.textContent = shown;
    if ((node.getAttribute('title') ?? '') === (title ?? '')) return;
    if (title) node.setAttribute('title', title);
    else node.removeAttribute('title');
  });
}

export class InstanceLabels {
  readonly element = el('div', { class: 'labels' });
  #shown = '';

  place(view: ReplayView): void {
    const panels = view.panels;
    const key = panels.map((p) => p.sources.map((s) => s.label).join('|')).join('/');
    if (key !== this.#shown) {
      this.#shown = key;
      this.element.replaceChildren(
        ...panels.map(({ sources }) =>
          el(
            'div',
            { class: 'label' },
            sources.map((s) => el('b', {}, el('i', { style: `background:${s.colour}` }), s.label)),
            el('small'),
          ),
        ),
      );
    }
    panels.forEach(({ rect, sources }, i) => {
      const node = this.element.children[i] as HTMLElement;
      node.style.transform = `translate(${rect.x}px, ${rect.y}px)`;
      node.style.maxWidth = `${rect.width}px`;
      const text = instanceLine(sources[0] as InstanceSource);
      const small = node.querySelector('small') as HTMLElement;
      if (small.textContent !== text) small.textContent = text;
    });
  }
}
