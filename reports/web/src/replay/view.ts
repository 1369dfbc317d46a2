// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The picture: engines side by side in one canvas, or overlaid, seen by one camera. It shows FrameSources at a time,
// whoever makes them; it has no clock and no controls but those of the camera.
//
//   const view = new ReplayView(element, scene);     // throws NoWebGL
//   view.setSources([...]); view.setTime(0.5); view.setOptions({...});
// Sources may grow: setTime() looks at their times anew; refresh() after a frame that was shown has changed.
import {
  type Camera,
  Color,
  Matrix4,
  OrthographicCamera,
  PerspectiveCamera,
  Raycaster,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { lightTheme, type Theme } from './colours.ts';
import type { Frame, FrameSource } from './frames.ts';
import { arrowScales, type Framing, frameScene } from './framing.ts';
import { defaultOptions, type ViewOptions } from './layers.ts';
import type { ArrowScales } from './overlays.ts';
import { nearestContact, type Rect, rectAt, tile, toDevice } from './picking.ts';
import type { Scene } from './scene.ts';
import { TemplateCache } from './shape_meshes.ts';
import { SourceLayer } from './source_layer.ts';
import type { Vec3 } from './vectors.ts';
import { veilingBodies } from './veil.ts';

/** The browser can not draw in three dimensions. */
export class NoWebGL extends Error {}

/** Renderers of views that are gone. A browser gives few contexts and takes long to let one go: they are used again. */
const idle: WebGLRenderer[] = [];

function takeRenderer(): WebGLRenderer {
  const known = idle.pop();
  if (known) return known;
  try {
    const made = new WebGLRenderer({ antialias: true, powerPreference: 'high-performance' });
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

/** What the pointer is on. */
export interface Pick {
  source: FrameSource;
  frame: Frame;
  body: number; // -1: none
  shape: number; // among the shapes of the body
  contact: number; // of the frame, -1: none
  point: Vec3; // [m] on the surface, or of the contact
  island: number;
}

/** A ray of the world: where the pointer aims. */
export interface Aim {
  origin: Vec3;
  direction: Vec3; // unit
}

export interface CameraState {
  position: Vec3;
  target: Vec3;
  zoom: number;
}

const halfAngle = 15; // of the camera [degrees]

/** Part of a picture's height that the scene may take: labels stand above it. */
const clearOf = (rect: Rect) => Math.min(0.88, Math.max(0.6, 1 - 100 / rect.height));

interface Picture {
  panel: Panel;
  layers: SourceLayer[];
}

export class ReplayView {
  readonly canvas: HTMLCanvasElement;
  readonly options: ViewOptions = defaultOptions();
  /** Seconds that the last drawing took: placing, colouring and overlays; and with three.js and the driver. */
  readonly spent = { own: 0, all: 0, calls: 0 };
  /** After every drawing. */
  onDraw: (() => void) | null = null;
  /** The camera was moved by hand. */
  onCamera: (() => void) | null = null;

  readonly #scene: Scene;
  readonly #renderer: WebGLRenderer;
  readonly #templates: TemplateCache;
  readonly #flat: boolean;
  readonly #camera: PerspectiveCamera | OrthographicCamera;
  readonly #controls: OrbitControls;
  readonly #raycaster = new Raycaster();
  readonly #clear = new Color();
  readonly #resize: ResizeObserver;
  #sources: FrameSource[] = [];
  #pictures: Picture[] = [];
  #theme: Theme = lightTheme;
  #framing: Framing = { centre: [0, 0, 0], radius: 1, low: [-1, -1, -1], high: [1, 1, 1] };
  #scales: ArrowScales = { size: 1, body: 1, speed: 1, spin: 1, impulse: 1 };
  #framed = false;
  #byHand = false; // the camera stands where somebody put it
  #wide = 1.25; // width of the scene over its height, as the camera sees it
  #time = 0;
  #marked = -1;
  #glass: ReadonlySet<number> = new Set();
  #stale = true; // colours and overlays
  #asked = 0;
  #width = 1;
  #height = 1;

  constructor(element: HTMLElement, scene: Scene) {
    this.#scene = scene;
    this.#flat = scene.dimension === 2;
    this.#templates = new TemplateCache(scene.bodies.length);
    this.#renderer = takeRenderer();
    this.canvas = this.#renderer.domElement;
    this.canvas.tabIndex = 0;
    element.append(this.canvas);
    this.#camera = this.#flat ? new OrthographicCamera() : new PerspectiveCamera(2 * halfAngle, 1, 0.01, 1000);
    this.#controls = new OrbitControls(this.#camera, this.canvas);
    this.#controls.enableRotate = !this.#flat;
    this.#controls.screenSpacePanning = true;
    this.#controls.zoomSpeed = 1.4;
    if (this.#flat) this.#controls.mouseButtons = { LEFT: 2, MIDDLE: 1, RIGHT: 2 };
    this.#controls.addEventListener('change', () => this.invalidate());
    this.#controls.addEventListener('start', () => {
      this.#byHand = true;
    });
    this.#controls.addEventListener('end', () => {
      this.#veil();
      this.onCamera?.();
    });
    this.#resize = new ResizeObserver(() => this.#measure(element));
    this.#resize.observe(element);
    this.#measure(element);
  }

  /** Engines in their order; a ghost among them is the reference and is drawn into every picture. */
  setSources(sources: readonly FrameSource[]): void {
    this.#sources = [...sources];
    this.#rebuild();
    if (!this.#framed && sources.some((s) => s.times.length > 0)) this.frameAll();
  }

  setTime(seconds: number): void {
    this.#time = seconds;
    this.invalidate();
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

  /** A frame that is shown has changed. */
  refresh(): void {
    for (const { layers } of this.#pictures) for (const layer of layers) layer.forget();
    this.invalidate();
  }

  get panels(): Panel[] {
    return this.#pictures.map((picture) => picture.panel);
  }

  /** Frame that a source shows; null while it has none. */
  frameOf(source: FrameSource): { frame: Frame; index: number } | null {
    for (const { layers } of this.#pictures)
      for (const layer of layers)
        if (layer.source === source && layer.frame) return { frame: layer.frame, index: layer.index };
    return null;
  }

  // ---- camera ----

  /** Everything that moves, at any time. */
  frameAll(): void {
    const shown = this.#sources.filter((s) => s.times.length > 0);
    const exact = shown.filter((s) => s.ghost);
    this.#framing = frameScene(this.#scene, [...exact, ...shown.filter((s) => !s.ghost)]);
    this.#scales = arrowScales(this.#scene, shown, this.#framing.radius);
    this.#framed = shown.length > 0;
    this.#byHand = false;
    this.#layout();
    this.#veil();
    for (const { layers } of this.#pictures) for (const layer of layers) this.#dress(layer);
    this.#stale = true;
    this.invalidate();
  }

  /** Brings a point to the middle, as near as a sphere of this radius [m] needs. */
  lookAt(point: Vec3, radius: number): void {
    this.#byHand = true;
    const away = this.#camera.position.clone().sub(this.#controls.target);
    this.#controls.target.set(...point);
    if (this.#flat) this.#camera.zoom = Math.min(40, (0.8 * this.#framing.radius) / radius);
    else away.setLength(radius / Math.sin((halfAngle * Math.PI) / 180));
    this.#camera.position.copy(this.#controls.target).add(away);
    this.#controls.update();
    this.invalidate();
  }

  get camera(): CameraState {
    return {
      position: this.#camera.position.toArray() as Vec3,
      target: this.#controls.target.toArray() as Vec3,
      zoom: this.#camera.zoom,
    };
  }
  set camera({ position, target, zoom }: CameraState) {
    this.#byHand = true;
    this.#camera.position.set(...position);
    this.#camera.zoom = zoom;
    this.#controls.target.set(...target);
    this.#controls.update();
    this.invalidate();
  }

  // ---- pointer ----

  /** What is under a point of the page, by clientX and clientY. */
  pick(clientX: number, clientY: number): Pick | null {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const picture = this.#pictures[this.#panelAt(x, y)];
    if (!picture) return null;
    const { rect } = picture.panel;
    this.#shape(rect);
    const viewProjection = new Matrix4().multiplyMatrices(
      this.#camera.projectionMatrix,
      this.#camera.matrixWorldInverse,
    );
    this.#raycaster.setFromCamera(new Vector2(...toDevice(rect, x, y)), this.#camera as Camera);
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

  /** The ray under a point of the page; null outside of all pictures. For dragging. */
  aim(clientX: number, clientY: number): Aim | null {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const picture = this.#pictures[this.#panelAt(x, y)];
    if (!picture) return null;
    this.#shape(picture.panel.rect);
    this.#raycaster.setFromCamera(new Vector2(...toDevice(picture.panel.rect, x, y)), this.#camera as Camera);
    const { origin, direction } = this.#raycaster.ray;
    return { origin: origin.toArray() as Vec3, direction: direction.toArray() as Vec3 };
  }

  /** Where a point of the world is seen in the picture of a source, from the canvas' upper left [px]; null: nowhere. */
  project(source: FrameSource, point: Vec3): [number, number] | null {
    const picture = this.#pictures.find(({ panel }) => panel.sources.includes(source));
    if (!picture) return null;
    const { rect } = picture.panel;
    this.#shape(rect);
    const at = new Vector3(...point).project(this.#camera);
    if (!(at.z < 1)) return null;
    return [rect.x + ((at.x + 1) / 2) * rect.width, rect.y + ((1 - at.y) / 2) * rect.height];
  }

  /** While something else uses the pointer. */
  set cameraEnabled(on: boolean) {
    this.#controls.enabled = on;
  }

  dispose(): void {
    cancelAnimationFrame(this.#asked);
    this.#resize.disconnect();
    this.#controls.dispose();
    this.#dropPictures();
    this.#templates.dispose();
    this.canvas.remove();
    this.canvas.style.cursor = '';
    idle.push(this.#renderer);
  }

  // ---- drawing ----

  /** Draws before the browser shows its next picture. */
  invalidate(): void {
    if (this.#asked === 0) this.#asked = requestAnimationFrame(() => this.draw());
  }

  /** Draws now. */
  draw(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
    const start = performance.now();
    this.#renderer.info.reset();
    let own = 0;
    this.#renderer.setScissorTest(false);
    this.#renderer.setClearColor(this.#clear.set(this.#theme.gap), 1);
    this.#renderer.clear();
    this.#renderer.setClearColor(this.#clear.set(this.#theme.background), 1);
    this.#renderer.setScissorTest(true);
    for (const { panel, layers } of this.#pictures) {
      this.#shape(panel.rect);
      const { x, y, width, height } = panel.rect;
      this.#renderer.setViewport(x, this.#height - y - height, width, height);
      this.#renderer.setScissor(x, this.#height - y - height, width, height);
      this.#renderer.clear();
      for (const layer of layers) {
        const before = performance.now();
        if (layer.seek(this.#time) || this.#stale) layer.paint(this.options, this.#theme, this.#scales, this.#marked);
        own += performance.now() - before;
        if (layer.frame) this.#renderer.render(layer.three, this.#camera);
      }
    }
    this.#stale = false;
    this.spent.own = own / 1e3;
    this.spent.all = (performance.now() - start) / 1e3;
    this.spent.calls = this.#renderer.info.render.calls;
    this.onDraw?.();
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
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.#renderer.setSize(this.#width, this.#height);
    this.#layout();
    this.draw();
  }

  #layout(): void {
    if (!this.#byHand) this.#turn();
    const rects = tile(this.#pictures.length, this.#width, this.#height, this.#wide);
    this.#pictures.forEach((picture, i) => {
      picture.panel.rect = rects[i] as Rect;
    });
    if (!this.#byHand && rects[0]) this.#approach(rects[0]);
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
    this.#layout();
    this.#stale = true;
    this.invalidate();
  }

  /** Walls before the scene become glass, others stone again. */
  #veil(): void {
    if (this.#flat) return;
    const glass = veilingBodies(this.#scene, this.#framing, this.#camera.position.toArray() as Vec3);
    if (glass.size === this.#glass.size && [...glass].every((b) => this.#glass.has(b))) return;
    this.#glass = glass;
    this.#rebuild();
  }

  #dropPictures(): void {
    for (const { layers } of this.#pictures) for (const layer of layers) layer.dispose();
    this.#pictures = [];
  }

  #dress(layer: SourceLayer): void {
    layer.build(this.#framing, this.#theme, this.#renderer.getPixelRatio());
  }

  /** First direction of the camera: from the front and a little above, or straight at the plane. */
  #turn(): void {
    const target = new Vector3(...this.#framing.centre);
    const direction = new Vector3(0, 0, 1);
    if (!this.#flat) {
      const up = new Vector3(...this.#scene.gravity).negate();
      if (up.lengthSq() < 1e-12) up.set(0, 1, 0);
      this.#camera.up.copy(up.normalize());
      direction.set(0.42, 0, 1).addScaledVector(up, 0.34).normalize();
      if (Math.abs(direction.dot(up)) > 0.9) direction.set(1, 0.3, 0.2).normalize();
    }
    this.#camera.zoom = 1;
    this.#controls.target.copy(target);
    this.#camera.position.copy(target).addScaledVector(direction, 10 * this.#framing.radius);
    this.#controls.update();
    let [wide, high] = [1e-9, 1e-9];
    for (const p of this.#corners()) [wide, high] = [Math.max(wide, Math.abs(p.x)), Math.max(high, Math.abs(p.y))];
    this.#wide = Math.min(4, Math.max(0.3, wide / high));
  }

  /** Corners of the framed box, from its centre, along the axes of the camera. */
  #corners(): Vector3[] {
    const { low, high, centre } = this.#framing;
    const back = this.#camera.quaternion.clone().invert();
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => {
      const at = [0, 1, 2].map(
        (k) => ((i >> k) & 1 ? (high[k] as number) : (low[k] as number)) - (centre[k] as number),
      );
      return new Vector3(...(at as Vec3)).applyQuaternion(back);
    });
  }

  /** As near as a picture of this form still shows the framed box below its label. */
  #approach(rect: Rect): void {
    if (this.#flat) return;
    const tangent = Math.tan((halfAngle * Math.PI) / 180);
    const [wide, high] = [(0.9 * tangent * rect.width) / rect.height, tangent * clearOf(rect)];
    let distance = 1e-6;
    for (const p of this.#corners())
      distance = Math.max(distance, p.z + Math.abs(p.x) / wide, p.z + Math.abs(p.y) / high);
    const away = this.#camera.position.clone().sub(this.#controls.target).setLength(distance);
    this.#camera.position.copy(this.#controls.target).add(away);
    this.#controls.update();
  }

  /** Fits the camera to the form of a picture. */
  #shape(rect: Rect): void {
    const aspect = rect.width / rect.height;
    const { radius, low, high } = this.#framing;
    if (this.#camera instanceof PerspectiveCamera) {
      this.#camera.aspect = aspect;
      const distance = this.#camera.position.distanceTo(this.#controls.target);
      this.#camera.near = Math.max(distance, radius) / 1000;
      this.#camera.far = distance + 40 * radius;
    } else {
      const [w, h] = [(high[0] - low[0]) / 2, (high[1] - low[1]) / 2];
      const half = Math.max(h / clearOf(rect), w / aspect / 0.9, 0.05 * radius);
      this.#camera.left = -half * aspect;
      this.#camera.right = half * aspect;
      this.#camera.top = half;
      this.#camera.bottom = -half;
      this.#camera.near = 0.001;
      this.#camera.far = 100 * radius;
    }
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }
}
