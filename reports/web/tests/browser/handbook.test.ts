// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The handbook in Chromium, opened from disk as `./rigor docs` has written it: scenes play and are scrubbed, a page loads
// files of the site alone, and fits a telephone. Skipped where the handbook has not been written.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import type { Page } from 'playwright-core';
import { axeFindings } from '../axe.ts';
import { sharedBrowser, skip } from '../browser.ts';

const site = join(process.env.RIGOR_BINARY_DIR ?? '', 'handbook');
const missing = existsSync(join(site, 'en/build/state.html')) ? false : './rigor docs has not been run';

describe('the handbook', { skip: skip || missing }, () => {
  let page: Page;
  const trouble: string[] = [];
  before(async () => {
    page = await (await sharedBrowser()).newPage({ viewport: { width: 1200, height: 900 } });
    page.on('console', (message) => {
      if (message.type() === 'error') trouble.push(message.text());
    });
    page.on('pageerror', (error) => trouble.push(error.message));
    page.on('request', (request) => {
      if (!/^(file|data):/.test(request.url())) trouble.push(`request of ${request.url()}`);
    });
  });
  after(() => page?.close());

  const open = (path: string) => page.goto(`file://${join(site, path)}`);
  /** The picture of the first scene as text. */
  const picture = () =>
    page
      .locator('figure.scene canvas')
      .first()
      .evaluate((c) => (c as HTMLCanvasElement).toDataURL());

  test('a scene is drawn, scrubbed and played', async () => {
    await open('en/build/clipping.html');
    const figure = page.locator('figure.scene.ready').first();
    await figure.scrollIntoViewIfNeeded();
    const start = await picture();
    await figure.locator('input[type=range]').evaluate((slider) => {
      const input = slider as HTMLInputElement;
      input.value = String(Number(input.max) / 2);
      input.dispatchEvent(new Event('input'));
    });
    const middle = await picture();
    assert.notEqual(middle, start);
    assert.equal(await figure.locator('output').textContent(), '1.50 s');
    await figure.locator('button.next').click();
    assert.notEqual(await picture(), middle);
    await figure.locator('button.play').click();
    await page.waitForFunction(
      () => Number.parseFloat(document.querySelector('figure.scene output')?.textContent ?? '') > 1.7,
    );
    assert.deepEqual(trouble, []);
  });

  test('every page of contents opens, in both languages, and fits a telephone', async () => {
    await page.setViewportSize({ width: 390, height: 800 });
    for (const language of ['en', 'zh']) {
      await open(`${language}/index.html`);
      const links = await page
        .locator('nav.contents a')
        .evaluateAll((all) => all.map((a) => (a as HTMLAnchorElement).href));
      assert.ok(links.length > 25, `${links.length} links`);
      for (const link of language === 'en' ? links : links.filter((l) => l.includes('/zh/'))) {
        await page.goto(link);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        assert.ok(wide <= 0, `${link} is ${wide} px too wide`);
        assert.equal(await page.locator('h1').count(), 1, link);
        const cut = await page
          .locator('.exercise .judge + .code pre')
          .evaluateAll((all) => all.filter((e) => e.scrollWidth > e.clientWidth).map((e) => e.textContent));
        assert.deepEqual(cut, [], `${link}: commands that are cut`);
      }
    }
    assert.deepEqual(trouble, []);
  });

  test('nothing has to be scrolled to before a page is printed', async () => {
    await page.setViewportSize({ width: 1200, height: 400 });
    await open('en/build/step.html');
    const far = page.locator('figure.scene').last();
    await page.waitForFunction(() => [...document.querySelectorAll('figure.scene')].every((f) => f.matches('.ready')));
    assert.equal(await page.evaluate(() => scrollY), 0);
    const top = await far.evaluate((e) => e.getBoundingClientRect().top);
    assert.ok(top > 400 + 600, `the last scene is near, ${top} px below`);
    const colours = await far
      .locator('canvas')
      .first()
      .evaluate((c) => {
        const canvas = c as HTMLCanvasElement;
        const g = canvas.getContext('2d') as CanvasRenderingContext2D;
        const { data } = g.getImageData(0, 0, canvas.width, canvas.height);
        return new Set(new Uint32Array(data.buffer)).size;
      });
    assert.ok(colours > 3, `${colours} colours`);
    await open('en/gallery.html');
    const pictures = await page
      .locator('.cards img')
      .evaluateAll((all) =>
        all.map((i) => (i as HTMLImageElement).complete && (i as HTMLImageElement).naturalWidth > 0),
      );
    assert.ok(pictures.length > 10 && pictures.every(Boolean), pictures.join());
    assert.deepEqual(trouble, []);
  });

  test('pictures of the gallery are dark where the page is, with light lines', async () => {
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await open('en/gallery.html');
      const shot = await page.locator('.card img').nth(1).screenshot();
      const { mean, most, least } = await page.evaluate(
        async (url) => {
          const image = new Image();
          image.src = url;
          await image.decode();
          const canvas = new OffscreenCanvas(image.width, image.height);
          const g = canvas.getContext('2d') as OffscreenCanvasRenderingContext2D;
          g.drawImage(image, 0, 0);
          const green = [...g.getImageData(0, 0, image.width, image.height).data].filter((_, i) => i % 4 === 1);
          const sum = green.reduce((a, b) => a + b, 0);
          return {
            mean: sum / green.length,
            most: green.reduce((a, b) => Math.max(a, b)),
            least: green.reduce((a, b) => Math.min(a, b)),
          };
        },
        `data:image/png;base64,${shot.toString('base64')}`,
      );
      const found = `${colorScheme}: ${least} ... ${most}, mean ${mean}`;
      if (colorScheme === 'dark') assert.ok(mean < 100 && most > 150, found);
      else assert.ok(mean > 150 && least < 100, found);
    }
    await page.emulateMedia({ colorScheme: 'light' });
    assert.deepEqual(trouble, []);
  });

  test('a page of each kind has no finding of axe-core', async () => {
    for (const path of [
      'en/index.html',
      'zh/build/sat.html',
      'en/use/figure.html',
      'en/reference/specs.html',
      'en/gallery.html',
    ]) {
      await open(path);
      assert.deepEqual(await axeFindings(page), [], path);
    }
  });

  test('light and dark are chosen by a button and kept', async () => {
    await open('en/index.html');
    const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
    await page.locator('#theme').click();
    assert.equal(await theme(), 'dark');
    await page.reload();
    assert.equal(await theme(), 'dark');
    await page.locator('#theme').click();
    assert.equal(await theme(), 'light');
  });
});
