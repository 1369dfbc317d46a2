// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The picture: engines side by side in one canvas, or overlaid, seen by one camera. It shows FrameSources at a time,
// its caller; it has no clock and no controls but those of the camera.
//
//   const view = new ReplayView(element, scene);     // throws NoWebGL
//   view.setSources([...]); view.setTime(0.5); view.setOptions({...});
// Sources may grow: setTime() looks at their times anew; refresh() after a frame that was shown has changed.
import { Color, Matrix4, Raycaster, Vector2, Vector3, WebGLRenderer } from 'three';
import { type ContactFinding, nearestExact, placeOf } from '../common/finding.ts';
import { CameraRig, type CameraState } from './camera_rig.ts';
import { lightTheme, type Theme } from './colours.ts';
import { findingNotes, type Note } from './finding_overlay.ts';
import type { Frame, FrameSource } from './frames.ts';
import { arrowScales, bodyReach, frameScene } from './framing.ts';
import { defaultOptions, type ViewOptions } from './layers.ts';
import { legendOf } from './legend.ts';
import { occludingBodies } from './occluder_fade.ts';
import type { ArrowScales } from './overlays.ts';
import { Pace } from './pace.ts';
import { gapsOf, nearestContact, type Rect, rectAt, tile, toDevice } from './picking.ts';
import type { Scene } from './scene.ts';
import { TemplateCache } from './shape_meshes.ts';
import { drawsInSoftware } from './software.ts';
import { type Drawn, SourceLayer } from './source_layer.ts';
import { add, type Vec3 } from './vectors.ts';

export type { CameraState } from './camera_rig.ts';

/** The browser can not draw in three dimensions. */
export class NoWebGL extends Error {}

/** Renderers of views that are gone. A browser gives few contexts and takes long to let one go: they are used again. */
const idle: WebGLRenderer[] = [];

const stillAfter = 1200; // [ms] since the last drawing
const mostEdged = 120; // bodies of all pictures that have edges while they move, where the browser draws in software
const mostOfFinding = 5; // radius of a scene that is shown as a whole, in lengths of the finding's arrows
const pixelRatio = () => (drawsInSoftware() ? 1 : Math.min(2, devicePixelRatio));

function takeRenderer(): WebGLRenderer {
  const known = idle.pop();
  if (known) return known;
  try {
    const canvas = document.createElement('canvas');
    const context = canvas.getContext('webgl2', {
      alpha: false, // nothing of the page is seen through it
      antialias: !drawsInSoftware(),
      powerPreference: 'high-performance',
    });
    if (!context) throw new Error('no WebGL 2');
    const made = new WebGLRenderer({ canvas, context });
    made.autoClear = false;
    made.info.autoReset = false;
    return made;
  } catch (error) {
    throw new NoWebGL(String(error));
  }
}

/** One picture of the canvas. */
export interface Panel {
  sources: FrameSource[]; // the first one gives it its name
  rect: Rect;
}

/** Object under the pointer. */
export interface Pick {
  source: FrameSource;
  frame: Frame;
  body: number; // -1: none
  shape: number; // index among the shapes of the body
  contact: number; // index of the contact in the frame, -1: none
  point: Vec3; // [m] on the surface, or of the contact
  island: number;
}

/** A finding of the audit in the run of an engine. */
export interface ShownFinding {
  spec: string;
  finding: ContactFinding;
}

/** A ray of the world: where the pointer aims. */
export interface Aim {
  origin: Vec3;
  direction: Vec3; // unit
}

interface Picture {
  panel: Panel;
  layers: SourceLayer[];
}

export class ReplayView {
  readonly canvas: HTMLCanvasElement;
  readonly options: ViewOptions = defaultOptions();
  /** Seconds that the last drawing took: placing, colouring and overlays; and with three.js and the driver. */
  readonly spent = { own: 0, all: 0, calls: 0 };
  /** Called after every drawing. */
  onDraw: (() => void) | null = null;
  /** The camera was moved by hand. */
  onCamera: (() => void) | null = null;

