// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Texts at points of the world, over the pictures: names of bodies, of the arrows of a finding, measures.
import { el, svg } from '../common/elements.ts';
import { type NotesOf, placedNotes } from './notes_layout.ts';
import type { ReplayView } from './view.ts';

export class NotesLayer {
  readonly element = el('div', { class: 'notes', 'aria-hidden': 'true' });
  readonly #spans: HTMLElement[] = [];
  readonly #drawing = svg('svg', {});

  constructor() {
    this.element.append(this.#drawing);
  }

  /** Shows these and no others, each where its point is seen. */
  place(view: ReplayView, all: readonly NotesOf[]): void {
    const paths: string[] = [];
    for (const { source, lines = [] } of all) {
      if (!view.panels.some((p) => p.sources.includes(source))) continue;
      for (const [from, to] of lines) {
        const ends = [view.project(source, from), view.project(source, to)];
        if (ends[0] && ends[1]) paths.push(`M${ends[0].join(' ')}L${ends[1].join(' ')}`);
      }
    }
    const notes = placedNotes(view, all);
    notes.forEach(({ text, kind, left, top }, i) => {
      const span = this.#span(i);
      if (span.textContent !== text) span.textContent = text;
      span.className = kind;
      span.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    });
    this.#drawing.replaceChildren(...(paths.length ? [svg('path', { d: paths.join('') })] : []));
    for (let i = notes.length; i < this.#spans.length; ++i) (this.#spans[i] as HTMLElement).textContent = '';
  }

  #span(i: number): HTMLElement {
    let span = this.#spans[i];
    if (!span) {
      span = el('span');
      this.#spans.push(span);
      this.element.append(span);
    }
    return span;
  }
}
