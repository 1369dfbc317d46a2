// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Contacts, Frame, FrameSource } from '../../src/replay/frames.ts';
import { bodyQuantities, pairQuantities, samplesOf } from '../../src/replay/quantities.ts';
import { decodeChoice, encodeChoice, withPlots } from '../../src/report/scenario/free_choice.ts';

const contacts: Contacts = {
  count: 3,
  bodyA: [0, 1, 0],
  bodyB: [1, 0, 2],
  shapeA: [0, 0, 0],
  shapeB: [0, 0, 0],
  pointA: [],
  pointB: [],
  normal: [],
  depth: [0.1, 0.3, 0.9],
  normalImpulse: [1, 2, 100],
  frictionImpulse: [3, 4, 0, 0, 0, 2, 9, 9, 9],
};
const half = Math.SQRT1_2;
const frame: Frame = {
  time: 0,
  step: 0,
  position: [1, 2, 3, 4, 5, 6],
  orientation: [1, 0, 0, 0, half, 0, half, 0],
  velocity: [3, 4, 0, 0, 0, 0],
  angularVelocity: null,
  contacts,
};
const source = (frames: Frame[]): FrameSource =>
  ({ times: frames.map((f) => f.time), frame: (i: number) => frames[i] as Frame }) as unknown as FrameSource;
const value = (key: string, a: number, b = -1, frames = [frame]) => {
  const quantity = [...bodyQuantities, ...pairQuantities].find((q) => q.key === key);
  assert.ok(quantity, key);
  return samplesOf(source(frames), quantity, a, b);
};

test('quantities of a body', () => {
  assert.deepEqual(value('py', 0), [2]);
  assert.deepEqual(value('pz', 1), [6]);
  assert.deepEqual(value('speed', 0), [5]);
  assert.deepEqual(value('wx', 0), [null], 'not stored');
  assert.ok(Math.abs((value('angle', 1)[0] ?? 0) - 90) < 1e-9);
});

test('quantities of the contacts of two bodies, in either order', () => {
  for (const [a, b] of [
    [0, 1],
    [1, 0],
  ] as const) {
    assert.deepEqual(value('points', a, b), [2]);
    assert.deepEqual(value('depth', a, b), [0.3]);
    assert.deepEqual(value('normal_impulse', a, b), [3]);
    assert.deepEqual(value('friction_impulse', a, b), [7]);
  }
  assert.deepEqual(value('points', 1, 2), [0]);
  assert.deepEqual(value('depth', 1, 2), [null]);
  assert.deepEqual(value('points', 0, 1, [{ ...frame, contacts: null }]), [null], 'not stored');
});

test('a plot is kept in the address, whatever its names', () => {
  const choice = { of: 'a~b|c d', y: 'depth', x: 't', spec: 'x:preset=y,k=1' };
  assert.deepEqual(decodeChoice(encodeChoice(choice)), choice);
  for (const text of ['', 'a', 'a~b', '~b~t~', '%~b~t~']) assert.equal(decodeChoice(text), null, text);
  const hash = withPlots('#/scenario/s?dt=0.1&plot=old~px~t~', [choice]);
  const query = new URLSearchParams(hash.split('?')[1]);
  assert.equal(query.get('dt'), '0.1');
  assert.deepEqual(query.getAll('plot').map(decodeChoice), [choice]);
  assert.equal(withPlots(hash.replace('dt=0.1&', ''), []), '#/scenario/s');
});
