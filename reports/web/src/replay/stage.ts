// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Picture, controls and keys of a replay, bound together.

import type { Focus } from '../common/cursor.ts';
import { download, pngOf, saveText } from '../common/download.ts';
import { el } from '../common/elements.ts';
import { findingKey } from '../common/finding.ts';
import { stepAt } from '../common/steps.ts';
import type { JumpTarget, ReplayActions, Saved } from './actions.ts';
import { bodyNames } from './body_names.ts';
import { composed, recordVideo, statesCsv } from './capture.ts';
import type { ReplayContext } from './context.ts';
import { Controls } from './controls.ts';
import { followPointer, followTheme, type PointerActions } from './follow.ts';
import { type Frame, type FrameSource, indexAt, middleOf } from './frames.ts';
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
import { Measure } from './measure.ts';
import { NotesLayer } from './notes_layer.ts';
import type { NotesOf } from './notes_layout.ts';
import { PanelLabels } from './panel_labels.ts';
import { type Choosable, chosenNext, contactOf, type Pinned } from './pinned.ts';
import { Player } from './player.ts';
import type { Scene } from './scene.ts';
import { Seldom } from './seldom.ts';
import { sub, type Vec3 } from './vectors.ts';
import { type CameraState, type Pick, ReplayView } from './view.ts';

/** More pictures than this make each too small to begin with. */
const mostShownAtFirst = 4;

