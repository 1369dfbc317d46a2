// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CodeReader } from '../../src/replay/codec.ts';
import { indexAt } from '../../src/replay/frames.ts';
import { fullSource } from '../../src/replay/full_frames.ts';
import { readReplay, spacing } from '../../src/replay/replay_file.ts';
import { bundleOf, linkedCodes, seriesCodes } from '../replay_bytes.ts';

test('series read back within half a quantum, what is not finite stays so', () => {
  const values = [0.1, 2.5, Number.NaN, -1e6, 3.25, 3.5, Number.POSITIVE_INFINITY, 1e9];
  for (const quantum of [2 ** -20, 0.5]) {
    const out = new Float64Array(values.length);
    new CodeReader(seriesCodes(values, quantum)).series(values.length, quantum, out);
    values.forEach((v, i) => {
      if (Number.isFinite(v)) assert.ok(Math.abs((out[i] as number) - v) <= quantum / 2, `${i}`);
      else assert.ok(Number.isNaN(out[i]));
    });
  }
});

test('columns go to their places', () => {
  const reader = new CodeReader([...seriesCodes([1, 2, 3], 1), ...seriesCodes([7, 7, 9], 1)]);
  const out = new Float32Array(9).fill(-1);
  reader.series(3, 1, out, 0, 3);
  reader.series(3, 1, out, 2, 3);
  assert.deepEqual([...out], [1, -1, 7, 2, -1, 7, 3, -1, 9]);
});

test('linked values are predicted by those they name', () => {
  const values = [5, 100, 6, 101, Number.NaN, 102];
  const previous = [-1, -1, 0, 1, 2, 3];
  const out = new Float64Array(6);
  new CodeReader(linkedCodes(values, previous, 0.25)).linked(previous, 0.25, out);
  assert.deepEqual([...out].map(String), values.map(String));
});

test('data that ends early is an error, not zeros', () => {
  assert.throws(() => new CodeReader([129]).difference(), RangeError);
  assert.throws(() => new CodeReader(seriesCodes([1, 2], 1)).series(3, 1, new Float64Array(3)), RangeError);
});

test('indexAt finds the frame that is shown', () => {
  const times = [0, 0.1, 0.2, 0.30000000000000004];
  assert.equal(indexAt(times, -1), 0);
  assert.equal(indexAt(times, 0.0999), 0);
  assert.equal(indexAt(times, 0.1), 1);
  assert.equal(indexAt(times, 0.3), 3, 'a rounded time is still that time');
  assert.equal(indexAt(times, 9), 3);
  assert.equal(indexAt([0], 5), 0);
});

test('the usual distance of frames', () => {
  assert.equal(spacing([0, 4, 8, 9, 12, 16, 20]), 4);
  assert.equal(spacing([0]), 1);
});

/** Two bodies, the second one moves; three frames, contacts in the last. */
function file(): ArrayBuffer {
  const quantum = { position: 0.001, orientation: 0.0001, velocity: 0.01, angularVelocity: 0.01 };
  const contactQuantum = { point: 0.001, offset: 0.0001, normal: 0.001, depth: 0.0001, impulse: 0.01 };
  const numbers = [1, 2, 3, 0, -0.002, 0, 0, 1, 0, 0.002, Number.NaN, 0.1, 0.2, 0.3];
  const quanta = [0.001, 0.001, 0.001, 0.0001, 0.0001, 0.0001, 0.001, 0.001, 0.001, 0.0001, 0.01, 0.01, 0.01, 0.01];
  const columns = (rows: number[][], q: number) => rows.flatMap((row) => seriesCodes(row, q));
  return bundleOf(
    {
      kind: 'replay',
      scenario: 's',
      dt: 0.5,
      bodies: ['floor', 'ball'],
      reference: null,
      cases: [
        {
          id: 'x',
          spec: 'ode:preset=matched',
          engine: 'ode',
          label: 'ode matched',
          outcome: 'non_finite',
          reason: 'ball',
          frames: 3,
          stored: 9,
          stride: 1,
          moving: [1],
          quantum,
          turns: true,
          velocities: false,
          contacts: 1,
          contactQuantum,
          events: [{ time: 1, kind: 'largest', what: 'position_max' }],
        },
        { id: 'y', spec: 'b', engine: 'b', label: 'b', outcome: 'crashed', reason: 'SIGSEGV', frames: 0 },
      ],
    },
    {
      first: Float64Array.from([9, 8, 7, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]),
      '0.steps': Uint8Array.from(seriesCodes([0, 2, 4], 1)),
      '0.position': Uint8Array.from(
        columns(
          [
            [1, 2, 4],
            [0, Number.NaN, 0],
            [0, 0, -1],
          ],
          0.001,
        ),
      ),
      '0.orientation': Uint8Array.from(
        columns(
          [
            [1, 1, 1],
            [0, 0, 0],
            [0, 0, 0],
            [0, 0, 0],
          ],
          0.0001,
        ),
      ),
      '0.contactCounts': Uint8Array.from(seriesCodes([-1, 0, 1], 1)),
      '0.contactIds': Uint8Array.from([0, 1, 0, 2].flatMap((id) => linkedCodes([id], [-1], 1))),
      '0.contactNumbers': Uint8Array.from(numbers.flatMap((v, k) => linkedCodes([v], [-1], quanta[k] as number))),
    },
  );
}

