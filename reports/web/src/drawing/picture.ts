// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A drawing of a scene at its start: bodies from a fixed direction without perspective, ground, gravity, first
// velocities, joints, and the ways that bodies take. Far faces first.
import { svg } from '../common/elements.ts';
import { bodyReach } from '../replay/framing.ts';
import type { Json } from '../replay/json.ts';
import type { Scene, SceneBody } from '../replay/scene.ts';
import { vector } from '../replay/scene.ts';
import { add, rotate, type Vec3 } from '../replay/vectors.ts';
import { type Solid, solidsOf } from './faces.ts';

export interface PictureOptions {
  width: number;
  height: number;
  paths: Vec3[][]; // paths of bodies through the world
  labels: boolean;
}

export type Point = [x: number, y: number];

/** Projection from the world to the picture [px], and distance of a point from the eye. */
export interface Projection {
  at: (p: Vec3) => Point;
  depth: (p: Vec3) => number;
  scale: number; // [px/m]
  towards: Vec3; // direction from the scene to the eye
}

const yaw = (28 * Math.PI) / 180;
const pitch = (20 * Math.PI) / 180;

export function projection(planar: boolean, middle: Vec3, radius: number, width: number, height: number): Projection {
  const scale = (0.5 * Math.min(width, height * 1.2)) / radius;
  const [c, s] = planar ? [1, 0] : [Math.cos(yaw), Math.sin(yaw)];
  const [cp, sp] = planar ? [1, 0] : [Math.cos(pitch), Math.sin(pitch)];
  const right: Vec3 = [c, 0, -s];
  const towards: Vec3 = [s * cp, sp, c * cp];
  const up: Vec3 = [-s * sp, cp, -c * sp];
  const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const from = (p: Vec3): Vec3 => [p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]];
  return {
    at: (p) => [width / 2 + scale * dot(right, from(p)), height / 2 - scale * dot(up, from(p))],
    depth: (p) => dot(towards, from(p)),
    scale,
    towards,
  };
}

/** Frame of the moving bodies with their paths, or of everything if nothing moves. */
function framing(scene: Scene, paths: Vec3[][]): { middle: Vec3; radius: number } {
  const moving = scene.bodies.flatMap((b, i) => (b.type === 'static' ? [] : [i]));
  const shown = moving.length ? moving : scene.bodies.map((_, i) => i);
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  const take = (p: Vec3, reach: number) => {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k] as number, (p[k] as number) - reach);
      high[k] = Math.max(high[k] as number, (p[k] as number) + reach);
    }
  };
  for (const i of shown) {
    const body = scene.bodies[i] as SceneBody;
    take(add(body.first.position, [0, 0, 0]), Math.max(1e-3, bodyReach(scene, i)));
  }
  const reach = Math.max(...shown.map((i) => bodyReach(scene, i)), 1e-3);
  for (const path of paths) for (const p of path) take(p, reach);
  for (const joint of scene.joints) if (joint.a < 0) take(joint.anchorA, 0);
  const middle = low.map((v, k) => (v + (high[k] as number)) / 2) as Vec3;
  const half = low.map((v, k) => ((high[k] as number) - v) / 2) as Vec3;
  return { middle, radius: 1.25 * Math.max(half[0], half[1] * 1.2, half[2] * 0.8, 1e-3) };
}

const points = (list: Point[]) => list.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');

interface Drawn {
  depth: number;
  ground: boolean;
  node: SVGElement;
}

export function brightness(corners: Vec3[], towards: Vec3): number {
  const [a, b, c] = corners as [Vec3, Vec3, Vec3];
  const u: Vec3 = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const v: Vec3 = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  const n: Vec3 = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n) || 1;
  const light: Vec3 = [towards[0] * 0.3 - 0.25, 0.85, towards[2] * 0.45];
  const side = n[0] * towards[0] + n[1] * towards[1] + n[2] * towards[2] < 0 ? -1 : 1;
  const lit = (side * (n[0] * light[0] + n[1] * light[1] + n[2] * light[2])) / length;
  return Math.round(58 + 42 * Math.max(0, Math.min(1, lit)));
}

