// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Overlays of the bodies of one source: contacts, arrows, joints, boxes, trails. Rebuilt when the frame or a switch
// changes, in buffers that are kept.
import { Color, Group } from 'three';
import type { BodyLayer } from './body_layer.ts';
import type { Bounds } from './bounds.ts';
import type { Theme } from './colours.ts';
import { type Contacts, type Frame, type FrameSource, indexAt, middleOf } from './frames.ts';
import type { ViewOptions } from './layers.ts';
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
      if (layers.bounds) this.#drawBounds(bodies, frame, theme);
      if (layers.joints) this.#drawJoints(frame, theme, scales);
      // colours show the source of a contact if all sources are in one picture
      const own = options.overlaid ? { ...theme, contact: source.colour, normal: source.colour } : theme;
      if (frame.contacts) this.#drawContacts(frame.contacts, options, own, scales);
      if (layers.velocities) this.#drawVectors(frame, frame.velocity, theme.velocity, scales.speed, scales, options);
      if (layers.spins) this.#drawVectors(frame, frame.angularVelocity, theme.spin, scales.spin, scales, options);
    }
    if (layers.trails) this.#drawTrails(source, frame, theme, colours);
    for (const batch of [this.#thin, this.#boxes, this.#fat, this.#dots]) batch.end();
  }

  #drawBounds(bodies: BodyLayer, frame: Frame, theme: Theme): void {
    const b = this.#box;
    this.#c.set(theme.bounds);
    const own = frame.boxes;
    const count = own ? own.length / 6 : bodies.shapes.length;
    const corner = (i: number, k: number) => b[k + ((i >> k) & 1 ? 3 : 0)] as number;
    for (let s = 0; s < count; ++s) {
      if (own) for (let k = 0; k < 6; ++k) b[k] = own[6 * s + k] as number;
      else if (!bodies.bounds(s, b)) continue;
      if (!b.every((v) => Math.abs(v) < 1e9)) continue; // a half-space has no end
      for (let e = 0; e < edgesOfBox.length; e += 2) {
        const [i, j] = [edgesOfBox[e] as number, edgesOfBox[e + 1] as number];
        this.#boxes.line(corner(i, 0), corner(i, 1), corner(i, 2), corner(j, 0), corner(j, 1), corner(j, 2), this.#c);
      }
    }
  }

  #drawContacts(contacts: Contacts, options: ViewOptions, theme: Theme, scales: ArrowScales): void {
    const { layers } = options;
    const normalLength = Math.min(0.11 * scales.size, 0.9 * scales.body) * options.arrows;
    const head = 0.3 * normalLength;
    for (let i = 0; i < contacts.count; ++i) {
      const at = (list: ArrayLike<number>, k: number) => list[3 * i + k] as number;
      const [x, y, z] = middleOf(contacts, i);
      const nx = at(contacts.normal, 0);
      const ny = at(contacts.normal, 1);
      const nz = at(contacts.normal, 2);
      if (!Number.isFinite(x + y + z)) continue;
      if (layers.contacts) this.#dots.dot(x, y, z, this.#c.set(theme.contact));
      if (layers.normals)
        this.#fat.arrow(
          x,
          y,
          z,
          nx * normalLength,
          ny * normalLength,
          nz * normalLength,
          head,
          this.#c.set(theme.normal),
        );
      if (layers.penetration) {
        const half = ((contacts.depth[i] as number) * options.exaggeration) / 2;
        this.#c.set(theme.penetration);
        this.#fat.line(
          x - nx * half,
          y - ny * half,
          z - nz * half,
          x + nx * half,
          y + ny * half,
          z + nz * half,
          this.#c,
        );
      }
      if (layers.impulses) this.#drawImpulse(contacts, i, x, y, z, theme, scales, options.arrows);
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

  #drawJoints(frame: Frame, theme: Theme, scales: ArrowScales): void {
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
      if (joint.axis && this.#scene.dimension === 3 && joint.type !== 'ball') {
        const d = this.#turned(frame, joint.b, joint.axis);
        const h = 0.05 * scales.size;
        this.#fat.line(
          b[0] - d[0] * h,
          b[1] - d[1] * h,
          b[2] - d[2] * h,
          b[0] + d[0] * h,
          b[1] + d[1] * h,
          b[2] + d[2] * h,
          this.#c,
        );
      }
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
