// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Overlays of the bodies of one source: contacts, arrows, joints, boxes, trails. Rebuilt when the frame or a switch
// changes, in buffers that are kept. Where a frame brings the lines of an engine's debug drawing, they are drawn.
import { Color, Group } from 'three';
import type { BodyLayer } from './body_layer.ts';
import type { Bounds } from './bounds.ts';
import type { Theme } from './colours.ts';
import { type Contacts, type DrawnLines, type Frame, type FrameSource, indexAt, middleOf } from './frames.ts';
import { layerOfKind, type ViewOptions } from './layers.ts';
import { type Arrow, Dots, FatLines, ThinLines } from './line_batch.ts';
import type { Scene, SceneJoint } from './scene.ts';
import { type Quat, rotate, type Vec3 } from './vectors.ts';

/** Lengths that belong to the scene, not to a frame: arrows of two frames can be compared. */
export interface ArrowScales {
  size: number; // size of the picture [m]
  body: number; // reach of a typical body [m]
  speed: number; // speed of an arrow of full length [m/s]
  spin: number; // [rad/s]
  impulse: number; // [N s]
}

interface LineStyle {
  colour: string; // "": that of the body
  batch: ThinLines;
  scale: number;
  head: number; // length of an arrow's head [m]; 0: a line
}
type SixNumbers = [number, number, number, number, number, number];

const normalLength = (options: ViewOptions, scales: ArrowScales) =>
  Math.min(0.11 * scales.size, 0.9 * scales.body) * options.arrows;

const mostTrails = 80; // bodies; more would be a tangle
const trailFrames = 240;
const edgesOfBox = [0, 1, 1, 3, 3, 2, 2, 0, 4, 5, 5, 7, 7, 6, 6, 4, 0, 4, 1, 5, 2, 6, 3, 7];

export class Overlays {
  readonly group = new Group();
  readonly #scene: Scene;
  readonly #thin = new ThinLines(5, true);
  readonly #boxes = new ThinLines(4, false);
  readonly #fat = new FatLines(6, 2.2);
  readonly #dots = new Dots(7, 8);
  readonly #c = new Color();
  readonly #to = new Color();
  readonly #box: Bounds = [0, 0, 0, 0, 0, 0];

