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

/** "t = 0.5 s · step 60 · 12 contacts · 8 iterations · 0.3 ms a step". */
export function instanceLine(source: InstanceSource, withNote = true): string {
  const head = source.head;
  if (!head) return source.note || 'no frames yet';
  const { contacts, iterations, residual } = head.counters;
  const parts = [`t = ${format(head.time, 6)} s`, `step ${head.step}`];
  if (head.stage.in_step) parts.push(`inside the next step, after ${head.stage.done.replaceAll('_', ' ')}`);
  else {
    if (contacts !== undefined) parts.push(counted(contacts, 'contact'));
    if (iterations !== undefined) parts.push(counted(iterations, 'iteration'));
    if (residual !== undefined) parts.push(`residual ${format(residual, 2)}`);
  }
  if (head.step_seconds) parts.push(`${duration(head.step_seconds)} a step`);
  if (withNote && source.note) parts.push(source.note);
  return parts.join(' · ');
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
