// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { BoxGeometry, type BufferGeometry } from 'three';
import { Pace } from '../../src/replay/pace.ts';
import { repeated } from '../../src/replay/repeated.ts';

/** The ratio after frames that are so far apart [ms]. */
function ratioAfter(pace: Pace, frames: number, gap: number, from: number): number {
  let ratio = 1;
  for (let i = 0; i <= frames; ++i) ratio = pace.ratioAt(from + gap * i);
  return ratio;
}

test('slow frames get fewer pixels, quick ones all of them, pauses change nothing', () => {
  const pace = new Pace();
  assert.equal(ratioAfter(pace, 5, 80, 0), 1, 'not before some frames have come');
  assert.ok(ratioAfter(pace, 12, 80, 10_000) < 1);
  assert.equal(ratioAfter(pace, 60, 80, 20_000), 0.5, 'never below a half');
  assert.equal(ratioAfter(pace, 30, 2_000, 30_000), 0.5);
  assert.equal(ratioAfter(pace, 60, 16, 200_000), 1);
  assert.equal(ratioAfter(pace, 60, 33, 300_000), 1, '30 frames in a second are enough');
});

test('copies of several geometries are one, with their vertices, their triangles, and their number', () => {
  const box = new BoxGeometry(1, 2, 3);
  const loose = new BoxGeometry(3, 2, 1).toNonIndexed();
  const all = repeated([
    { geometry: box, count: 2 },
    { geometry: loose, count: 3 },
  ]);
  const counts = [box, loose].map((g) => g.getAttribute('position').count) as [number, number];
  const total = 2 * counts[0] + 3 * counts[1];
  const which = all.getAttribute('which');
  assert.equal(which.count, total);
  const owners = [0, 1, 2, 3, 4].flatMap((copy) => new Array(counts[copy < 2 ? 0 : 1]).fill(copy));
  assert.deepEqual([...which.array], owners);
  // Corner by corner the triangles are those of the geometries, one copy after the other.
  const corners = (g: BufferGeometry) => {
    const at = g.getAttribute('position');
    const normal = g.getAttribute('normal');
    const order = g.index ? [...g.index.array] : Array.from({ length: at.count }, (_, i) => i);
    return order.map((i) => [at.getX(i), at.getY(i), at.getZ(i), normal.getX(i), normal.getY(i), normal.getZ(i)]);
  };
  assert.deepEqual(corners(all), [box, box, loose, loose, loose].flatMap(corners));
  const drawn = [...(all.index?.array ?? [])].map((i) => which.getX(i));
  assert.deepEqual(
    drawn,
    [...drawn].sort((a, b) => a - b),
  );
});
