// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of a bench: bars, growth curves, invalid times struck out with their reason, what changed since a baseline.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { makeBench, reportOf, screenshots, skip } from '../browser.ts';

describe('the report of a bench', { skip }, () => {
  const it = reportOf(makeBench);

  test('shows every case, and nothing of a validation that was not run', async () => {
    await it.open();
    await it.page.waitForSelector('#engines');
    assert.equal(await it.page.locator('#bench tr[data-case]').count(), 12, 'parts are folded');
    assert.equal(await it.page.locator('#scoreboard, #summary, #ledger').count(), 0);
    assert.match(await it.text('#bench'), /authors of this bench wrote one of the engines/);
    assert.match(await it.text('#bench tr[data-case="rigor-55-1"]'), /55 µs.*valid.*0\.5/);
    assert.match(await it.text('#bench tr[data-case="rigor-1240-2"]'), /×1\.8/);
    await it.page.screenshot({ path: join(screenshots, 'bench.png'), fullPage: true });
    it.clean();
  });

  test('an invalid time is struck out, says why, and has no bar', async () => {
    await it.open();
    const row = '#bench tr[data-case="bullet-1240-1"]';
    assert.equal(await it.page.locator(`${row} s`).count(), 1);
    assert.match(await it.text(row), /invalid: max_penetration 0\.02 m > 0\.005/);
    const bar = it.page.locator('.bars tr', { hasText: 'bullet' });
    assert.match((await bar.textContent()) ?? '', /no timing/);
    assert.equal(await bar.locator('i').count(), 0);
    assert.match(await it.text('#bench tr[data-case="<b>dead</b>-55-1"]'), /crashed: SIGSEGV/);
  });

  test('a spec that is longer than a line has a short name, which is explained once', async () => {
    await it.open();
    assert.match(await it.text('#bench tr[data-case="lengthy"] th'), /^rigor\[1\]$/);
    const key = it.page.locator('#bench dl.facts', { hasText: 'rigor[1]' });
    assert.match((await key.textContent()) ?? '', /rigor:box_margin=0\.05,.*velocity_iterations=0/);
    const table = it.page.locator('#bench .bench-subject table.bench').first();
    const [shown, whole] = await table.evaluate((t) => [t.parentElement?.clientWidth ?? 0, t.scrollWidth]);
    assert.ok(shown >= whole, `the table is ${whole} wide, ${shown} of it are seen`);
    it.clean();
  });

  test('a narrow page has nothing to scroll sideways but its tables', async () => {
    await it.open();
    await it.page.setViewportSize({ width: 420, height: 900 });
    // Charts follow the page's width when they are notified of it, on a busy machine some seconds later.
    await it.page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await it.page.setViewportSize({ width: 1400, height: 1000 });
    it.clean();
  });

  test('the machine is named once', async () => {
    await it.open();
    assert.equal(await it.page.locator('dt', { hasText: /^cpu$/ }).count(), 1);
  });

  test('growth is a curve per engine and number of threads', async () => {
    await it.open();
    const plot = it.page.locator('[data-plot="pyramid: growth"]');
    await plot.scrollIntoViewIfNeeded();
    await plot.locator('canvas').waitFor();
    assert.equal(await plot.locator('.lines > span').count(), 3);
    it.clean();
  });

  test('a part shows the fastest of each engine, and unfolded how much work it was and how well done', async () => {
    await it.open();
    const part = it.page.locator('[data-part="broad_phase"]');
    const best = part.locator('table').first().locator('tbody tr');
    assert.match((await best.first().textContent()) ?? '', /moving boxes, 1000 boxes.*50 µs.*100 ns/);
    assert.equal(await best.locator('b').textContent(), '100 ns', 'the wrong one is not the fastest');
    await part.locator('summary').first().click();
    await part.locator('.bars th').first().waitFor();
    assert.deepEqual(await part.locator('.bars th').allTextContents(), ['rigor tree', 'fcl', 'rigor hash']);
    assert.match(await it.text('#bench tr[data-case="quick"]'), /100 ns.*valid.*10 M.*480.*500.*0/);
    assert.match(await it.text('#bench tr[data-case="wrong"]'), /invalid: missed_pairs 3 > 0/);
    await part.screenshot({ path: join(screenshots, 'bench_part.png') });
    it.clean();
  });

  test('shows what became slower, and the command of each', async () => {
    await it.open();
    assert.match(await it.text('#bench tr.change-slower'), /rigor.*1\.5.*slower/);
    await it.page.locator('#bench details summary').first().click();
    assert.match(await it.text('#bench details .command code'), /^\.\/rigor bench pyramid --engines/);
    it.clean();
  });
});