function drawSolid(solid: Solid, kind: string, planar: boolean, p: Projection): Drawn[] {
  if ('ball' in solid) {
    const { center, radius } = solid.ball;
    const [cx, cy] = p.at(center);
    const r = radius * p.scale;
    const disc = svg('circle', { cx, cy, r, class: `face ${kind}` });
    const shine = planar
      ? svg('line', { x1: cx, y1: cy, x2: cx + r, y2: cy, class: 'edge' })
      : svg('circle', { cx: cx - 0.3 * r, cy: cy - 0.35 * r, r: 0.3 * r, class: 'shine' });
    return [{ depth: p.depth(center) + 0.3 * radius, ground: false, node: svg('g', null, disc, shine) }];
  }
  return solid.faces.map(({ corners, closed }) => {
    const depth = corners.reduce((sum, c) => sum + p.depth(c), 0) / corners.length;
    const shape = points(corners.map(p.at));
    if (!closed)
      return { depth, ground: kind === 'static', node: svg('polyline', { points: shape, class: `line ${kind}` }) };
    const style = planar ? null : `--lit:${brightness(corners, p.towards)}%`;
    return { depth, ground: kind === 'static', node: svg('polygon', { points: shape, class: `face ${kind}`, style }) };
  });
}

function arrow(from: Point, to: Point, kind: string, title: string): SVGElement {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 2)
    return svg('circle', { cx: from[0], cy: from[1], r: 3, class: `dot ${kind}` }, svg('title', null, title));
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(9, 0.5 * length);
  const back: Point = [to[0] - head * ux, to[1] - head * uy];
  const side = (s: number): Point => [back[0] - s * 0.45 * head * uy, back[1] + s * 0.45 * head * ux];
  return svg(
    'g',
    { class: `arrow ${kind}` },
    svg('title', null, title),
    svg('line', { x1: from[0], y1: from[1], x2: back[0], y2: back[1] }),
    svg('polygon', { points: points([to, side(1), side(-1)]) }),
  );
}

/** First velocities of the bodies of the file, by name; templates of generators are left out. */
function velocities(file: Json): Map<string, { linear: Vec3; angular: Vec3 }> {
  const found = new Map<string, { linear: Vec3; angular: Vec3 }>();
  for (const body of file.bodies ?? []) {
    const spin = body.angular_velocity;
    const angular: Vec3 = typeof spin === 'number' ? [0, 0, spin] : vector(spin);
    found.set(String(body.name), { linear: vector(body.velocity), angular });
  }
  return found;
}

function arrows(scene: Scene, file: Json, p: Projection, longest: number): SVGElement[] {
  const first = velocities(file);
  const speeds = [...first.values()].map((v) => Math.hypot(...v.linear));
  const spins = [...first.values()].map((v) => Math.hypot(...v.angular));
  const unit = longest / p.scale;
  const drawn: SVGElement[] = [];
  for (const body of scene.bodies) {
    const v = first.get(body.name);
    if (!v) continue;
    const center = add(body.first.position, rotate(body.first.orientation, body.center));
    const push = (value: Vec3, most: number, kind: string, what: string) => {
      const size = Math.hypot(...value);
      if (!(size > 0)) return;
      const tip = add(center, value.map((x) => (x / most) * unit) as Vec3);
      drawn.push(arrow(p.at(center), p.at(tip), kind, `${body.name}: ${what}`));
    };
    push(v.linear, Math.max(...speeds), 'velocity', `velocity ${v.linear.join(', ')} m/s`);
    if (scene.dimension === 3)
      push(v.angular, Math.max(...spins), 'spin', `angular velocity ${v.angular.join(', ')} rad/s`);
    else if (v.angular[2] !== 0)
      drawn.push(turning(p.at(center), v.angular[2] > 0, `${body.name}: angular velocity ${v.angular[2]} rad/s`));
  }
  return drawn;
}

/** A spin in 2D: an arc with a head. */
function turning([x, y]: Point, counterclockwise: boolean, title: string): SVGElement {
  const r = 16;
  const s = counterclockwise ? 1 : -1;
  const end: Point = [x - s * r * Math.cos(0.6), y - r * Math.sin(0.6)];
  const arc = `M ${x + s * r} ${y} A ${r} ${r} 0 0 ${counterclockwise ? 0 : 1} ${end[0].toFixed(1)} ${end[1].toFixed(1)}`;
  const tip: Point = [end[0] - s * 3, end[1] + 6];
  return svg(
    'g',
    { class: 'arrow spin' },
    svg('title', null, title),
    svg('path', { d: arc, fill: 'none' }),
    svg('polygon', { points: points([tip, [end[0] + 5, end[1] + 1], [end[0] - 5, end[1] - 2]]) }),
  );
}

