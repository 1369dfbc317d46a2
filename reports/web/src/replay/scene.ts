// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The scenario as the view needs it: bodies with shapes, joints with anchors, in file order. Reads scenario files of
// format 1 as they stand (scenarios/FORMAT.md); what a generator makes is expanded, without the random turns of a
// pile, which the frames bring. The loader has checked the file: what is wrong here throws an Error.
import { expandGenerators } from './generators.ts';
import type { Json } from './json.ts';
import { add, conjugate, type Quat, rotate, sub, type Vec3 } from './vectors.ts';

export interface Pose {
  position: Vec3;
  orientation: Quat;
}

export type Geometry =
  | { kind: 'sphere'; radius: number }
  | { kind: 'box' | 'ellipsoid'; half: Vec3 }
  | { kind: 'capsule' | 'cylinder' | 'cone'; radius: number; halfLength: number } // axis along y
  | { kind: 'hull'; vertices: Vec3[] }
  | { kind: 'half_space'; normal: Vec3; offset: number }
  | { kind: 'segment' | 'chain'; vertices: Vec3[]; loop: boolean }
  | { kind: 'triangle_mesh'; vertices: Vec3[]; triangles: number[][] }
  | { kind: 'height_field'; spacing: [number, number]; heights: number[][] };

export interface SceneShape {
  geometry: Geometry;
  name: string; // kind as in the file: "sphere", "circle", ...
  pose: Pose; // pose in the body frame
}

export interface SceneBody {
  name: string;
  type: 'dynamic' | 'static' | 'kinematic';
  first: Pose;
  center: Vec3; // centre of mass as given, or the middle of its shapes; body frame
  shapes: SceneShape[];
  collides: boolean;
}

export interface SceneJoint {
  name: string;
  type: string;
  a: number; // body, -1: the world
  b: number;
  anchorA: Vec3; // anchor in A's frame
  anchorB: Vec3;
  axis: Vec3 | null; // axis in B's frame
}

export interface Scene {
  dimension: 2 | 3;
  gravity: Vec3;
  duration: number;
  bodies: SceneBody[];
  joints: SceneJoint[];
}

/** A vector of the file; two-dimensional ones have z = 0. */
export const vector = (json: Json, fallback: Vec3 = [0, 0, 0]): Vec3 =>
  json === undefined ? fallback : [Number(json[0]), Number(json[1]), Number(json[2] ?? 0)];

const turn = (axis: Vec3, angle: number): Quat => {
  const length = Math.hypot(...axis) || 1;
  const s = Math.sin(angle / 2) / length;
  return [Math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s];
};

export function orientation(json: Json): Quat {
  const degree = Math.PI / 180;
  if (json.orientation !== undefined) {
    const q = (json.orientation as number[]).map(Number) as Quat;
    const norm = Math.hypot(...q) || 1;
    return q.map((v) => v / norm) as Quat;
  }
  if (json.axis_angle_deg !== undefined)
    return turn(vector(json.axis_angle_deg.axis), Number(json.axis_angle_deg.angle_deg) * degree);
  if (json.angle !== undefined) return turn([0, 0, 1], Number(json.angle));
  if (json.angle_deg !== undefined) return turn([0, 0, 1], Number(json.angle_deg) * degree);
  return [1, 0, 0, 0];
}

const round = (kind: 'capsule' | 'cylinder' | 'cone') => (json: Json) =>
  ({ kind, radius: Number(json.radius), halfLength: Number(json.half_length) }) as const;
const ball = (json: Json) => ({ kind: 'sphere', radius: Number(json.radius) }) as const;
const hull = (json: Json) => ({ kind: 'hull', vertices: json.vertices.map((v: Json) => vector(v)) }) as const;
const solidBelow = (json: Json): Geometry => {
  const n = vector(json.normal);
  const length = Math.hypot(...n) || 1;
  return {
    kind: 'half_space',
    normal: n.map((v) => v / length) as Vec3,
    offset: Number(json.offset ?? 0),
  };
};

