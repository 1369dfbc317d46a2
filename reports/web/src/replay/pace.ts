// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pixels of a picture that moves where the browser draws in software: fewer when frames come too slowly, more when there
// is time. Pictures that stand still do not concern it.

const steps = [1, 0.8, 0.65, 0.5];
const slow = 45; // [ms] from frame to frame
const quick = 24;
const pause = 400; // [ms] longer ones are not between two frames of a motion
const taken = 6; // frames that are averaged

export class Pace {
  #step = 0;
  #last = Number.NEGATIVE_INFINITY;
  #sum = 0;
  #frames = 0;

  /** Pixels of the canvas in one of the page, for a frame that is drawn now [ms]. */
  ratioAt(now: number): number {
    const gap = now - this.#last;
    this.#last = now;
    if (gap < pause) {
      this.#sum += gap;
      ++this.#frames;
    }
    if (this.#frames === taken) {
      const mean = this.#sum / taken;
      if (mean > slow) this.#step = Math.min(this.#step + 1, steps.length - 1);
      else if (mean < quick) this.#step = Math.max(this.#step - 1, 0);
      this.#sum = 0;
      this.#frames = 0;
    }
    return steps[this.#step] as number;
  }
}
