// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Texts and marks beside a picture that moves. Where the browser draws in software, changing them with every frame would
// take as long as the picture: while it plays they change a few times a second.
import { drawsInSoftware } from './software.ts';

const pause = 200; // [ms]

export class Seldom {
  readonly #show: () => void;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(show: () => void) {
    this.#show = show;
  }

  /** Shows it at once; while it plays in software within a fifth of a second. */
  call(playing: boolean): void {
    if (playing && drawsInSoftware()) {
      this.#timer ??= setTimeout(() => this.#now(), pause);
      return;
    }
    this.#now();
  }

  #now(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#show();
  }

  end(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}
