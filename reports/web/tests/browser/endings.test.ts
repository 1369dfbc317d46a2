// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of a run that was broken off and has crashed, timed-out and non-finite cases, hostile names and a study: it
// says so, and stays a page.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { launch, makeSynthetic, open, skip, type Watched, watched } from '../browser.ts';

describe('the report of a run that went badly', { skip }, () => {
  let run = '';
  let browser: Browser;
  let seen: Watched;
  let page: Page;
  before(async () => {
    run = makeSynthetic('endings');
    browser = await launch();
    seen = await watched(browser);
    page = seen.page;
  });
  after(async () => {
    await seen?.close();
    await browser?.close();
  });
  const text = async (selector: string) => (await page.locator(selector).first().textContent()) ?? '';

  test('says what is missing and why', async () => {
    await open(page, run);
    assert.match(await text('#summary'), /This run is unfinished: \d+ of \d+ cases/);
    for (const verdict of ['crashed', 'timeout', 'non_finite']) {
      await page.getByLabel('Verdict').selectOption(verdict);
      const rows = page.locator('#scoreboard tbody tr');
      const count = await rows.count();
      assert.ok(count > 0, verdict);
      assert.equal(await page.locator(`#scoreboard tbody tr:has(.v-${verdict})`).count(), count);
    }
    await page.getByLabel('Verdict').selectOption('crashed');
    await page.locator('#scoreboard a.v-crashed').first().click();
    await page.waitForSelector('#outcomes');
    assert.match(await text('#outcomes'), /SIGSEGV|more than 4096 MiB/);
    assert.deepEqual(seen.faults, []);
  });

  test('every page of it opens, hostile names stay text', async () => {
    await open(page, run);
    const links = await page
      .locator('#scoreboard tbody th a')
      .evaluateAll((list) => list.map((a) => a.getAttribute('href')));
    assert.equal(links.length, 25);
    for (const link of links) {
      await open(page, run, link ?? '');
      assert.ok((await page.locator('#metrics tr[data-metric]').count()) > 0, link ?? '');
      assert.ok((await page.locator('#commands code').count()) > 0, link ?? '');
    }
    assert.equal(await page.evaluate(() => 'hostile' in window), false);
    assert.equal(await page.evaluate(() => document.images.length), 0);
    assert.deepEqual(seen.faults, []);
  });

  test('a study shows its charts and tables', async () => {
    await open(page, run, '#study');
    const kinds = await page
      .locator('#study .chart')
      .evaluateAll((list) => list.map((c) => (c as HTMLElement).dataset.kind));
    assert.deepEqual(kinds, ['lines', 'bars']);
    await page.locator('#study [data-kind="lines"]').scrollIntoViewIfNeeded();
    await page.locator('#study [data-kind="lines"] canvas').waitFor();
    assert.equal(await page.locator('#study [data-kind="bars"] table.bars tr').count(), 3);
    const values = await page
      .locator('[data-part="sweep"] td[data-value]')
      .evaluateAll((list) => list.map((td) => Number((td as HTMLElement).dataset.value)));
    assert.deepEqual(values, [0.1, 0.05, 0.025, 0.1, 0.05, 0.025]);
  });
});