  readonly #scene: Scene;
  readonly #renderer: WebGLRenderer;
  readonly #templates: TemplateCache;
  readonly #rig: CameraRig;
  readonly #raycaster = new Raycaster();
  readonly #clear = new Color();
  readonly #resize: ResizeObserver;
  #sources: FrameSource[] = [];
  #pictures: Picture[] = [];
  #theme: Theme = lightTheme;
  #scales: ArrowScales = { size: 1, body: 1, speed: 1, spin: 1, impulse: 1 };
  #framed = false;
  #time = 0;
  #marked = -1;
  #glass: ReadonlySet<number> = new Set();
  #finding: ShownFinding | null = null;
  readonly #pace = new Pace();
  #stale = true; // colours and overlays
  #requested = 0;
  #finer: ReturnType<typeof setTimeout> | undefined;
  #width = 1;
  #height = 1;

  constructor(element: HTMLElement, scene: Scene) {
    this.#scene = scene;
    this.#templates = new TemplateCache(scene.bodies.length, drawsInSoftware());
    this.#renderer = takeRenderer();
    this.canvas = this.#renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'application');
    this.canvas.setAttribute(
      'aria-label',
      'Picture of the scene. Comma and full stop turn it, arrow up and down tilt it, page up and down zoom; the question mark lists all keys.',
    );
    element.append(this.canvas);
    this.#rig = new CameraRig(scene, this.canvas);
    this.#rig.onChange = () => this.invalidate();
    this.#rig.onHand = () => {
      this.#fadeOccluders();
      this.onCamera?.();
    };
    this.#resize = new ResizeObserver(() => this.#measure(element));
    this.#resize.observe(element);
    this.#measure(element);
  }

  /** Engines in their order; a ghost among them is the reference and is drawn into every picture. */
  setSources(sources: readonly FrameSource[]): void {
    this.#sources = [...sources];
    this.#rebuild();
    if (!this.#framed && sources.some((s) => s.times.length > 0)) this.#frame();
  }

  setTime(seconds: number): void {
    this.#time = seconds;
    if (this.#pictures.some(({ layers }) => layers.some((layer) => !layer.isAt(seconds)))) this.invalidate();
  }

  setOptions(change: Partial<ViewOptions>): void {
    const before = { overlaid: this.options.overlaid, reference: this.options.layers.reference };
    Object.assign(this.options, change);
    if (before.overlaid !== this.options.overlaid || before.reference !== this.options.layers.reference)
      this.#rebuild();
    this.#stale = true;
    this.invalidate();
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const { layers } of this.#pictures) for (const layer of layers) this.#dress(layer);
    this.#stale = true;
    this.invalidate();
  }

  /** Lights a body up; -1: none. */
  mark(body: number): void {
    if (body === this.#marked) return;
    this.#marked = body;
    this.#stale = true;
    this.invalidate();
  }

  /** Draws a finding in its frame and makes all other bodies glass; null: none. */
  setFinding(found: ShownFinding | null): void {
    if (found?.finding === this.#finding?.finding) return;
    this.#finding = found;
    this.#fadeOccluders();
    this.#giveFinding();
    this.#stale = true;
    this.invalidate();
  }

  /**
   * Moves the camera to the finding: across its normals, so that the angle between them has its true size. With `whole` it
   * shows the whole scene, unless the finding would be small in it.
   */
  lookAtFinding(whole = false): void {
    const finding = this.#finding?.finding;
    const at = finding && placeOf(finding);
    if (!finding || !at) return;
    const away = new Vector3(...this.#rig.position).sub(new Vector3(...this.#rig.looking.center)).normalize();
    const exact = new Vector3(...(nearestExact(finding) ?? [0, 1, 0]));
    const across = new Vector3(...(finding.said?.normal ?? [0, 0, 0])).cross(exact);
    if (across.length() > 1e-3) {
      across.normalize();
      if (across.dot(away) < 0) across.negate();
    } else across.copy(away).addScaledVector(exact, -away.dot(exact)).normalize();
    const length = this.#findingLength(finding);
    const middle = new Vector3(...at).addScaledVector(exact, 0.4 * length).toArray() as Vec3;
    const { center, radius } = this.#rig.framing;
    const isWhole = whole && radius < mostOfFinding * length;
    this.#rig.lookFrom(isWhole ? center : middle, isWhole ? radius : 1.7 * length, across.toArray() as Vec3);
    this.#fadeOccluders();
    this.invalidate();
  }

  /** Texts at points of the finding; none while another frame is shown. */
  get findingNotes(): { source: FrameSource; notes: Note[] } | null {
    const found = this.#finding;
    const source = this.#sources.find((s) => s.spec === found?.spec && !s.ghost);
    if (!found || !source || this.frameOf(source)?.frame.step !== found.finding.step) return null;
    return { source, notes: findingNotes(found.finding, this.#findingLength(found.finding)) };
  }

  /** A frame that is shown has changed. */
  refresh(): void {
    for (const { layers } of this.#pictures) for (const layer of layers) layer.forget();
    this.invalidate();
  }

  get panels(): Panel[] {
    return this.#pictures.map((picture) => picture.panel);
  }

  /** Meaning of the colours that are on the picture. */
  get legend(): ReturnType<typeof legendOf> {
    const shown = this.#sources.filter((s) => !s.ghost);
    return legendOf(this.options, this.#theme, this.#scales, {
      finding: this.findingNotes ? (this.#finding?.finding ?? null) : null,
      contacts: shown.some((s) => s.events.some((e) => e.kind === 'contact_begin' || e.kind === 'audit')),
      joints: this.#scene.joints.length > 0,
      reference: this.#sources.some((s) => s.ghost),
    });
  }

  /** Frame that a source shows; null while it has none. */
  frameOf(source: FrameSource): { frame: Frame; index: number } | null {
    for (const { layers } of this.#pictures)
      for (const layer of layers)
        if (layer.source === source && layer.frame) return { frame: layer.frame, index: layer.index };
    return null;
  }

  /** Drawing of a source, null while there is none; for tests and the browser's tools. */
  drawn(spec: string): Drawn | null {
    for (const { layers } of this.#pictures)
      for (const layer of layers) if (layer.source.spec === spec && layer.frame) return layer.drawn;
    return null;
  }

  // ---- camera ----

  /** Everything that moves, at any time; nothing is glass for a finding any more. */
  frameAll(): void {
    this.setFinding(null);
    this.#rig.release();
    this.#frame();
  }

  /** Brings a point to the middle, as near as a sphere of this radius [m] needs. */
  lookAt(point: Vec3, radius: number): void {
    this.#rig.lookAt(point, radius);
    this.#fadeOccluders();
    this.invalidate();
  }

  get camera(): CameraState {
    return this.#rig.state;
  }
  set camera(state: CameraState) {
    this.#rig.state = state;
    this.invalidate();
  }

  /** Moves the camera and what it looks at by a vector [m]. */
  shiftCamera(by: Vec3): void {
    const { position, target, zoom } = this.#rig.state;
    this.camera = { position: add(position, by), target: add(target, by), zoom };
  }

  // ---- pointer ----

  /** Object under a point of the page, by clientX and clientY. */
  pick(clientX: number, clientY: number): Pick | null {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const picture = this.#pictures[this.#panelAt(x, y)];
    if (!picture) return null;
    const { rect } = picture.panel;
    const { camera } = this.#rig;
    this.#rig.shape(rect);
    const viewProjection = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.#raycaster.setFromCamera(new Vector2(...toDevice(rect, x, y)), camera);
    for (const layer of [...picture.layers].sort((a, b) => Number(a.source.ghost) - Number(b.source.ghost))) {
      const frame = layer.frame;
      if (!frame) continue;
      const { contacts: withPoints, normals } = this.options.layers;
      const contact =
        frame.contacts && !layer.source.ghost && (withPoints || normals)
          ? nearestContact(frame.contacts, rect, viewProjection.elements, x, y, 9)
          : -1;
      const hit = this.#raycaster.intersectObjects(layer.bodies.targets, false)[0];
      const shape = hit ? layer.bodies.shapeOf(hit.object, hit.instanceId ?? -1) : null;
      if (contact < 0 && !shape) continue;
      const at = frame.contacts?.pointA;
      return {
        source: layer.source,
        frame,
        body: shape?.body ?? -1,
        shape: shape?.index ?? -1,
        contact,
        point:
          contact >= 0 && at
            ? ([0, 1, 2].map((k) => at[3 * contact + k] as number) as Vec3)
            : ((hit?.point.toArray() ?? [0, 0, 0]) as Vec3),
        island: shape ? layer.islandOf(shape.body) : -1,
      };
    }
    return null;
  }

  /** The ray under a point of the page; null outside of all pictures. Used for dragging. */
  aim(clientX: number, clientY: number): Aim | null {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const picture = this.#pictures[this.#panelAt(x, y)];
    if (!picture) return null;
    this.#rig.shape(picture.panel.rect);
    this.#raycaster.setFromCamera(new Vector2(...toDevice(picture.panel.rect, x, y)), this.#rig.camera);
    const { origin, direction } = this.#raycaster.ray;
    return { origin: origin.toArray() as Vec3, direction: direction.toArray() as Vec3 };
  }

  /**
   * Position of a point of the world in the picture of a source, from the canvas' upper left [px]; null: not visible.
   */
  project(source: FrameSource, point: Vec3): [number, number] | null {
    const picture = this.#pictures.find(({ panel }) => panel.sources.includes(source));
    if (!picture) return null;
    const { rect } = picture.panel;
    this.#rig.shape(rect);
    const at = new Vector3(...point).project(this.#rig.camera);
    if (!(at.z < 1)) return null;
    return [rect.x + ((at.x + 1) / 2) * rect.width, rect.y + ((1 - at.y) / 2) * rect.height];
  }

  /** Switched off while something else uses the pointer. */
  set cameraEnabled(on: boolean) {
    this.#rig.enabled = on;
  }

  dispose(): void {
    cancelAnimationFrame(this.#requested);
    clearTimeout(this.#finer);
    this.#resize.disconnect();
    this.#rig.dispose();
    this.#dropPictures();
    this.#templates.dispose();
    this.canvas.remove();
    this.canvas.style.cursor = '';
    idle.push(this.#renderer);
  }

  // ---- drawing ----

  /** Draws before the browser shows its next picture. */
  invalidate(): void {
    if (this.#requested === 0) this.#requested = requestAnimationFrame(() => this.draw());
  }

  /** Draws now what is requested, so that frameOf() is of the time that was set last. */
  settle(): void {
    if (this.#requested !== 0) this.draw();
  }

  /** Draws now. */
  draw(): void {
    this.#useRatio(drawsInSoftware() ? this.#pace.ratioAt(performance.now()) : pixelRatio());
    this.#drawNow(false);
    clearTimeout(this.#finer);
    if (drawsInSoftware()) this.#finer = setTimeout(() => this.drawFine(), stillAfter);
  }

  /** Draws once with smooth edges, which takes long in software. */
  drawFine(): void {
    this.#useRatio(2);
    this.#drawNow(true);
  }

  #useRatio(ratio: number): void {
    if (this.#renderer.getPixelRatio() === ratio) return;
    this.#renderer.setPixelRatio(ratio);
    for (const { layers } of this.#pictures) for (const layer of layers) layer.pixelRatio = ratio;
  }

  /** `fine`: as well as it can be; else as a picture that moves is drawn in software. */
  #drawNow(fine: boolean): void {
    cancelAnimationFrame(this.#requested);
    this.#requested = 0;
    const start = performance.now();
    this.#renderer.info.reset();
    let own = 0;
    this.#clearAll();
    const moves = !fine && drawsInSoftware();
    const alone = this.findingNotes !== null; // nothing else stands at the place of a finding
    for (const { panel, layers } of this.#pictures) {
      this.#rig.shape(panel.rect);
      const { x, y, width, height } = panel.rect;
      this.#renderer.setViewport(x, this.#height - y - height, width, height);
      this.#renderer.setScissor(x, this.#height - y - height, width, height);
      for (const layer of layers) {
        if (layer.source.ghost && alone) continue;
        layer.groundInLines = moves;
        layer.edged = !moves || this.#scene.bodies.length * this.#pictures.length <= mostEdged;
        const before = performance.now();
        if (layer.seek(this.#time) || this.#stale) layer.paint(this.options, this.#theme, this.#scales, this.#marked);
        own += performance.now() - before;
        if (layer.frame) this.#renderer.render(layer.three, this.#rig.camera);
      }
    }
    this.#stale = false;
    this.spent.own = own / 1e3;
    this.spent.all = (performance.now() - start) / 1e3;
    this.spent.calls = this.#renderer.info.render.calls;
    this.onDraw?.();
  }

  /** The background at once, then the colour of what lies between and beside the pictures. */
  #clearAll(): void {
    this.#renderer.setScissorTest(false);
    this.#renderer.setClearColor(this.#clear.set(this.#theme.background), 1);
    this.#renderer.clear();
    this.#renderer.setScissorTest(true);
    this.#renderer.setClearColor(this.#clear.set(this.#theme.gap), 1);
    const rects = this.#pictures.map(({ panel }) => panel.rect);
    for (const { x, y, width, height } of gapsOf(rects, this.#width)) {
      this.#renderer.setScissor(x, this.#height - y - height, width, height);
      this.#renderer.clearColor();
    }
  }

  #panelAt(x: number, y: number): number {
    return rectAt(
      this.#pictures.map((p) => p.panel.rect),
      x,
      y,
    );
  }

  #measure(element: HTMLElement): void {
    this.#width = Math.max(1, element.clientWidth);
    this.#height = Math.max(1, element.clientHeight);
    this.#renderer.setPixelRatio(pixelRatio());
    this.#renderer.setSize(this.#width, this.#height);
    this.#layout();
    this.draw();
  }

  #layout(): void {
    this.#rig.turn();
    const rects = tile(this.#pictures.length, this.#width, this.#height, this.#rig.wide);
    this.#pictures.forEach((picture, i) => {
      picture.panel.rect = rects[i] as Rect;
    });
    if (rects[0]) this.#rig.fit(rects[0]);
  }

  /** Measures what moves; the camera follows unless the user has moved it. */
  #frame(): void {
    const shown = this.#sources.filter((s) => s.times.length > 0);
    const exact = shown.filter((s) => s.ghost);
    this.#rig.framing = frameScene(this.#scene, [...exact, ...shown.filter((s) => !s.ghost)]);
    this.#scales = arrowScales(this.#scene, shown, this.#rig.framing.radius);
    this.#framed = shown.length > 0;
    this.#layout();
    this.#fadeOccluders();
    for (const { layers } of this.#pictures) for (const layer of layers) this.#dress(layer);
    this.#stale = true;
    this.invalidate();
  }

  #rebuild(): void {
    this.#dropPictures();
    const ghosts = this.#sources.filter((s) => s.ghost && this.options.layers.reference);
    const engines = this.#sources.filter((s) => !s.ghost);
    const groups =
      this.options.overlaid || engines.length === 0 ? [[...ghosts, ...engines]] : engines.map((s) => [s, ...ghosts]);
    this.#pictures = groups
      .filter((group) => group.length > 0)
      .map((group) => ({
        panel: { sources: group, rect: { x: 0, y: 0, width: 1, height: 1 } },
        layers: group.map((source, i) => new SourceLayer(this.#scene, source, this.#templates, i === 0, this.#glass)),
      }));
    for (const { layers } of this.#pictures) for (const layer of layers) this.#dress(layer);
    this.#giveFinding();
    this.#layout();
    this.#stale = true;
    this.invalidate();
  }

  /** Length of the arrows of a finding: as long as the smaller of its bodies reaches [m]. */
  #findingLength({ bodies }: ContactFinding): number {
    const reaches = bodies.map((b) => bodyReach(this.#scene, b)).filter((r) => r > 0 && Number.isFinite(r));
    return Math.min(this.#rig.framing.radius, ...reaches);
  }

  #giveFinding(): void {
    const found = this.#finding;
    for (const { layers } of this.#pictures)
      for (const layer of layers)
        layer.finding =
          found && layer.source.spec === found.spec && !layer.source.ghost
            ? { finding: found.finding, length: this.#findingLength(found.finding) }
            : null;
  }

  /** Walls before the scene, and what has no part in a finding, become glass, others stone again. */
  #fadeOccluders(): void {
    if (this.#scene.dimension === 2) return;
    const glass = occludingBodies(this.#scene, this.#rig.looking, this.#rig.position);
    const pair = this.#finding?.finding.bodies;
    if (pair)
      for (let b = 0; b < this.#scene.bodies.length; ++b) {
        if (!pair.includes(b)) glass.add(b);
      }
    if (glass.size === this.#glass.size && [...glass].every((b) => this.#glass.has(b))) return;
    this.#glass = glass;
    this.#rebuild();
  }

  #dropPictures(): void {
    for (const { layers } of this.#pictures) for (const layer of layers) layer.dispose();
    this.#pictures = [];
  }

  #dress(layer: SourceLayer): void {
    layer.build(this.#rig.framing, this.#theme, this.#renderer.getPixelRatio());
  }
}
