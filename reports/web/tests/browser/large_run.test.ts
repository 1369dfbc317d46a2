// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of a large run, whose cases, audit and parity ledger stand beside the page: it shows what the page of a small
// run shows, and loads these files when a part of the page needs them.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { makeLarge, open, sharedBrowser, skip, type Watched, watched } from '../browser.ts';

describe('the report of a large run', { skip }, () => {
  let it: Watched, folder: string;
  let loaded: string[] = [];
  before(async () => {
    folder = makeLarge();
    it = await watched(await sharedBrowser());
    it.page.on('request', (request) => {
      const found = /\/data\/([a-z]+)[^/]*\.js$/.exec(request.url());
      if (found) loaded.push(found[1] ?? '');
    });
  });
  after(() => it?.close());

  /** Text of a part of the page in one of the two forms of the report. */
  async function textOf(form: 'whole' | 'beside', hash: string): Promise<string> {
    loaded = [];
    await open(it.page, join(folder, form), hash);
    const text = await it.page.locator('#page').innerText();
    return text.replaceAll(join(folder, form), 'RUN');
  }

  const tabs = async (): Promise<string[]> => {
    await open(it.page, join(folder, 'beside'));
    return it.page.locator('nav a[href^="#"]').evaluateAll((list) => list.map((a) => a.getAttribute('href') ?? ''));
  };

  test('shows in every tab what the page of a small run shows', async () => {
    const all = await tabs();
    for (const wanted of ['#scoreboard', '#contacts', '#ledger']) assert.ok(all.includes(wanted), wanted);
    for (const hash of all) {
      const whole = await textOf('whole', hash);
      assert.ok(whole.length > 100, hash);
      assert.equal(await textOf('beside', hash), whole, hash);
    }
    assert.deepEqual(it.faults, []);
  });

  test('loads its lists where they are shown alone', async () => {
    for (const [hash, expected] of [
      ['#scoreboard', false],
      ['#cost', false],
      ['#contacts', true],
      ['#ledger', true],
    ] as const) {
      await textOf('beside', hash);
      assert.equal(loaded.includes('lists'), expected, hash);
      await textOf('whole', hash);
      assert.ok(!loaded.includes('lists') && !loaded.includes('cases'), hash);
    }
    await textOf('beside', '#ledger');
    assert.ok(!loaded.includes('cases'), 'the ledger needs no case');
    assert.deepEqual(it.faults, []);
  });
});
