// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { angleBetween, type ContactFinding, nearestExact, type Point, placeOf } from '../../src/common/finding.ts';
import { arc, degrees, findingNotes, lengthText, type Note } from '../../src/replay/finding_overlay.ts';
import type { Frame, FrameSource } from '../../src/replay/frames.ts';
import { Measure } from '../../src/replay/measure.ts';
import { noteHeight, placedNotes } from '../../src/replay/notes_layout.ts';

const finding: ContactFinding = {
  what: 'normal',
  error: Math.PI / 6,
  unit: 'rad',
  time: 0.5,
  step: 30,
  bodies: [0, 1],
  names: ['floor', 'box'],
  shapes: [0, 0],
  contact: 2,
  said: { normal: [0, 1, 0], depth: 0.002, pointA: [1, 0, 0], pointB: [1, -0.002, 0] },
  exact: {
    distance: -0.003,
    normals: [
      [1, 0, 0],
      [0.5, Math.sqrt(0.75), 0],
    ],
    pointA: [2, 0, 0],
    pointB: [2, -0.003, 0],
  },
};

test('of several exact normals the nearest is the one that counts', () => {
  assert.deepEqual(nearestExact(finding), finding.exact?.normals[1]);
  assert.deepEqual(nearestExact({ ...finding, said: null }), [1, 0, 0]);
  assert.equal(nearestExact({ ...finding, exact: null }), null);
  assert.deepEqual(placeOf(finding), [1, -0.001, 0], 'between the points of the engine');
  assert.deepEqual(placeOf({ ...finding, said: null }), [2, -0.0015, 0], 'else between the exact ones');
});

test('the arc between two normals has their angle and its radius', () => {
  const at = [3, 4, 5] as [number, number, number];
  const points = arc(at, [0, 1, 0], [1, 0, 0], 0.5, 8);
  assert.equal(points.length, 9);
  const directions = points.map((p) => p.map((x, k) => x - (at[k] as number)) as [number, number, number]);
  for (const d of directions) assert.ok(Math.abs(Math.hypot(...d) - 0.5) < 1e-12);
  assert.ok(Math.abs(angleBetween(directions[0] as never, directions[4] as never) - Math.PI / 4) < 1e-12);
  assert.deepEqual(arc(at, [0, 1, 0], [0, 1, 0], 1), [], 'the same normal');
});

test('the notes say the angle, or both depths, or that there is no contact', () => {
  const texts = (f: ContactFinding) => findingNotes(f, 1).map((n) => n.text);
  assert.deepEqual(texts(finding), ['engine', 'exact', '30°']);
  assert.deepEqual(texts({ ...finding, what: 'depth' }), ['engine', 'exact', 'depth 2 mm, exact 3 mm']);
  assert.deepEqual(texts({ ...finding, what: 'missed', said: null }), ['exact', 'no contact of the engine']);
  const apart = {
    ...finding,
    what: 'depth' as const,
    exact: { ...(finding.exact as NonNullable<typeof finding.exact>), distance: 0.5 },
  };
  assert.equal(
    texts({ ...apart, said: { ...(finding.said as NonNullable<typeof finding.said>), depth: -0.4 } })[2],
    'distance 0.4 m, exact 0.5 m',
  );
});

test('lengths and angles are short', () => {
  assert.deepEqual([0, 5e-5, 0.01234567, 2.5].map(lengthText), ['0 mm', '50 µm', '12.35 mm', '2.5 m']);
  assert.deepEqual([0, 1e-12, Math.PI / 2].map(degrees), ['0°', '0°', '90°']);
});

test('a measured point stays with its body', () => {
  const frame = (x: number): Frame => ({
    time: x,
    step: 0,
    position: [x, 0, 0, 0, 0, 0],
    orientation: [Math.SQRT1_2, 0, 0, Math.SQRT1_2, 1, 0, 0, 0], // a quarter turn about z
    velocity: null,
    angularVelocity: null,
    contacts: null,
  });
  const source = {} as FrameSource;
  const measure = new Measure();
  assert.equal(
    measure.at(() => frame(0)),
    null,
  );
  measure.add(source, frame(0), 0, [0, 1, 0]);
  measure.add(source, frame(0), 1, [0, 0, 0]);
  const text = (x: number) => measure.at(() => frame(x))?.notes.find((n) => n.kind === 'measure')?.text;
  assert.equal(text(0), '1 m');
  assert.equal(text(1), '1.414 m', 'the first body has moved');
  measure.add(source, frame(0), 1, [1, 0, 0]);
  assert.equal(measure.at(() => frame(0))?.notes.find((n) => n.kind === 'angle')?.text, '90°');
  measure.add(source, frame(0), 1, [2, 0, 0]);
  assert.equal(measure.count, 1, 'a fourth point begins anew');
});

test('texts over the picture never cover each other and stay in their panel', () => {
  const source = {} as FrameSource;
  const panel = { rect: { x: 100, y: 0, width: 300, height: 200 }, sources: [source] };
  const view = { panels: [panel], project: (_: unknown, [x, y]: Point) => [x, y] as [number, number] };
  const note = (x: number, y: number, text: string, kind: 'engine' | 'exact' | 'angle'): Note => ({
    at: [x, y, 0],
    text,
    kind,
  });
  const notes = [note(250, 100, 'bullet', 'engine'), note(240, 103, 'exact', 'exact'), note(246, 99, '9.23°', 'angle')];
  const close = [note(395, 50, 'exact', 'exact'), note(90, 50, 'outside', 'angle')];
  const placed = placedNotes(view as never, [{ source, notes: [...notes, ...close] }], (text) => 8 * text.length);
  assert.deepEqual(
    placed.map((p) => p.text),
    ['bullet', 'exact', '9.23°', 'exact'],
  );
  for (const a of placed)
    for (const b of placed)
      if (a !== b)
        assert.ok(
          a.left + a.width <= b.left || b.left + b.width <= a.left || Math.abs(a.top - b.top) >= noteHeight,
          `${a.text} covers ${b.text}`,
        );
  assert.ok(placed.every((p) => p.left >= 100 && p.left + p.width <= 400));
  assert.ok(Math.abs((placed[0]?.top ?? 0) + noteHeight / 2 - 100) < 1, 'the first one stays at its point');
});