function joints(scene: Scene, p: Projection): SVGElement[] {
  return scene.joints.map((joint) => {
    const world = (index: number, anchor: Vec3): Vec3 => {
      const body = scene.bodies[index];
      return body ? add(body.first.position, rotate(body.first.orientation, anchor)) : anchor;
    };
    const [a, b] = [p.at(world(joint.a, joint.anchorA)), p.at(world(joint.b, joint.anchorB))];
    const link = svg('line', { x1: a[0], y1: a[1], x2: b[0], y2: b[1], class: 'link' });
    const fixed =
      joint.a < 0
        ? svg('polygon', { points: points([a, [a[0] - 7, a[1] - 11], [a[0] + 7, a[1] - 11]]), class: 'anchor' })
        : null;
    const pin = svg('circle', { cx: b[0], cy: b[1], r: 3.5, class: 'pin' });
    return svg('g', { class: 'joint' }, svg('title', null, `${joint.name}: ${joint.type}`), link, fixed, pin);
  });
}

function gravityMark(scene: Scene, p: Projection, width: number): SVGElement | null {
  const size = Math.hypot(...scene.gravity);
  if (!(size > 0)) return svg('text', { x: width - 12, y: 20, class: 'label', 'text-anchor': 'end' }, 'no gravity');
  const at = p.at([0, 0, 0]);
  const tip = p.at(scene.gravity.map((v) => v / size / p.scale) as Vec3);
  const from: Point = [width - 24, 14];
  const to: Point = [from[0] + 30 * (tip[0] - at[0]), from[1] + 30 * (tip[1] - at[1])];
  return svg(
    'g',
    null,
    arrow(from, to, 'gravity', `gravity ${scene.gravity.join(', ')} m/s²`),
    svg('text', { x: from[0] - 8, y: from[1] + 12, class: 'label', 'text-anchor': 'end' }, 'g'),
  );
}

/** A length of one, two or five times a power of ten. */
function scaleBar(p: Projection, height: number): SVGElement {
  const wanted = 90 / p.scale;
  const decade = 10 ** Math.floor(Math.log10(wanted));
  const length = ([5, 2, 1].find((f) => f * decade <= wanted) ?? 1) * decade;
  const right = 12 + length * p.scale;
  return svg(
    'g',
    { class: 'scalebar' },
    svg('path', { d: `M 12 ${height - 16} v 6 H ${right.toFixed(1)} v -6`, fill: 'none' }),
    svg('text', { x: right + 6, y: height - 9, class: 'label' }, `${Number(length.toPrecision(1))} m`),
  );
}

const mostLabels = 8;

export function scenePicture(scene: Scene, file: Json, options: PictureOptions): SVGSVGElement {
  const { width, height, paths } = options;
  const planar = scene.dimension === 2;
  const { middle, radius } = framing(scene, paths);
  const p = projection(planar, middle, radius, width, height);
  const drawn = scene.bodies.flatMap((body) =>
    solidsOf(body, planar, middle, 2.2 * radius).flatMap((solid) => drawSolid(solid, body.type, planar, p)),
  );
  drawn.sort((a, b) => Number(b.ground) - Number(a.ground) || a.depth - b.depth);
  const moving = scene.bodies.filter((b) => b.type !== 'static');
  const labels =
    options.labels && moving.length <= mostLabels
      ? moving.map((b) => {
          const [x, y] = p.at(add(b.first.position, rotate(b.first.orientation, b.center)));
          return svg('text', { x: x + 6, y: y - 6, class: 'label name' }, b.name);
        })
      : [];
  return svg(
    'svg',
    {
      viewBox: `0 0 ${width} ${height}`,
      class: 'scene',
      role: 'img',
      'aria-label': 'Drawing of the scene at its start',
    },
    drawn.map((d) => d.node),
    paths.map((path) => svg('polyline', { points: points(path.map(p.at)), class: 'way' })),
    joints(scene, p),
    arrows(scene, file, p, 0.22 * width),
    labels,
    gravityMark(scene, p, width),
    scaleBar(p, height),
  );
}
