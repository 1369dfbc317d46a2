// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Recorded runs beside each other on canvases, under one clock: play, pause, step, scrub. The recordings come as scripts,
// so that a page opened from disk finds them.
import { cssValue } from '../../common/elements.ts';
import { composed, type Solid, solidsOf } from '../../drawing/faces.ts';
import { brightness, type Projection, projection } from '../../drawing/picture.ts';
import { bodyReach } from '../../replay/framing.ts';
import { type Pose, readScene, type Scene, type SceneBody } from '../../replay/scene.ts';
import type { Quat, Vec3 } from '../../replay/vectors.ts';
import type { Recording } from '../recording.ts';

type Listener = (recording: Recording) => void;
const arrived = new Map<string, Recording>();
const waiting = new Map<string, Listener[]>();

/** Called by the scripts of the recordings. */
export function receive(id: string, recording: Recording): void {
  arrived.set(id, recording);
  for (const listener of waiting.get(id) ?? []) listener(recording);
  waiting.delete(id);
}

function load(id: string, folder: string): Promise<Recording> {
  const known = arrived.get(id);
  if (known) return Promise.resolve(known);
  return new Promise((resolve, reject) => {
    const listeners = waiting.get(id);
    if (listeners) {
      listeners.push(resolve);
      return;
    }
    waiting.set(id, [resolve]);
    const script = document.createElement('script');
    script.src = `${folder}/${id}.js`;
    script.onerror = () => reject(new Error(`no recording ${id}`));
    document.head.append(script);
  });
}

/** A recording with its scene: poses of all bodies at any of its frames. */
class Run {
  readonly scene: Scene;
  readonly times: number[];
  readonly #recording: Recording;
  readonly #bodies: SceneBody[];
  readonly #column: number[]; // place among the bodies that move, -1: still

  constructor(recording: Recording) {
    this.#recording = recording;
    this.scene = readScene(recording.scenario);
    this.times = recording.times;
    const named = new Map(this.scene.bodies.map((body) => [body.name, body]));
    let columns = 0;
    this.#column = recording.still.map((pose) => (pose === null ? columns++ : -1));
    this.#bodies = recording.bodies.map(
      (name) =>
        named.get(name) ?? {
          name,
          type: 'dynamic',
          first: { position: [0, 0, 0], orientation: [1, 0, 0, 0] },
          center: [0, 0, 0],
          shapes: [],
          collides: false,
        },
    );
  }

  get bodies(): readonly SceneBody[] {
    return this.#bodies;
  }

  moves(body: number): boolean {
    return (this.#column[body] as number) >= 0;
  }

  frameAt(time: number): number {
    const last = this.times.length - 1;
    let frame = 0;
    while (frame < last && (this.times[frame + 1] as number) <= time + 1e-6) ++frame;
    return frame;
  }

  /** Null where the run has no number for it. */
  pose(frame: number, body: number): Pose | null {
    const column = this.#column[body] as number;
    const numbers =
      column < 0
        ? (this.#recording.still[body] as (number | null)[])
        : (this.#recording.poses[frame] ?? []).slice(7 * column, 7 * column + 7);
    if (numbers.length < 7 || numbers.some((v) => v === null)) return null;
    return { position: numbers.slice(0, 3) as Vec3, orientation: numbers.slice(3, 7) as Quat };
  }

  contacts(frame: number): readonly number[] {
    return this.#recording.contacts?.[frame] ?? [];
  }
}

const median = (values: number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;

/** The rectangle that all pictures show: where bodies are during the last run, and near that during the others. */
function framing(runs: Run[], view: number[] | null): { middle: Vec3; width: number; height: number } {
  if (view?.length === 4) {
    const [x0, y0, x1, y1] = view as [number, number, number, number];
    return { middle: [(x0 + x1) / 2, (y0 + y1) / 2, 0], width: x1 - x0, height: y1 - y0 };
  }
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  const take = (run: Run, frame: number) => {
    run.bodies.forEach((body, b) => {
      const pose = run.pose(frame, b);
      if (!pose || (!run.moves(b) && body.type === 'static')) return;
      const reach = run.scene.bodies.indexOf(body) < 0 ? 0.1 : bodyReach(run.scene, run.scene.bodies.indexOf(body));
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k] as number, (pose.position[k] as number) - reach);
        high[k] = Math.max(high[k] as number, (pose.position[k] as number) + reach);
      }
    });
  };
  const sound = runs.at(-1) as Run;
  const frames = (run: Run, count: number) => {
    for (let i = 0; i < count; ++i) take(run, Math.floor((i / (count - 1)) * (run.times.length - 1)));
  };
  for (const run of runs) take(run, 0);
  frames(sound, 24);
  // The other runs may leave the picture, but not at once: they get as much room again on each side.
  const room = Math.max(...high.map((v, k) => v - (low[k] as number)), 0.2) * 0.5;
  const [least, most] = [low.map((v) => v - room), high.map((v) => v + room)];
  for (const run of runs) frames(run, 24);
  for (let k = 0; k < 3; ++k) {
    low[k] = Math.max(low[k] as number, least[k] as number);
    high[k] = Math.min(high[k] as number, most[k] as number);
  }
  for (const joint of sound.scene.joints)
    if (joint.a < 0)
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k] as number, joint.anchorA[k] as number);
        high[k] = Math.max(high[k] as number, joint.anchorA[k] as number);
      }
  if (!low.every(Number.isFinite)) return { middle: [0, 0, 0], width: 2, height: 2 };
  const middle = low.map((v, k) => (v + (high[k] as number)) / 2) as Vec3;
  const size = low.map((v, k) => Math.max(0.2, (high[k] as number) - v)) as Vec3;
  const deep = sound.scene.dimension === 3 ? 0.6 * size[2] : 0;
  const margin = 1.18;
  return { middle, width: margin * (size[0] + deep), height: margin * (size[1] + deep * 0.6) };
}

