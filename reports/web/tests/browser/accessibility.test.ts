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
  reportOf,
  skip,
  smokeRun,
} from '../browser.ts';

const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const wide = { width: 1400, height: 900 };
const narrow = { width: 390, height: 844 };
const colours = { runOnly: ['color-contrast', 'link-in-text-block'] };
/** All rules at both widths, and those about colours in each colour scheme at each width. */
const looks = [
  { colorScheme: 'light', viewport: wide, rules: {} },
  { colorScheme: 'dark', viewport: wide, rules: colours },
  { colorScheme: 'dark', viewport: narrow, rules: {} },
  { colorScheme: 'light', viewport: narrow, rules: colours },
] as const;

interface Finding {
  id: string;
  impact: string;
  nodes: { html: string }[];
}

/** Findings of a page, a line each: "serious color-contrast, 3: <first element>". */
async function findings(it: Opened, hash: string): Promise<string[]> {
  const lines: string[] = [];
  const { page } = it;
  await (hash ? it.follow(hash) : it.open());
  if (await page.evaluate(() => !('axe' in window))) await page.evaluate(axe);
  for (const { colorScheme, viewport, rules } of looks) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize(viewport);
    // Charts follow the page's width when they are notified of it, on a busy machine some seconds later.
    const fits = page.waitForFunction((w) => document.documentElement.scrollWidth <= w, viewport.width);
    const found = (await fits.then(
      () =>
        page.evaluate(`axe.run(document, ${JSON.stringify({ resultTypes: ['violations'], ...rules })})
        .then((r) => r.violations)`),
      async () => [{ id: 'width', impact: 'serious', nodes: [{ html: 'the page' }] }],
    )) as Finding[];
    for (const f of found)
      lines.push(`${colorScheme}, ${viewport.width} px: ${f.impact} ${f.id}, ${f.nodes.length}: ${f.nodes[0]?.html}`);
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
  const it = reportOf(makeSynthetic);
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a bench has none', { skip }, () => {
  const it = reportOf(makeBench);
  test('the overview', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a history has none', { skip }, () => {
  const it = reportOf(makeHistory);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of collision queries has none', { skip }, () => {
  const it = reportOf(makeCollide);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});

describe('a page of contact problems has none', { skip }, () => {
  const it = reportOf(() => makeSolve().folder);
  test('the page', async () => assert.deepEqual(await findings(it, ''), []));
});
