// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The bar under the picture: drag it to any time; marks show the events of the engines that are shown.
import { el, svg } from '../common/elements.ts';
import type { FrameSource, ReplayEvent } from './frames.ts';
import { describe } from './jumps.ts';

const tracks: Record<ReplayEvent['kind'], { height: number; mark: string }> = {
  contact_begin: { height: 0.35, mark: 'contact' },
  contact_end: { height: 0.2, mark: 'contact' },
  engine_divergence: { height: 0.6, mark: 'engine_divergence' },
  largest: { height: 0.75, mark: 'largest' },
  audit: { height: 0.75, mark: 'audit' },
  divergence: { height: 1, mark: 'divergence' },
  nonfinite: { height: 1, mark: 'nonfinite' },
};

/** Largest errors of single bodies are in the tables; here they would hide the others. */
const isMarked = (event: ReplayEvent) => event.kind !== 'largest' || !event.subject;

export class Timeline {
  readonly element: HTMLElement;
  readonly #bar: HTMLInputElement;
  readonly #marks: SVGSVGElement;
  #end = 1;

  constructor(seek: (time: number) => void) {
    this.#bar = el('input', { type: 'range', min: 0, max: 100000, step: 1, value: 0, 'aria-label': 'Time' });
    this.#bar.addEventListener('input', () => seek((Number(this.#bar.value) / 100000) * this.#end));
    this.#marks = svg('svg', {
      class: 'marks',
      viewBox: '0 0 1000 24',
      preserveAspectRatio: 'none',
      'aria-hidden': 'true',
    });
    this.#marks.addEventListener('click', (event) => {
      const time = (event.target as Element).getAttribute('data-time');
      if (time !== null) seek(Number(time));
    });
    this.element = el('div', { class: 'timeline' }, this.#marks as unknown as Node, this.#bar);
  }

  /** Marks of these sources, up to `end` [s]. */
  show(sources: readonly FrameSource[], end: number): void {
    this.#end = end || 1;
    this.#marks.replaceChildren(
      ...sources.flatMap((source) =>
        source.events.filter(isMarked).map((event) => {
          const { height, mark } = tracks[event.kind];
          const x = (1000 * event.time) / this.#end;
          const y = 24 * (1 - height);
          const line = svg(
            'path',
            { class: `mark ${mark}`, d: `M${x} 24V${y}`, stroke: source.colour, 'data-time': event.time },
            svg('title', {}, `${source.label}: ${describe(event)}, t = ${Number(event.time.toPrecision(6))} s`),
          );
          return line;
        }),
      ),
    );
  }

  set time(seconds: number) {
    this.#bar.value = String(Math.round((seconds / this.#end) * 100000));
    this.#bar.setAttribute('aria-valuetext', `${seconds.toFixed(4)} s`);
  }
}
