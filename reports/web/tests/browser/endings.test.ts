// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of a run that was broken off and has crashed, timed-out and non-finite cases, hostile names and a study: it
// says so, and stays a page.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { makeSynthetic, reportOf, skip } from '../browser.ts';

describe('the report of a run that went badly', { skip }, () => {
  const it = reportOf(makeSynthetic);

  test('says what is missing and why', async () => {
    await it.open();
    assert.match(await it.text('#summary'), /This run is unfinished: \d+ of \d+ cases/);
    await it.open('#scoreboard');
    for (const verdict of ['crashed', 'timeout', 'non_finite']) {
      await it.page.getByLabel('Ending', { exact: true }).selectOption(verdict);
      const rows = it.page.locator('#scoreboard tbody tr[data-scenario]');
      const count = await rows.count();
      assert.ok(count > 0, verdict);
      assert.equal(await it.page.locator(`#scoreboard tbody tr[data-scenario]:has(.v-${verdict})`).count(), count);
    }
    await it.page.getByLabel('Ending', { exact: true }).selectOption('crashed');
    await it.page.locator('#scoreboard a.v-crashed').first().click();
    await it.page.waitForSelector('#outcomes');
    assert.match(await it.text('#outcomes'), /SIGSEGV|more than 4096 MiB/);
    it.clean();
  });

  test('every page of it opens, hostile names stay text', async () => {
    await it.open('#scoreboard');
    const links = await it.page
      .locator('#scoreboard tbody th a')
      .evaluateAll((list) => list.map((a) => a.getAttribute('href')));
    assert.equal(links.length, 25);
    for (const link of links) {
      await it.follow(link ?? '');
      assert.ok((await it.page.locator('#metrics tr[data-metric]').count()) > 0, link ?? '');
      assert.ok((await it.page.locator('#commands code').count()) > 0, link ?? '');
    }
    assert.equal(await it.page.evaluate(() => 'hostile' in window), false);
    assert.equal(await it.page.evaluate(() => document.images.length), 0);
    it.clean();
  });

  test('a study shows its charts and tables', async () => {
    await it.open('#study');
    const kinds = await it.page
      .locator('#study .chart')
      .evaluateAll((list) => list.map((c) => (c as HTMLElement).dataset.kind));
    assert.deepEqual(kinds, ['lines', 'bars']);
    await it.page.locator('#study [data-kind="lines"]').scrollIntoViewIfNeeded();
    await it.page.locator('#study [data-kind="lines"] canvas').waitFor();
    assert.equal(await it.page.locator('#study [data-kind="bars"] table.bars tr').count(), 3);
    const values = await it.page
      .locator('[data-part="sweep"] td[data-value]')
      .evaluateAll((list) => list.map((td) => Number((td as HTMLElement).dataset.value)));
    assert.deepEqual(values, [0.1, 0.05, 0.025, 0.1, 0.05, 0.025]);
  });
});
