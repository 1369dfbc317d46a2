// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pages by the rules of axe-core: contrast, names of controls, headings, tables; light and dark, on a desktop and a phone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import {
  makeBench,
  makeCollide,
  makeHistory,
  makeSolve,
  makeSynthetic,
  type Opened,
  open,
  reportOf,
  skip,
  smokeRun,
  watched,
} from '../browser.ts';

const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const looks = (['light', 'dark'] as const).flatMap((colorScheme) => [
  { colorScheme, viewport: { width: 1400, height: 900 } },
  { colorScheme, viewport: { width: 390, height: 844 } },
]);

interface Finding {
  id: string;
  impact: string;
  nodes: { html: string }[];
}

/** Findings of a page, a line each: "serious color-contrast, 3: <first element>". */
async function findings(it: Opened, hash: string): Promise<string[]> {
  const lines: string[] = [];
  for (const look of looks) {
    const { page, close } = await watched(it.browser, look);
    await open(page, it.run, hash);
    await page.evaluate(axe);
    const found = (await page.evaluate(
      "axe.run(document, { resultTypes: ['violations'] }).then((r) => r.violations)",
    )) as Finding[];
    const where = `${look.colorScheme}, ${look.viewport.width} px`;
    for (const f of found) lines.push(`${where}: ${f.impact} ${f.id}, ${f.nodes.length}: ${f.nodes[0]?.html}`);
    const wide = await page.evaluate('document.documentElement.scrollWidth');
    if (Number(wide) > look.viewport.width) lines.push(`${where}: ${wide} px wide`);
    await close();
  }
  return lines;
}

describe('a run has no finding of axe-core', { skip }, () => {
  const it = reportOf(smokeRun);
  const tabs = ['', '#scoreboard', '#cost', '#contacts', '#ledger', '#method', '#glossary'];
  for (const hash of [...tabs, '#/scenario/free_flight', '#/scenario/box_stack', '#/engine/rigor', '#/engine/box2d'])
    test(hash || 'the overview', async () => assert.deepEqual(await findings(it, hash), []));
});

describe('a run with every bad ending has none', { skip }, () => {
  const it = reportOf(() => makeSynthetic('accessible_endings'));
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a bench has none', { skip }, () => {
  const it = reportOf(() => makeBench('accessible_bench'));
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a history has none', { skip }, () => {
  const it = reportOf(() => makeHistory('accessible_history'));
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of collision queries has none', { skip }, () => {
  const it = reportOf(() => makeCollide('accessible_collide'));
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of contact problems has none', { skip }, () => {
  const it = reportOf(() => makeSolve('accessible_solve').folder);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});
