// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results of the stages of a step, read from the arrays of a frame.
import type { ArrayBundle } from '../common/arrays.ts';
import type { Contacts } from '../replay/frames.ts';
import type { FrameHead } from './api.ts';

export interface ShapeRef {
  body: number;
  shape: number;
}
export interface ManifoldPoint {
  depth: number; // [m]
  feature: number;
  impulse: number; // it starts with [N s]
  row: number; // -1: none
}
export interface Manifold {
  a: ShapeRef;
  b: ShapeRef;
  normal: [number, number, number];
  points: ManifoldPoint[];
}

export const rowKinds = ['normal', 'friction', 'joint', 'limit'] as const;
export interface Row {
  kind: (typeof rowKinds)[number];
  a: number; // body, -1: the world
  b: number;
  joint: number; // -1: none
  impulse: number;
  bias: number;
  softness: number;
  error: number;
  effectiveMass: number;
}

export interface Iteration {
  substep: number;
  residual: number;
  impulses: Float64Array; // impulses by row
}

export interface StageData {
  boxes: number;
  pairs: [ShapeRef, ShapeRef][];
  manifolds: Manifold[];
  rows: Row[];
  start: Float64Array; // impulses of the rows before the first iteration
  iterations: Iteration[];
  islands: number[][];
}

const ref = (list: Int32Array, at: number): ShapeRef => ({ body: list[at] as number, shape: list[at + 1] as number });

/** Null where the frame has none. */
export function stageData(head: FrameHead, arrays: ArrayBundle): StageData | null {
  if (!head.has_stages) return null;
  const d = (name: string) => arrays.get(`${head.instance}/${name}`) as Float64Array;
  const i = (name: string) => arrays.get(`${head.instance}/${name}`) as Int32Array;
  const pairs: StageData['pairs'] = [];
  const pairList = i('pairs');
  for (let k = 0; k < pairList.length; k += 4) pairs.push([ref(pairList, k), ref(pairList, k + 2)]);
  return {
    boxes: i('boxes/of').length / 2,
    pairs,
    manifolds: manifolds(d, i),
    rows: rows(d, i),
    start: d('iterations/start'),
    iterations: iterations(d, i),
    islands: islands(i('islands')),
  };
}

type Doubles = (name: string) => Float64Array;
type Integers = (name: string) => Int32Array;

function manifolds(d: Doubles, i: Integers): Manifold[] {
  const between = i('manifolds/between');
  const normal = d('manifolds/normal');
  const [feature, row] = [i('manifolds/feature'), i('manifolds/row')];
  const [depth, impulse] = [d('manifolds/depth'), d('manifolds/impulse')];
  const out: Manifold[] = [];
  let point = 0;
  for (let m = 0; 5 * m < between.length; ++m) {
    const points: ManifoldPoint[] = [];
    for (let n = between[5 * m + 4] as number; n > 0; --n, ++point)
      points.push({
        depth: depth[point] as number,
        feature: (feature[point] as number) >>> 0,
        impulse: impulse[point] as number,
        row: row[point] as number,
      });
    out.push({
      a: ref(between, 5 * m),
      b: ref(between, 5 * m + 2),
      normal: [normal[3 * m] as number, normal[3 * m + 1] as number, normal[3 * m + 2] as number],
      points,
    });
  }
  return out;
}

function rows(d: Doubles, i: Integers): Row[] {
  const names = i('rows/names');
  const number = (name: string) => d(`rows/${name}`);
  const [impulse, bias, softness] = [number('impulse'), number('bias'), number('softness')];
  const [error, effectiveMass] = [number('error'), number('effective_mass')];
  return Array.from(impulse, (value, k) => ({
    kind: rowKinds[names[4 * k] as number] ?? 'normal',
    a: names[4 * k + 1] as number,
    b: names[4 * k + 2] as number,
    joint: names[4 * k + 3] as number,
    impulse: value,
    bias: bias[k] as number,
    softness: softness[k] as number,
    error: error[k] as number,
    effectiveMass: effectiveMass[k] as number,
  }));
}

function iterations(d: Doubles, i: Integers): Iteration[] {
  const sizes = i('iterations/sizes');
  const [residual, impulses] = [d('iterations/residual'), d('iterations/impulses')];
  const out: Iteration[] = [];
  let at = 0;
  for (let k = 0; 2 * k < sizes.length; ++k) {
    const count = sizes[2 * k + 1] as number;
    out.push({
      substep: sizes[2 * k] as number,
      residual: residual[k] as number,
      impulses: impulses.subarray(at, at + count),
    });
    at += count;
  }
  return out;
}

function islands(list: Int32Array): number[][] {
  const out: number[][] = [];
  for (let at = 0; at < list.length; ) {
    const count = list[at] as number;
    out.push(Array.from(list.subarray(at + 1, at + 1 + count)));
    at += 1 + count;
  }
  return out;
}

/** Points of the manifolds as contacts; impulses are those of their rows, or those they start with. */
export function manifoldContacts(head: FrameHead, arrays: ArrayBundle): Contacts {
  const d = (name: string) => arrays.get(`${head.instance}/${name}`) as Float64Array;
  const i = (name: string) => arrays.get(`${head.instance}/${name}`) as Int32Array;
  const between = i('manifolds/between');
  const normals = d('manifolds/normal');
  const row = i('manifolds/row');
  const start = d('manifolds/impulse');
  const solved = d('rows/impulse');
  const count = start.length;
  const [bodyA, bodyB] = [new Int32Array(count), new Int32Array(count)];
  const [shapeA, shapeB] = [new Int32Array(count), new Int32Array(count)];
  const normal = new Float64Array(3 * count);
  let point = 0;
  for (let m = 0; 5 * m < between.length; ++m)
    for (let n = between[5 * m + 4] as number; n > 0; --n, ++point) {
      bodyA[point] = between[5 * m] as number;
      shapeA[point] = between[5 * m + 1] as number;
      bodyB[point] = between[5 * m + 2] as number;
      shapeB[point] = between[5 * m + 3] as number;
      for (let k = 0; k < 3; ++k) normal[3 * point + k] = normals[3 * m + k] as number;
    }
  return {
    count,
    bodyA,
    bodyB,
    shapeA,
    shapeB,
    pointA: d('manifolds/point_a').slice(),
    pointB: d('manifolds/point_b').slice(),
    normal,
    depth: d('manifolds/depth').slice(),
    normalImpulse: start.map((value, k) => solved[row[k] as number] ?? value),
    frictionImpulse: new Float64Array(3 * count),
  };
}
