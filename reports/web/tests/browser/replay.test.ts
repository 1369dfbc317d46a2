// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The replay in the report of a real run: plays, steps, scrubs, jumps, switches; shows the numbers that the engine gave;
// a link restores the view; screenshots of several scenes.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { drawn, open, reportOf, screenshots, skip, smokeRun, watched } from '../browser.ts';

const scenarios = ['box_stack', 'asymmetric_top', 'pendulum_chain', 'slip_to_roll_2d', 'bouncing_disc_2d'];

/** State of a body at a step, from a run of its own: t, body, px, py, pz, qw, ... */
function stateOf(scenario: string, spec: string, body: string, step: number): number[] {
  const folder = mkdtempSync(join(tmpdir(), 'rigor-replay-'));
  const file = join(folder, 'states.csv');
  const program = join(process.env.RIGOR_BINARY_DIR ?? '', 'bin/rigor');
  try {
    execFileSync(program, ['run', scenario, '--engine', spec, '--csv', file], { stdio: 'ignore' });
    const rows = readFileSync(file, 'utf8').trim().split('\n').slice(1);
    const own = rows.map((line) => line.split(',')).filter((cells) => cells[1] === body);
    return (own[step] as string[]).map(Number);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

describe('the replay of a real run', { skip }, () => {
  const it = reportOf(smokeRun);
  const show = async (scenario: string, more = '') => {
    await it.open(`#/scenario/${scenario}${more}`);
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay canvas');
    await it.page.waitForSelector('.replay .label small:not(:empty)');
  };
  const time = async () => Number.parseFloat((await it.page.textContent('.replay .clock')) ?? '');
  const labels = () => it.page.locator('.replay .label small').allTextContents();
  const press = async (key: string) => {
    await it.page.locator('.replay canvas').focus();
    await it.page.keyboard.press(key);
  };
  const action = (name: string) => it.page.click(`.replay [data-action="${name}"]`);

  test('shows a picture for each engine', async () => {
    await show('box_stack');
    const labelled = await labels();
    assert.equal(labelled.length, 4);
    for (const text of labelled) assert.match(text, /^t = 0 s · frame 1\/\d+/);
    it.clean();
  });

  test('has its place and the focus before its frames arrive: what stands below stays under the pointer', async () => {
    const other = await watched(it.browser);
    let arrive = () => {};
    const held = new Promise<void>((resolve) => {
      arrive = resolve;
    });
    await other.page.route(/replay-\d+-\d+/, async (route) => {
      await held;
      await route.continue();
    });
    await open(other.page, it.run, '#/scenario/box_stack');
    await other.page.locator('#replay').scrollIntoViewIfNeeded();
    await other.page.waitForSelector('.replay-note:has-text("Loading")');
    const place = () => other.page.locator('#curves').evaluate((e) => e.getBoundingClientRect().top + scrollY);
    const before = await place();
    await other.page.focus('#replay [role="group"]');
    arrive();
    await other.page.waitForSelector('.replay .label small:not(:empty)');
    await other.page.waitForFunction(() => document.activeElement?.matches('.replay canvas')); // it had the focus
    const moved = (await place()) - before;
    assert.ok(Math.abs(moved) < 80, `${moved} px`); // a row of buttons more or less, by the width of the letters
    assert.deepEqual(other.faults, []);
    await other.close();
  });

  test('steps, plays, pauses, scrubs', async () => {
    await show('box_stack');
    await action('forward');
    const first = await time();
    assert.ok(first > 0 && first < 0.05, String(first));
    await action('forward');
    await press('ArrowLeft');
    assert.equal(await time(), first);
    await press(' ');
    await it.page.waitForFunction(
      () => Number.parseFloat(document.querySelector('.replay .clock')?.textContent ?? '') > 0.2,
    );
    await press(' ');
    const paused = await time();
    for (let k = 0; k < 5; ++k) await drawn(it.page);
    assert.equal(await time(), paused, 'it stands still');
    const bar = await it.page.locator('.replay .timeline input').boundingBox();
    assert.ok(bar);
    await it.page.mouse.click(bar.x + bar.width / 2, bar.y + bar.height / 2);
    assert.ok(Math.abs((await time()) - 1.5) < 0.1, 'half of three seconds');
    await press('Home');
    assert.equal(await time(), 0);
    it.clean();
  });

  test('jumps to the largest error and to contacts', async () => {
    await show('bouncing_disc_2d');
    await action('largest');
    assert.match((await it.page.textContent('.replay .said')) ?? '', /largest \w+/);
    assert.ok((await time()) > 0);
    await press('Home');
    await press(']');
    const hit = await time();
    assert.ok(hit > 0, 'the disc falls first');
    assert.match((await it.page.textContent('.replay .said')) ?? '', /contact begins/);
    await press(']');
    assert.ok((await time()) > hit);
    await press('[');
    assert.equal(await time(), hit);
    it.clean();
  });

  test('numbers of a body are those of the engine', async () => {
    const spec = 'rigor:preset=matched';
    const on = 'faces.outlines';
    const view = new URLSearchParams({ t: '0.5', on, by: 'body', e: spec, b: '1' }).toString();
    await show('pendulum_chain', `?view=${encodeURIComponent(view)}`);
    await it.page.waitForSelector('.replay .inspector [data-quantity="position"]');
    const cell = async (name: string) =>
      ((await it.page.textContent(`.replay .inspector [data-quantity="${name}"]`)) ?? '').replaceAll('−', '-');
    const numbers = (text: string) => text.split(',').map((part) => Number.parseFloat(part));
    const body = (await cell('body')).replace(/ \(\d+\)$/, '');
    const step = Number(/step (\d+)/.exec(await cell('time'))?.[1]);
    const state = stateOf('pendulum_chain', spec, body, step);
    assert.ok(Math.abs(Number.parseFloat(await cell('time')) - (state[0] as number)) < 1e-6);
    numbers(await cell('position')).forEach((shown, k) => {
      const exact = state[2 + k] as number;
      assert.ok(Math.abs(shown - exact) < 1e-5, `position ${k}: ${shown} is shown, ${exact} was computed`);
    });
    const turned = numbers(await cell('orientation'));
    const dot = turned.reduce((sum, q, k) => sum + q * (state[5 + k] as number), 0);
    assert.ok(Math.abs(Math.abs(dot) - 1) < 1e-4);
    it.clean();
  });

  test('the pointer finds bodies', async () => {
    await show('box_stack');
    const box = await it.page.locator('.replay canvas').boundingBox();
    assert.ok(box);
    await it.page.mouse.move(box.x + box.width / 8, box.y + box.height / 2);
    await it.page.waitForSelector('.replay .inspector:not([hidden])');
    assert.match((await it.page.textContent('.replay .inspector')) ?? '', /box_0_\d_0|contact/);
    it.clean();
  });

  test('the camera is moved by keys alone', async () => {
    await show('box_stack');
    const camera = () => it.page.evaluate(() => new URLSearchParams(location.hash.split('?')[1]).get('view') ?? '');
    const seen = new Set([await camera()]);
    for (const key of ['.', ',', 'ArrowUp', 'PageUp']) {
      const before = await camera();
      await press(key);
      if (key === ',') await press(key); // back to where it was, and on
      await it.page.waitForFunction(
        (was) => (new URLSearchParams(location.hash.split('?')[1]).get('view') ?? '') !== was,
        before,
      );
      seen.add(await camera());
    }
    assert.equal(seen.size, 5, [...seen].join('\n'));
    it.clean();
  });

  test('a link restores the view', async () => {
    await show('box_stack');
    await it.page.click('.replay [data-switch="trails"]');
    await it.page.click('.replay [data-switch="overlaid"]');
    await press('End');
    await it.page.waitForFunction(() => {
      const view = new URLSearchParams(location.hash.split('?')[1]).get('view') ?? '';
      const link = new URLSearchParams(view);
      return link.get('over') === '1' && Number(link.get('t')) > 0;
    });
    const [hash, end] = [await it.page.evaluate(() => location.hash), await time()];
    await show('slip_to_roll_2d');
    await it.open(hash);
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
    assert.equal(await time(), end);
    assert.equal(await it.page.getAttribute('.replay [data-switch="trails"]', 'aria-pressed'), 'true');
    assert.equal(await it.page.getAttribute('.replay [data-switch="overlaid"]', 'aria-pressed'), 'true');
    assert.equal((await labels()).length, 1);
    it.clean();
  });

  test('curves and replay share the time', async () => {
    await show('slip_to_roll_2d');
    const before = await it.page.locator('#curves').textContent();
    await press('End');
    await it.page.waitForFunction((old) => document.querySelector('#curves')?.textContent !== old, before);
    it.clean();
  });

  test('every layer draws without a fault, in light and dark', async () => {
    for (const scenario of scenarios) {
      await show(scenario);
      await press('e');
      for (const name of ['penetration', 'impulses', 'velocities', 'spins', 'bounds', 'trails'])
        await it.page.click(`.replay [data-switch="${name}"]`);
      await drawn(it.page);
      await it.page.locator('#replay').screenshot({ path: join(screenshots, `replay-${scenario}.png`) });
      await it.page.emulateMedia({ colorScheme: 'dark' });
      await drawn(it.page);
      await it.page.locator('#replay').screenshot({ path: join(screenshots, `replay-${scenario}-dark.png`) });
      await it.page.emulateMedia({ colorScheme: 'light' });
      it.clean();
    }
  });

  test('a served run brings all frames', async () => {
    const program = join(process.env.RIGOR_BINARY_DIR ?? '', 'bin/rigor');
    const folder = mkdtempSync(join(tmpdir(), 'rigor-replay-'));
    const long = join(folder, 'run');
    execFileSync(program, ['validate', 'asymmetric_top', '--engines', 'rigor', '--dt', '0.001', '--out', long], {
      stdio: 'ignore',
    });
    const server = spawn(program, ['view', long, '--json', '--no-open']);
    try {
      const line = await new Promise<string>((resolve) => {
        server.stdout.once('data', (data: Buffer) => resolve(data.toString()));
      });
      const served = await it.browser.newPage();
      const faults: string[] = [];
      served.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
      served.on('pageerror', (error) => faults.push(error.message));
      await served.goto((JSON.parse(line) as { url: string }).url);
      await served.waitForSelector('#page[data-shown]');
      await served.evaluate(() => {
        location.hash = '#/scenario/asymmetric_top';
      });
      await served.locator('#replay').scrollIntoViewIfNeeded();
      await served.waitForSelector('.replay .label small:has-text("every")');
      await served.click('.replay [data-switch="all"]');
      await served.waitForSelector('.replay .label small:has-text("frame 1/3001")');
      await served.click('.replay [data-action="forward"]');
      assert.match((await served.textContent('.replay .clock')) ?? '', /^0\.0010 s/);
      assert.equal(await served.locator('.replay [data-switch="all"]').count(), 0, 'there is nothing more');
      assert.deepEqual(faults, []);
      await served.close();
    } finally {
      server.kill();
      rmSync(folder, { recursive: true, force: true });
    }
  });

  test('says why where there is no WebGL', async () => {
    const other = await watched(it.browser);
    await other.page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    await open(other.page, it.run, '#/scenario/box_stack');
    await other.page.locator('#replay').scrollIntoViewIfNeeded();
    await other.page.waitForSelector('.replay-note:has-text("no WebGL")');
    await other.close();
  });
});
