// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ArrayBundle } from '../../src/common/arrays.ts';
import type { FrameHead } from '../../src/live/api.ts';
import { changes, overrides } from '../../src/live/branch_form.ts';
import { Dragger, type Held, meet } from '../../src/live/drag.ts';
import { curves, mostCurves } from '../../src/live/impulse_plot.ts';
import { InstanceSource } from '../../src/live/instance_source.ts';
import { type KeyActions, keyAction } from '../../src/live/keys.ts';
import { instanceParts } from '../../src/live/labels.ts';
import { type StageData, stageData } from '../../src/live/stage_data.ts';
import { type Frame, middleOf } from '../../src/replay/frames.ts';
import type { Pick } from '../../src/replay/view.ts';

/** The format of validation/results/array_bundle.cpp, written a second time. */
function bundle(arrays: Record<string, number[]>, integers: Record<string, number[]> = {}): ArrayBundle {
  const entries: object[] = [];
  const parts: Uint8Array[] = [];
  let offset = 0;
  const add = (name: string, type: string, values: Float64Array | Int32Array) => {
    entries.push({ name, type, offset, count: values.length });
    const bytes = new Uint8Array(Math.ceil(values.byteLength / 8) * 8);
    bytes.set(new Uint8Array(values.buffer));
    parts.push(bytes);
    offset += bytes.length;
  };
  for (const [name, values] of Object.entries(arrays)) add(name, 'f64', Float64Array.from(values));
  for (const [name, values] of Object.entries(integers)) add(name, 'i32', Int32Array.from(values));
  const head = new TextEncoder().encode(JSON.stringify({ meta: null, arrays: entries }));
  const start = Math.ceil((4 + head.length) / 8) * 8;
  const out = new Uint8Array(start + offset);
  new DataView(out.buffer).setUint32(0, head.length, true);
  out.set(head, 4);
  let at = start;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return new ArrayBundle(out.buffer);
}

const head = (step: number, more: Partial<FrameHead> = {}): FrameHead => ({
  instance: 3,
  step,
  time: 0.1 * step,
  counters: {},
  stage: { in_step: false, done: '', next: '', substep: 0 },
  has_stages: false,
  broken_joints: [],
  ...more,
});

/** Two bodies and one contact; the second body is at (step, 0, 0). */
const numbersAt = (step: number): Record<string, number[]> => ({
  '3/position': [0, 0, 0, step, 0, 0],
  '3/orientation': [1, 0, 0, 0, 1, 0, 0, 0],
  '3/velocity': [0, 0, 0, 1, 2, 3],
  '3/angular_velocity': [0, 0, 0, 0, 0, 1],
  '3/contacts/point_a': [1, 2, 3],
  '3/contacts/point_b': [1, 2, 3],
  '3/contacts/carried_a': [1 + step, 2, 3],
  '3/contacts/carried_b': [1 + step, 2, 5],
  '3/contacts/normal': [0, 1, 0],
  '3/contacts/depth': [0.01],
  '3/contacts/normal_impulse': [Number.NaN],
  '3/contacts/friction_impulse': [0, 0, 0],
});
const contactNames = {
  '3/contacts/body_a': [0],
  '3/contacts/body_b': [1],
  '3/contacts/shape_a': [0],
  '3/contacts/shape_b': [2],
};
const frame = (step: number): ArrayBundle => bundle(numbersAt(step), contactNames);

test('an instance keeps its last frames, and forgets those after a step back', () => {
  const instance = new InstanceSource(3, 'instance 3', 'rigor', '#fff');
  for (let step = 0; step < 300; ++step) instance.push(head(step), frame(step));
  assert.equal(instance.times.length, 240);
  assert.equal(instance.newest?.position[3], 299);
  assert.equal(instance.frame(0).position[3], 60);
  assert.equal(instance.newest?.contacts?.shapeB[0], 2);
  assert.ok(Number.isNaN(instance.newest?.contacts?.normalImpulse[0]));
  const contacts = instance.newest?.contacts;
  assert.ok(contacts);
  assert.deepEqual(middleOf(contacts, 0), [300, 2, 4], 'drawn where the bodies have carried it');
  assert.equal(contacts.pointA[0], 1, 'reported as it was found');
  assert.match(contacts.instant ?? '', /where the last step began/);
  instance.push(head(100), frame(100));
  assert.equal(instance.times.length, 41);
  assert.equal(instance.newest?.step, 100);
  instance.push(head(100), frame(7));
  assert.equal(instance.times.length, 41, 'the same moment is replaced');
  assert.equal(instance.newest?.position[3], 7);
  instance.push(head(0), frame(0));
  assert.deepEqual(instance.times, [0]);
});