export class ReplayStage implements ReplayActions {
  readonly view: ReplayView;
  readonly player: Player;
  readonly sources: FrameSource[];
  readonly #context: ReplayContext;
  readonly #scene: Scene;
  readonly controls: Controls;
  readonly #inspector: Inspector; // beside the picture: what was chosen
  readonly #pointed: Inspector; // over it: what the pointer is on
  readonly #notes = new NotesLayer();
  readonly #measure = new Measure();
  readonly #labels: PanelLabels;
  readonly #stage: HTMLElement;
  readonly #ends: (() => void)[] = [];
  readonly #clock = new Seldom(() => {
    this.controls.time = this.time;
  });
  readonly #beside = new Seldom(() => {
    this.controls?.refreshLegend();
    this.#labels.place(this.view);
    this.#inspect();
  });
  #chosen: Set<string>; // specs that have a picture
  #pinned: Pinned | null = null;
  #hover: Pick | null = null;
  #followed: Vec3 | null = null; // last place of the body that the camera goes along with
  following = false;
  measuring = false;
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
    this.#inspector = new Inspector(scene, false);
    this.#pointed = new Inspector(scene, true);
    root.append(el('div', { class: 'stage-row' }, this.#stage, this.#inspector.element));
    this.view = new ReplayView(this.#stage, scene);
    this.player = new Player(context.cursor.time, () => {
      context.cursor.playing = this.player.playing;
      this.controls?.refresh();
    });
    this.#labels = new PanelLabels();
    this.#stage.append(this.#notes.element, this.#labels.element, this.#pointed.element);
    this.#chosen = this.#firstChoice();
    this.player.end = Math.max(0, ...sources.map((s) => s.times[s.times.length - 1] ?? 0));
    if (context.cursor.time.value > this.player.end) context.cursor.time.set(this.player.end, this);
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
    const camera = this.#restore();
    this.#choose();
    if (camera) this.view.camera = camera;
    this.view.mark(this.#pinned?.body ?? -1);
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
      const isContact = to === 'next' || to === 'previous';
      this.controls.say(
        isContact
          ? `No ${to} contact event of the engines that are shown is kept: a run keeps its first ones.`
          : 'There is no such event among the engines that are shown.',
      );
      return;
    }
    this.setTime(found.event.time);
    this.controls.say(`${found.source.label}: ${describe(found.event)}`);
    if (to !== 'normal') return;
    const { spec } = found.source;
    const key = findingKey(found.event.what ?? '', 'normal');
    this.focus({ spec, bodies: bodiesOf(found.event), contact: found.event.contact ?? null, finding: key });
  }

  focus({ spec, bodies, contact, finding = null }: Focus): void {
    const source = this.engines.find((s) => s.spec === spec && s.times.length > 0);
    if (source && !this.isShown(source)) this.toggleEngine(source);
    if (source && finding && this.#showFinding(source, finding)) return;
    this.view.setFinding(null);
    this.#lookAtBodies(bodies, source, contact);
  }

  choose(what: Choosable, forward: boolean): void {
    this.player.pause();
    this.view.settle(); // a slow picture may still show the frame before
    const source = this.shown.find((s) => s.spec === this.#pinned?.spec) ?? this.shown[0];
    const frame = source && this.view.frameOf(source)?.frame;
    const next = source && frame && chosenNext(what, forward, this.#pinned, source.spec, frame, this.#scene);
    this.controls.say(next ? '' : `There is no ${what} at this time.`);
    if (!next) return;
    this.view.setFinding(null);
    this.#pinned = next;
    this.view.mark(next.body);
    this.#inspect();
    this.#remember();
  }

  /** The camera goes along with the chosen body, or no longer. */
  toggleFollow(): void {
    this.following = !this.following && this.#pinned !== null;
    this.#followed = null;
    if (!this.following && this.#pinned === null)
      this.controls.say('Choose a body first, by a click or the key s: the camera goes along with it.');
    this.#goAlong();
    this.controls.refresh();
    this.#remember();
  }

  toggleMeasure(): void {
    this.measuring = !this.measuring;
    this.#measure.clear();
    this.controls.say(
      this.measuring
        ? 'Click two points for their distance, a third one for the angle at the second. By keys: s or k, then Enter.'
        : '',
    );
    this.controls.refresh();
    this.view.invalidate();
  }

  /** The next point to measure: that of the chosen contact, or the origin of the chosen body. */
  measureChosen(): void {
    this.view.settle();
    const pinned = this.#pinned;
    const source = this.shown.find((s) => s.spec === pinned?.spec);
    const frame = source && this.view.frameOf(source)?.frame;
    if (!pinned || !source || !frame) {
      this.controls.say('Choose a body (s) or a contact (k) first.');
      return;
    }
    const contact = contactOf(pinned, frame);
    const point =
      frame.contacts && contact >= 0
        ? middleOf(frame.contacts, contact)
        : ([0, 1, 2].map((k) => frame.position[3 * pinned.body + k] as number) as Vec3);
    this.#addMeasured(source, frame, pinned.body, point);
  }

  #addMeasured(source: FrameSource, frame: Frame, body: number, point: Vec3): void {
    this.#measure.add(source, frame, body, point);
    this.controls.say(this.#measure.said(frame));
    this.view.invalidate();
  }

  /** Saves what is seen: the picture, the run as a video at the speed that is chosen, or the states of the bodies. */
  async save(what: Saved): Promise<void> {
    const name = `${this.#context.name ?? 'replay'}-${this.shown.map((s) => s.label.replaceAll(' ', '-')).join('-')}`;
    const canvas = document.createElement('canvas');
    const picture = () => composed(this.view, this.#allNotes(), canvas);
    try {
      if (what === 'csv') saveText(`${name}.csv`, statesCsv(this.shown, this.#scene), 'text/csv');
      if (what === 'png') {
        this.view.drawFine();
        download(`${name}.png`, await pngOf(picture()));
      }
      if (what === 'webm') await this.#saveVideo(`${name}.webm`, picture);
    } catch (error) {
      this.controls.say(error instanceof Error ? error.message : String(error));
    }
  }

  async #saveVideo(name: string, picture: () => HTMLCanvasElement): Promise<void> {
    this.player.pause();
    const before = this.time;
    const show = (time: number) => {
      this.setTime(time);
      this.view.draw();
      return picture();
    };
    const progress = (done: number) => this.controls.say(`Recording: ${Math.round(100 * done)} %`);
    download(name, await recordVideo(this.player.end, this.player.speed, { show, progress }));
    this.controls.say('');
    this.setTime(before);
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
      this.#beside.call(this.player.playing);
      this.#notes.place(this.view, this.#allNotes());
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
        if (this.measuring) {
          if (pick) this.#addMeasured(pick.source, pick.frame, pick.body, pick.point);
          return;
        }
        this.view.setFinding(null);
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
      this.#pointed.show(stale ? { ...this.#hover, frame: now.frame, contact: -1 } : this.#hover);
    } else this.#pointed.show(null);
    const pinned = this.#pinned;
    const source = pinned && this.sources.find((s) => s.spec === pinned.spec);
    const now = source ? this.view.frameOf(source) : null;
    const contact = pinned && now ? contactOf(pinned, now.frame) : -1;
    const what =
      pinned && source && now ? { source, frame: now.frame, body: pinned.body, shape: -1, contact, island: -1 } : null;
    const found = pinned?.finding?.found;
    this.#inspector.show(what, found && found.step === now?.frame.step ? found : null);
  }

  /** Names of bodies, of the arrows of a finding, and measures. */
  #allNotes(): NotesOf[] {
    const all: NotesOf[] = [];
    const found = this.view.findingNotes;
    if (found) all.push(found);
    const measured = this.#measure.at((source) => this.view.frameOf(source)?.frame ?? null);
    if (measured) all.push(measured);
    if (!this.view.options.layers.names) return all;
    for (const source of this.shown) {
      const frame = this.view.frameOf(source)?.frame;
      if (frame) all.push({ source, notes: bodyNames(this.#scene, frame) });
    }
    return all;
  }

  /** Shows a finding of the audit alone and from near; false where there is none. */
  #showFinding(source: FrameSource, key: string): boolean {
    const found = this.#context.findingOf?.(source.spec, key);
    if (!found) return false;
    const [a, b] = found.bodies;
    const body = this.#scene.bodies[b]?.type === 'static' ? a : b;
    this.#pinned = { spec: source.spec, body, other: body === a ? b : a, finding: { key, found } };
    if (found.contact >= 0) this.#pinned.contact = { index: found.contact, step: found.step };
    this.#chosen = new Set([source.spec]);
    this.view.setFinding({ spec: source.spec, finding: found });
    this.#choose();
    this.view.mark(body);
    this.view.lookAtFinding();
    return true;
  }

  /** Moves the camera as far as the followed body has moved. */
  #goAlong(): void {
    const pinned = this.#pinned;
    const source = pinned && this.sources.find((s) => s.spec === pinned.spec);
    if (!this.following || !pinned || !source || source.times.length === 0) return;
    const { position } = source.frame(indexAt(source.times, this.time));
    const now = [0, 1, 2].map((k) => position[3 * pinned.body + k] as number) as Vec3;
    if (!now.every(Number.isFinite)) return;
    if (this.#followed) this.view.shiftCamera(sub(now, this.#followed));
    this.#followed = now;
  }

  #seek(time: number): void {
    this.#goAlong();
    this.view.setTime(time);
    this.#clock.call(this.player.playing);
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

  /** The state of the link, but for the camera, which is returned: it is set when there are pictures. */
  #restore(): CameraState | undefined {
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
    const spec = this.shown.find((s) => s.spec === state.of)?.spec ?? this.shown[0]?.spec;
    if (state.body === undefined || state.body >= this.#scene.bodies.length || spec === undefined) return state.camera;
    this.#pinned = { spec, body: state.body };
    this.following = state.follow ?? false;
    const { contact, step, finding: key } = state;
    if (contact !== undefined && step !== undefined) this.#pinned.contact = { index: contact, step };
    const found = key === undefined ? null : (this.#context.findingOf?.(spec, key) ?? null);
    if (!found || key === undefined) return state.camera;
    this.#pinned.finding = { key, found };
    this.view.setFinding({ spec, finding: found });
    return state.camera;
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
      ...(this.#pinned?.finding?.found.step === step ? { finding: this.#pinned?.finding?.key ?? '' } : {}),
      follow: this.following,
    });
  }

  dispose(): void {
    clearTimeout(this.#linkTimer);
    this.player.pause();
    this.#clock.end();
    this.#beside.end();
    for (const end of this.#ends) end();
    this.view.dispose();
  }
}
