// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The picture of a live session: the view of the replay, fed by instances, with what the pointer is on and the spring
// that it pulls.
import { el, svg } from '../common/elements.ts';
import type { CameraState } from '../replay/camera_rig.ts';
import { followPointer, followTheme, type PointerActions } from '../replay/follow.ts';
import { Inspector } from '../replay/inspector.ts';
import type { Scene } from '../replay/scene.ts';
import type { Vec3 } from '../replay/vectors.ts';
import { type Pick, ReplayView } from '../replay/view.ts';
import { Dragger, type Held } from './drag.ts';
import type { InstanceSource } from './instance_source.ts';
import { InstanceLabels } from './labels.ts';

const forEver = 1e12; // [s]: the newest frame

export class Picture {
  readonly view: ReplayView;
  readonly element: HTMLElement;
  readonly #inspector: Inspector;
  readonly #labels = new InstanceLabels();
  readonly #dragger: Dragger;
  readonly #spring = svg('svg', { class: 'spring' });
  readonly #ends: (() => void)[] = [];
  readonly #scene: Scene;
  #sources: InstanceSource[] = [];
  #lookAgain = 0; // time from which the camera may move by itself [ms]
  #hover: Pick | null = null;
  #pinned: { source: InstanceSource; body: number } | null = null;
  /** The user has moved the camera. */
  byHand = false;
  /** The camera or a switch has changed. */
  onChange: (() => void) | null = null;

  /** Takes the place of what is in `parent`. Throws NoWebGL. */
  constructor(parent: HTMLElement, scene: Scene, drag: (held: Held | null) => Promise<unknown>) {
    this.#scene = scene;
    this.element = el('div', { class: 'stage' });
    parent.replaceChildren(this.element); // inserted before the view reads its size
    this.view = new ReplayView(this.element, scene);
    this.#inspector = new Inspector(scene, true);
    this.#dragger = new Dragger(this.view, (body) => scene.bodies[body]?.type === 'dynamic', drag);
    this.element.append(this.#labels.element, this.#spring, this.#inspector.element);
    this.#ends.push(this.#dragger.listen(this.element));
    this.view.onCamera = () => {
      this.byHand = true;
      this.onChange?.();
    };
    this.view.onDraw = () => {
      this.#labels.place(this.view);
      this.#inspect();
      this.#drawSpring();
    };
    this.#followPointer();
    this.#ends.push(followTheme(this.view));
  }

  setInstances(sources: InstanceSource[]): void {
    this.#sources = sources;
    this.view.setSources(sources);
    this.update();
  }

  /** Instances have new frames. */
  update(): void {
    this.view.setTime(forEver);
    this.view.refresh();
    if (performance.now() < this.#lookAgain) return;
    this.#lookAgain = performance.now() + 400;
    if (!this.byHand && this.#sources.some((source) => this.#hasLost(source))) this.view.frameAll();
  }

  /** The camera follows what moves, until the user moves it. */
  frame(): void {
    this.byHand = false;
    this.view.frameAll();
  }
  setCamera(camera: CameraState): void {
    this.byHand = true;
    this.view.camera = camera;
  }

  /** A body that moves is outside of the instance's picture. */
  #hasLost(source: InstanceSource): boolean {
    const panel = this.view.panels.find(({ sources }) => sources.includes(source));
    const position = source.newest?.position;
    if (!panel || !position) return false;
    const { x, y, width, height } = panel.rect;
    return this.#scene.bodies.some((body, b) => {
      if (body.type !== 'dynamic') return false;
      const at = [0, 1, 2].map((k) => position[3 * b + k] as number) as Vec3;
      const seen = at.every(Number.isFinite) ? this.view.project(source, at) : null;
      return seen !== null && (seen[0] < x || seen[0] > x + width || seen[1] < y || seen[1] > y + height);
    });
  }

  #followPointer(): void {
    const actions: PointerActions = {
      cursor: 'grab',
      hover: (pick) => {
        this.#hover = pick;
        this.view.mark(pick?.body ?? this.#pinned?.body ?? -1);
        this.#inspect();
      },
      click: (pick) => {
        this.#pinned = pick && pick.body >= 0 ? { source: pick.source as InstanceSource, body: pick.body } : null;
        this.view.mark(this.#pinned?.body ?? -1);
        this.#inspect();
      },
    };
    this.#ends.push(followPointer(this.view, actions));
  }

  /** Shows the object under the pointer, or the body that was clicked, with the numbers of the newest frame. */
  #inspect(): void {
    if (this.#hover) {
      const now = this.view.frameOf(this.#hover.source);
      const stale = now !== null && now.frame !== this.#hover.frame;
      this.#inspector.show(stale ? { ...this.#hover, frame: now.frame, contact: -1 } : this.#hover);
      return;
    }
    const frame = this.#pinned?.source.newest;
    const what =
      this.#pinned && frame
        ? { source: this.#pinned.source, frame, body: this.#pinned.body, shape: -1, contact: -1, island: -1 }
        : null;
    this.#inspector.show(what);
  }

  /** A line in every picture from where the body is held to where the pointer wants it. */
  #drawSpring(): void {
    const lines = this.#sources.flatMap((source) => {
      const drag = source.head?.drag;
      const from = drag && this.view.project(source, drag.point as Vec3);
      const to = drag && this.view.project(source, drag.target as Vec3);
      if (!from || !to) return [];
      const ends = { x1: from[0], y1: from[1], x2: to[0], y2: to[1] };
      return [svg('line', ends), svg('circle', { cx: from[0], cy: from[1], r: 4 })];
    });
    this.#spring.replaceChildren(...lines);
  }

  dispose(): void {
    for (const end of this.#ends) end();
    this.view.dispose();
    this.element.remove();
  }
}