  constructor(scene: Scene) {
    this.#scene = scene;
    this.group.add(this.#boxes.object, this.#thin.object, this.#fat.object, this.#fat.heads, this.#dots.object);
  }

  get arrows(): Arrow[] {
    return this.#fat.arrows;
  }
  /** Ends of the thin lines that are drawn, 6 numbers each [m]. */
  get lines(): number[] {
    return [...this.#thin.ends, ...this.#boxes.ends];
  }
  /** Dots that are drawn, 3 numbers each [m]. */
  get dots(): number[] {
    return this.#dots.points;
  }

  set pixels(value: number) {
    this.#dots.pixels = value;
  }

  draw(
    source: FrameSource,
    frame: Frame,
    bodies: BodyLayer,
    options: ViewOptions,
    theme: Theme,
    scales: ArrowScales,
    colours: Float32Array,
  ): void {
    for (const batch of [this.#thin, this.#boxes, this.#fat, this.#dots]) batch.begin();
    const { layers } = options;
    if (!source.ghost) {
      // colours show the source of a contact if all sources are in one picture
      const own = options.overlaid ? { ...theme, contact: source.colour, normal: source.colour } : theme;
      if (frame.lines) this.#drawLines(frame.lines, options, own, scales, colours);
      else {
        if (layers.bounds) this.#drawBounds(bodies, theme);
        if (layers.joints) this.#drawJoints(frame, theme);
        if (frame.contacts) this.#drawContacts(frame.contacts, options, own, scales);
        if (layers.velocities) this.#drawVectors(frame, frame.velocity, theme.velocity, scales.speed, scales, options);
      }
      if (layers.joints) this.#drawAxes(frame, theme, scales);
      if (layers.penetration && frame.contacts) this.#drawPenetration(frame.contacts, options, theme);
      if (layers.spins) this.#drawVectors(frame, frame.angularVelocity, theme.spin, scales.spin, scales, options);
    }
    if (layers.trails) this.#drawTrails(source, frame, theme, colours);
    for (const batch of [this.#thin, this.#boxes, this.#fat, this.#dots]) batch.end();
  }

  /** Lines of the debug drawing: arrows to the scales of the picture, those of islands in the colours of bodies. */
  #drawLines(lines: DrawnLines, options: ViewOptions, theme: Theme, scales: ArrowScales, colours: Float32Array): void {
    const styles = lines.kinds.map((kind) => this.#styleOf(kind, options, theme, scales));
    const at = (list: ArrayLike<number>, i: number) => list[i] as number;
    for (let i = 0; 2 * i < lines.lineNames.length; ++i) {
      const style = styles[at(lines.lineNames, 2 * i)];
      if (!style) continue;
      const [ax, ay, az, bx, by, bz] = [0, 1, 2, 3, 4, 5].map((k) => at(lines.ends, 6 * i + k)) as SixNumbers;
      const body = at(lines.lineNames, 2 * i + 1);
      if (style.colour !== '') this.#c.set(style.colour);
      else this.#c.setRGB(at(colours, 3 * body), at(colours, 3 * body + 1), at(colours, 3 * body + 2));
      const { scale, head } = style;
      if (head > 0) this.#fat.arrow(ax, ay, az, (bx - ax) * scale, (by - ay) * scale, (bz - az) * scale, head, this.#c);
      else style.batch.line(ax, ay, az, bx, by, bz, this.#c);
    }
    for (let i = 0; 2 * i < lines.pointNames.length; ++i) {
      const style = styles[at(lines.pointNames, 2 * i)];
      const [x, y, z] = [0, 1, 2].map((k) => at(lines.points, 3 * i + k)) as Vec3;
      if (style) this.#dots.dot(x, y, z, this.#c.set(style.colour));
    }
  }

  /** Style of the lines of a kind; null: its layer is off. `scale` [m for 1 m, 1 m/s, 1 N s]. */
  #styleOf(kind: string, options: ViewOptions, theme: Theme, scales: ArrowScales): LineStyle | null {
    const layer = layerOfKind[kind];
    if (!layer || !options.layers[layer]) return null;
    const plain = (colour: string, batch = this.#thin) => ({ colour, batch, scale: 1, head: 0 });
    const arrow = (colour: string, scale: number, head: number) =>
      Number.isFinite(scale) ? { ...plain(colour), scale, head } : null;
    const long = 0.03 * scales.size;
    const styles: Record<string, LineStyle | null> = {
      contact: plain(theme.contact),
      normal: arrow(theme.normal, normalLength(options, scales), 0.3 * normalLength(options, scales)),
      impulse: arrow(theme.impulse, (0.35 * scales.size * options.arrows) / scales.impulse, long),
      velocity: arrow(theme.velocity, (0.3 * scales.size * options.arrows) / scales.speed, long),
      joint: plain(theme.joint),
      box: plain(theme.bounds, this.#boxes),
      island: plain(''),
    };
    return styles[kind] ?? null;
  }

  #drawBounds(bodies: BodyLayer, theme: Theme): void {
    const b = this.#box;
    this.#c.set(theme.bounds);
    const corner = (i: number, k: number) => b[k + ((i >> k) & 1 ? 3 : 0)] as number;
    for (let s = 0; s < bodies.shapes.length; ++s) {
      if (!bodies.bounds(s, b)) continue;
      if (!b.every((v) => Math.abs(v) < 1e9)) continue; // a half-space has no end
      for (let e = 0; e < edgesOfBox.length; e += 2) {
        const [i, j] = [edgesOfBox[e] as number, edgesOfBox[e + 1] as number];
        this.#boxes.line(corner(i, 0), corner(i, 1), corner(i, 2), corner(j, 0), corner(j, 1), corner(j, 2), this.#c);
      }
    }
  }

  #drawContacts(contacts: Contacts, options: ViewOptions, theme: Theme, scales: ArrowScales): void {
    const { layers } = options;
    const length = normalLength(options, scales);
    const head = 0.3 * length;
    for (let i = 0; i < contacts.count; ++i) {
      const at = (list: ArrayLike<number>, k: number) => list[3 * i + k] as number;
      const [x, y, z] = middleOf(contacts, i);
      const nx = at(contacts.normal, 0);
      const ny = at(contacts.normal, 1);
      const nz = at(contacts.normal, 2);
      if (!Number.isFinite(x + y + z)) continue;
      if (layers.contacts) this.#dots.dot(x, y, z, this.#c.set(theme.contact));
      if (layers.normals)
        this.#fat.arrow(x, y, z, nx * length, ny * length, nz * length, head, this.#c.set(theme.normal));
      if (layers.impulses) this.#drawImpulse(contacts, i, x, y, z, theme, scales, options.arrows);
    }
  }

  #drawPenetration(contacts: Contacts, options: ViewOptions, theme: Theme): void {
    this.#c.set(theme.penetration);
    for (let i = 0; i < contacts.count; ++i) {
      const [x, y, z] = middleOf(contacts, i);
      const half = ((contacts.depth[i] as number) * options.exaggeration) / 2;
      const [a, b, c] = [0, 1, 2].map((k) => (contacts.normal[3 * i + k] as number) * half) as Vec3;
      if (Number.isFinite(x + y + z)) this.#fat.line(x - a, y - b, z - c, x + a, y + b, z + c, this.#c);
    }
  }

  /** Impulse on B along the normal and perpendicular to it. */
  #drawImpulse(c: Contacts, i: number, x: number, y: number, z: number, theme: Theme, s: ArrowScales, arrows: number) {
    const normal = c.normalImpulse[i] as number;
    if (!Number.isFinite(normal) || !(s.impulse > 0)) return;
    const k = (0.35 * s.size * arrows) / s.impulse;
    const along = (axis: number) =>
      k * (normal * (c.normal[3 * i + axis] as number) + ((c.frictionImpulse[3 * i + axis] as number) || 0));
    this.#fat.arrow(x, y, z, along(0), along(1), along(2), 0.03 * s.size, this.#c.set(theme.impulse));
  }

  #drawVectors(
    frame: Frame,
    vectors: ArrayLike<number> | null,
    colour: string,
    full: number,
    scales: ArrowScales,
    options: ViewOptions,
  ): void {
    if (vectors === null || !(full > 0)) return;
    const k = (0.3 * scales.size * options.arrows) / full;
    this.#c.set(colour);
    this.#scene.bodies.forEach((body, b) => {
      if (body.type === 'static') return;
      const [x, y, z] = this.#pointOf(frame, b, body.center);
      const [vx, vy, vz] = [vectors[3 * b] as number, vectors[3 * b + 1] as number, vectors[3 * b + 2] as number];
      this.#fat.arrow(x, y, z, vx * k, vy * k, vz * k, 0.03 * scales.size, this.#c);
    });
  }

  #drawJoints(frame: Frame, theme: Theme): void {
    this.#c.set(theme.joint);
    for (const joint of this.#scene.joints) {
      const [a, b] = [
        this.#anchor(frame, joint, joint.a, joint.anchorA),
        this.#anchor(frame, joint, joint.b, joint.anchorB),
      ];
      if (!Number.isFinite(a[0] + b[0])) continue;
      for (const [body, anchor] of [
        [joint.a, a],
        [joint.b, b],
      ] as const) {
        const center = this.#scene.bodies[body]?.center;
        if (center) this.#thin.line(...this.#pointOf(frame, body, center), ...anchor, this.#c);
        this.#dots.dot(...anchor, this.#c);
      }
      this.#fat.line(...a, ...b, this.#c); // line between the anchors: the joint's length or its drift
    }
  }

