// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The clock of a replay: moves a shared time while it plays.
import type { Observable } from '../common/cursor.ts';

const measured = 0.5; // [s] between two measurements of the rate

export const speeds = [0.01, 0.03, 0.1, 0.25, 0.5, 1, 2, 4];

export class Player {
  readonly #time: Observable<number>;
  readonly #changed: () => void;
  #speed = 1;
  #requested = 0;
  #last = 0;
  #rate = 1;
  #really = 0; // [s] since the rate was measured
  #simulated = 0;
  /** Last time there is [s]. */
  end = 0;

  /** `changed`: playing or speed is another one. */
  constructor(time: Observable<number>, changed: () => void) {
    this.#time = time;
    this.#changed = changed;
  }

  /** Simulated time over that of the clock while it plays: over the last second; 1 is real time. */
  get rate(): number {
    return this.#rate;
  }

  #measure(really: number, simulated: number): void {
    this.#really += really;
    this.#simulated += simulated;
    if (this.#really < measured) return;
    this.#rate = this.#simulated / this.#really;
    this.#really = 0;
    this.#simulated = 0;
  }

  get playing(): boolean {
    return this.#requested !== 0;
  }
  get speed(): number {
    return this.#speed;
  }
  set speed(value: number) {
    this.#speed = value;
    this.#rate = value;
    this.#changed();
  }

  /** One faster or slower. */
  shift(by: number): void {
    const at = speeds.findIndex((s) => s >= this.#speed - 1e-9);
    this.speed = speeds[Math.min(speeds.length - 1, Math.max(0, (at < 0 ? speeds.length - 1 : at) + by))] as number;
  }

  /** Plays on, from the start if the end is reached. */
  play(): void {
    if (this.playing) return;
    if (this.#time.value >= this.end - 1e-9) this.#time.set(0, this);
    this.#last = performance.now();
    this.#rate = this.#speed;
    this.#really = 0;
    this.#simulated = 0;
    this.#requested = requestAnimationFrame(this.#tick);
    this.#changed();
  }

  pause(): void {
    if (!this.playing) return;
    cancelAnimationFrame(this.#requested);
    this.#requested = 0;
    this.#changed();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  readonly #tick = (now: number) => {
    // a page that was hidden does not leap
    const really = Math.max(0, (now - this.#last) / 1e3);
    const passed = Math.min(0.1, really);
    this.#last = now;
    const time = Math.min(this.end, this.#time.value + passed * this.#speed);
    this.#measure(really, time - this.#time.value);
    this.#time.set(time, this);
    // The picture requests the next frame before the clock does: it is drawn in each, and not in every second one.
    if (this.playing) this.#requested = requestAnimationFrame(this.#tick);
    if (time >= this.end) this.pause();
  };
}