/** A static box that is larger than what is looked at, cut to that: floors have edges in the picture, then. */
function cut(body: SceneBody, middle: Vec3, reach: number): SceneBody {
  const upright = Math.abs(body.first.orientation[0]) > 1 - 1e-9;
  return {
    ...body,
    shapes: body.shapes.map((shape) => {
      const { geometry, pose } = shape;
      if (geometry.kind !== 'box' || !upright || Math.abs(pose.orientation[0]) < 1 - 1e-9) return shape;
      const [half, position] = [[...geometry.half] as Vec3, [...pose.position] as Vec3];
      for (const k of [0, 2] as const) {
        const at = body.first.position[k] + position[k];
        const low = Math.max(at - half[k], middle[k] - reach);
        const high = Math.min(at + half[k], middle[k] + reach);
        if (high <= low) return shape;
        half[k] = (high - low) / 2;
        position[k] = (high + low) / 2 - body.first.position[k];
      }
      return { ...shape, geometry: { ...geometry, half }, pose: { ...pose, position } };
    }),
  };
}

function tint(color: string, lit: number): string {
  return `color-mix(in srgb, ${color} ${lit}%, black)`;
}

class Panel {
  readonly #canvas: HTMLCanvasElement;
  readonly #run: Run;
  readonly #trail: number[];
  readonly #showContacts: boolean;
  readonly #side: boolean; // seen from the front, without depth
  readonly #frame: ReturnType<typeof framing>;

  constructor(canvas: HTMLCanvasElement, run: Run, frame: ReturnType<typeof framing>, figure: DOMStringMap) {
    this.#canvas = canvas;
    this.#run = run;
    this.#frame = frame;
    const trail = figure.trail ? (JSON.parse(figure.trail) as string[]) : [];
    this.#trail = trail.map((name) => run.bodies.findIndex((b) => b.name === name)).filter((b) => b >= 0);
    this.#showContacts = figure.contacts === 'yes';
    this.#side = figure.side === 'yes';
  }