const staged = bundle(
  {
    '3/boxes/sides': [0, 0, 0, 1, 1, 1, 0, 1, 0, 1, 2, 1],
    '3/manifolds/normal': [0, 1, 0, 1, 0, 0],
    '3/manifolds/point_a': [1, 0, 0, 2, 0, 0, 3, 0, 0],
    '3/manifolds/point_b': [1, 0, 0, 2, 0, 0, 3, 0, 0],
    '3/manifolds/depth': [0.1, 0.2, -0.3],
    '3/manifolds/impulse': [5, 6, 7],
    '3/rows/impulse': [10, 11, 12],
    '3/rows/bias': [0, 0, 0],
    '3/rows/softness': [0, 0, 0],
    '3/rows/error': [0, 0, 0],
    '3/rows/effective_mass': [1, 2, 3],
    '3/iterations/start': [0.5, 1, 1.5],
    '3/iterations/residual': [0.5, 0],
    '3/iterations/impulses': [1, 2, 3, 10, 11, 12],
    '3/position': [0, 0, 0],
    '3/orientation': [1, 0, 0, 0],
    '3/velocity': [0, 0, 0],
    '3/angular_velocity': [0, 0, 0],
  },
  {
    '3/boxes/of': [0, 0, 1, 0],
    '3/pairs': [0, 0, 1, 2],
    '3/islands': [2, 4, 5, 1, 9],
    '3/manifolds/between': [0, 0, 1, 0, 2, 1, 0, 2, 3, 1],
    '3/manifolds/feature': [-1, 8, 9],
    '3/manifolds/row': [0, -1, 2],
    '3/rows/names': [0, 0, 1, -1, 1, 0, 1, -1, 3, -1, 2, 4],
    '3/iterations/sizes': [0, 3, 1, 3],
  },
);
const inStep = head(4, {
  has_stages: true,
  stage: { in_step: true, done: 'solve', next: 'move', substep: 0 },
});

test('what stages have made is read in its order', () => {
  const data = stageData(inStep, staged) as StageData;
  assert.equal(data.boxes, 2);
  assert.deepEqual(data.pairs, [
    [
      { body: 0, shape: 0 },
      { body: 1, shape: 2 },
    ],
  ]);
  assert.deepEqual(data.islands, [[4, 5], [9]]);
  assert.equal(data.manifolds.length, 2);
  assert.equal(data.manifolds[0]?.points.length, 2);
  assert.deepEqual(data.manifolds[1]?.b, { body: 2, shape: 3 });
  assert.equal(data.manifolds[1]?.points[0]?.depth, -0.3);
  assert.equal(data.manifolds[0]?.points[0]?.feature, 0xffffffff, 'features have no sign');
  assert.deepEqual([data.rows[2]?.kind, data.rows[2]?.a, data.rows[2]?.joint], ['limit', -1, 4]);
  assert.deepEqual(Array.from(data.iterations[1]?.impulses ?? []), [10, 11, 12]);
  assert.equal(data.iterations[1]?.substep, 1);
  assert.equal(stageData(head(4), staged), null);
});

test('the time of a step and the residual say what they are', () => {
  const instance = new InstanceSource(3, 'instance 3', 'rigor', '#fff');
  instance.push(head(2, { counters: { residual: 1e-5 }, step_seconds: 1.27e-3 }), frame(2));
  const titleOf = (words: RegExp) => instanceParts(instance).find(({ text }) => words.test(text))?.title ?? '';
  assert.match(titleOf(/^1\.27 ms a step$/), /measured in the live process.*not the cost of a step/);
  assert.match(titleOf(/^residual /), /the engine’s own measure: not comparable/);
  instance.push(head(1), frame(1));
  assert.deepEqual(
    instanceParts(instance).map((part) => part.text),
    ['t = 0.1 s', 'step 1'],
    'no time after a step back',
  );
});

test('inside a step the manifolds are the contacts, with the impulses of their rows', () => {
  const instance = new InstanceSource(3, 'instance 3', 'rigor', '#fff');
  instance.push(inStep, staged);
  const { contacts } = instance.newest as Frame;
  assert.equal(contacts?.count, 3);
  assert.deepEqual(Array.from(contacts?.bodyB as Int32Array), [1, 1, 2]);
  assert.deepEqual(Array.from(contacts?.normal as Float64Array), [0, 1, 0, 0, 1, 0, 1, 0, 0]);
  assert.deepEqual(
    Array.from(contacts?.normalImpulse as Float64Array),
    [10, 6, 12],
    'a point without a row keeps its own',
  );
});

test('the newest frame has the lines that the server has drawn of it, and only that', () => {
  const instance = new InstanceSource(3, 'instance 3', 'rigor', '#fff');
  const drawn = (step: number) =>
    bundle(
      { ...numbersAt(step), '3/lines/ends': [0, 0, 0, 0, step, 0], '3/points/at': [] },
      { ...contactNames, '3/lines/names': [1, 0], '3/points/names': [] },
    );
  instance.push(head(1), frame(1));
  assert.equal(instance.newest?.lines, null, 'none were requested');
  instance.push(head(2), drawn(2), ['contact', 'velocity']);
  const { lines } = instance.newest as Frame;
  assert.deepEqual(Array.from(lines?.ends ?? []), [0, 0, 0, 0, 2, 0]);
  assert.deepEqual([lines?.kinds[1], lines?.lineNames[1]], ['velocity', 0]);
  instance.push(head(3), drawn(3), ['contact', 'velocity']);
  assert.deepEqual([instance.frame(1).lines, (instance.newest as Frame).lines?.ends[4]], [null, 3]);
  instance.push(head(3), frame(3));
  assert.equal(instance.times.length, 3);
  assert.equal(instance.newest?.lines, null, 'the same frame again, without lines');
});

