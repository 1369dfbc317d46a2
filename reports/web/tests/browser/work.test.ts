// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The work that a replay gives a browser which draws in software, counted: none while it stands still; while it plays a few
// calls a picture, none of which fills it; the shaded ground once it rests.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { drawn, makeRunOf, open, sharedBrowser, skip, type Watched, watched } from '../browser.ts';

interface Work {
  draws: number;
  planes: number; // draws of two triangles: the shaded ground
  clears: number; // clears with depth: one begins a frame
}

describe('the work of a replay in software', { skip }, () => {
  let it: Watched;
  let pictures = 0;
  before(async () => {
    it = await watched(await sharedBrowser());
    await it.page.addInitScript(() => {
      const work = { draws: 0, planes: 0, clears: 0 };
      const gl = WebGL2RenderingContext.prototype;
      const { drawElements, drawArrays, clear } = gl;
      gl.drawElements = function (mode, count, type, offset) {
        ++work.draws;
        if (mode === gl.TRIANGLES && count === 6) ++work.planes;
        drawElements.call(this, mode, count, type, offset);
      };
      gl.drawArrays = function (mode, first, count) {
        ++work.draws;
        drawArrays.call(this, mode, first, count);
      };
      gl.clear = function (mask) {
        if (mask & gl.DEPTH_BUFFER_BIT) ++work.clears;
        clear.call(this, mask);
      };
      (globalThis as unknown as { work: Work }).work = work;
    });
    const run = makeRunOf('ground', 'bouncing_ball', '--engines', 'rigor,bullet', '--no-audit');
    await open(it.page, run, '#/scenario/bouncing_ball');
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    pictures = await it.page.locator('.replay .label').count();
    assert.ok(pictures >= 2);
  });
  after(() => it?.close());

  const since = async (): Promise<Work> =>
    it.page.evaluate(() => {
      const { work } = globalThis as unknown as { work: Work };
      const now = { ...work };
      work.draws = work.planes = work.clears = 0;
      return now;
    });
  /** Until the shaded ground was drawn: in each of the pictures. */
  const rests = () =>
    it.page.waitForFunction((n) => (globalThis as unknown as { work: Work }).work.planes >= n, pictures, {
      polling: 50,
    });

  test('a picture at rest has the shaded ground, and is not drawn again', async () => {
    await rests();
    await since();
    for (let k = 0; k < 5; ++k) await drawn(it.page);
    assert.deepEqual(await since(), { draws: 0, planes: 0, clears: 0 });
  });

  test('a picture that plays has few calls, and none fills it', async () => {
    await it.page.locator('.replay canvas').focus();
    await since();
    await it.page.keyboard.press(' ');
    await it.page.waitForFunction(() => (globalThis as unknown as { work: Work }).work.clears >= 5);
    const { draws, planes, clears } = await since();
    await it.page.keyboard.press(' ');
    assert.equal(planes, 0, 'the ground is lines while it plays');
    // A picture has faces, edges, those of the reference, lines of the ground, and stems, heads and dots of contacts.
    assert.ok(draws <= 7 * pictures * clears, `${draws} calls in ${clears} frames`);
    await rests();
    assert.deepEqual(it.faults, []);
  });

  test('the canvas is cleared once a frame', async () => {
    await since();
    await it.page.keyboard.press('ArrowRight');
    await it.page.waitForFunction(() => (globalThis as unknown as { work: Work }).work.draws > 0);
    const { clears, draws } = await since();
    assert.equal(clears, 1, `${clears} clears with depth for ${draws} calls`);
  });
});