test('a replay file gives sources with frames, contacts, events and what is missing', () => {
  const { sources, reference } = readReplay(file(), (spec) => (spec ? 'red' : 'grey'));
  assert.equal(reference, null);
  const [ode, crashed] = sources;
  assert.ok(ode && crashed);
  assert.deepEqual([...ode.times], [0, 1, 2]);
  assert.equal(ode.note, 'non finite: ball, every 2 steps');
  assert.equal(ode.events[0]?.what, 'position_max');
  const last = ode.frame(2);
  assert.equal(last.step, 4);
  assert.deepEqual([...(last.position as Float32Array)], [9, 8, 7, 4, 0, -1], 'still bodies keep their first pose');
  assert.ok(Number.isNaN(ode.frame(1).position[4]));
  assert.equal(last.velocity, null);
  assert.equal(ode.frame(0).contacts, null, 'not stored is not the same as none');
  assert.equal(ode.frame(1).contacts?.count, 0);
  const c = last.contacts;
  assert.ok(c);
  assert.deepEqual([c.bodyA[0], c.bodyB[0], c.shapeA[0], c.shapeB[0]], [0, 1, 0, 2]);
  assert.equal(c.instant, undefined, 'of the frame');
  assert.ok(Math.abs((c.pointB[1] as number) - 1.998) < 1e-6);
  assert.ok(Math.abs((c.depth[0] as number) - 0.002) < 1e-6);
  assert.ok(Number.isNaN(c.normalImpulse[0]));
  assert.ok(Math.abs((c.frictionImpulse[2] as number) - 0.3) < 1e-6);
  assert.equal(ode.frame(2), last, 'the same frame is not made twice');
  assert.throws(() => ode.frame(3), RangeError);
  assert.equal(crashed.times.length, 0);
  assert.equal(crashed.note, 'crashed: SIGSEGV');
});

test('a file that is cut off is refused', () => {
  assert.throws(() => readReplay(file().slice(0, -40), () => ''), RangeError);
});

test('all frames of a trajectory arrive in parts', async () => {
  const frames = 5;
  const part = (from: number, count: number, instants = false) => {
    const at = (columns: number) =>
      Float64Array.from({ length: count * columns }, (_, i) => 10 * (from + Math.floor(i / columns)) + (i % columns));
    const touching = [2, 2, 4].filter((f) => f >= from && f < from + count);
    const n = touching.length;
    const ids = (k: number) => Int32Array.from({ length: n }, () => k);
    const three = (k: number) => Float64Array.from({ length: 3 * n }, (_, i) => k + (i % 3));
    return bundleOf(
      { dt: 0.1, stride: 2, contact_stride: 2, contact_instants: instants, frames, from, count, bodies: ['a'] },
      {
        time: Float64Array.from({ length: count }, (_, i) => (from + i) * 0.2),
        position: at(3),
        orientation: at(4),
        velocity: at(3),
        angular_velocity: at(3),
        'contacts/frame': Int32Array.from(touching),
        'contacts/body_a': ids(0),
        'contacts/body_b': ids(1),
        'contacts/shape_a': ids(2),
        'contacts/shape_b': ids(3),
        'contacts/point_a': three(0),
        'contacts/point_b': three(5),
        'contacts/normal': three(7),
        'contacts/depth': Float64Array.from({ length: n }, () => 0.5),
        'contacts/normal_impulse': Float64Array.from({ length: n }, () => Number.NaN),
        'contacts/friction_impulse': three(9),
      },
    );
  };
  const look = { label: 'x', spec: 'x', colour: '', ghost: false, note: 'timeout, every 7 steps', events: [] };
  const requested: number[] = [];
  const source = await fullSource(look, async (from) => {
    requested.push(from);
    return part(from, Math.min(2, frames - from));
  });
  assert.deepEqual(requested, [0, 2, 4]);
  assert.equal(source.note, 'timeout, every 2 steps');
  assert.equal(source.times.length, frames);
  assert.deepEqual([...(source.frame(3).position as Float64Array)], [30, 31, 32]);
  assert.equal(source.frame(3).step, 6);
  assert.equal(source.frame(1).contacts, null);
  assert.equal(source.frame(0).contacts?.count, 0);
  const c = source.frame(2).contacts;
  assert.ok(c);
  assert.equal(c.count, 2);
  assert.deepEqual([...(c.pointB as Float32Array)].slice(0, 3), [5, 6, 7]);
  assert.equal(source.frame(4).contacts?.count, 1);
  assert.match(c.instant ?? '', /does not name/, 'of an older file');
  const known = await fullSource(look, async (from) => part(from, frames - from, true));
  assert.equal(known.frame(2).contacts?.instant, undefined);
  await assert.rejects(fullSource(look, async (from) => part(from, 0)));
});
