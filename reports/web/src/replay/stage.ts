// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Picture, controls and keys of a replay, bound together.

import type { Focus } from '../common/cursor.ts';
import { el } from '../common/elements.ts';
import { stepAt } from '../common/steps.ts';
import type { JumpTarget, ReplayActions } from './actions.ts';
import type { ReplayContext } from './context.ts';
import { Controls } from './controls.ts';
import { followPointer, followTheme, type PointerActions } from './follow.ts';
import { type Frame, type FrameSource, indexAt } from './frames.ts';
import { bodyReach } from './framing.ts';
import { Inspector } from './inspector.ts';
import {
  bodiesOf,
  contactEvent,
  describe,
  firstDivergence,
  type Jump,
  largestError,
  neighbourTime,
  worstNormal,
} from './jumps.ts';
import { bindKeys } from './keys.ts';
import { decodeLink, encodeLink, viewOfHash, withView } from './link.ts';
import { PanelLabels } from './panel_labels.ts';
import { Player } from './player.ts';
import type { Scene } from './scene.ts';
import type { Vec3 } from './vectors.ts';
import { type Pick, ReplayView } from './view.ts';

/** More pictures than this make each too small to begin with. */
const mostShownAtFirst = 4;

/** Selection that the inspector goes on showing. */
interface Pinned {
  spec: string;
  body: number;
  other?: number; // body, of a contact looked at
  contact?: { index: number; step: number }; // contact that is shown as long as the frame is that of its step
}

/** The contact that is looked at: the one that was named, else the deepest of the two bodies; -1 where there is none. */
function contactOf(pinned: Pinned, { contacts, step }: Frame): number {
  const { body, other, contact } = pinned;
  let found = -1;
  if (!contacts) return found;
  if (contact && contact.step === step && contact.index < contacts.count) return contact.index;
  if (other === undefined) return found;
  for (let i = 0; i < contacts.count; ++i) {
    const [a, b] = [contacts.bodyA[i], contacts.bodyB[i]];
    if (!((a === body && b === other) || (a === other && b === body))) continue;
    if (found < 0 || (contacts.depth[i] as number) > (contacts.depth[found] as number)) found = i;
  }
  return found;
}

export class ReplayStage implements ReplayActions {
  readonly view: ReplayView;
  readonly player: Player;
  readonly sources: FrameSource[];
  readonly #context: ReplayContext;
  readonly #scene: Scene;
  readonly controls: Controls;
  readonly #inspector: Inspector;
  readonly #labels: PanelLabels;
  readonly #stage: HTMLElement;
  readonly #ends: (() => void)[] = [];
  #chosen: Set<string>; // specs that have a picture
  #pinned: Pinned | null = null;
  #hover: Pick | null = null;
  readonly #thinned: Map<FrameSource, () => Promise<FrameSource>> | null;
  #linkTimer: ReturnType<typeof setTimeout> | undefined;
  #left = false; // a link was followed: the address is already that of the next page

