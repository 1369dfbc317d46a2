// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The page of `rigor solve`: a row for each solver of the record, and the residual over iterations and over time.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import type { SolveProblem } from '../../src/solve/data.ts';
import { solved } from '../../src/solve/lines.ts';
import { makeSolve, reportOf, screenshots, skip } from '../browser.ts';

describe('the page of a contact problem', { skip }, () => {
  let record: { problems: SolveProblem[] };
  const it = reportOf(() => {
    const { folder, json } = makeSolve();
    record = JSON.parse(json);
    return folder;
  });

  test('has a row for each solver, with its last residual', async () => {
    await it.open();
    const answers = record.problems[0]?.answers ?? [];
    assert.ok(answers.length >= 2);
    assert.equal(await it.page.locator('.problem tbody tr').count(), answers.length);
    it.clean();
  });

  test('draws the residual over iterations and over time', async () => {
    await it.open();
    const cards = it.page.locator('.problem .chart');
    assert.equal(await cards.count(), 2);
    await it.page.waitForSelector('.problem .chart canvas');
    const lines = solved(record.problems[0]?.answers ?? []).length;
    assert.ok(lines >= 2);
    assert.equal(await it.page.locator('.problem .lines span').count(), lines);
    await it.page.screenshot({ path: join(screenshots, 'solve.png') });
    it.clean();
  });
});
