// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// State shared by curves, tables and the replay of one scenario: the selected time, engine and pair, and the engines
// that are switched off. Each part reads, sets and follows the same observables and knows no other part.

/**
 * A value with listeners to its changes. `source`: the component that set it, so that a listener can leave its own
 * changes alone.
 */
export class Observable<T> {
  #value: T;
  readonly #listeners = new Set<(value: T, source: unknown) => void>();

  constructor(value: T) {
    this.#value = value;
  }

  get value(): T {
    return this.#value;
  }

  /** Calls the listeners unless the value is the same. */
  set(value: T, source?: unknown): void {
    if (Object.is(value, this.#value)) return;
    this.#value = value;
    for (const listener of [...this.#listeners]) listener(value, source);
  }

  /** Follows from now on; returns what ends it. */
  follow(listener: (value: T, source: unknown) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }
}

/** Selection of a table's link: one engine, and two bodies if the row is about a pair. */
export interface Focus {
  spec: string;
  bodies: string[]; // names; empty: the whole scene
  contact: number | null; // index of the contact in the frame; null: the deepest of the two bodies
  finding?: string | null; // key of a finding of the audit, which is drawn there
}

export interface Cursor {
  time: Observable<number>; // [s], >= 0
  focus: Observable<Focus | null>;
  playing: boolean; // the time moves by itself
  hidden: Observable<ReadonlySet<string>>; // specs that are switched off, in curves and replay alike
}

export function newCursor(time = 0): Cursor {
  return {
    time: new Observable(time),
    focus: new Observable<Focus | null>(null),
    playing: false,
    hidden: new Observable<ReadonlySet<string>>(new Set()),
  };
}
