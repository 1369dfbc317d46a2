// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The live view in a browser: what a person does with it, and whether what is shown is what the engine says.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { ArrayBundle } from '../../src/common/arrays.ts';
import type { News } from '../../src/live/api.ts';
import { drawn, sharedBrowser, skip } from '../browser.ts';
import { shoot, view, watched } from '../live_program.ts';

const binaries = process.env.RIGOR_BINARY_DIR ?? '';
let browser: Browser;
const saved = mkdtempSync(join(tmpdir(), 'rigor-live-'));

before(async () => {
  if (!skip) browser = await sharedBrowser();
});
after(() => rmSync(saved, { recursive: true, force: true }));

/** Current state of the server, requested by the page itself. */
async function now(page: Page): Promise<News> {
  const numbers = await page.evaluate(async () => {
    const answer = await fetch('/api/frames?after=0&wait=0');
    return Array.from(new Uint8Array(await answer.arrayBuffer()));
  });
  const arrays = new ArrayBundle(Uint8Array.from(numbers).buffer);
  return { ...(arrays.meta as Omit<News, 'arrays'>), arrays };
}

const instance = (id: number) => `[data-panel="instances"] [data-instance="${id}"]`;
const clock = (page: Page) => page.locator('.clock').innerText();
const ready = (page: Page, id: number) => page.waitForSelector(`${instance(id)}[data-state="ready"]`);
const numberOf = (text: string) => Number(text.replace('−', '-'));

/** A point of the page where a body of this name is seen. */
async function findBody(page: Page, name: string): Promise<[number, number]> {
  const box = (await page.locator('canvas').boundingBox()) as { x: number; y: number; width: number; height: number };
  for (let j = 1; j < 24; ++j)
    for (let i = 1; i < 24; ++i) {
      const [x, y] = [box.x + (box.width * i) / 24, box.y + (box.height * j) / 24];
      await page.mouse.move(x, y);
      await drawn(page);
      const text = await page.locator('.inspector [data-quantity="body"]').allInnerTexts();
      if (text[0]?.startsWith(name)) return [x, y];
    }
  throw new Error(`${name} is nowhere to be seen`);
}