  draw(time: number): void {
    const canvas = this.#canvas;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0 || height === 0) return;
    const dense = Math.min(2, window.devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * dense) || canvas.height !== Math.round(height * dense)) {
      canvas.width = Math.round(width * dense);
      canvas.height = Math.round(height * dense);
    }
    const g = canvas.getContext('2d');
    if (!g) return;
    g.setTransform(dense, 0, 0, dense, 0, 0);
    g.clearRect(0, 0, width, height);
    const run = this.#run;
    const planar = run.scene.dimension === 2 || this.#side;
    const { middle } = this.#frame;
    const scale = Math.min(width / this.#frame.width, height / this.#frame.height);
    const radius = (0.5 * Math.min(width, height * 1.2)) / scale;
    const p = projection(planar, middle, radius, width, height);
    const frame = run.frameAt(time);
    // A half-space in 3D is drawn as a piece with edges, so that it is seen to move.
    const reach = planar ? (2.2 * Math.max(width, height)) / scale : (0.5 * Math.min(width, 1.7 * height)) / scale;
    this.#drawBodies(g, frame, planar, p, reach);
    this.#drawTrails(g, frame, p);
    if (this.#showContacts) this.#drawContacts(g, frame, p);
  }

  #drawBodies(g: CanvasRenderingContext2D, frame: number, planar: boolean, p: Projection, reach: number): void {
    const [fill, ground, edge] = [cssValue('--body'), cssValue('--ground'), cssValue('--edge')];
    const faces: { depth: number; back: boolean; paint: () => void }[] = [];
    this.#run.bodies.forEach((body, b) => {
      const pose = this.#run.pose(frame, b);
      if (!pose) return;
      const still = body.type === 'static';
      const colour = still ? ground : fill;
      const moved = { ...body, first: pose };
      const placed = still && !planar ? cut(moved, this.#frame.middle, reach) : moved;
      for (const solid of solidsOf(placed, planar, this.#frame.middle, reach))
        faces.push(...this.#facesOf(g, solid, placed, still, colour, edge, planar, p));
    });
    faces.sort((a, b) => Number(b.back) - Number(a.back) || a.depth - b.depth);
    for (const face of faces) face.paint();
  }

  #facesOf(
    g: CanvasRenderingContext2D,
    solid: Solid,
    body: SceneBody,
    back: boolean,
    colour: string,
    edge: string,
    planar: boolean,
    p: Projection,
  ): { depth: number; back: boolean; paint: () => void }[] {
    if ('ball' in solid) {
      const { center, radius } = solid.ball;
      const [x, y] = p.at(center);
      const r = radius * p.scale;
      const mark = p.at(composed(body.first, { position: [radius, 0, 0], orientation: [1, 0, 0, 0] }).position);
      const paint = () => {
        g.beginPath();
        g.arc(x, y, r, 0, 2 * Math.PI);
        if (planar) g.fillStyle = colour;
        else {
          const shade = g.createRadialGradient(x - 0.35 * r, y - 0.4 * r, 0.1 * r, x, y, r);
          shade.addColorStop(0, tint(colour, 100));
          shade.addColorStop(1, tint(colour, 62));
          g.fillStyle = shade;
        }
        g.fill();
        g.strokeStyle = edge;
        g.lineWidth = 1;
        g.stroke();
        if (planar) {
          g.beginPath();
          g.moveTo(x, y);
          g.lineTo(...mark);
          g.stroke();
        }
      };
      return [{ depth: p.depth(center) + 0.3 * radius, back, paint }];
    }
    return solid.faces.map(({ corners, closed }) => {
      const path = corners.map((c) => p.at(c));
      const depth = corners.reduce((sum, c) => sum + p.depth(c), 0) / corners.length;
      const paint = () => {
        g.beginPath();
        path.forEach(([x, y], i) => {
          if (i === 0) g.moveTo(x, y);
          else g.lineTo(x, y);
        });
        g.lineJoin = 'round';
        if (closed) {
          g.closePath();
          g.fillStyle = planar ? colour : tint(colour, brightness(corners, p.towards));
          g.fill();
        }
        g.strokeStyle = closed ? edge : cssValue('--muted');
        g.lineWidth = closed ? 1 : 2;
        g.stroke();
      };
      return { depth, back, paint };
    });
  }

  #drawTrails(g: CanvasRenderingContext2D, frame: number, p: Projection): void {
    g.strokeStyle = cssValue('--velocity');
    g.lineWidth = 1.5;
    for (const body of this.#trail) {
      g.beginPath();
      for (let i = 0; i <= frame; ++i) {
        const pose = this.#run.pose(i, body);
        if (!pose) break;
        const [x, y] = p.at(pose.position);
        if (i === 0) g.moveTo(x, y);
        else g.lineTo(x, y);
      }
      g.stroke();
    }
  }

  #drawContacts(g: CanvasRenderingContext2D, frame: number, p: Projection): void {
    const all = this.#run.contacts(frame);
    const length = 26;
    g.strokeStyle = g.fillStyle = cssValue('--contact');
    g.lineWidth = 2;
    for (let i = 0; i + 5 < all.length; i += 6) {
      const point = all.slice(i, i + 3) as Vec3;
      const [x, y] = p.at(point);
      const tip = p.at(point.map((v, k) => v + ((all[i + 3 + k] as number) * length) / p.scale) as Vec3);
      g.beginPath();
      g.moveTo(x, y);
      g.lineTo(...tip);
      g.stroke();
      g.beginPath();
      g.arc(x, y, 3, 0, 2 * Math.PI);
      g.fill();
    }
  }
}

