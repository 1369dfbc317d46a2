// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of a bench: bars, growth curves, invalid times struck out with their reason, what changed since a baseline.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { launch, makeBench, open, screenshots, skip, type Watched, watched } from '../browser.ts';

describe('the report of a bench', { skip }, () => {
  let run = '';
  let browser: Browser;
  let seen: Watched;
  let page: Page;
  before(async () => {
    run = makeBench('bench');
    mkdirSync(screenshots, { recursive: true });
    browser = await launch();
    seen = await watched(browser);
    page = seen.page;
  });
  after(async () => {
    await seen?.close();
    await browser?.close();
  });
  const text = async (selector: string) => (await page.locator(selector).first().textContent()) ?? '';

  test('shows every case, and nothing of a validation that was not run', async () => {
    await open(page, run);
    await page.waitForSelector('#engines');
    assert.equal(await page.locator('#bench tr[data-case]').count(), 12);
    assert.equal(await page.locator('#scoreboard, #summary, #ledger').count(), 0);
    assert.match(await text('#bench'), /authors of this bench wrote one of the engines/);
    assert.match(await text('#bench tr[data-case="rigor-55-1"]'), /55 µs.*valid.*0\.5/);
    assert.match(await text('#bench tr[data-case="rigor-1240-2"]'), /×1\.8/);
    await page.screenshot({ path: join(screenshots, 'bench.png'), fullPage: true });
    assert.deepEqual(seen.faults, []);
  });

  test('an invalid time is struck out, says why, and has no bar', async () => {
    await open(page, run);
    const row = '#bench tr[data-case="bullet-1240-1"]';
    assert.equal(await page.locator(`${row} s`).count(), 1);
    assert.match(await text(row), /invalid: max_penetration 0\.02 m > 0\.005/);
    const bar = page.locator('.bars tr', { hasText: 'bullet' });
    assert.match((await bar.textContent()) ?? '', /no timing/);
    assert.equal(await bar.locator('i').count(), 0);
    assert.match(await text('#bench tr[data-case="<b>dead</b>-55-1"]'), /crashed: SIGSEGV/);
  });

  test('growth is a curve per engine and number of threads', async () => {
    await open(page, run);
    const plot = page.locator('[data-plot="pyramid: growth"]');
    await plot.scrollIntoViewIfNeeded();
    await plot.locator('canvas').waitFor();
    assert.equal(await plot.locator('.lines > span').count(), 3);
    assert.deepEqual(seen.faults, []);
  });

  test('tells what became slower, and the command of each', async () => {
    await open(page, run);
    assert.match(await text('#bench tr.change-slower'), /rigor.*1\.5.*slower/);
    await page.locator('#bench details summary').first().click();
    assert.match(await text('#bench details .command code'), /^\.\/rigor bench pyramid --engines/);
    assert.deepEqual(seen.faults, []);
  });
});
