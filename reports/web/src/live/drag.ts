// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A body is dragged with the pointer: the point that was taken follows it in the plane through the point across the
// view (in two dimensions that of the scene). A spring does it, in every instance that shows the body; the last place
// is sent when the one before has been processed, so that nothing queues up.
import { conjugate, rotate, sub, type Vec3 } from '../replay/vectors.ts';
import type { Aim, Pick } from '../replay/view.ts';

export interface Held {
  body: number;
  point: Vec3; // point in the body's frame [m]
  target: Vec3; // [m]
}

/** Intersection of a ray with the plane through `point` normal to `normal`; null if there is none ahead. */
export function meet(aim: Aim, point: Vec3, normal: Vec3): Vec3 | null {
  const along = dot(aim.direction, normal);
  if (Math.abs(along) < 1e-9) return null;
  const distance = dot(sub(point, aim.origin), normal) / along;
  if (!(distance > 0)) return null;
  return [0, 1, 2].map((k) => (aim.origin[k] as number) + distance * (aim.direction[k] as number)) as Vec3;
}
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The point of the world in the frame of a body of the frame that was picked. */
export function inBody(pick: Pick): Vec3 {
  const at = (list: ArrayLike<number>, n: number) =>
    Array.from({ length: n }, (_, k) => list[n * pick.body + k] as number);
  const orientation = at(pick.frame.orientation, 4) as [number, number, number, number];
  return rotate(conjugate(orientation), sub(pick.point, at(pick.frame.position, 3) as Vec3));
}

interface Surface {
  pick(x: number, y: number): Pick | null;
  aim(x: number, y: number): Aim | null;
  set cameraEnabled(on: boolean);
}

export class Dragger {
  readonly #view: Surface;
  readonly #moves: (body: number) => boolean;
  readonly #send: (held: Held | null) => Promise<unknown>;
  #held: Held | null = null;
  #plane: { point: Vec3; normal: Vec3 } | null = null;
  #waiting = false;
  #stale = false;

  /** `moves`: whether a body can be dragged. `send`: sends it to the server; null: let go. */
  constructor(view: Surface, moves: (body: number) => boolean, send: (held: Held | null) => Promise<unknown>) {
    this.#view = view;
    this.#moves = moves;
    this.#send = send;
  }

  get held(): Held | null {
    return this.#held;
  }

  /** Listens on an element around the canvas, before the camera does. Returns what ends it. */
  listen(element: HTMLElement): () => void {
    const down = (event: PointerEvent) => {
      if (event.button !== 0 || event.shiftKey || event.ctrlKey || !(event.target instanceof HTMLCanvasElement)) return;
      if (!this.take(event.clientX, event.clientY)) return;
      this.#view.cameraEnabled = false;
      event.target.setPointerCapture(event.pointerId);
    };
    const move = (event: PointerEvent) => this.move(event.clientX, event.clientY);
    const up = () => this.release();
    element.addEventListener('pointerdown', down, { capture: true });
    element.addEventListener('pointermove', move);
    element.addEventListener('pointerup', up);
    element.addEventListener('pointercancel', up);
    return () => {
      element.removeEventListener('pointerdown', down, { capture: true });
      element.removeEventListener('pointermove', move);
      element.removeEventListener('pointerup', up);
      element.removeEventListener('pointercancel', up);
    };
  }

  /** True: there is a body that moves. */
  take(x: number, y: number): boolean {
    const pick = this.#view.pick(x, y);
    const aim = this.#view.aim(x, y);
    if (!pick || !aim || pick.body < 0 || !this.#moves(pick.body)) return false;
    this.#plane = { point: pick.point, normal: aim.direction };
    this.#held = { body: pick.body, point: inBody(pick), target: pick.point };
    return true;
  }

  move(x: number, y: number): void {
    const aim = this.#view.aim(x, y);
    if (!this.#held || !this.#plane || !aim) return;
    const target = meet(aim, this.#plane.point, this.#plane.normal);
    if (!target) return;
    this.#held.target = target;
    this.#sendDrag();
  }

  release(): void {
    if (!this.#held) return;
    this.#held = null;
    this.#view.cameraEnabled = true;
    this.#sendDrag();
  }

  #sendDrag(): void {
    if (this.#waiting) {
      this.#stale = true;
      return;
    }
    this.#waiting = true;
    this.#stale = false;
    const held = this.#held ? { ...this.#held } : null;
    void this.#send(held).finally(() => {
      this.#waiting = false;
      if (this.#stale) this.#sendDrag();
    });
  }
}
