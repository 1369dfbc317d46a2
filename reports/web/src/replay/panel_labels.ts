// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Names over the pictures: whose run it is, which frame, and what is missing.
import { el } from '../common/elements.ts';
import type { FrameSource } from './frames.ts';
import type { ReplayView } from './view.ts';

const short = (x: number) => String(Number(x.toPrecision(5)));

const requested = new WeakMap<FrameSource, boolean>();
/** True if any frame has contacts, so that their absence is reported. */
function hasContacts(source: FrameSource): boolean {
  let known = requested.get(source);
  if (known === undefined) {
    known = source.events.some((event) => event.kind === 'contact_begin');
    requested.set(source, known);
  }
  return known;
}

interface Label {
  node: HTMLElement;
  state: HTMLElement;
  sources: FrameSource[];
  text: string;
}

export class PanelLabels {
  readonly element = el('div', { class: 'labels' });
  #labels: Label[] = [];

  place(view: ReplayView): void {
    const panels = view.panels;
    const same =
      panels.length === this.#labels.length && panels.every((panel, i) => panel.sources === this.#labels[i]?.sources);
    if (!same) this.#build(panels.map((panel) => panel.sources));
    panels.forEach(({ rect, sources }, i) => {
      const { node, state } = this.#labels[i] as Label;
      node.style.transform = `translate(${rect.x}px, ${rect.y}px)`;
      node.style.maxWidth = `${rect.width}px`;
      const text = this.#stateOf(view, sources);
      if (text === this.#labels[i]?.text) return;
      (this.#labels[i] as Label).text = text;
      state.textContent = text;
    });
  }

  #stateOf(view: ReplayView, sources: FrameSource[]): string {
    const first = sources[0] as FrameSource;
    const now = view.frameOf(first);
    if (!now) return 'no frames';
    const { frame, index } = now;
    const parts = [`t = ${short(frame.time)} s`, `frame ${index + 1}/${first.times.length}`];
    if (sources.filter((s) => !s.ghost).length === 1 && first.note) parts.push(first.note);
    const { contacts, normals, penetration, impulses } = view.options.layers;
    if (!frame.contacts && !first.ghost && hasContacts(first) && (contacts || normals || penetration || impulses))
      parts.push('contacts are not stored here');
    for (let i = 0; i < frame.position.length; ++i)
      if (!Number.isFinite(frame.position[i] as number) && !first.ghost) {
        parts.push('a body is not finite and not drawn');
        break;
      }
    return parts.join(' · ');
  }

  #build(groups: FrameSource[][]): void {
    this.#labels = groups.map((sources) => {
      const state = el('small');
      const names = sources.map((s) =>
        el('b', { class: s.ghost ? 'ghost' : null }, el('i', { style: `background:${s.colour}` }), s.label),
      );
      return { node: el('div', { class: 'label' }, names, state), state, sources, text: '' };
    });
    this.element.replaceChildren(...this.#labels.map((l) => l.node));
  }
}