test('a person plays, looks inside a step, drags, branches and saves', { skip }, async (t) => {
  const program = await view(['slide_and_stop', '--engines', 'rigor', '--save-to', saved]);
  t.after(() => program.end());
  const { page, context, faults } = await watched(browser, program);
  await page.goto(program.url);
  await page.waitForSelector('canvas');
  await ready(page, 0);
  assert.ok(!page.url().includes('token'), 'the token is gone from the address');

  await t.test('steps forwards and back', async () => {
    await page.click('[data-action="step"]');
    await page.waitForFunction(() => document.querySelector('.clock')?.textContent === '0.0166667 s');
    await page.keyboard.press('Shift+ArrowRight');
    await page.waitForFunction(() => document.querySelector('.clock')?.textContent === '0.183333 s');
    const time = page.locator('.where').first().locator('span', { hasText: 'a step' });
    assert.match((await time.getAttribute('title')) ?? '', /measured in the live process/);
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => document.querySelector('.clock')?.textContent === '0.166667 s');
    await page.waitForFunction(() => document.querySelector('.where')?.textContent?.includes('step 10'));
    assert.equal(await time.count(), 0, 'the time of steps that were taken back is gone');
  });

  await t.test('shows the numbers of the engine', async () => {
    await page.waitForFunction(() => document.querySelector('.where')?.textContent?.includes('step 10'));
    await findBody(page, 'block');
    const shown = await page.locator('.inspector [data-quantity="position"]').innerText();
    const { arrays } = await now(page);
    const exact = Array.from(arrays.get('0/position').slice(3, 6));
    shown
      .replace(' m', '')
      .split(', ')
      .map(numberOf)
      .forEach((value, k) => {
        assert.ok(Math.abs(value - (exact[k] as number)) <= 1e-6 * Math.abs(value) + 1e-12, `${shown}: ${exact}`);
      });
  });

  await t.test('draws the lines that the server has drawn', async () => {
    for (const key of ['v', 'i', 'u', 'b', 'a']) await page.keyboard.press(key); // a: arrows to the scale of this frame
    const layers = ['velocities', 'impulses', 'islands', 'bounds'];
    for (const name of layers) await page.waitForSelector(`[data-switch="${name}"][aria-pressed="true"]`);
    const lines = 'lines=contact,normal,impulse,velocity,joint,box,island';
    const numbers = await page.evaluate(async (query) => {
      const answer = await fetch(`/api/frames?after=0&wait=0&${query}`);
      return Array.from(new Uint8Array(await answer.arrayBuffer()));
    }, lines);
    const sent = new ArrayBundle(Uint8Array.from(numbers).buffer);
    const kinds = (sent.meta as News).line_kinds;
    const ends = Array.from(sent.get('0/lines/ends'));
    const kindOf = (i: number) => kinds[sent.get('0/lines/names')[2 * i] as number] as string;
    const plain: number[] = [];
    const arrows: number[][] = [];
    for (let i = 0; 6 * i < ends.length; ++i) {
      const line = ends.slice(6 * i, 6 * i + 6);
      if (['normal', 'impulse', 'velocity'].includes(kindOf(i))) arrows.push(line);
      else if (kindOf(i) !== 'box') plain.push(...line);
    }
    for (let i = 0; 6 * i < ends.length; ++i) if (kindOf(i) === 'box') plain.push(...ends.slice(6 * i, 6 * i + 6));
    assert.ok(arrows.length > 2 && plain.length > 6 * 12, 'arrows, boxes and islands');
    type Shown = { lines: number[]; dots: number[]; arrows: { from: number[]; to: number[] }[] };
    await page.waitForFunction((count) => {
      const root = document.querySelector('.live-picture') as unknown as {
        picture: { view: { drawn: (of: string) => Shown } };
      };
      return root.picture.view.drawn('instance 0').lines.length === count;
    }, plain.length);
    const shown = await page.evaluate(() => {
      const root = document.querySelector('.live-picture') as unknown as {
        picture: { view: { drawn: (of: string) => Shown } };
      };
      return root.picture.view.drawn('instance 0');
    });
    const near = (a: number[], b: number[], what: string) => {
      assert.equal(a.length, b.length, what);
      for (const [k, v] of a.entries())
        assert.ok(Math.abs(v - (b[k] as number)) < 1e-5 * (1 + Math.abs(v)), `${what}: ${v}, ${b[k]}`);
    };
    near(shown.lines, plain, 'boxes and islands');
    near(shown.dots, Array.from(sent.get('0/points/at')), 'contact points');
    assert.equal(shown.arrows.length, arrows.length);
    shown.arrows.forEach(({ from, to }, i) => {
      const line = arrows[i] as number[];
      near(from, line.slice(0, 3), 'where an arrow begins');
      const length = (v: number[]) => Math.hypot(...v);
      const [sentWay, way] = [
        line.slice(3).map((v, k) => v - (line[k] as number)),
        to.map((v, k) => v - (from[k] as number)),
      ];
      near(
        way.map((v) => v / length(way)),
        sentWay.map((v) => v / length(sentWay)),
        'where it points',
      );
    });
    await shoot(page, 'live-lines');
    for (const key of ['v', 'i', 'u', 'b']) await page.keyboard.press(key);
  });

  await t.test('stops inside the step', async () => {
    for (const stage of ['broad_phase', 'narrow_phase', 'rows', 'velocities', 'solve']) {
      await page.keyboard.press('s');
      await page.waitForSelector(`[data-stage="${stage}"][aria-current="step"]`);
    }
    const { arrays, frames } = await now(page);
    assert.equal(frames[0]?.stage.done, 'solve');
    const rows = arrays.get('0/rows/impulse');
    const part = page.locator('[data-part="Rows"]');
    assert.equal(await part.locator('tbody tr').count(), rows.length);
    const impulse = numberOf(await part.locator('tbody tr td').nth(2).innerText());
    assert.ok(Math.abs(impulse - (rows[0] as number)) <= 1e-4 * Math.abs(impulse));
    assert.ok(await page.locator('.impulses canvas').isVisible());
    await page.click('[data-part="Manifolds"] summary');
    await page.waitForSelector('[data-part="Manifolds"] tbody tr');
    await shoot(page, 'live-stages');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.querySelector('.clock')?.textContent === '0.183333 s');
  });

  await t.test('branches with another solver and other gravity', async () => {
    await page.click(`${instance(0)} [data-action="branch"]`);
    await page.selectOption('dialog select[name="solver"]', 'xpbd');
    await page.fill('dialog textarea', 'gravity=[0,-1.6,0]');
    await shoot(page, 'live-branch');
    await page.click('[data-action="branch-now"]');
    await ready(page, 1);
    const text = await page.locator(instance(1)).innerText();
    assert.match(text, /solver=xpbd/);
    assert.match(text, /branch of instance 0, from step 11/);
    await page.keyboard.press(' ');
    await page.waitForFunction(() => Number.parseFloat(document.querySelector('.clock')?.textContent ?? '') > 0.6);
    await page.keyboard.press(' ');
    await page.waitForSelector('[data-action="play"][aria-pressed="false"]');
    const { arrays } = await now(page);
    assert.notEqual(arrays.get('0/position')[3], arrays.get('1/position')[3], 'the branch slides farther');
    await shoot(page, 'live-beside');
  });

  await t.test('a body follows the pointer', async () => {
    await page.click(`${instance(1)} [data-action="remove"]`);
    await page.waitForFunction(
      () => document.querySelectorAll('[data-panel="instances"] [data-instance]').length === 1,
    );
    await page.keyboard.press('a');
    const [x, y] = await findBody(page, 'block');
    const from = (await now(page)).arrays.get('0/position')[4] as number;
    await page.keyboard.press(' ');
    await page.mouse.down();
    await page.mouse.move(x, y - 40, { steps: 5 });
    await page.mouse.move(x, y - 90, { steps: 5 });
    await page.waitForSelector('svg.spring line', { state: 'attached' });
    const end = Date.now() + 30_000;
    const height = async () => (await now(page)).arrays.get('0/position')[4] as number;
    while ((await height()) <= from + 0.05) assert.ok(Date.now() < end, 'it is lifted');
    await shoot(page, 'live-drag');
    await page.mouse.up();
    await page.waitForFunction(() => document.querySelector('svg.spring line') === null);
    await page.keyboard.press(' ');
    await page.waitForSelector('[data-action="play"][aria-pressed="false"]');
  });

  await t.test('saves a scenario that every command takes', async () => {
    await page.click(`${instance(0)} [data-action="save"]`);
    await page.waitForFunction(() => document.querySelector('.said')?.textContent?.startsWith('Saved as'));
    const file = /^Saved as (.*\.json)\./.exec(await page.locator('.said').innerText())?.[1] as string;
    assert.ok(file.startsWith(saved));
    execFileSync(join(binaries, 'bin/rigor'), ['check', file]);
  });

  await t.test('the address restores the view', async () => {
    await page.keyboard.press('o');
    await page.keyboard.press('v');
    await page.waitForFunction(() => location.hash.includes('over'));
    const before = await clock(page);
    await page.reload();
    await page.waitForSelector('canvas');
    await page.waitForSelector('[data-switch="velocities"][aria-pressed="true"]');
    await page.waitForSelector('[data-mode="overlaid"][aria-pressed="true"]');
    assert.equal(await clock(page), before, 'and the session went on without the page');
  });

  await t.test('no other client is let in', async () => {
    const stranger = await browser.newContext();
    const other = await stranger.newPage();
    assert.equal((await other.goto(program.url))?.status(), 403);
    assert.equal((await other.goto(`${program.origin}/`))?.status(), 403);
    await stranger.close();
  });

  assert.deepEqual(faults, []);
  await context.close();
});

