// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Tools of the replay and of plots: names, measures, a camera that goes along, the legend, the clock; and files of what is
// seen, each opened again.
import assert from 'node:assert/strict';
import { readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { drawn, figureOf, reportOf, screenshots, skip, smokeRun, watched } from '../browser.ts';

describe('tools of the replay', { skip }, () => {
  const it = reportOf(smokeRun);
  const show = async (scenario: string, view: Record<string, string> = {}) => {
    const link =
      Object.keys(view).length > 0 ? `?view=${encodeURIComponent(new URLSearchParams(view).toString())}` : '';
    await it.open(`#/scenario/${scenario}${link}`);
    await it.page.locator('#replay').scrollIntoViewIfNeeded();
    await it.page.waitForSelector('.replay .label small:not(:empty)');
  };
  /** Calls something of the stage. */
  const stage = <T>(code: string): Promise<T> =>
    it.page.evaluate(`(() => { const stage = document.querySelector('.replay').stage; return ${code}; })()`);
  const download = async (click: () => Promise<unknown>): Promise<{ name: string; data: Buffer }> => {
    const [saved] = await Promise.all([it.page.waitForEvent('download'), click()]);
    return { name: saved.suggestedFilename(), data: readFileSync((await saved.path()) ?? '') };
  };
  const one = 'rigor:preset=matched';

  test('names of bodies, and a legend of what is on', async () => {
    await show('pendulum_chain', { e: one, on: 'faces.velocities' });
    assert.match(await it.text('.replay .colour-legend'), /velocity, full length [\d.]+ m\/s/);
    assert.doesNotMatch(await it.text('.replay .colour-legend'), /joint/);
    await it.page.click('.replay [data-switch="joints"]');
    await it.page.waitForSelector('.replay .colour-legend:has-text("joint")');
    await it.page.click('.replay [data-switch="names"]');
    await it.page.waitForSelector('.replay .notes .body:not(:empty)');
    const names = await it.page.locator('.replay .notes .body').allTextContents();
    assert.ok(names.length >= 3, names.join());
    it.clean();
  });

  test('a distance and an angle between clicked points are those of the points', async () => {
    await show('box_stack', { e: one });
    await it.page.click('.replay [data-switch="measure"]');
    const box = await it.page.locator('.replay canvas').boundingBox();
    assert.ok(box);
    const places = await it.page.evaluate(() => {
      const { view, shown } = (document.querySelector('.replay') as never as { stage: Record<string, never> })
        .stage as never as {
        view: {
          project: (s: unknown, p: number[]) => [number, number];
          frameOf: (s: unknown) => { frame: { position: ArrayLike<number> } };
        };
        shown: unknown[];
      };
      const at = (b: number) => [0, 1, 2].map((k) => view.frameOf(shown[0]).frame.position[3 * b + k] as number);
      return [1, 4, 2].map((b) => view.project(shown[0], at(b)));
    });
    const [first, corner, last] = places as [number, number][];
    for (const [x, y] of [first, corner, last && [last[0] + 8, last[1]]] as [number, number][])
      await it.page.mouse.click(box.x + x, box.y + y);
    await it.page.waitForSelector('.replay .notes .angle:not(:empty)');
    const picked = await stage<number>('stage.view.panels.length');
    assert.equal(picked, 1);
    const distance = await it.text('.replay .notes .measure');
    const metres = Number.parseFloat(distance) * (/mm/.test(distance) ? 1e-3 : 1);
    assert.ok(Math.abs(metres - 3) < 0.5, `${distance} between boxes three apart`);
    assert.match(await it.text('.replay .notes .angle'), /^[\d.]+°$/);
    await it.page.click('.replay [data-switch="measure"]');
    await it.page.waitForFunction(() => !document.querySelector('.replay .notes')?.textContent);
    it.clean();
  });

  test('a distance and an angle are measured by keys alone', async () => {
    await show('box_stack', { e: one });
    const press = (key: string) => it.page.keyboard.press(key);
    const said = () => it.text('.replay .said');
    const cell = (name: string) => `.replay .inspector.pinned [data-quantity="${name}"]`;
    await it.page.focus('.replay canvas');
    await press('x');
    await press('Enter');
    assert.match(await said(), /^Choose a body/);
    const chosen = new Set<string>();
    for (const point of [1, 2, 3]) {
      await press('s');
      chosen.add(await it.text(cell('body')));
      assert.equal(chosen.size, point, 'another body');
      await press('Enter');
      assert.match(await said(), new RegExp(`^point ${point}`));
    }
    const origins = await stage<number[][]>(
      `[1, 2, 3].map((b) => [0, 1, 2].map((k) => stage.view.frameOf(stage.shown[0]).frame.position[3 * b + k]))`,
    );
    const [first, second, third] = origins as [number[], number[], number[]];
    const distance = (a: number[], b: number[]) => Math.hypot(...a.map((x, k) => x - (b[k] as number)));
    const read = (await said()).split(', ').slice(1);
    assert.equal(read.length, 3, read.join());
    for (const [i, length] of [distance(first, second), distance(second, third)].entries()) {
      const text = read[i] as string;
      const metres = Number.parseFloat(text) * (/mm/.test(text) ? 1e-3 : 1);
      assert.ok(Math.abs(metres - length) < 1e-3 * length, `${text} for ${length} m`);
    }
    assert.ok(Math.abs(Number.parseFloat(read[2] as string) - 180) < 1, `${read[2]} in a straight stack`);
    await press('ArrowRight'); // contacts are those that a step has acted upon
    await press('k');
    await it.page.waitForSelector(cell('contact'));
    await press('Enter'); // a fourth point begins anew
    assert.match(await said(), /^point 1$/);
    it.clean();
  });

  test('the camera goes along with a body', async () => {
    await show('free_flight', { e: one, t: '0', b: '0' });
    const target = () => stage<number[]>('stage.view.camera.target');
    const body = () => stage<number[]>('[0, 1, 2].map((k) => stage.view.frameOf(stage.shown[0]).frame.position[k])');
    await it.page.click('.replay [data-switch="follow"]');
    const [from, start] = [await target(), await body()];
    await stage('stage.setTime(0.5)');
    await it.page.waitForFunction(() => document.querySelector('.replay .clock')?.textContent?.startsWith('0.5'));
    await drawn(it.page);
    const [to, end] = [await target(), await body()];
    const moved = Math.hypot(...end.map((x, k) => x - (start[k] as number)));
    assert.ok(moved > 0.1, `it flies: ${moved} m`);
    to.forEach((x, k) => {
      const [camera, followed] = [x - (from[k] as number), (end[k] as number) - (start[k] as number)];
      assert.ok(Math.abs(camera - followed) < 1e-3, `axis ${k}: camera ${camera}, body ${followed}`);
    });
    it.clean();
  });

  test('the clock says when it is not real time', async () => {
    await show('box_stack', { e: one, s: '0.1' });
    await it.page.click('.replay [data-action="play"]');
    await it.page.waitForFunction(() =>
      /×0\.\d+ real time/.test(document.querySelector('.replay .clock')?.textContent ?? ''),
    );
    await it.page.click('.replay [data-action="play"]');
    assert.match(await it.text('.replay .clock'), /^[\d.]+ s$/);
    it.clean();
  });

  test('the picture and the states are saved', async () => {
    await show('bouncing_disc_2d', { e: one });
    const png = await download(() => it.page.click('.replay [data-action="save-png"]'));
    assert.match(png.name, /^bouncing_disc_2d-.*\.png$/);
    assert.equal(png.data.subarray(1, 4).toString(), 'PNG');
    const [width, height] = [png.data.readUInt32BE(16), png.data.readUInt32BE(20)];
    assert.ok(width > 400 && height > 200, `${width} x ${height}`);
    const csv = await download(() => it.page.click('.replay [data-action="save-csv"]'));
    const [head, ...rows] = csv.data.toString().trim().split('\n');
    assert.match(head ?? '', /^engine,step,time,body,px,py,pz,qw/);
    const count = await stage<number>('stage.shown[0].times.length');
    const disc = rows.filter((row) => row.split(',')[3] === 'disc');
    assert.equal(disc.length, count);
    it.clean();
  });

  test('the run is saved as a video that plays', async () => {
    await show('slide_and_stop', { e: one, s: '4' });
    const webm = await download(() => it.page.click('.replay [data-action="save-webm"]'));
    assert.match(webm.name, /\.webm$/);
    const player = await it.browser.newPage(); // the policy of the report's page lets no video in
    const shown = await player.evaluate(async (base64) => {
      const video = document.createElement('video');
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      video.src = URL.createObjectURL(new Blob([bytes], { type: 'video/webm' }));
      await new Promise((done, fail) => {
        video.onloadeddata = done;
        video.onerror = () => fail(new Error(video.error?.message));
      });
      return { seconds: video.duration, width: video.videoWidth };
    }, webm.data.toString('base64'));
    await player.close();
    const end = await stage<number>('stage.player.end');
    assert.ok(Math.abs(shown.seconds - end / 4) < 0.1, `${shown.seconds} s of ${end} s, four times as fast`);
    assert.ok(shown.width > 400);
    it.clean();
  });

  test('a plot is saved as CSV, SVG and PNG', async () => {
    await it.open('#/scenario/slide_and_stop');
    const card = it.page.locator('#curves .chart').first();
    await card.scrollIntoViewIfNeeded();
    const save = (kind: string) => download(() => card.locator('select.save').selectOption(kind));
    const csv = (await save('csv')).data.toString().trim().split('\n');
    assert.match(csv[0] ?? '', /^line,t \[s\],/);
    assert.ok(csv.length > 100 && csv.every((row) => row.split(',').length === 3));
    const svg = await save('svg');
    assert.match(svg.name, /^slide_and_stop-time-step-1-\d+-s-block-position-x\.svg$/);
    const figure = await figureOf(it.page, svg.data.toString());
    assert.equal(figure.fault, undefined);
    assert.deepEqual(new Set(figure.lines), new Set(csv.slice(1).map((row) => row.split(',')[0])));
    assert.equal(figure.texts.at(-2), 'block: position x');
    assert.match(figure.texts.at(-1) ?? '', /^slide_and_stop, time step 1\/\d+ s$/);
    for (const title of ['t [s]', 'block: position x [m]']) assert.ok(figure.texts.includes(title), title);
    assert.deepEqual(figure.legend, figure.dashes, 'the legend has the dashes of the lines');
    assert.ok(figure.dashes.some((dash) => dash) && figure.dashes.some((dash) => !dash));
    assert.ok(figure.legendAt >= figure.frameEnd, 'the legend is beside the curves');
    const png = (await save('png')).data;
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    assert.equal(png.readUInt32BE(16), 2 * figure.width, 'the PNG is the same figure');
    it.clean();
  });

  test('plots of one’s own are added by clicks and kept in the address', async () => {
    await it.open('#/scenario/slide_and_stop');
    await it.page.click('#free-plots summary');
    const form = it.page.locator('#free-plots');
    await form.getByLabel('Of', { exact: true }).selectOption('block');
    await form.getByLabel('Quantity').selectOption('vx');
    await it.page.click('#free-plots [data-action="add-plot"]');
    await form.getByLabel('Over').selectOption('px');
    await form.getByLabel('Engine').selectOption(one);
    await it.page.click('#free-plots [data-action="add-plot"]');
    await form.getByLabel('Of', { exact: true }).selectOption('floor|block');
    await form.getByLabel('Quantity').selectOption('depth');
    await it.page.click('#free-plots [data-action="add-plot"]');
    const names = () =>
      it.page.locator('#free-plots .chart').evaluateAll((all) => all.map((c) => c.getAttribute('data-plot')));
    const wanted = ['block: velocity x', 'block: velocity x over position x', 'floor and block: largest depth'];
    assert.deepEqual(await names(), wanted);
    const csv = (await download(() => form.locator('.chart').first().locator('select.save').selectOption('csv'))).data;
    const rows = csv
      .toString()
      .trim()
      .split('\n')
      .map((row) => row.split(','));
    const own = rows.filter((row) => row[0] === 'rigor matched').map((row) => Number(row[2]));
    assert.ok(own.length > 50 && (own[0] ?? 0) > 1 && Math.abs(own.at(-1) ?? 1) < 1e-3, 'it slides, then stands');
    const hash = await it.page.evaluate(() => location.hash);
    await it.open(hash);
    await it.page.waitForSelector('#free-plots .chart');
    assert.deepEqual(await names(), wanted);
    await it.page.locator('#free-plots .chart button[aria-label^="Remove"]').first().click();
    assert.deepEqual(await names(), wanted.slice(1));
    it.clean();
  });

  test('one file of one scenario opens alone, with its replay', async () => {
    await it.open('#/scenario/slide_and_stop');
    const page = await download(() => it.page.click('[data-action="save-page"]'));
    assert.equal(page.name, 'slide_and_stop.html');
    const other = await watched(it.browser);
    const file = join(screenshots, page.name);
    const { writeFileSync } = await import('node:fs');
    writeFileSync(file, page.data);
    await other.page.goto(`file://${file}`);
    await other.page.waitForSelector('#verdicts tbody tr');
    await other.page.locator('#replay').scrollIntoViewIfNeeded();
    await other.page.waitForSelector('.replay .label small:not(:empty)');
    assert.equal(
      await other.page.locator('#metrics tbody tr').count(),
      await it.page.locator('#metrics tbody tr').count(),
      'all numbers are there',
    );
    assert.deepEqual(other.faults, []);
    await other.close();
    rmSync(file);
  });
});