test('curves are those of the largest impulses, residuals of nothing are gaps', () => {
  const { rows, data } = curves(stageData(inStep, staged) as StageData);
  assert.deepEqual(rows, [0, 1, 2]);
  assert.deepEqual(data, [
    [0, 1, 2],
    [0.5, 1, 10],
    [1, 2, 11],
    [1.5, 3, 12],
    [null, 0.5, null],
  ]);
  const impulses = Float64Array.from({ length: 30 }, (_, i) => (i % 2 ? i : -i));
  const many = { start: impulses, iterations: [{ substep: 0, residual: 1, impulses }] } as unknown as StageData;
  assert.deepEqual(
    curves(many).rows,
    Array.from({ length: mostCurves }, (_, i) => 30 - mostCurves + i),
  );
});

test('a branch sends only the changes', () => {
  const now = { solver: 'block', slop: '1e-5', friction: 'cone' };
  assert.deepEqual(changes(now, { solver: 'xpbd', slop: '1e-5', friction: '' }), { solver: 'xpbd' });
  assert.deepEqual(overrides(' gravity=[0,-1,0] \n\nbodies.a.mass=2\n'), ['gravity=[0,-1,0]', 'bodies.a.mass=2']);
});

test('keys do what the buttons do', () => {
  const done: string[] = [];
  const actions: KeyActions = {
    send: (command, steps) => done.push(`${command} ${steps ?? ''}`.trim()),
    toggle: () => done.push('toggle'),
    shiftSpeed: (by) => done.push(`speed ${by}`),
    layer: (name) => done.push(name),
    overlay: () => done.push('overlay'),
    frame: () => done.push('frame'),
    help: () => done.push('help'),
  };
  for (const [key, shift] of [
    [' ', false],
    ['ArrowRight', false],
    ['ArrowLeft', true],
    ['s', false],
    ['Home', false],
    ['+', false],
    ['b', false],
    ['o', false],
  ] as const)
    keyAction(key, shift, actions)?.();
  assert.deepEqual(done, ['toggle', 'step 1', 'back 10', 'stage', 'reset', 'speed 1', 'bounds', 'overlay']);
  assert.equal(keyAction('q', false, actions), null);
});

test('a ray meets a plane ahead of it', () => {
  assert.deepEqual(meet({ origin: [0, 0, 5], direction: [0, 0, -1] }, [3, 4, 0], [0, 0, 1]), [0, 0, 0]);
  assert.equal(meet({ origin: [0, 0, 5], direction: [1, 0, 0] }, [0, 0, 0], [0, 0, 1]), null);
  assert.equal(meet({ origin: [0, 0, 5], direction: [0, 0, 1] }, [0, 0, 0], [0, 0, 1]), null, 'behind');
});

/** A view from +z onto the plane z = 0, one pixel a metre. */
function dragger() {
  const sent: (Held | null)[] = [];
  const answers: (() => void)[] = [];
  let camera = true;
  const body = { position: [0, 0, 0, 2, 0, 0], orientation: [1, 0, 0, 0, Math.SQRT1_2, 0, 0, Math.SQRT1_2] };
  const surface = {
    pick: (x: number, y: number) =>
      x < 100 ? ({ body: x < 0 ? 0 : 1, point: [x, y, 0], frame: body } as unknown as Pick) : null,
    aim: (x: number, y: number) => ({ origin: [x, y, 9], direction: [0, 0, -1] }) as const as never,
    set cameraEnabled(on: boolean) {
      camera = on;
    },
  };
  const drag = new Dragger(
    surface,
    (b) => b === 1,
    (held) => {
      sent.push(held);
      return new Promise((resolve) => answers.push(() => resolve(null)));
    },
  );
  const answer = async () => {
    answers.shift()?.();
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { drag, sent, answer, cameraIsOn: () => camera };
}

test('a drag holds a point of the body and sends the last place alone', async () => {
  const { drag, sent, answer } = dragger();
  assert.equal(drag.take(-5, 0), false, 'that one does not move');
  assert.equal(drag.take(200, 0), false, 'nothing there');
  assert.equal(drag.take(3, 0), true);
  const point = drag.held?.point as number[];
  assert.ok(Math.abs((point[0] as number) - 0) < 1e-12 && Math.abs((point[1] as number) + 1) < 1e-12, 'turned by 90°');
  for (let x = 4; x < 50; ++x) drag.move(x, 7);
  assert.equal(sent.length, 1, 'one question at a time');
  await answer();
  assert.equal(sent.length, 2);
  assert.deepEqual(sent[1]?.target, [49, 7, 0], 'what was between is left out');
  drag.release();
  await answer();
  assert.equal(sent.at(-1), null, 'let go');
  assert.equal(sent.length, 3);
  drag.move(60, 0);
  await answer();
  assert.equal(sent.length, 3);
});