const readers: Record<string, (json: Json) => Geometry> = {
  sphere: ball,
  circle: ball,
  box: (json) => ({ kind: 'box', half: vector(json.half_extents) }),
  ellipsoid: (json) => ({ kind: 'ellipsoid', half: vector(json.half_axes) }),
  capsule: round('capsule'),
  cylinder: round('cylinder'),
  cone: round('cone'),
  hull,
  polygon: hull,
  half_space: solidBelow,
  half_plane: solidBelow,
  segment: (json) => ({ kind: 'segment', vertices: [vector(json.a), vector(json.b)], loop: false }),
  chain: (json) => ({
    kind: 'chain',
    vertices: json.vertices.map((v: Json) => vector(v)),
    loop: Boolean(json.loop),
  }),
  triangle_mesh: (json) => ({
    kind: 'triangle_mesh',
    vertices: json.vertices.map((v: Json) => vector(v)),
    triangles: json.triangles,
  }),
  height_field: (json) => ({ kind: 'height_field', spacing: json.spacing, heights: json.heights }),
};

function readShape(json: Json): SceneShape {
  const name = Object.keys(readers).find((key) => json[key] !== undefined);
  if (name === undefined) throw new Error('a shape of a kind that the view does not know');
  const read = readers[name] as (json: Json) => Geometry;
  return {
    name,
    geometry: read(json[name]),
    pose: { position: vector(json.position), orientation: orientation(json) },
  };
}

/** Start of a body's arrows if the file has no centre of mass: the mean of its shapes' positions. */
function middle(shapes: SceneShape[]): Vec3 {
  let sum: Vec3 = [0, 0, 0];
  for (const { geometry, pose } of shapes) {
    let own: Vec3 = [0, 0, 0];
    if (geometry.kind === 'hull') {
      for (const v of geometry.vertices) own = add(own, v);
      own = own.map((x) => x / geometry.vertices.length) as Vec3;
    }
    sum = add(sum, add(pose.position, rotate(pose.orientation, own)));
  }
  return shapes.length === 0 ? sum : (sum.map((x) => x / shapes.length) as Vec3);
}

function readBody(json: Json): SceneBody {
  const shapes = (json.shapes ?? []).map(readShape);
  return {
    name: String(json.name),
    type: json.type ?? 'dynamic',
    first: { position: vector(json.position), orientation: orientation(json) },
    center: json.center_of_mass === undefined ? middle(shapes) : vector(json.center_of_mass),
    shapes,
    collides: json.collides !== false,
  };
}

/** The point of the world in the frame of a body at its first pose. */
const inFrame = (body: SceneBody | undefined, point: Vec3): Vec3 =>
  body === undefined ? point : rotate(conjugate(body.first.orientation), sub(point, body.first.position));

function readJoint(json: Json, bodies: SceneBody[]): SceneJoint {
  const index = (name: string) => (name === 'world' ? -1 : bodies.findIndex((b) => b.name === name));
  const a = index(json.a);
  const b = index(json.b);
  const anchor = (key: string, body: SceneBody | undefined): Vec3 => {
    if (json.anchor !== undefined) return inFrame(body, vector(json.anchor));
    return vector(json[key]);
  };
  const axis =
    json.axis === undefined || bodies[b] === undefined
      ? null
      : rotate(conjugate((bodies[b] as SceneBody).first.orientation), vector(json.axis));
  return {
    name: String(json.name),
    type: String(json.type),
    a,
    b,
    anchorA: anchor('anchor_a', bodies[a]),
    anchorB: anchor('anchor_b', bodies[b]),
    axis,
  };
}

export function readScene(file: Json): Scene {
  const dimension = file.dimension === 2 ? 2 : 3;
  const generated = expandGenerators(file.generators ?? [], dimension);
  const bodies: SceneBody[] = [...(file.bodies ?? []), ...generated.bodies].map(readBody);
  return {
    dimension,
    gravity: vector(file.gravity),
    duration: Number(file.duration),
    bodies,
    joints: [...(file.joints ?? []), ...generated.joints].map((json: Json) => readJoint(json, bodies)),
  };
}