test('an engine that crashes says so, and the other plays on', { skip }, async (t) => {
  const path = `${join(binaries, 'bin/adapters')}:${join(binaries, 'tests/doubles')}`;
  const program = await view(['free_flight', '--engines', 'double_abort,rigor'], { RIGOR_ADAPTER_PATH: path });
  t.after(() => program.end());
  const { page, context, faults } = await watched(browser, program);
  await page.goto(program.url);
  await ready(page, 1);
  await page.keyboard.press(' ');
  await page.waitForSelector(`${instance(0)}[data-state="crashed"]`);
  assert.match(await page.locator(`${instance(0)} .why`).innerText(), /SIGABRT/);
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('.clock')?.textContent ?? '') > 0.5);
  await page.keyboard.press(' ');
  await shoot(page, 'live-crashed');
  assert.deepEqual(faults, []);
  await context.close();
});

test('another scenario in two dimensions, and the end of the server', { skip }, async (t) => {
  const program = await view(['box_stack', '--engines', 'rigor']);
  t.after(() => program.end());
  const { page, context, faults } = await watched(browser, program);
  await page.goto(program.url);
  await page.waitForSelector('canvas');
  await page.selectOption('header select', 'box_stack_2d');
  await page.waitForFunction(() => document.querySelector('.about')?.textContent?.startsWith('box_stack_2d'));
  await page.waitForFunction(() => document.querySelector('.where')?.textContent?.includes('step 0'));
  await page.keyboard.press('b');
  await page.keyboard.press('Shift+ArrowRight');
  await page.waitForFunction(() => document.querySelector('.where')?.textContent?.includes('step 10'));
  await shoot(page, 'live-2d');
  assert.deepEqual(faults, []);
  assert.equal(await program.end(), 0);
  await page.waitForFunction(() => document.querySelector('.ended')?.textContent?.includes('has ended'));
  await context.close();
});