/** Binds the controls of a figure to its recordings. */
class Player {
  readonly #figure: HTMLElement;
  readonly #slider: HTMLInputElement;
  readonly #button: HTMLButtonElement;
  readonly #clock: HTMLOutputElement;
  #panels: Panel[] = [];
  #time = 0;
  #end = 0;
  #step = 1 / 60;
  #playing = false;
  #before = 0;

  constructor(figure: HTMLElement) {
    this.#figure = figure;
    this.#slider = figure.querySelector('input[type=range]') as HTMLInputElement;
    this.#button = figure.querySelector('button.play') as HTMLButtonElement;
    this.#clock = figure.querySelector('output') as HTMLOutputElement;
    this.#slider.addEventListener('input', () => {
      this.#pause();
      this.#show(Number(this.#slider.value));
    });
    this.#button.addEventListener('click', () => {
      if (this.#playing) this.#pause();
      else this.#play();
    });
    for (const [name, by] of [
      ['back', -1],
      ['next', 1],
    ] as const)
      figure.querySelector(`button.${name}`)?.addEventListener('click', () => {
        this.#pause();
        this.#show(this.#time + by * this.#step);
      });
  }

  async load(): Promise<void> {
    const canvases = [...this.#figure.querySelectorAll('canvas')];
    const { folder = '', view, seconds } = this.#figure.dataset;
    try {
      const recordings = await Promise.all(canvases.map((c) => load(c.dataset.run as string, folder)));
      const runs = recordings.map((r) => new Run(r));
      const frame = framing(runs, view ? (JSON.parse(view) as number[]) : null);
      this.#panels = runs.map((r, i) => new Panel(canvases[i] as HTMLCanvasElement, r, frame, this.#figure.dataset));
      const longest = Math.max(...runs.map((r) => r.times.at(-1) ?? 0));
      this.#end = seconds ? Math.min(longest, Number(seconds)) : longest;
      this.#step = Math.max(
        1e-3,
        median((runs.at(-1) as Run).times.slice(1).map((t, i) => t - ((runs.at(-1) as Run).times[i] as number))),
      );
      this.#slider.max = String(this.#end);
      this.#slider.step = 'any';
      this.#figure.classList.add('ready');
      this.#show(0);
      new ResizeObserver(() => this.redraw()).observe(this.#figure);
    } catch (error) {
      this.#clock.value = error instanceof Error ? error.message : String(error);
    }
  }

  redraw(): void {
    for (const panel of this.#panels) panel.draw(this.#time);
  }

  #show(time: number): void {
    this.#time = Math.max(0, Math.min(this.#end, time));
    this.#slider.value = String(this.#time);
    this.#clock.value = `${this.#time.toFixed(2)} s`;
    this.redraw();
  }

  #play(): void {
    if (this.#panels.length === 0) return;
    if (this.#time >= this.#end - 1e-6) this.#show(0);
    this.#playing = true;
    this.#button.classList.add('playing');
    this.#before = performance.now();
    requestAnimationFrame((now) => this.#tick(now));
  }

  #pause(): void {
    this.#playing = false;
    this.#button.classList.remove('playing');
  }

  #tick(now: number): void {
    if (!this.#playing) return;
    this.#show(this.#time + Math.min(0.1, (now - this.#before) / 1000));
    this.#before = now;
    if (this.#time >= this.#end) this.#pause();
    else requestAnimationFrame((next) => this.#tick(next));
  }
}

const whenIdle: (then: () => void) => void = (then) =>
  'requestIdleCallback' in window ? requestIdleCallback(then) : setTimeout(then, 500);

/** Figures are drawn when they come near, and the others while the browser has nothing else to do: a page may be printed. */
export function mountPlayers(): void {
  const players = new Map<Element, Player>();
  for (const figure of document.querySelectorAll<HTMLElement>('figure.scene')) players.set(figure, new Player(figure));
  const drawn = new Set<Element>();
  const draw = async (figure: Element) => {
    near.unobserve(figure);
    if (drawn.has(figure)) return;
    drawn.add(figure);
    await players.get(figure)?.load();
  };
  const drawAll = async (figures: Iterable<Element>) => {
    for (const figure of figures) await draw(figure);
  };
  const near = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (entry.isIntersecting) void draw(entry.target);
      }
    },
    { rootMargin: '600px' },
  );
  for (const figure of players.keys()) near.observe(figure);
  whenIdle(() => void drawAll(players.keys()));
  const redraw = () => {
    for (const player of players.values()) player.redraw();
  };
  document.addEventListener('themechange', redraw);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
}
