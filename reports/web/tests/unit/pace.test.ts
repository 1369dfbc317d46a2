// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { BoxGeometry } from 'three';
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

test('copies of a geometry have its vertices, its triangles, and their number', () => {
  const one = new BoxGeometry(1, 2, 3);
  const three = repeated(one, 3);
  const vertices = one.getAttribute('position').count;
  assert.equal(three.getAttribute('position').count, 3 * vertices);
  const [first, last] = [one, three].map((g) => [...(g.index?.array ?? [])].slice(-3));
  assert.deepEqual(
    last,
    first?.map((i) => i + 2 * vertices),
  );
  const which = three.getAttribute('which');
  assert.deepEqual(
    [0, vertices - 1, vertices, 3 * vertices - 1].map((i) => which.getX(i)),
    [0, 0, 1, 2],
  );
  for (const k of [0, 1, 2])
    assert.equal(three.getAttribute('normal').array[3 * vertices + k], one.getAttribute('normal').array[k]);
});