  /** `thinned`: how to get all frames of a source that has not all of them. */
  constructor(
    root: HTMLElement,
    scene: Scene,
    sources: FrameSource[],
    context: ReplayContext,
    thinned: Map<FrameSource, () => Promise<FrameSource>> | null = null,
  ) {
    this.#thinned = thinned;
    this.#context = context;
    this.#scene = scene;
    this.sources = sources;
    this.#stage = el('div', { class: 'stage' });
    root.append(this.#stage);
    this.view = new ReplayView(this.#stage, scene);
    this.player = new Player(context.cursor.time, () => this.controls?.refresh());
    this.#inspector = new Inspector(scene);
    this.#labels = new PanelLabels();
    this.#stage.append(this.#labels.element, this.#inspector.element);
    this.#chosen = this.#firstChoice();
    this.player.end = Math.max(0, ...sources.map((s) => s.times[s.times.length - 1] ?? 0));
    if (this.player.end < 1.2) this.player.speed = 0.25;
    this.controls = new Controls(this);
    root.append(this.controls.element);
    this.#ends.push(bindKeys(root, this, this.controls));
    const leave = () => {
      this.#left = true;
    };
    addEventListener('hashchange', leave);
    this.#ends.push(() => removeEventListener('hashchange', leave));
    this.#follow();
    this.#restore();
    this.#choose();
    this.#seek(context.cursor.time.value);
  }

  // ---- ReplayActions ----

  get engines(): FrameSource[] {
    return this.sources.filter((s) => !s.ghost);
  }
  get shown(): FrameSource[] {
    const { hidden } = this.#context.cursor;
    return this.engines.filter((s) => this.#chosen.has(s.spec) && !hidden.value.has(s.spec) && s.times.length > 0);
  }
  get hasReference(): boolean {
    return this.sources.some((s) => s.ghost);
  }
  get time(): number {
    return this.#context.cursor.time.value;
  }
  isShown(source: FrameSource): boolean {
    return this.shown.includes(source);
  }

  /** Switches the picture of an engine. An engine that the curves have switched off is shown again only with them. */
  toggleEngine(source: FrameSource): void {
    const { hidden } = this.#context.cursor;
    if (hidden.value.has(source.spec)) {
      hidden.set(new Set([...hidden.value].filter((spec) => spec !== source.spec)));
      this.#chosen.add(source.spec);
    } else if (!this.#chosen.delete(source.spec)) this.#chosen.add(source.spec);
    this.#choose();
  }

  /** True if there are frames that are not loaded yet. */
  get canLoadMore(): boolean {
    return this.shown.some((s) => this.#thinned?.has(s));
  }

  /** Replaces the thinned frames of the engines that are shown by all that were stored. */
  async loadAll(): Promise<void> {
    for (const source of this.shown) {
      const load = this.#thinned?.get(source);
      if (!load) continue;
      this.controls.say(`Loading all frames of ${source.label} …`);
      try {
        const whole = await load();
        this.sources[this.sources.indexOf(source)] = whole;
        this.controls.say('');
      } catch (error) {
        this.controls.say(`${source.label}: ${error instanceof Error ? error.message : String(error)}`);
      }
      this.#thinned?.delete(source);
    }
    this.#choose();
  }

  setTime(seconds: number): void {
    this.#context.cursor.time.set(Math.min(this.player.end, Math.max(0, seconds)), this);
    this.#seek(this.time);
  }

  step(forward: boolean, count = 1): void {
    this.player.pause();
    let time = this.time;
    for (let i = 0; i < count; ++i) time = neighbourTime(this.shown, time, forward) ?? time;
    this.setTime(time);
  }

  jump(to: JumpTarget): void {
    const shown = this.shown;
    const find: Record<JumpTarget, () => Jump | null> = {
      divergence: () => firstDivergence(shown),
      largest: () => largestError(shown, this.#context.metrics ?? []),
      next: () => contactEvent(shown, this.time, true),
      previous: () => contactEvent(shown, this.time, false),
      normal: () => worstNormal(shown),
    };
    const found = find[to]();
    this.player.pause();
    if (!found) {
      this.controls.say('There is no such event among the engines that are shown.');
      return;
    }
    this.setTime(found.event.time);
    this.controls.say(`${found.source.label}: ${describe(found.event)}`);
    if (to === 'normal') this.#lookAtBodies(bodiesOf(found.event), found.source, found.event.contact ?? null);
  }

  focus({ spec, bodies, contact }: Focus): void {
    const source = this.engines.find((s) => s.spec === spec && s.times.length > 0);
    if (source && !this.isShown(source)) this.toggleEngine(source);
    this.#lookAtBodies(bodies, source, contact);
  }

  setOptions(change: Parameters<ReplayView['setOptions']>[0]): void {
    this.view.setOptions(change);
    this.controls.refresh();
    this.#remember();
  }

  // ---- inside ----

  /** The engine in focus and those preferred; at most a few at first. */
  #firstChoice(): Set<string> {
    const able = this.engines.filter((s) => s.times.length > 0);
    if (able.length <= mostShownAtFirst) return new Set(able.map((s) => s.spec));
    const wanted = this.#context.cursor.focus.value?.spec;
    const rank = (s: FrameSource) => (s.spec === wanted ? 0 : this.#context.isPreferred?.(s.spec) ? 1 : 2);
    const first = [...able].sort((a, b) => rank(a) - rank(b)).slice(0, mostShownAtFirst);
    return new Set(first.map((s) => s.spec));
  }

  #choose(): void {
    const shown = new Set(this.shown);
    this.view.setSources(this.sources.filter((s) => s.ghost || shown.has(s)));
    this.controls.refresh();
    this.#remember();
  }

  #follow(): void {
    const { cursor } = this.#context;
    this.#ends.push(
      cursor.time.follow((time, source) => {
        if (source !== this) this.#seek(time);
      }),
      cursor.hidden.follow(() => this.#choose()),
      cursor.focus.follow((focus) => {
        if (focus) this.focus(focus);
      }),
    );
    this.view.onCamera = () => this.#remember();
    this.view.onDraw = () => {
      this.#labels.place(this.view);
      this.#inspect();
    };
    this.#followPointer();
    this.#ends.push(followTheme(this.view));
  }

  #followPointer(): void {
    const actions: PointerActions = {
      cursor: 'pointer',
      hover: (pick) => {
        this.#hover = pick;
        this.view.mark(pick?.body ?? this.#pinned?.body ?? -1);
        this.#inspect();
      },
      click: (pick) => {
        this.#pinned = pick && pick.body >= 0 ? { spec: pick.source.spec, body: pick.body } : null;
        this.view.mark(this.#pinned?.body ?? -1);
        this.#inspect();
        this.#remember();
      },
    };
    this.#ends.push(followPointer(this.view, actions));
  }

  /** Shows the object under the pointer, or the body that was clicked. */
  #inspect(): void {
    if (this.#hover) {
      const now = this.view.frameOf(this.#hover.source);
      const stale = now !== null && now.frame !== this.#hover.frame;
      this.#inspector.show(stale ? { ...this.#hover, frame: now.frame, contact: -1 } : this.#hover, false);
      return;
    }
    const pinned = this.#pinned;
    const source = pinned && this.sources.find((s) => s.spec === pinned.spec);
    const now = source ? this.view.frameOf(source) : null;
    const contact = pinned && now ? contactOf(pinned, now.frame) : -1;
    const what =
      pinned && source && now ? { source, frame: now.frame, body: pinned.body, shape: -1, contact, island: -1 } : null;
    this.#inspector.show(what, true);
  }

  #seek(time: number): void {
    this.view.setTime(time);
    this.controls.time = time;
    if (!this.player.playing) this.#remember();
  }

  #lookAtBodies(names: string[], source: FrameSource | undefined, contact: number | null): void {
    const bodies = names.map((name) => this.#scene.bodies.findIndex((b) => b.name === name)).filter((b) => b >= 0);
    const moving = bodies.filter((b) => this.#scene.bodies[b]?.type !== 'static');
    const b = moving[0];
    if (b === undefined || !source || source.times.length === 0) return;
    const { position, step } = source.frame(indexAt(source.times, this.time)); // the picture may still show another one
    const places = moving.slice(0, 2).map((m) => [0, 1, 2].map((k) => position[3 * m + k] as number) as Vec3);
    const at = [0, 1, 2].map((k) => places.reduce((sum, p) => sum + (p[k] as number) / places.length, 0)) as Vec3;
    if (!at.every(Number.isFinite)) return;
    const apart = Math.hypot(...at.map((v, k) => v - (places[0]?.[k] as number)));
    const reach = Math.max(...moving.slice(0, 2).map((m) => bodyReach(this.#scene, m)));
    this.view.lookAt(at, Math.max(1e-3, apart + 2 * reach));
    this.#pinned = { spec: source.spec, body: b };
    const other = bodies.find((body) => body !== b);
    if (other !== undefined) this.#pinned.other = other;
    if (contact !== null) this.#pinned.contact = { index: contact, step };
    this.view.mark(b);
  }

  // ---- the link ----

  #restore(): void {
    const state = decodeLink(this.#context.state ?? viewOfHash(location.hash));
    if (state.options) this.view.setOptions(state.options);
    if (state.shown) {
      const known = state.shown.filter((spec) => this.engines.some((s) => s.spec === spec));
      if (known.length > 0) this.#chosen = new Set(known);
    }
    if (state.speed !== undefined) this.player.speed = state.speed;
    const { dt } = this.#context;
    const time = state.step !== undefined && dt ? state.step * dt : state.time;
    if (time !== undefined) this.#context.cursor.time.set(Math.min(time, this.player.end));
    if (state.camera) this.view.camera = state.camera;
    const spec = this.shown.find((s) => s.spec === state.of)?.spec ?? this.shown[0]?.spec;
    if (state.body === undefined || state.body >= this.#scene.bodies.length || spec === undefined) return;
    this.#pinned = { spec, body: state.body };
    const { contact, step } = state;
    if (contact !== undefined && step !== undefined) this.#pinned.contact = { index: contact, step };
  }

  /** Writes the address a little later: not while it plays or the camera turns, and never over another page's. */
  #remember(): void {
    clearTimeout(this.#linkTimer);
    if (this.#left) return;
    const address = location.hash;
    this.#linkTimer = setTimeout(() => {
      if (location.hash !== address) return;
      const text = this.link();
      if (this.#context.onState) this.#context.onState(text);
      else history.replaceState(null, '', withView(location.hash, text));
    }, 300);
  }

  /** All that is needed to see the same again. */
  link(): string {
    const step = stepAt(this.time, this.#context.dt ?? 0);
    return encodeLink({
      time: this.time,
      ...(step === null ? {} : { step }),
      shown: this.shown.map((s) => s.spec),
      options: this.view.options,
      camera: this.view.camera,
      speed: this.player.speed,
      body: this.#pinned?.body ?? -1,
      ...(this.#pinned ? { of: this.#pinned.spec } : {}),
      ...(this.#pinned?.contact && this.#pinned.contact.step === step ? { contact: this.#pinned.contact.index } : {}),
    });
  }

  dispose(): void {
    clearTimeout(this.#linkTimer);
    this.player.pause();
    for (const end of this.#ends) end();
    this.view.dispose();
  }
}
