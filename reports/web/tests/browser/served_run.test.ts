// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor view RUN`: the report over HTTP, and in its replay every frame that was stored.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { sharedBrowser, skip } from '../browser.ts';
import { view, watched } from '../live_program.ts';

test('a recorded run is served with all its frames', { skip }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'rigor-served-'));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const run = join(folder, 'run');
  const program = join(process.env.RIGOR_BINARY_DIR ?? '', 'bin/rigor');
  const requested = ['pile', '--engines', 'rigor:preset=default', '--dt', '1/60', '-q', '--out', run];
  try {
    execFileSync(program, ['validate', ...requested], { stdio: 'ignore' });
  } catch {
    // a missed bound is a red run, and as good a run to look at
  }
  const served = await view([run]);
  t.after(() => served.end());
  const { page, context, faults } = await watched(await sharedBrowser(), served);
  t.after(() => context.close());
  await page.goto(served.url);
  await page.waitForSelector('#page[data-shown]');
  await page.goto(`${served.origin}/#/scenario/pile`);
  await page.waitForSelector('.replay canvas');
  const label = () => page.locator('.replay .label small').first().innerText();
  const thinned = Number(/frame \d+\/(\d+)/.exec(await label())?.[1]);
  const [answer] = await Promise.all([
    page.waitForResponse((response) => response.url().includes('/trajectory/')),
    page.click('.replay [data-switch="all"]'),
  ]);
  assert.equal(answer.status(), 200);
  await page.waitForFunction(() => document.querySelector('.replay [data-switch="all"]') === null);
  await page.waitForFunction(
    (before) =>
      Number(/frame \d+\/(\d+)/.exec(document.querySelector('.replay .label small')?.textContent ?? '')?.[1]) >= before,
    thinned,
  );
  assert.deepEqual(faults, []);
});
