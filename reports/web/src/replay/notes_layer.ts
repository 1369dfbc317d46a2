// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Texts at points of the world, over the pictures: names of bodies, of the arrows of a finding, measures.
import { el, svg } from '../common/elements.ts';
import type { Note } from './finding_overlay.ts';
import type { FrameSource } from './frames.ts';
import type { Vec3 } from './vectors.ts';
import type { ReplayView } from './view.ts';

export interface NotesOf {
  source: FrameSource;
  notes: Note[];
  lines?: [from: Vec3, to: Vec3][];
}

export class NotesLayer {
  readonly element = el('div', { class: 'notes', 'aria-hidden': 'true' });
  readonly #spans: HTMLElement[] = [];
  readonly #drawing = svg('svg', {});

  constructor() {
    this.element.append(this.#drawing);
  }

  /** Shows these and no others, each where its point is seen. */
  place(view: ReplayView, all: readonly NotesOf[]): void {
    let used = 0;
    const paths: string[] = [];
    for (const { source, notes, lines = [] } of all) {
      const panel = view.panels.find((p) => p.sources.includes(source))?.rect;
      if (!panel) continue;
      for (const [from, to] of lines) {
        const ends = [view.project(source, from), view.project(source, to)];
        if (ends[0] && ends[1]) paths.push(`M${ends[0].join(' ')}L${ends[1].join(' ')}`);
      }
      for (const { at, text, kind } of notes) {
        const place = view.project(source, at);
        if (place === null) continue;
        const [x, y] = place;
        if (x < panel.x || y < panel.y || x > panel.x + panel.width || y > panel.y + panel.height) continue;
        const span = this.#span(used++);
        if (span.textContent !== text) span.textContent = text;
        span.className = kind;
        span.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
      }
    }
    this.#drawing.replaceChildren(...(paths.length ? [svg('path', { d: paths.join('') })] : []));
    for (let i = used; i < this.#spans.length; ++i) (this.#spans[i] as HTMLElement).textContent = '';
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