  #drawAxes(frame: Frame, theme: Theme, scales: ArrowScales): void {
    this.#c.set(theme.joint);
    const h = 0.05 * scales.size;
    for (const joint of this.#scene.joints) {
      if (!joint.axis || this.#scene.dimension !== 3 || joint.type === 'ball') continue;
      const [x, y, z] = this.#anchor(frame, joint, joint.b, joint.anchorB);
      const [a, b, c] = this.#turned(frame, joint.b, joint.axis).map((v) => v * h) as Vec3;
      if (Number.isFinite(x)) this.#fat.line(x - a, y - b, z - c, x + a, y + b, z + c, this.#c);
    }
  }

  #anchor(frame: Frame, _joint: SceneJoint, body: number, local: Vec3): Vec3 {
    return body < 0 ? local : this.#pointOf(frame, body, local);
  }

  #turned(frame: Frame, body: number, v: Vec3): Vec3 {
    if (body < 0) return v;
    const q = [0, 1, 2, 3].map((k) => frame.orientation[4 * body + k] as number) as Quat;
    return rotate(q, v);
  }

  #pointOf(frame: Frame, body: number, local: Vec3): Vec3 {
    const p = this.#turned(frame, body, local);
    return [
      p[0] + (frame.position[3 * body] as number),
      p[1] + (frame.position[3 * body + 1] as number),
      p[2] + (frame.position[3 * body + 2] as number),
    ];
  }

  /** Way of the bodies up to this frame; the further back, the fainter. */
  #drawTrails(source: FrameSource, frame: Frame, theme: Theme, colours: Float32Array): void {
    const moving: number[] = [];
    this.#scene.bodies.forEach((body, b) => {
      if (body.type !== 'static' && moving.length < mostTrails) moving.push(b);
    });
    const last = indexAt(source.times, frame.time);
    const first = Math.max(0, last - trailFrames);
    this.#to.set(theme.background);
    let before: Vec3[] | null = null;
    for (let f = first; f <= last; ++f) {
      const state = source.frame(f);
      const points = moving.map((b) => this.#pointOf(state, b, (this.#scene.bodies[b] as { center: Vec3 }).center));
      if (before)
        for (let i = 0; i < points.length; ++i) {
          const [p, q, b] = [before[i] as Vec3, points[i] as Vec3, 3 * (moving[i] as number)];
          if (!Number.isFinite(p[0] + q[0])) continue;
          if (source.ghost) this.#c.set(theme.ghost);
          else this.#c.setRGB(colours[b] as number, colours[b + 1] as number, colours[b + 2] as number);
          this.#thin.line(...p, ...q, this.#c, this.#to, 0.75 * (1 - (f - first) / Math.max(1, last - first)));
        }
      before = points;
    }
  }

  dispose(): void {
    this.#thin.dispose();
    this.#boxes.dispose();
    this.#fat.dispose();
    this.#dots.dispose();
  }
}
